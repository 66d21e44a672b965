"""A state in a few lines, for people."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.types import Value, show, show_call

FEW = 4
"""So many values of one fluent are all shown."""

Known: TypeAlias = tuple[tuple[Value, ...], Value]
"""Arguments of a ground fluent, and its value."""


@dataclass(frozen=True)
class Family:
    """All ground fluents of one name in a state: those that are worth mentioning, and the value of all others.

    ``relational``: all are true or false; then the true ones are mentioned. ``whole``: there are no others.
    """

    name: str
    mentioned: tuple[Known, ...]
    usual: Value
    relational: bool
    whole: bool


def families(dynamics: Dynamics, state: State) -> Iterator[Family]:
    """The fluents in the order of declaration, as far as they have any instances."""
    values: dict[str, list[Known]] = {}
    for (name, args), value in dynamics.values(state):
        values.setdefault(name, []).append((args, value))
    for name, known in values.items():
        yield _family(name, known)


def _family(name: str, known: list[Known]) -> Family:
    if known[0][0] == ():
        return Family(name, tuple(known), known[0][1], False, True)
    if all(isinstance(value, bool) for _, value in known):
        holds = tuple([each for each in known if each[1]])
        return Family(name, holds, False, True, len(holds) == len(known))
    usual = Counter(value for _, value in known).most_common(1)[0][0]
    others = tuple([each for each in known if each[1] != usual])
    whole = bool(others) and len(known) <= FEW
    return Family(name, tuple(known) if whole else others, usual, False, whole)


def summary(dynamics: Dynamics, state: State) -> Iterator[str]:
    """A state in a few lines: fluents without arguments together, a relational one by where it holds, any other by its
    usual value and the exceptions."""
    found = list(families(dynamics, state))
    plain = [f"{family.name} = {show(family.usual)}" for family in found if _is_plain(family)]
    if plain:
        yield ", ".join(plain)
    for family in found:
        if not _is_plain(family):
            yield _line(family)


def _is_plain(family: Family) -> bool:
    return family.whole and family.mentioned[0][0] == ()


def _line(family: Family) -> str:
    name, usual = family.name, show(family.usual)
    if family.relational:
        holds = [arguments(args) for args, _ in family.mentioned]
        return f"{name} holds for {', '.join(holds) or 'nothing'}"
    if not family.mentioned:
        return f"every {name} = {usual}"
    shown = [f"{show_call(name, args)} = {show(value)}" for args, value in family.mentioned]
    return ", ".join(shown if family.whole else [*shown, f"all other {name} = {usual}"])


def arguments(args: tuple[Value, ...]) -> str:
    """``4``, or ``(4, left)``: the arguments of a ground fluent without its name."""
    return show(args[0]) if len(args) == 1 else show_call("", args)
