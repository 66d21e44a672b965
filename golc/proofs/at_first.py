"""What is so at first whatever functions of Python that are not executed are."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import replace

from golc.proofs.prover import Prover
from golc.proofs.questions import Asked, Question, Witness
from golc.theory.rewriting import Rewriting
from golc.theory.terms import Binder, Choice, DefinedTerm, FluentTerm, Operation, Operator, Quantified, Term, Variable
from golc.theory.theory import BasicActionTheory, Definition, Fluent, Parameter
from golc.theory.types import BOOL


class AtFirst:
    """Answers questions about the initial situation of a theory, or about all that are possible at first.

    A definition of its initial value stands in place of each fluent that has one.
    """

    def __init__(self, theory: BasicActionTheory) -> None:
        definitions = {name: _definition(fluent) for name, fluent in theory.fluents.items() if not _is_open(fluent)}
        fluents = {name: fluent for name, fluent in theory.fluents.items() if _is_open(fluent)}
        self._rewriting = Rewriting(lambda term: _defined(term, definitions))
        found = self._rewriting.theory(replace(theory, invariants=()))
        self._prover = Prover(replace(found, definitions={**found.definitions, **definitions}, fluents=fluents))
        possible = (*[_among(fluent) for fluent in fluents.values()], *theory.initially)
        self._possible = tuple([Asked(term) for term in self._rewriting.terms(possible)])

    def holds(self, formula: Term, variables: tuple[Parameter, ...] = ()) -> bool | None:
        """Whether a formula is always true at first, for all values of some variables, or provably not so; none if that
        depends on functions that are not executed, or is not decided."""
        asked = Asked(self._rewriting.term(formula), tuple(range(len(variables))))
        question = Question(variables, (*self._possible, replace(asked, false=True)))
        answers = [self._prover.answer(each, small=False) for each in (question, replace(question, fails=True))]
        if isinstance(answers[0], Witness):
            return False
        return True if answers == [None, None] else None


def _is_open(fluent: Fluent) -> bool:
    return isinstance(fluent.initial, Choice)


def _definition(fluent: Fluent) -> Definition:
    assert not isinstance(fluent.initial, Choice)
    return Definition(fluent.name, fluent.parameters, fluent.type, fluent.initial, span=fluent.span)


def _defined(term: Term, definitions: Container[str]) -> Term:
    if isinstance(term, FluentTerm) and term.fluent in definitions:
        return DefinedTerm(term.fluent, term.args, type=term.type, span=term.span)
    return term


def _among(fluent: Fluent) -> Term:
    """That a fluent has values that it may have at first."""
    assert isinstance(fluent.initial, Choice)
    variables = [Variable(level, each.name, type=each.type) for level, each in enumerate(fluent.parameters)]
    value = FluentTerm(fluent.name, tuple(variables), type=fluent.type, span=fluent.span)
    among = fluent.initial.among
    is_one = Operation(Operator.ELEMENT, (value, among), type=BOOL, span=among.span)
    binders = tuple([Binder(variable) for variable in variables])
    return Quantified("forall", binders, None, is_one, type=BOOL, span=among.span) if binders else is_one
