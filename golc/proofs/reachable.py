"""The states that can be reached: from the initial one, by all actions that are possible, in any order.

A state is what an agent may know then; with a complete initial theory, and without ``unknown``, that is one world. The
agent does a primitive action if it knows that it is possible; an exogenous one happens if it is possible in some
world. An action whose effects fail is an error of the theory, as is one that breaks an invariant: nothing follows it.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any, TypeAlias

from golc.diagnostics import Code, ProgramError, counted
from golc.proofs.cases import Case, explore
from golc.proofs.domains import Domain, Some, any_of, domain
from golc.proofs.effort import Effort
from golc.proofs.symbols import NotDecidedError, Range, Symbol
from golc.situation.dynamics import Args, Dynamics
from golc.situation.worlds import State, TooManyCasesError, Worlds
from golc.theory.errors import NotExecutedError
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.terms import Variable, subterms
from golc.theory.theory import Action
from golc.theory.types import Value, show

Condition: TypeAlias = Callable[..., Any]

MOST_STATES = 10_000
"""States that are gone through."""

MOST_VALUES = 2_000_000
"""Values in all states together: of each ground fluent one, and the elements of sets and lists."""

MOST_EFFORT = 200_000
"""Parts of terms that all actions and invariants together may have, each time that they are evaluated."""

FEW = (0, 1, 2, -1)
"""Arguments that are tried where all integers cannot be."""

SECONDS = 3.0
"""How long to go on finding states."""


@dataclass(frozen=True)
class Scope:
    """How many states were gone through; why these are not all, if they are not.

    ``narrowed``: how many questions were answered with regard to what can be reached.
    """

    states: int
    reason: str | None = None
    narrowed: int = 0

    @property
    def whole(self) -> bool:
        """Whether no other state can be reached."""
        return self.reason is None

    def __str__(self) -> str:
        if self.reason is None and self.states == 1:
            return "in the only state that can be reached"
        if self.reason is None:
            return f"in all {counted(self.states, 'state')} that can be reached"
        narrowed = f"; {counted(self.narrowed, 'question')} answered by those that can" if self.narrowed else ""
        return f"in all states: {self.reason}{narrowed}"


@dataclass(frozen=True)
class Reached:
    """A state, and how it was reached: by which action, in words, from which state; the initial one by none."""

    state: State
    by: str = ""
    action: tuple[str, Args] | None = None
    before: Reached | None = None
    actions: int = 0

    def steps(self) -> list[Reached]:
        """The states from the first one that is not the initial one to this one; no others lead here in fewer."""
        found, here = [], self
        while here.before is not None:
            found.append(here)
            here = here.before
        return found[::-1]

    @property
    def way(self) -> tuple[str, ...]:
        """The actions from the initial state to this one."""
        return tuple([step.by for step in self.steps()])


def reachable(dynamics: Dynamics, seconds: float = SECONDS) -> tuple[list[Reached], Scope]:
    """The states that can be reached, those that take fewer actions first, as far as they can be gone through."""
    return _Search(dynamics, time.monotonic() + seconds).run()


def leads_on(dynamics: Dynamics, reached: Reached) -> bool:
    """Whether the actions that lead to a state do so in a theory that leaves nothing open, which need not be the one
    in which it was found."""
    state = dynamics.initial()
    for step in reached.steps():
        assert step.action is not None
        try:
            if not dynamics.possible(state, *step.action):
                return False
            state = dynamics.progress(state, *step.action)
        except ProgramError:
            return False
        if not all(_is_true(condition, state) for condition in _invariants(dynamics)):
            return False
    return True


@dataclass
class _Search:
    dynamics: Dynamics
    deadline: float
    found: list[Reached] = field(default_factory=list)
    reason: str | None = None
    """Why what was found is not all."""
    _seen: set[State] = field(default_factory=set)
    _values: int = 0

    def run(self) -> tuple[list[Reached], Scope]:
        """Breadth first."""
        try:
            with deep_recursion(EVALUATION):
                self._explore()
        except NotDecidedError as error:
            self._not_all(str(error))
        except TooManyCasesError as error:
            self._not_all(f"more than {error.most} worlds are possible in one")
        except ProgramError as error:
            self._not_all(error.diagnostic.message)
        return self.found, Scope(len(self.found), self.reason)

    def _not_all(self, reason: str) -> None:
        self.reason = self.reason or reason

    def _explore(self) -> None:
        theory = self.dynamics.theory
        effort = Effort(theory)
        actions = [action for action in theory.actions.values() if action.effects or action.senses]
        bodies = [theory.definitions[name].body for name in theory.invariants]
        if sum(map(effort.of_action, actions)) + effort.of(bodies) > MOST_EFFORT:
            raise NotDecidedError("what the actions do takes too long to evaluate")
        holds = _invariants(self.dynamics)
        instances = {action.name: _domains(action) for action in actions}
        self._add(Reached(self.dynamics.initial()))
        for here in self.found:
            for action in actions:
                domains = instances[action.name]
                try:
                    self._follow(here, action, domains, holds)
                except _TooLongError:
                    raise
                except NotDecidedError as error:
                    if Range not in map(type, domains):
                        raise
                    self._not_all(f"`{action.name}` has more instances than can be gone through: {error}")
                    instances[action.name] = [Some(FEW) if isinstance(of, Range) else of for of in domains]
                    self._follow(here, action, instances[action.name], holds)

    def _follow(self, here: Reached, action: Action, domains: list[Domain], holds: list[Condition]) -> None:
        """What the instances of an action lead to."""
        for case, successors in explore(partial(Case, domains), partial(self._successors, here.state, action)):
            if not case.whole:
                self._not_all(f"`{action.name}` has more instances than can be gone through")
            if time.monotonic() > self.deadline:
                raise _TooLongError("it takes too long to find those that can be reached")
            for by, args, state in successors:
                if state not in self._seen and all(_is_true(condition, state) for condition in holds):
                    self._add(Reached(state, by, (action.name, args), here, here.actions + 1))

    def _add(self, reached: Reached) -> None:
        self._values += _size(reached.state)
        if len(self.found) == MOST_STATES or self._values > MOST_VALUES:
            raise _TooLongError(f"more than {counted(len(self.found), 'state')} can be reached")
        self.found.append(reached)
        self._seen.add(reached.state)

    def _successors(self, state: State, action: Action, case: Case) -> list[tuple[str, Args, State]]:
        """The states after an action, each with the action as text, and its arguments."""
        parameters = range(len(action.parameters))
        args = tuple([case[slot] for slot in parameters])
        found = [(sensed, _plain(after)) for sensed, after in self._after(state, action, args)]
        shown = tuple([case.value(slot) for slot in parameters])
        call = self.dynamics.call(action.name, shown) if found else ""
        return [(f"`{call}`{sensed}", shown, after) for sensed, after in found]

    def _after(self, state: State, action: Action, args: Args) -> list[tuple[str, State]]:
        """What an action leads to if it can happen and its effects succeed, each with what is sensed in words."""
        dynamics, name = self.dynamics, action.name
        try:
            before: State | None = state
            if action.exogenous:
                before = dynamics.witness(state, name, args)
            elif not dynamics.possible(state, name, args):
                before = None
            if before is None:
                return []
            after = dynamics.progress(before, name, args)
            outcomes = dynamics.outcomes(after, name, args) if action.senses else []
        except ProgramError as error:
            _tell(error)
            return []
        if not outcomes:
            return [("", after)]
        sensed = [f" (senses {', '.join(map(show, outcome.results))})" for outcome in outcomes]
        return [(words if len(outcomes) > 1 else "", o.state) for words, o in zip(sensed, outcomes, strict=True)]


def _invariants(dynamics: Dynamics) -> list[Condition]:
    theory = dynamics.theory
    return [dynamics.knowing.condition(theory.definitions[name].body, 0) for name in theory.invariants]


class _TooLongError(NotDecidedError):
    """The search is over."""


def _domains(action: Action) -> list[Domain]:
    """What the parameters of an action may be; one value each of those that do not matter."""
    terms = [*action.preconditions, *action.senses, *[term for effect in action.effects for term in effect.terms]]
    levels = {part.level for term in terms for part in subterms(term) if isinstance(part, Variable)}
    domains = [domain(parameter.type) for parameter in action.parameters]
    return [of if level in levels else (any_of(of),) for level, of in enumerate(domains)]


def _is_true(condition: Condition, state: State) -> bool:
    try:
        return bool(condition(state, ()))
    except ProgramError as error:
        _tell(error)
        return False


def _tell(error: ProgramError) -> None:
    """Raise an error that says nothing about the theory."""
    if isinstance(error, NotExecutedError) or error.diagnostic.code is Code.TOO_MANY_WORLDS:
        raise error


def _size(state: State) -> int:
    """How many values make up a state."""
    rows = [row for factor in state.factors for row in factor.rows] if isinstance(state, Worlds) else [state]
    return sum(1 + (len(value) if isinstance(value, tuple | frozenset) else 0) for row in rows for value in row)


def _plain(state: State) -> State:
    """A state without integers of which only an interval is known."""
    if isinstance(state, Worlds):
        if any(isinstance(value, Symbol) for value in state.base):
            raise NotDecidedError("any integer becomes the value of a fluent")
        return state
    return tuple([_known(value) for value in state])


def _known(value: Value) -> Value:
    match value:
        case Symbol():
            return int(value)
        case tuple():
            return tuple([_known(element) for element in value])
        case frozenset():
            return frozenset([_known(element) for element in value])
        case _:
            return value
