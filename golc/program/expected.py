"""Expected exogenous actions: what look-ahead counts on when a program can only wait."""

from __future__ import annotations

import itertools
from typing import NamedTuple

from golc.situation.dynamics import Args, Dynamics
from golc.situation.worlds import State


class Event(NamedTuple):
    """An exogenous action with its arguments."""

    action: str
    args: Args


class Events:
    """The exogenous actions of a theory that are declared ``expected``; true if there are any."""

    def __init__(self, dynamics: Dynamics) -> None:
        self._dynamics = dynamics
        self._actions = [action for action in dynamics.theory.actions.values() if action.expected]
        self._last: tuple[State, Event | None] | None = None

    def __bool__(self) -> bool:
        return bool(self._actions)

    def first(self, state: State) -> Event | None:
        """The first that is possible, in the order of declaration, then of the parameters' types; none if none is."""
        if not self._actions:
            return None
        if self._last is None or self._last[0] is not state:
            self._last = state, self._possible(state)
        return self._last[1]

    def _possible(self, state: State) -> Event | None:
        for action in self._actions:
            possible = self._dynamics.possible_function(action.name)
            for args in itertools.product(*[parameter.type.values for parameter in action.parameters]):
                if possible(state, *args):
                    return Event(action.name, args)
        return None
