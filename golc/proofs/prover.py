"""Answers to questions about all situations, by going through the cases that they distinguish, or by a solver."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

from golc.diagnostics import ProgramError
from golc.proofs.asking import Asking, Leaf
from golc.proofs.cases import MOST_LOOKS, Budget, Case, explore, sample
from golc.proofs.domains import Domain
from golc.proofs.questions import Question, Undecided, Witness
from golc.proofs.rigid import Rigid
from golc.proofs.smallest import rank, reduced, smallest
from golc.proofs.symbols import NeedsPythonError, NotDecidedError
from golc.proofs.uniform import Uniform
from golc.proofs.weaken import Weakening
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value

IN_ORDER, BY_CHANCE = 200, 300
"""How many cases of one question are gone through in order, and tried by chance, before all others in order."""

MOST_CASES = 2_000
"""How many cases of one question are gone through."""

ALL_LOOKS, FEW_LOOKS = 2_000_000, 20_000
"""How often all questions about a theory may look at slots, and each of them still may when they have done so."""

MORE_CASES = 500
"""How many cases are gone through to try out what a solver has found."""


@dataclass
class Prover:
    """Answers questions about one theory, by going through the cases that they distinguish."""

    theory: BasicActionTheory
    asking: Asking = field(init=False)

    def __post_init__(self) -> None:
        self._rigid = Rigid(self.theory)
        self.asking = Asking(self._rigid.theory, GUESS)
        self._looks = ALL_LOOKS

    def answer(self, question: Question, small: bool = True) -> Witness | Undecided | None:
        """A witness; none if there is provably none. If it is to be ``small``, a smallest one of those in the cases
        that can be gone through, otherwise the first one.

        What the answer is, it is for every function of the right type in place of one that is not executed.
        """
        question = self._weakening.in_order(self._rigid.question(question))
        answer = self._answer(question, small)
        if answer is None or not self._rigid.functions:
            return answer
        return self._whatever_they_are(question, answer, small)

    def _whatever_they_are(self, question: Question, answer: Witness | Undecided, small: bool) -> Witness | Undecided:
        """The answer, if it does not depend on functions that are not executed; another witness that does not."""
        asked = self._rigid.asked_by(question)
        if isinstance(answer, Undecided):
            return replace(answer, function=asked[0]) if asked and answer.function is None else answer
        functions = [*asked, *self._rigid.assumed()]
        if not functions or not answer.certain:
            return answer
        found = self._uniform.witness(question, self._values(answer))
        if found is None:
            return Undecided(str(NeedsPythonError(functions[0])), function=functions[0])
        domains = self.asking.domains_of(question)
        matter = reduced(self.asking, question, found.values, found.answer) if small else None
        try:
            return self._fixed(question, domains, found.values, matter)
        except NeedsPythonError:  # it is the solver that has shown it
            return self.asking.witness(domains, found.values, None)

    def _values(self, witness: Witness) -> dict[int, Value]:
        """The values of a witness by their slots."""
        slots = self.asking.layout.slots
        named = {slots[name]: value for name, value in witness.fluents.items()}
        return named | dict(enumerate(witness.variables, start=self.asking.layout.size))

    @cached_property
    def _uniform(self) -> Uniform:
        names = self.asking.layout.ground_fluents
        slots = [slot for slot, (name, _) in enumerate(names) if name in self._rigid.fluents]
        return Uniform(self.asking, frozenset(slots))

    def _answer(self, question: Question, small: bool) -> Witness | Undecided | None:
        answer = self._explored(question, small)
        if not isinstance(answer, Undecided):
            return answer
        weaker = self._weakening.weaker(question)
        if weaker is None and len(self._coarse.theory.invariants) < len(self.theory.invariants):
            weaker = question
        if weaker is None or (not weaker.steps and not question.fails):
            return answer
        return None if not weaker.steps or self._coarse.answer(weaker, small=False) is None else answer

    @cached_property
    def _weakening(self) -> Weakening:
        return Weakening(self._rigid.theory)

    @cached_property
    def _coarse(self) -> Prover:
        """A prover that assumes only what can be gone through: what it proves to be impossible is so."""
        return Prover(replace(self._rigid.theory, invariants=self._weakening.definite_invariants()))

    def _explored(self, question: Question, small: bool) -> Witness | Undecided | None:
        domains = self.asking.domains_of(question)
        found: list[tuple[Case, Leaf]] = []
        undecided = None
        try:
            for number, (case, leaf) in enumerate(self._cases(question, domains)):
                found.append((case, leaf))
                if not small and leaf.is_witness and case.guesses < 2:
                    break
                if number == MOST_CASES:
                    undecided = Undecided(f"more than {number} cases would have to be told apart")
                    break
        except NotDecidedError as error:
            undecided = Undecided(str(error), function=error.name if isinstance(error, NeedsPythonError) else None)
        if not all(case.whole for case, _ in found):
            undecided = undecided or Undecided("a value is asked for that cannot be enumerated")
        if any(leaf.is_witness for _, leaf in found):
            return self._witness(question, domains, found, small, all_=undecided is None)
        return undecided and self._solved(question, domains, undecided, small)

    def _cases(self, question: Question, domains: Sequence[Domain]) -> Iterator[tuple[Case, Leaf]]:
        """Whether what is asked is so, case by case; of many cases some by chance before the rest in order."""
        allowed = min(MOST_LOOKS, max(self._looks, FEW_LOOKS))
        budget = Budget(allowed)
        ask = partial(self.asking.leaf, question)
        every = explore(partial(Case, domains, budget=budget), ask)
        try:
            yield from itertools.islice(every, IN_ORDER)
            first = next(every, None)
            if first is not None:
                yield from itertools.islice(sample(domains, ask, 0, budget), BY_CHANCE)
                yield first
                yield from every
        finally:
            self._looks -= allowed - budget.left

    def _solved(
        self, question: Question, domains: list[Domain], why: Undecided, small: bool
    ) -> Witness | Undecided | None:
        """What a solver answers, if there is one; a witness of its is tried out."""
        try:
            from golc.proofs.solver import solve
        except ImportError:
            return replace(why, help="install `golc[smt]`, which brings a solver")
        try:
            found = solve(self._rigid.theory, question, small)
        except NotDecidedError as error:
            return replace(why, reason=f"{why.reason}; {error}")
        if found is None:
            return None
        values = self.asking.layout.placed(found[0]) | dict(enumerate(found[1], start=self.asking.layout.size))
        fixed = [(values[slot],) if slot in values else of for slot, of in enumerate(domains)]
        try:
            for case, leaf in itertools.islice(self._cases(question, fixed), MORE_CASES):
                if leaf.is_witness:
                    return self._witness(question, domains, [(case, leaf)], small)
        except NeedsPythonError:  # which is then left to the solver, whatever the function is
            return self.asking.witness(domains, values, None)
        except NotDecidedError as error:
            return replace(why, reason=f"{why.reason}; {error}")
        return replace(why, reason=f"{why.reason}; what the solver says is not confirmed")

    def _witness(
        self,
        question: Question,
        domains: Sequence[Domain],
        cases: Sequence[tuple[Case, Leaf]],
        small: bool,
        all_: bool = False,
    ) -> Witness:
        """A witness of those in some cases; a ``small`` one is the smallest, or that of all, if these are all cases."""
        first = self.asking.layout.size
        if small and all_ and not any(case.open for case, _ in cases):
            found = smallest([leaf for _, leaf in cases], domains, first)
            if found is not None:
                return self._fixed(question, domains, found, {*found})
        case, leaf = min([pair for pair in cases if pair[1].is_witness], key=lambda pair: _worth(pair[0], domains))
        values = case.values()
        matter = None if case.open or not small else reduced(self.asking, question, values, leaf.answer)
        return replace(self._fixed(question, domains, values, matter), certain=case.guesses < 2)

    def _fixed(
        self, question: Question, domains: Sequence[Domain], values: Mapping[int, Value], matter: set[int] | None
    ) -> Witness:
        """The witness with some values, of which those matter that are read, if nothing else is known of that."""
        case = Case([(values[slot],) if slot in values else of for slot, of in enumerate(domains)], [])
        verdict = self.asking.verdict(question, case)
        first = self.asking.layout.size
        kept = {*case.cells} if matter is None else matter
        shown = {slot: value for slot, value in values.items() if slot >= first or slot in kept}
        error = verdict if isinstance(verdict, ProgramError) else None
        return self.asking.witness(domains, shown, error)


def _worth(case: Case, domains: Sequence[Domain]) -> tuple[bool, int, int]:
    """What makes a witness worse: that it may be none, how many values it has, and how large these are."""
    values = case.values()
    return case.guesses > 1, len(values), sum([rank(value, domains[slot]) for slot, value in values.items()])


def _guess_knows(ask: Callable[..., Any], case: Any, *rest: Any) -> bool:
    return bool(ask(case, *rest)) and bool(case.guess())


def _guess_possible(ask: Callable[..., Any], case: Any, *rest: Any) -> bool:
    return bool(ask(case, *rest)) or bool(case.guess())


def _guess_known(ask: Callable[..., Any], case: Any, *rest: Any) -> bool:
    return bool(case.guess())


GUESS: Mapping[str, Callable[..., bool]] = {
    "knows": _guess_knows,
    "possible": _guess_possible,
    "known": _guess_known,
}
"""What an agent may know: anything that is not false, in any combination."""
