"""Planning for a goal without a program: breadth-first search over the theory's primitive actions."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from golc.diagnostics import LimitError
from golc.planning import conditional
from golc.planning.dead_end import DeadEnd
from golc.planning.ground_actions import GroundActions
from golc.planning.limits import Budget, Limits
from golc.planning.plans import Outcome, Plan, Step, plan_of
from golc.program.blame import false_parts
from golc.program.program import Program
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.statements import Strategy
from golc.theory.terms import Term
from golc.theory.theory import BasicActionTheory

MOST_REASONS = 10
"""How many impossible actions are named where a search got stuck."""


@dataclass(frozen=True, slots=True)
class _Reached:
    """A state, how it was reached first, and after how many actions."""

    state: State
    label: Step | None
    before: _Reached | None
    depth: int

    def steps(self) -> tuple[Step, ...]:
        """The steps that lead here, in order."""
        found: list[Step] = []
        step: _Reached | None = self
        while step is not None and step.label is not None:
            found.append(step.label)
            step = step.before
        return tuple(reversed(found))


class GoalPlanning:
    """A search for the shortest plan that makes a formula true; iterate over it, then read its ``outcome``.

    The first in the order of the ground actions among equally short ones. It may wait for what is expected, and it is a
    conditional plan if actions sense what is not known, unless ``conformant``. ``start``: where it begins, by default
    the initial state. Raises ``UserError`` for an action whose instances cannot be listed, and while iterating
    ``ProgramError`` where the language says that something is an error.
    """

    def __init__(
        self,
        theory: BasicActionTheory,
        goal: Term,
        limits: Limits,
        conformant: bool = False,
        start: State | None = None,
    ) -> None:
        self.outcome = Outcome(proof="no sequence of actions makes it true")
        self._dynamics = Dynamics(theory)
        self._goal = goal
        self._start = start
        self._budget = Budget(limits)
        self._deepest: tuple[tuple[str, ...], State] | None = None
        self._actions = GroundActions(self._dynamics, conformant)
        with deep_recursion():
            self._holds: Callable[..., bool] = self._dynamics.knowing.condition(self._goal, 0)

    def __iter__(self) -> Iterator[Plan]:
        outcome, found = self.outcome, None
        try:
            with deep_recursion(EVALUATION):
                found = self._search()
            if found is not None:
                outcome.plans = 1
            elif self._budget.cut:
                outcome.gave_up = f"no plan of more than {self._budget.limits.steps} steps was considered"
        except LimitError as error:
            outcome.gave_up = str(error)
        outcome.expanded, outcome.seconds = self._budget.expanded, self._budget.elapsed
        if found is None:
            self._explain()
        else:
            yield found

    def _search(self) -> Plan | None:
        initial = self._dynamics.initial() if self._start is None else self._start
        if self._holds(initial, ()):
            return Plan(())
        if self._actions.branch or self._actions.waits:
            return self._conditional(initial)
        reached = self._breadth_first(_Reached(initial, None, None, 0))
        return None if reached is None else Plan(reached.steps())

    def _breadth_first(self, start: _Reached) -> _Reached | None:
        seen = {start.state}
        open_ = deque([start])
        reached = start
        try:
            while open_:
                self._budget.spend()
                reached = open_.popleft()
                for label, state in self._actions.successors(reached.state):
                    if state not in seen and self._budget.allows(reached.depth + 1):
                        after = _Reached(state, label, reached, reached.depth + 1)
                        if self._holds(state, ()):
                            return after
                        seen.add(state)
                        open_.append(after)
        finally:
            self._deepest = tuple(map(str, reached.steps())), reached.state
        return None

    def _conditional(self, initial: State) -> Plan | None:
        nothing = Program().nil
        goal = conditional.Goal(self._actions, self._holds)
        start, dead_end = (nothing, initial), DeadEnd()
        path = conditional.find(goal, self._dynamics, Strategy.SHORTEST, start, self._budget, dead_end)
        if path is not None:
            return plan_of(path, self._dynamics)
        if dead_end.node is not None:
            self._deepest = dead_end.way, dead_end.state
        return None

    def _explain(self) -> None:
        """Where the search came last, what is false of the goal there, and what is impossible if everything is."""
        if self._deepest is None:
            return
        self.outcome.stuck, state = self._deepest
        self.outcome.reasons = false_parts(self._dynamics, state, self._goal)
        if next(self._actions.forks(state), None) is None:
            self.outcome.reasons += self._actions.why_not(state, MOST_REASONS)
