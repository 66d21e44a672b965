"""The meaning of typed terms and actions in a state, read off the theory.

The generated code of ``compile`` says the same faster and is tested against this. What golc explains (why a branch is
blocked, which values a condition had) comes from here, too.
"""

from __future__ import annotations

from typing import cast

from golc.situation.happened import Happened, before
from golc.situation.layout import Layout, World
from golc.situation.worlds import ASK, Readable
from golc.theory import errors
from golc.theory.evaluate import Env, Evaluator
from golc.theory.terms import Before, Choice, Epistemic, FluentTerm, PossTerm
from golc.theory.theory import Action, BasicActionTheory, Definition, Effect, Static
from golc.theory.types import Value, show_call


class Interpreter(Evaluator[Readable]):
    """Evaluates the terms of a theory in a state."""

    def __init__(self, theory: BasicActionTheory, layout: Layout | None = None) -> None:
        self.theory = theory
        self.layout = layout or Layout(theory)

    def static(self, name: str) -> Static:
        return self.theory.statics[name]

    def definition(self, name: str) -> Definition:
        return self.theory.definitions[name]

    def fluent(self, term: FluentTerm, situation: Readable, env: Env) -> Value:
        place = self.layout.places[term.fluent]
        return situation[place.slot(self.arguments(term.fluent, place.fluent.parameters, term.args, situation, env))]

    def poss(self, term: PossTerm, situation: Readable, env: Env) -> bool:
        action = self.theory.actions[term.action]
        return self.possible(
            action, situation, self.arguments(action.name, action.parameters, term.args, situation, env)
        )

    def epistemic(self, term: Epistemic, situation: Readable, env: Env) -> bool:
        """What the agent knows in the state that a world belongs to."""
        return ASK[term.kind](lambda world: self.evaluate(term.body, world, env), situation)

    def before(self, term: Before, situation: Readable, env: Env) -> Value:
        """What a term was known to be before the action that led to a situation, which is a ``Happened``."""
        return before(lambda world: self.evaluate(term.body, world, env), cast(Happened, situation))

    def possible(self, action: Action, state: Readable, args: Env) -> bool:
        """Whether the action's preconditions hold."""
        return self.all_hold(action.preconditions, state, args)

    def progress(self, action: Action, state: Readable, args: Env) -> World:
        """The state after a ground action: all its effects at once, everything else unchanged."""
        changes: dict[int, Value] = {}
        for effect in action.effects:

            def apply(env: Env, effect: Effect = effect) -> None:
                if effect.condition is None or self.holds(effect.condition, state, env):
                    self._apply(effect, state, env, changes)

            self.visit(effect.binders, effect.where, state, args, apply)
        return tuple([changes[slot] if slot in changes else state[slot] for slot in range(self.layout.size)])

    def _apply(self, effect: Effect, state: Readable, env: Env, changes: dict[int, Value]) -> None:
        fluent = self.theory.fluents[effect.fluent]
        args = self.arguments(fluent.name, fluent.parameters, effect.args, state, env)
        slot = self.layout.places[fluent.name].slot(args)
        assert not isinstance(effect.value, Choice)
        value = self.evaluate(effect.value, state, env)
        if value not in fluent.type:
            raise errors.value_outside(effect.value.span, show_call(fluent.name, args), value, fluent.type)
        if changes.setdefault(slot, value) != value:
            raise errors.conflicting_effects(effect.span, show_call(fluent.name, args), changes[slot], value)
