"""Functions of Python that are not executed, as *rigid* fluents: no action changes them.

A function gives the same value for the same arguments, and values of the type that its declaration says; nothing else
is known of it. So it is a fluent of that type which is what it is in every situation: what holds whatever its values
are, holds for the function of the file.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace

from golc.proofs.questions import Afterwards, Asked, Compared, Question, Step, terms_of
from golc.theory.border import PythonFunction
from golc.theory.fitting import size
from golc.theory.reading import reached
from golc.theory.rewriting import Rewriting
from golc.theory.terms import FluentTerm, Literal, StaticTerm, Term
from golc.theory.theory import BasicActionTheory, Fluent, Static

MOST_CALLS = 10_000
"""How many lists of arguments a function may have to be a fluent; others are for a solver."""


class Rigid:
    """A theory, and the same with fluents in place of functions that are not executed."""

    def __init__(self, theory: BasicActionTheory) -> None:
        functions = {name: static for name, static in theory.statics.items() if is_open(static)}
        self.functions = frozenset(functions)
        """All functions that are not executed."""
        self.fluents = frozenset([name for name, static in functions.items() if _has_few_arguments(static)])
        """Those that are fluents."""
        self._rewriting = Rewriting(self._changed)
        self.theory = self._with_fluents(theory) if functions else theory

    def question(self, question: Question) -> Question:
        """A question about the theory as one about the theory with fluents."""
        if not self.functions:
            return question
        return replace(question, steps=tuple([self._step(step) for step in question.steps]))

    def asked_by(self, question: Question) -> list[str]:
        """The functions on which a question about the theory with fluents depends, but for its invariants."""
        return self._read_by([term for step in question.steps for term in terms_of(self.theory, step)])

    def assumed(self) -> list[str]:
        """The functions on which the invariants depend."""
        return self._read_by([self.theory.definitions[name].body for name in self.theory.invariants])

    def _read_by(self, terms: Iterable[Term]) -> list[str]:
        found = set()
        for part in reached(self.theory, terms):
            match part:
                case FluentTerm(fluent=name) | StaticTerm(static=name):
                    found.add(name)
        return sorted(self.functions & found)

    def _with_fluents(self, theory: BasicActionTheory) -> BasicActionTheory:
        reading = _callers(theory, self.functions)
        statics = {
            name: self._reading(static) if name in reading else static
            for name, static in theory.statics.items()
            if name not in self.fluents
        }
        fluents = {name: _fluent(theory.statics[name]) for name in sorted(self.fluents)}
        return replace(self._rewriting.theory(theory), statics=statics, fluents={**theory.fluents, **fluents})

    def _reading(self, static: Static) -> Static:
        assert not isinstance(static.body, Mapping | PythonFunction)
        return replace(static, body=self._rewriting.term(static.body), reads=True)

    def _changed(self, term: Term) -> Term:
        if isinstance(term, StaticTerm) and term.static in self.fluents:
            return FluentTerm(term.static, term.args, type=term.type, span=term.span)
        return term

    def _step(self, step: Step) -> Step:
        match step:
            case Asked() | Afterwards():
                return replace(step, term=self._rewriting.term(step.term))
            case Compared(left=left, right=right):
                one, other = [replace(side, term=self._rewriting.term(side.term)) for side in (left, right)]
                return replace(step, left=one, right=other)
            case _:
                return step


def is_open(static: Static) -> bool:
    """Whether a static is a function that is not executed."""
    return isinstance(static.body, PythonFunction) and not static.body.file.trusted


def _has_few_arguments(static: Static) -> bool:
    types = [parameter.type for parameter in static.parameters]
    return all(type_.finite for type_ in types) and math.prod(map(size, types)) <= MOST_CALLS


def _fluent(static: Static) -> Fluent:
    """What it is at first is not asked: no value is the right one."""
    return Fluent(static.name, static.parameters, static.type, Literal(None, type=static.type), span=static.span)


def _callers(theory: BasicActionTheory, functions: frozenset[str]) -> frozenset[str]:
    """The statics that call some functions, perhaps through others."""
    calls = {
        name: {part.static for part in reached(theory, [static.body]) if isinstance(part, StaticTerm)}
        for name, static in theory.statics.items()
        if not isinstance(static.body, Mapping | PythonFunction)
    }
    found: set[str] = set()
    while more := {name for name in calls.keys() - found if not calls[name].isdisjoint(functions | found)}:
        found |= more
    return frozenset(found)
