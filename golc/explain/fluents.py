"""The page of a fluent: the initial database and the successor state axiom."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from golc.explain import signs
from golc.explain.actions import is_successor, leaves_open, worlds_after
from golc.explain.axioms import Cause, SuccessorState, successor_state
from golc.explain.document import Document, Line, Nest, Text, join, separated
from golc.explain.formulas import Formulas
from golc.explain.page import Page, Section, called, conjunction, enclosed, head, implied, says
from golc.explain.pieces import NOT, OR, SUM, infixed, quantified, type_text
from golc.theory.reading import fluents_read
from golc.theory.terms import Choice, Literal
from golc.theory.theory import BasicActionTheory, Fluent
from golc.theory.types import BOOL

AFTER = called("do", signs.ACTION, signs.SITUATION)
TAKEN = frozenset({"a", "s"})
"""The variables of the axioms themselves."""


def fluent_page(theory: BasicActionTheory, fluent: Fluent) -> Page:
    """What a fluent is at first, and what changes it."""
    formulas = Formulas(theory, taken=TAKEN).extended([parameter.name for parameter in fluent.parameters])
    kind = "relational fluent" if fluent.type == BOOL else "functional fluent"
    title = head(kind, fluent.name, fluent.parameters)
    if fluent.type != BOOL:
        title += f": {fluent.type}"
    sections = [Section("Initially", tuple(_initially(formulas, fluent))), *_successor(formulas, theory, fluent)]
    return Page(title, fluent.span, tuple(sections))


def _initially(formulas: Formulas, fluent: Fluent) -> Iterator[Document]:
    possible = called("K", signs.SITUATION, signs.INITIAL)
    match fluent.initial:
        case Choice() as choice:
            value = join(_fluent(formulas, fluent, signs.SITUATION), signs.IN, formulas.among(choice))
            yield implied([possible], value)
        case Literal(value=bool(truth)) if fluent.type == BOOL:
            yield join(*([] if truth else [signs.NOT]), _fluent(formulas, fluent, signs.INITIAL))
        case initial if fluent.type == BOOL:
            yield says(_fluent(formulas, fluent, signs.INITIAL), signs.EQUIVALENT, formulas.term(initial, OR))
        case initial:
            yield says(_fluent(formulas, fluent, signs.INITIAL), signs.EQUALS, formulas.term(initial, SUM))
    for constraint in formulas.theory.initially:
        if fluent.name in fluents_read(formulas.theory, [constraint]):
            inner = Formulas(formulas.theory, taken=TAKEN, now=signs.SITUATION)
            yield implied([possible], inner.term(constraint, OR))


def _fluent(formulas: Formulas, fluent: Fluent, situation: Document) -> Document:
    return formulas.applied(signs.words(fluent.name), formulas.names[: len(fluent.parameters)], situation)


def _successor(formulas: Formulas, theory: BasicActionTheory, fluent: Fluent) -> Iterator[Section]:
    axiom = successor_state(theory, fluent)
    writer = _Writer(formulas if axiom.value is None else formulas.extended([axiom.value.name]), axiom)
    heading = "Successor state axiom" if axiom.certain else "Successor state axiom, in each possible world"
    yield Section(heading, (*writer.statements(), *writer.definitions()))
    if not axiom.certain:
        changing = dict.fromkeys(cause.action for cause in (*axiom.gains, *axiom.losses))
        uncertain = [theory.actions[name] for name in changing if leaves_open(theory.actions[name], fluent.name)]
        yield Section("Possible worlds", tuple([worlds_after(theory, action) for action in uncertain]))


@dataclass(frozen=True)
class _Writer:
    """Writes an axiom; the variables of ``formulas`` are those of the axiom."""

    formulas: Formulas
    axiom: SuccessorState

    def statements(self) -> Iterator[Document]:
        """``F(x, do(a, s)) ≡ …``; of a world s′ that is one of several two implications, or one."""
        value = self.axiom.value
        if value is None:
            yield from self.relational()
            return
        y = self.formulas.names[value.level]
        before, after = self.fluent(signs.SITUATION), self.fluent(self.after)
        if not self.axiom.gains:
            yield says(after, signs.EQUALS, before)
            return
        other = signs.primed(y)
        unchanged = join(signs.NOT, signs.EXISTS, other, signs.DOT, self.gamma(signs.GAMMA, other))
        keeps = [join(before, signs.sign(" = "), y), unchanged]
        yield self.concluded(join(after, signs.sign(" = "), y), self.gamma(signs.GAMMA, y), keeps)

    def relational(self) -> Iterator[Document]:
        before, after = self.fluent(signs.SITUATION), self.fluent(self.after)
        gains = self.gamma(signs.GAMMA_PLUS) if self.axiom.gains else None
        losses = self.gamma(signs.GAMMA_MINUS) if self.axiom.losses else None
        yield self.concluded(after, gains, [before, *_not(losses)])
        if not self.axiom.certain:
            yield self.concluded(join(signs.NOT, after), losses, [join(signs.NOT, before), *_not(gains)])

    def concluded(self, after: Document, becomes: Document | None, keeps: Sequence[Document]) -> Document:
        right = conjunction(keeps) if becomes is None else infixed(signs.OR, [becomes, conjunction(keeps)])
        if self.axiom.certain:
            return says(after, signs.EQUIVALENT, right)
        return implied([is_successor(signs.ACTION, signs.SITUATION), after], right)

    @property
    def after(self) -> Document:
        return AFTER if self.axiom.certain else signs.SUCCESSOR

    def fluent(self, situation: Document) -> Document:
        return _fluent(self.formulas, self.axiom.fluent, situation)

    def gamma(self, sign: Text, value: Document | None = None) -> Document:
        """``γ(x, y, a, s)``."""
        args = self.formulas.names[: len(self.axiom.parameters)]
        values = [] if value is None else [value]
        return self.formulas.applied(sign, [*args, *values, signs.ACTION], signs.SITUATION)

    def definitions(self) -> Iterator[Document]:
        """What the γ stand for."""
        if self.axiom.value is not None:
            named = [(self.gamma(signs.GAMMA, self.formulas.names[self.axiom.value.level]), self.axiom.gains)]
        else:
            named = [
                (self.gamma(signs.GAMMA_PLUS), self.axiom.gains),
                (self.gamma(signs.GAMMA_MINUS), self.axiom.losses),
            ]
        for gamma, causes in named:
            if causes:
                yield says(gamma, signs.EQUIVALENT, self.disjunction(causes))

    def disjunction(self, causes: Sequence[Cause]) -> Document:
        """One cause a line."""
        if len(causes) == 1:
            return self.cause(causes[0])
        found = [enclosed(self.cause(cause)) if cause.variables else self.cause(cause) for cause in causes]
        return separated([Nest(each) for each in found], Line(always=True), signs.OR)

    def cause(self, cause: Cause) -> Document:
        """``∃z. a = go(z) ∧ φ``; the variables that are no arguments of the action have their types beside them."""
        inner = self.formulas.at(signs.SITUATION).extended([variable.name for variable in cause.variables])
        action = inner.applied(signs.words(cause.action), [inner.term(arg) for arg in cause.args])
        last = len(cause.conditions) - 1
        conditions = [inner.term(part, NOT, place == last) for place, part in enumerate(cause.conditions)]
        body = conjunction([join(signs.ACTION, signs.sign(" = "), action), *conditions])
        if not cause.variables:
            return body
        names: list[Document] = []
        for variable in cause.variables:
            name = inner.names[variable.level]
            of_type = join(name, signs.COLON, type_text(variable.type))
            names.append(name if variable in cause.args else of_type)
        return quantified(signs.EXISTS, separated(names, signs.sign(", ")), body)


def _not(gamma: Document | None) -> list[Document]:
    return [] if gamma is None else [join(signs.NOT, gamma)]
