"""How much there is to evaluate in a term at the most, seen without evaluating it."""

from __future__ import annotations

import math
from collections.abc import Iterable

from golc.theory.fitting import collection, size
from golc.theory.terms import Binder, Comprehension, DefinedTerm, PossTerm, Quantified, Term, children
from golc.theory.theory import Action, BasicActionTheory, Effect

USUAL_ELEMENTS = 10
"""How many elements a set or list is taken to have whose elements have no finite type."""


class Effort:
    """The parts of terms, those of quantifiers, definitions and preconditions each time that they are evaluated."""

    def __init__(self, theory: BasicActionTheory) -> None:
        self._theory = theory
        self._known: dict[tuple[str, str], int] = {}

    def of(self, terms: Iterable[Term]) -> int:
        """How many parts are evaluated for all of some terms."""
        # Not by `sum` of a generator: that would take C stack, of which a long chain of definitions may need too much.
        total = 0
        for term in terms:
            total += self._of(term)
        return total

    def of_action(self, action: Action) -> int:
        """How many parts are evaluated when an action happens, those of an effect for all values of its binders."""
        parts = self.of((*action.preconditions, *action.senses))
        return parts + sum([self.of_effect(effect) for effect in action.effects])

    def of_effect(self, effect: Effect) -> int:
        """How many parts are evaluated of an effect, for all values of its binders."""
        return self.of(effect.terms) * math.prod([_instances(binder) for binder in effect.binders])

    def _of(self, term: Term) -> int:
        inside = 1 + self.of(children(term))
        match term:
            case Quantified(binders=binders) | Comprehension(binders=binders):
                for binder in binders:
                    inside *= _instances(binder)
            case DefinedTerm(definition=name):
                inside += self._once("definition", name)
            case PossTerm(action=name):
                inside += self._once("action", name)
        return inside

    def _once(self, kind: str, name: str) -> int:
        if (kind, name) not in self._known:
            theory = self._theory
            bodies = (theory.definitions[name].body,) if kind == "definition" else theory.actions[name].preconditions
            self._known[kind, name] = self.of(bodies)
        return self._known[kind, name]


def _instances(binder: Binder) -> int:
    type_ = binder.variable.type
    within = None if binder.within is None else collection(binder.within.type)
    return size(type_) if type_.finite and (within is None or within.kind == "set") else USUAL_ELEMENTS
