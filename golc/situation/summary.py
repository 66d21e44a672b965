"""A state in a few lines, for people."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.types import Value, show, show_call

FEW = 4
"""So many values of one fluent are all shown."""


def summary(dynamics: Dynamics, state: State) -> Iterator[str]:
    """A state in a few lines: fluents without arguments together, a relational one by where it holds, any other by its
    usual value and the exceptions."""
    values: dict[str, list[tuple[tuple[Value, ...], Value]]] = {}
    for (name, args), value in dynamics.values(state):
        values.setdefault(name, []).append((args, value))
    plain = [f"{name} = {show(known[0][1])}" for name, known in values.items() if known[0][0] == ()]
    if plain:
        yield ", ".join(plain)
    for name, known in values.items():
        if known[0][0] != ():
            yield _family(name, known)


def _family(name: str, known: list[tuple[tuple[Value, ...], Value]]) -> str:
    """All ground fluents of one name."""
    if all(isinstance(value, bool) for _, value in known):
        holds = [_arguments(args) for args, value in known if value]
        return f"{name} holds for {', '.join(holds)}" if holds else f"{name} holds for nothing"
    usual = Counter(value for _, value in known).most_common(1)[0][0]
    others = [(args, value) for args, value in known if value != usual]
    if not others:
        return f"every {name} = {show(usual)}"
    shown = [f"{show_call(name, args)} = {show(value)}" for args, value in (known if len(known) <= FEW else others)]
    return ", ".join(shown if len(known) <= FEW else [*shown, f"all other {name} = {show(usual)}"])


def _arguments(args: tuple[Value, ...]) -> str:
    return show(args[0]) if len(args) == 1 else show_call("", args)
