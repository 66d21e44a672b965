"""Situations in which something is so whatever functions of Python that are not executed are.

They are found in turns: a situation that fits all functions thought of so far, then a function that it does not fit.
A situation that fits every function is a witness; if none fits a few of them, there is no such witness.
"""

from __future__ import annotations

import itertools
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

from golc.proofs.asking import Asking, Leaf
from golc.proofs.cases import Budget, Case, explore
from golc.proofs.domains import Domain, Some, any_of
from golc.proofs.questions import Question
from golc.proofs.symbols import NotDecidedError, Range
from golc.theory.types import Value

MOST_FUNCTIONS = 12
"""How many functions are thought of before it is given up."""

MOST_CASES = 2_000
"""How many situations, or functions, are gone through in each turn."""

MOST_LOOKS = 100_000
"""How often slots are looked at in each turn."""

Values: TypeAlias = Mapping[int, Value]
"""What is in some slots."""


class Function(NamedTuple):
    """The values of functions in some slots; in all others they are the ``last`` of their types, or the first."""

    values: Values
    last: bool = False

    def value(self, slot: int, domain: Domain) -> Value:
        """The value in a slot."""
        return self.values[slot] if slot in self.values else _ends(domain)[not self.last]


class Found(NamedTuple):
    """The values that make a situation a witness, and the answer there, as that of a ``Leaf``."""

    values: Values
    answer: Hashable


class _Supposed(Case):
    """A case in which what functions are is supposed, not decided."""

    function: Function
    slots: frozenset[int]

    def __getitem__(self, slot: int) -> Value:
        slot = int(slot)
        if slot not in self.slots:
            return super().__getitem__(slot)
        self.look()
        return self.function.value(slot, self._domains[slot])


@dataclass
class Uniform:
    """Looks for such situations; ``slots`` are those of the functions."""

    asking: Asking
    slots: frozenset[int]

    def witness(self, question: Question, first: Values) -> Found | None:
        """A situation in which what is asked is so for every function; none if it is not known whether there is one.

        The one with the values ``first`` is tried before all others.
        """
        values = self._without_functions(first)
        functions = [Function({}, last=True), Function({})]
        try:
            while len(functions) < MOST_FUNCTIONS:
                found = self._whatever(question, values)
                if isinstance(found, Found):
                    return found
                functions.append(found)
                values = self._fitting(question, functions)
        except NotDecidedError:
            pass
        return None

    def _without_functions(self, values: Values) -> Values:
        return {slot: value for slot, value in values.items() if slot not in self.slots}

    def _fitting(self, question: Question, functions: Sequence[Function]) -> Values:
        """A situation in which what is asked is so, with the same answer, for some functions."""
        domains, budget = self.asking.domains_of(question), Budget(MOST_LOOKS)

        def new(decisions: list[tuple[int, int]]) -> _Supposed:
            case = _Supposed(domains, decisions, budget=budget)
            case.slots = self.slots
            return case

        def fits(case: _Supposed) -> bool:
            answers: set[Hashable] = set()
            for case.function in functions:
                leaf = self.asking.leaf(question, case)
                answers.add(leaf.answer)
                if not leaf.is_witness or len(answers) > 1:
                    return False
            return True

        for case, found in itertools.islice(explore(new, fits), MOST_CASES):
            if found:
                return case.values()
        raise NotDecidedError("no situation was found that fits these functions")

    def _whatever(self, question: Question, values: Values) -> Found | Function:
        """The situation, if what is asked is so there for all functions; otherwise one for which it is not so."""
        try:
            answers, read = set(), dict(values)
            for number, (case, leaf) in enumerate(self._leaves(question, values)):
                answers.add(leaf.answer)
                read |= self._without_functions(case.values())
                alike = leaf.is_witness and len(answers) == 1
                if not alike and not case.open:
                    return Function({slot: value for slot, value in case.values().items() if slot in self.slots})
                if not alike or not case.whole or number == MOST_CASES:
                    raise NotDecidedError("the functions cannot be gone through")
            return Found(read, answers.pop())
        except NotDecidedError:
            if question.fails:  # it might fail in several ways
                raise
        refuted = self._refuted(question, values)
        if refuted is None:
            return Found(values, True)
        return Function({slot: value for slot, value in refuted.items() if slot in self.slots})

    def _refuted(self, question: Question, values: Values) -> Values | None:
        """Values with which what is asked is not so, among them some that are given, or none if there are none; a
        solver is asked for them where the functions cannot be gone through."""
        try:
            from golc.proofs.solver import refuted
        except ImportError:
            raise NotDecidedError("there is no solver") from None
        layout, domains = self.asking.layout, self.asking.domains_of(question)
        fluents = {layout.ground_fluents[slot]: value for slot, value in values.items() if slot < layout.size}
        variables = [values.get(slot, any_of(domains[slot])) for slot in range(layout.size, len(domains))]
        found = refuted(self.asking.theory, question, fluents, variables)
        return None if found is None else layout.placed(found)

    def _leaves(self, question: Question, values: Values) -> Iterator[tuple[Case, Leaf]]:
        """The answers in a situation, whatever the functions are."""
        budget = Budget(MOST_LOOKS)
        domains = [
            _ends_first(of) if slot in self.slots else (values[slot] if slot in values else any_of(of),)
            for slot, of in enumerate(self.asking.domains_of(question))
        ]
        return explore(
            lambda decisions: Case(domains, decisions, budget=budget), lambda case: self.asking.leaf(question, case)
        )


def _ends(domain: Domain) -> tuple[Value, Value]:
    """The last and the first value of a domain, where it has one: what is so for both is often so for all between."""
    match domain:
        case Range(low=low, high=high):
            near = domain.nearest_to_zero()
            return (near if high is None else high), (near if low is None else low)
        case Some(values=values):
            return values[-1], values[0]
        case values:
            return values[-1], values[0]


def _ends_first(domain: Domain) -> Domain:
    """The values of a domain, the ends before the others."""
    if isinstance(domain, Range | Some) or len(domain) < 3:
        return domain
    return [domain[-1], domain[0], *domain[1:-1]]
