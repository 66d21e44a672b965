"""Planning for a goal without a program: breadth-first search over the theory's primitive actions."""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from golc.diagnostics import Code, Diagnostic, LimitError, UserError
from golc.planning.limits import Budget, Limits
from golc.planning.plans import Outcome, Plan
from golc.program.blame import Blocked, false_parts, impossible, pruned
from golc.program.labels import Act
from golc.program.prunes import Prunes
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.fitting import size
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.theory import Action, BasicActionTheory

MOST_INSTANCES = 100_000
"""How many ground actions of one action are tried in each state."""

MOST_REASONS = 10
"""How many impossible actions are named where a search got stuck."""


@dataclass(frozen=True)
class _Ground:
    """An action with arguments, and the compiled function that says whether it is possible."""

    label: Act
    possible: Callable[..., bool]


@dataclass(frozen=True, slots=True)
class _Reached:
    """A state, how it was reached first, and after how many actions."""

    state: State
    label: Act | None
    before: _Reached | None
    depth: int

    def actions(self) -> tuple[Act, ...]:
        """The actions that lead here, in order."""
        found: list[Act] = []
        step: _Reached | None = self
        while step is not None and step.label is not None:
            found.append(step.label)
            step = step.before
        return tuple(reversed(found))


class GoalPlanning:
    """A search for the shortest plan that makes a definition true; iterate over it, then read its ``outcome``.

    The first in the order of declaration, then of the parameters' types, last argument fastest, among equally short
    ones. Raises ``UserError`` for an action whose instances cannot be listed, and while iterating ``ProgramError``
    where the language says that something is an error.
    """

    def __init__(self, theory: BasicActionTheory, goal: str, limits: Limits) -> None:
        self.outcome = Outcome(proof="no sequence of actions makes it true")
        self._dynamics = Dynamics(theory)
        self._goal = theory.definitions[goal].body
        self._budget = Budget(limits)
        self._deepest: _Reached | None = None
        self._prunes = Prunes(self._dynamics)
        actions = [action for action in theory.actions.values() if not action.exogenous]
        _check_finite(actions)
        self._ground = [ground for action in actions for ground in self._instances(action)]
        with deep_recursion():
            self._holds: Callable[..., bool] = self._dynamics.knowing.condition(self._goal, 0)

    def __iter__(self) -> Iterator[Plan]:
        outcome = self.outcome
        try:
            found = self._search()
            if found is not None:
                outcome.plans = 1
            elif self._budget.cut:
                outcome.gave_up = f"no plan of more than {self._budget.limits.steps} steps was considered"
        except LimitError as error:
            found, outcome.gave_up = None, str(error)
        outcome.expanded, outcome.seconds = self._budget.expanded, self._budget.elapsed
        if found is None:
            self._explain()
        else:
            yield Plan(found.actions())

    def _instances(self, action: Action) -> Iterator[_Ground]:
        possible = self._dynamics.possible_function(action.name)
        for args in itertools.product(*[parameter.type.values for parameter in action.parameters]):
            yield _Ground(Act(action.name, args, action.span), possible)

    def _search(self) -> _Reached | None:
        with deep_recursion(EVALUATION):
            start = _Reached(self._dynamics.initial(), None, None, 0)
            if self._holds(start.state, ()):
                return start
            seen = {start.state}
            open_ = deque([start])
            while open_:
                self._budget.spend()
                self._deepest = reached = open_.popleft()
                for after in self._successors(reached):
                    if after.state not in seen and self._budget.allows(after.depth):
                        if self._holds(after.state, ()):
                            return after
                        seen.add(after.state)
                        open_.append(after)
        return None

    def _successors(self, reached: _Reached) -> Iterator[_Reached]:
        state = reached.state
        for ground in self._ground:
            label = ground.label
            if ground.possible(state, *label.args):
                after = self._dynamics.progress(state, label.action, label.args)
                if self._prunes.hit(state, label.action, label.args, after) is None:
                    yield _Reached(after, label, reached, reached.depth + 1)

    def _explain(self) -> None:
        """Where the search came last, what is false of the goal there, and what is impossible if everything is."""
        deepest = self._deepest
        if deepest is None:
            return
        self.outcome.stuck = tuple(map(str, deepest.actions()))
        self.outcome.reasons = false_parts(self._dynamics, deepest.state, self._goal)
        if next(self._successors(deepest), None) is None:
            self.outcome.reasons += [self._why_not(deepest.state, ground) for ground in self._ground[:MOST_REASONS]]

    def _why_not(self, state: State, ground: _Ground) -> Blocked:
        """Why look-ahead does not do an action in a state."""
        label = ground.label
        if not ground.possible(state, *label.args):
            return impossible(self._dynamics, state, label.action, label.args)
        after = self._dynamics.progress(state, label.action, label.args)
        prune = self._prunes.hit(state, label.action, label.args, after)
        assert prune is not None
        return pruned(label.span, prune, label)


def _check_finite(actions: list[Action]) -> None:
    """Every instance of every action can be tried; raises ``UserError`` otherwise."""
    findings = []
    for action in actions:
        instances = 1
        for parameter in action.parameters:
            if not parameter.type.finite:
                message = f"`{action.name}` cannot be used to plan for a goal: `{parameter.name}` has no list of values"
                findings.append(
                    Diagnostic(
                        Code.BAD_TYPE,
                        message,
                        parameter.span,
                        marker=f"`{parameter.type}` has no end",
                        help="give it an interval or an enumeration as its type, or plan with a procedure",
                    )
                )
                instances = 0
            else:
                instances *= size(parameter.type)
        if instances > MOST_INSTANCES:
            message = f"`{action.name}` has more than {MOST_INSTANCES} instances, too many to plan for a goal"
            findings.append(Diagnostic(Code.BAD_TYPE, message, action.span))
    if findings:
        raise UserError(*findings)
