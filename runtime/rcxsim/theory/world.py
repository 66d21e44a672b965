"""The world as the theory describes it: a state of its own, which the host never sees."""

from __future__ import annotations

import random
from collections.abc import Sequence
from itertools import product
from math import prod
from typing import Any

from golc.diagnostics import ProgramError
from golc.nqc.numbering import implied
from golc.runtime.rcxsim.trace import Trace
from golc.situation.dynamics import Args, Dynamics
from golc.situation.layout import World
from golc.situation.worlds import State
from golc.theory.terms import Choice, FluentTerm
from golc.theory.theory import Action, BasicActionTheory
from golc.theory.types import Value, show, show_call

MOST_INFERRED = 1000
"""Exogenous actions with more instances than this are never taken to have happened unseen."""


class TheoryWorld:
    """What is true around the simulated brick; actions of either side change it by the theory's effects."""

    def __init__(self, theory: BasicActionTheory, chance: random.Random, trace: Trace) -> None:
        self.theory = theory
        self.dynamics = Dynamics(theory)
        self._chance = chance
        self.state = self._settled_by_chance(self.dynamics.initial())
        self._trace = trace
        changed = {effect.fluent for action in theory.actions.values() for effect in action.effects}
        left_open = {fluent.name for fluent in theory.fluents.values() if isinstance(fluent.initial, Choice)}
        self._facts = frozenset(theory.fluents) - changed - left_open
        self._settled: set[tuple[str, Args]] = set()
        self._elsewhere = [action for action in theory.actions.values() if _comes_from_elsewhere(theory, action)]

    def happen(self, action: str, args: Args, now: float, what: str) -> None:
        """An action takes place; if the theory says it cannot, that is told and its effects are tried all the same."""
        before, problem = self.state, None
        try:
            if not self.dynamics.possible(before, action, args):
                problem = "it is not possible here"
            self.state = self._settled_by_chance(self.dynamics.progress(before, action, args))
        except ProgramError as error:
            problem = error.diagnostic.message
        if not self.theory.actions[action].senses:
            self._settled = {(fluent, of) for fluent, of in self._settled if of}
        details: dict[str, Any] = {} if problem is None else {"problem": problem}
        self._trace.tell(now, what, action=show_call(action, args), changed=self._changes(before), **details)

    def _settled_by_chance(self, state: State) -> World:
        """The world is one way, whatever the theory leaves open."""
        return self.dynamics.realize(state, self._chance.randrange)

    def catch_up_with(self, action: str, args: Args, now: float) -> None:
        """The host begins an action. If that is impossible as far as the brick knows, something may have happened that
        only the host was told: an exogenous action from elsewhere that would make it possible is taken to have."""
        if self.possible(action, args):
            return
        for other in self._elsewhere:
            for of in product(*(parameter.type.values for parameter in other.parameters)):
                if self.possible(other.name, of) and self._makes_possible(other.name, of, action, args):
                    self.happen(other.name, of, now, "inferred")
                    return

    def _makes_possible(self, other: str, of: Args, action: str, args: Args) -> bool:
        try:
            return self.dynamics.possible(self.dynamics.progress(self.state, other, of), action, args)
        except ProgramError:
            return False

    def possible(self, action: str, args: Args) -> bool:
        """Whether an action can take place now."""
        try:
            return self.dynamics.possible(self.state, action, args)
        except ProgramError:
            return False

    def matters(self, action: str, args: Args, state: World | None = None) -> bool:
        """Whether an action can take place and would change something, now or in the given state."""
        state = self.state if state is None else state
        try:
            return self.dynamics.possible(state, action, args) and (
                self.dynamics.progress(state, action, args) != state
            )
        except ProgramError:
            return False

    def sense(self, action: str, args: Args, answers: Sequence[Value] | None) -> Value:
        """What a perfect device answers after the action; ``answers`` are the values that it has numbers for.

        What the theory leaves open chance has settled already. A sensed fluent that no action of the theory changes is
        a fact that only the world knows, whatever value the theory takes for it: chance settles it when it is sensed
        first. With arguments it speaks of some place or
        thing and stays so; without, it is what is in front of the sensor now, until anything else is done.
        """
        self._settle(action, args, answers)
        return self.dynamics.sense(self.state, action, args)[0]

    def _settle(self, action: str, args: Args, answers: Sequence[Value] | None) -> None:
        term = self.theory.actions[action].senses[0]
        if not isinstance(term, FluentTerm) or term.fluent not in self._facts:
            return
        fluent = (term.fluent, tuple(self.dynamics.interpreter.evaluate(arg, self.state, args) for arg in term.args))
        if fluent in self._settled:
            return
        self._settled.add(fluent)
        values = term.type.values if term.type.finite else ()
        choice = [value for value in values if answers is None or value in answers]
        if choice:
            state, _ = self.dynamics.assimilate(self.state, action, args, (self._chance.choice(choice),))
            self.state = self._settled_by_chance(state)

    def _changes(self, before: World) -> dict[str, str]:
        names = self.dynamics.layout.ground_fluents
        return {
            show_call(*name): show(new)
            for name, old, new in zip(names, before, self.state, strict=True)
            if old is not new and old != new
        }


def _comes_from_elsewhere(theory: BasicActionTheory, action: Action) -> bool:
    """Whether an exogenous action reaches the host, but not through a brick, and can be listed."""
    bound = {binding.action for brick in theory.bricks for binding in brick.bindings or implied(theory, brick)}
    listed = prod(len(p.type.values) if p.type.finite else MOST_INFERRED + 1 for p in action.parameters)
    return action.exogenous and action.name not in bound and listed <= MOST_INFERRED
