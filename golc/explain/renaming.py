"""Terms moved from one scope into another: their variables become other variables, or terms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from golc.theory.terms import (
    Binder,
    Choice,
    Comprehension,
    Quantified,
    Term,
    Variable,
    children,
    with_children,
)


@dataclass(frozen=True)
class Renaming:
    """``terms`` says what each variable of the old scope is in the new one, in which ``depth`` variables are in scope;
    the variables that are bound inside a term follow those."""

    terms: Mapping[int, Term]
    depth: int

    def __call__(self, term: Term) -> Term:
        """The term in the new scope."""
        match term:
            case Variable(level=level):
                return self.terms[level] if level < len(self.terms) else self._bound(term)
            case Quantified(binders=binders, where=where, body=body):
                return replace(term, binders=self._binders(binders), where=where and self(where), body=self(body))
            case Comprehension(binders=binders, where=where, element=element):
                return replace(term, binders=self._binders(binders), where=where and self(where), element=self(element))
            case _:
                return with_children(term, tuple([self(inside) for inside in children(term)]))

    def choice(self, choice: Choice) -> Choice:
        """A choice in the new scope."""
        return replace(choice, among=self(choice.among))

    def _binders(self, binders: tuple[Binder, ...]) -> tuple[Binder, ...]:
        return tuple([Binder(self._bound(b.variable), b.within and self(b.within)) for b in binders])

    def _bound(self, variable: Variable) -> Variable:
        return replace(variable, level=variable.level - len(self.terms) + self.depth)
