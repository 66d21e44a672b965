"""Bad situations, which look-ahead never enters."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from golc.situation.dynamics import Args, Dynamics
from golc.situation.happened import Happened, NotKnownError
from golc.situation.knowing import placed
from golc.situation.worlds import State, survey
from golc.theory.recursion import deep_recursion
from golc.theory.terms import Before, subterms
from golc.theory.theory import Prune

Holds: TypeAlias = Callable[[State, Args, State], bool]
"""Whether a prune is known to hold: a function of the state before an action, the arguments that the prune speaks of,
and the state after it."""


class Prunes:
    """The prunes of a theory, compiled."""

    def __init__(self, dynamics: Dynamics) -> None:
        self._dynamics = dynamics
        self._prunes: list[tuple[Prune, Holds]] = []
        with deep_recursion():
            for prune in dynamics.theory.prunes.values():
                speaks_of_before = any(isinstance(term, Before) for term in subterms(prune.condition))
                self._prunes.append((prune, (self._between if speaks_of_before else self._afterwards)(prune)))

    def hit(self, before: State, action: str, args: Args, after: State) -> str | None:
        """The first prune that holds in the state to which an action has led, by its name; none if none does."""
        for prune, holds in self._prunes:
            if prune.action in (None, action) and holds(before, args if prune.action else (), after):
                return prune.name
        return None

    def _depth(self, prune: Prune) -> int:
        return 0 if prune.action is None else len(self._dynamics.theory.actions[prune.action].parameters)

    def _afterwards(self, prune: Prune) -> Holds:
        holds = self._dynamics.knowing.condition(prune.condition, self._depth(prune))
        return lambda before, args, after: bool(holds(after, args))

    def _between(self, prune: Prune) -> Holds:
        function = self._dynamics.compiler.term(prune.condition, self._depth(prune))

        def holds(before: State, args: Args, after: State) -> bool:
            try:
                with placed((prune.condition,)):
                    return all(answer for _, answer in survey(after, lambda w: function(Happened(w, before), args)))
            except NotKnownError:
                return False

        return holds
