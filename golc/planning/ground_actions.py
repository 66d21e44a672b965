"""The ground actions of a theory: what can be done in a state without a program."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from golc.diagnostics import Code, Diagnostic, UserError
from golc.planning.plans import Step
from golc.program.ahead import may_branch
from golc.program.blame import Blocked, impossible, pruned
from golc.program.expected import Events
from golc.program.labels import Act, Expect
from golc.program.prunes import Prunes
from golc.situation.dynamics import Dynamics, Outcome
from golc.situation.worlds import State
from golc.theory.fitting import MOST_INSTANCES, combinations
from golc.theory.forms import type_text
from golc.theory.theory import Action


@dataclass(frozen=True)
class _Ground:
    """An action with arguments, and the compiled function that says whether it is possible."""

    label: Act
    possible: Callable[..., bool]


class GroundActions:
    """Every primitive action with all its arguments, in the order of declaration, then of the parameters' types, the
    last argument fastest; after them, to wait for what is expected.

    ``branch``: whether an action may tell something that is not known; with ``conformant`` nothing is told. ``waits``:
    whether anything is ever expected. Raises ``UserError`` for an action whose instances cannot be listed.
    """

    def __init__(self, dynamics: Dynamics, conformant: bool = False) -> None:
        self._dynamics = dynamics
        self._prunes = Prunes(dynamics)
        self._events = Events(dynamics)
        self.waits = bool(self._events)
        self.branch = may_branch(dynamics) and not conformant
        actions = [action for action in dynamics.theory.actions.values() if not action.exogenous]
        _check_finite(actions)
        self._ground = [ground for action in actions for ground in self._instances(action)]

    def _instances(self, action: Action) -> Iterator[_Ground]:
        possible = self._dynamics.possible_function(action.name)
        for args in itertools.product(*[parameter.type.values for parameter in action.parameters]):
            yield _Ground(Act(action.name, args, action.span), possible)

    def successors(self, state: State) -> Iterator[tuple[Step, State]]:
        """What can be done in a state without entering a bad situation, with the state after it, as long as it is not
        known what the action senses."""
        for ground in self._ground:
            label = ground.label
            if ground.possible(state, *label.args):
                after = self._dynamics.progress(state, label.action, label.args)
                if self._prune(state, label, after) is None:
                    yield label, after
        if (event := self._events.first(state)) is not None:
            expected = Expect(event.action, event.args, self._dynamics.theory.actions[event.action].span)
            after = self._dynamics.progress(state, event.action, event.args)
            if self._prune(state, expected, after) is None:
                yield expected, after

    def forks(self, state: State) -> Iterator[tuple[Step, list[Outcome]]]:
        """The same, with what may be sensed."""
        for label, after in self.successors(state):
            outcomes = [Outcome((), after)]
            if self.branch and isinstance(label, Act):
                outcomes = self._dynamics.outcomes(after, label.action, label.args)
            if all(self._prune(state, label, outcome.state) is None for outcome in outcomes):
                yield label, outcomes

    def why_not(self, state: State, most: int) -> list[Blocked]:
        """Why not even one of the first actions, at most so many, can be done in a state."""
        return [self._why_not(state, ground) for ground in self._ground[:most]]

    def _prune(self, before: State, label: Step, after: State) -> str | None:
        return self._prunes.hit(before, label.action, label.args, after)

    def _why_not(self, state: State, ground: _Ground) -> Blocked:
        label = ground.label
        if not ground.possible(state, *label.args):
            return impossible(self._dynamics, state, label.action, label.args)
        after = self._dynamics.progress(state, label.action, label.args)
        for outcome in [Outcome((), after), *self._dynamics.outcomes(after, label.action, label.args)]:
            prune = self._prune(state, label, outcome.state)
            if prune is not None:
                return pruned(label.span, prune, label, outcome.results)
        raise AssertionError(label)


def _check_finite(actions: list[Action]) -> None:
    """Every instance of every action can be tried; raises ``UserError`` otherwise."""
    findings = []
    for action in actions:
        for parameter in action.parameters:
            if not parameter.type.finite:
                message = f"`{action.name}` cannot be used to plan for a goal: `{parameter.name}` has no list of values"
                findings.append(
                    Diagnostic(
                        Code.BAD_TYPE,
                        message,
                        parameter.span,
                        marker=f"`{type_text(parameter.type, parameter.span)}` has no end",
                        help="give it an interval or an enumeration as its type, or plan with a procedure",
                    )
                )
        if (combinations([parameter.type for parameter in action.parameters]) or 0) > MOST_INSTANCES:
            message = f"`{action.name}` has more than {MOST_INSTANCES} instances, too many to plan for a goal"
            findings.append(Diagnostic(Code.BAD_TYPE, message, action.span))
    if findings:
        raise UserError(*findings)
