"""Bad situations, which look-ahead never enters."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable

from golc.situation.dynamics import Args, Dynamics
from golc.situation.layout import State
from golc.theory.recursion import deep_recursion
from golc.theory.theory import Prune

Holds = Callable[[State, Args], bool]


class Prunes:
    """The prunes of a theory, compiled."""

    def __init__(self, dynamics: Dynamics) -> None:
        theory = dynamics.theory
        self._everywhere: list[tuple[str, Holds]] = []
        self._after: defaultdict[str, list[tuple[str, Holds]]] = defaultdict(list)
        with deep_recursion():
            for prune in theory.prunes.values():
                depth = len(theory.actions[prune.action].parameters) if prune.action else 0
                holds = dynamics.compiler.term(prune.condition, depth)
                (self._after[prune.action] if prune.action else self._everywhere).append((prune.name, holds))

    def __bool__(self) -> bool:
        return bool(self._everywhere or self._after)

    def hit(self, before: State, action: str, args: Args, after: State) -> str | None:
        """The name of the first prune that holds in a state to which an action has led from another one, if one does."""
        for name, holds in self._everywhere:
            if holds(after, ()):
                return name
        ...
