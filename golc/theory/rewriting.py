"""Theories with other terms in the place of some."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from golc.theory.terms import Binder, Choice, Term, children, with_children
from golc.theory.theory import Action, BasicActionTheory, Definition, Effect


@dataclass(frozen=True)
class Rewriting:
    """``change`` gives what stands in place of a term in which the terms inside have been rewritten already."""

    change: Callable[[Term], Term]

    def theory(self, theory: BasicActionTheory) -> BasicActionTheory:
        """A theory whose definitions and actions are rewritten; costs, programs and what is so at first are not."""
        return replace(
            theory,
            definitions={name: self._definition(each) for name, each in theory.definitions.items()},
            actions={name: self._action(each) for name, each in theory.actions.items()},
        )

    def term(self, term: Term) -> Term:
        """A term; the same object if nothing changes."""
        before = children(term)
        inside = self.terms(before)
        if any(old is not new for old, new in zip(before, inside, strict=True)):
            term = with_children(term, inside)
        return self.change(term)

    def terms(self, terms: tuple[Term, ...]) -> tuple[Term, ...]:
        """Some terms."""
        return tuple([self.term(term) for term in terms])

    def _definition(self, definition: Definition) -> Definition:
        return replace(definition, body=self.term(definition.body))

    def _action(self, action: Action) -> Action:
        return replace(
            action,
            preconditions=self.terms(action.preconditions),
            effects=tuple([self._effect(effect) for effect in action.effects]),
            senses=self.terms(action.senses),
        )

    def _effect(self, effect: Effect) -> Effect:
        value = effect.value
        return replace(
            effect,
            binders=tuple([self._binder(binder) for binder in effect.binders]),
            where=self._perhaps(effect.where),
            args=self.terms(effect.args),
            value=replace(value, among=self.term(value.among)) if isinstance(value, Choice) else self.term(value),
            condition=self._perhaps(effect.condition),
        )

    def _binder(self, binder: Binder) -> Binder:
        return replace(binder, within=self._perhaps(binder.within))

    def _perhaps(self, term: Term | None) -> Term | None:
        return None if term is None else self.term(term)
