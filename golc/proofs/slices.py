"""The part of a theory on which some fluents depend (its *cone of influence*)."""

from __future__ import annotations

from dataclasses import replace

from golc.theory.reading import fluents_read
from golc.theory.theory import BasicActionTheory


def dependence(theory: BasicActionTheory, fluents: frozenset[str]) -> frozenset[str]:
    """Some fluents, with those that decide when and how they change."""
    found = fluents
    while True:
        terms = []
        for action in theory.actions.values():
            effects = [effect for effect in action.effects if effect.fluent in found]
            if effects:
                terms += [*action.preconditions, *[term for effect in effects for term in effect.terms]]
        more = found | fluents_read(theory, terms)
        if more == found:
            return found
        found = more


def sliced(theory: BasicActionTheory, fluents: frozenset[str]) -> BasicActionTheory:
    """The theory without effects on other fluents; ``fluents`` are all that these depend on.

    What the fluents can be in states that can be reached does not change, unless an effect that is left out fails, or
    an invariant that speaks of others is broken: then there may be more states. Sensing is left out, too.
    """
    actions = {
        name: replace(action, effects=tuple([each for each in action.effects if each.fluent in fluents]), senses=())
        for name, action in theory.actions.items()
    }
    invariants = [name for name in theory.invariants if _reads(theory, name) <= fluents]
    return replace(theory, actions=actions, invariants=tuple(invariants))


def _reads(theory: BasicActionTheory, name: str) -> frozenset[str]:
    return fluents_read(theory, [theory.definitions[name].body])
