"""Answers to questions about all situations, by going through the cases that they distinguish, or by a solver."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from golc.diagnostics import ProgramError
from golc.proofs.cases import Case, explore, sample
from golc.proofs.domains import Domain, Some, domain
from golc.proofs.questions import Afterwards, Asked, Changed, Compared, Question, Step, Undecided, Witness
from golc.proofs.symbols import NeedsPythonError, NotDecidedError, Range
from golc.proofs.weaken import Weakening
from golc.situation.branching import Clause, Options
from golc.situation.compile import Cell, Compiler
from golc.situation.layout import Layout
from golc.theory.errors import NotExecutedError
from golc.theory.reading import fluents_read
from golc.theory.terms import Term
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value, show_call

IN_ORDER, BY_CHANCE = 200, 300
"""How many cases of one question are gone through in order, and tried by chance, before all others in order."""

MOST_CASES = 2_000
"""How many cases of one question are gone through."""

MORE_CASES = 500
"""How many more cases are gone through for a smaller witness, once there is one."""


@dataclass
class Prover:
    """Answers questions about one theory, by going through the cases that they distinguish."""

    theory: BasicActionTheory
    layout: Layout = field(init=False)
    compiler: Compiler = field(init=False)

    def __post_init__(self) -> None:
        self.layout = Layout(self.theory)
        self.compiler = Compiler(self.theory, self.layout, ask=GUESS)
        domains = {fluent.name: domain(fluent.type) for fluent in self.theory.fluents.values()}
        self._domains: list[Domain] = [domains[name] for name, _ in self.layout.ground_fluents]
        self._assumed = [self.theory.definitions[name] for name in self.theory.invariants]
        self._compiled: dict[tuple[Term, tuple[int, ...]], Callable[[Any], Any]] = {}
        self._clauses: dict[str, list[Clause]] = {}

    def answer(self, question: Question) -> Witness | Undecided | None:
        """A witness, as small as one that is found early; none if there is provably none."""
        question = self._weakening.in_order(question)
        answer = self._explored(question)
        weaker = self._weakening.weaker(question) if isinstance(answer, Undecided) else None
        if weaker is None or (not weaker.steps and not question.fails):
            return answer
        return None if not weaker.steps or self._coarse.answer(weaker) is None else answer

    @cached_property
    def _weakening(self) -> Weakening:
        return Weakening(self.theory)

    @cached_property
    def _coarse(self) -> Prover:
        """A prover that assumes only what can be gone through: what it proves to be impossible is so."""
        return Prover(replace(self.theory, invariants=self._weakening.definite_invariants()))

    def _explored(self, question: Question) -> Witness | Undecided | None:
        domains = [*self._domains, *(domain(variable.type) for variable in question.variables)]
        best: Case | None = None
        last = MOST_CASES
        undecided = None
        try:
            for number, (case, found) in enumerate(self._cases(question, domains)):
                if not case.whole:
                    undecided = Undecided("a value is asked for that cannot be enumerated")
                if found and (best is None or _worth(case) < _worth(best)):
                    best, last = case, min(last, number + MORE_CASES)
                if number >= last:
                    undecided = Undecided(f"more than {number} cases would have to be told apart")
                    break
        except NeedsPythonError as error:
            return Undecided(str(error), error.help)
        except NotDecidedError as error:
            undecided = Undecided(str(error))
        if best is not None:
            return self._witness(question, domains, best)
        return undecided and self._solved(question, domains, undecided)

    def _cases(self, question: Question, domains: Sequence[Domain]) -> Iterator[tuple[Case, bool]]:
        """Whether what is asked is so, case by case; of many cases some by chance before the rest in order."""

        reads = 0

        def ask(case: Case) -> bool:
            nonlocal reads
            case.reads = reads
            found = self._ask(question, case)
            reads = case.reads
            return found

        every = explore(domains, ask)
        yield from itertools.islice(every, IN_ORDER)
        first = next(every, None)
        if first is not None:
            yield from itertools.islice(sample(domains, ask, seed=0), BY_CHANCE)
            yield first
            yield from every

    def _solved(self, question: Question, domains: list[Domain], why: Undecided) -> Witness | Undecided | None:
        """What a solver answers, if there is one; a witness of its is tried out."""
        try:
            from golc.proofs.solver import solve
        except ImportError:
            return replace(why, help="install `golc[smt]`, which brings a solver")
        try:
            found = solve(self.theory, question)
        except NotDecidedError as error:
            return Undecided(f"{why.reason}; {error}")
        if found is None:
            return None
        for (name, args), value in found[0].items():
            domains[self.layout.places[name].slot(args)] = (value,)
        domains[self.layout.size :] = [(value,) for value in found[1]]
        try:
            for case, confirmed in itertools.islice(self._cases(question, domains), MORE_CASES):
                if confirmed:
                    return self._witness(question, domains, case)
        except NotDecidedError as error:
            return Undecided(f"{why.reason}; {error}")
        return Undecided(f"{why.reason}; what the solver says is not confirmed")

    def _witness(self, question: Question, domains: Sequence[Domain], found: Case) -> Witness:
        """A case in which what is asked is so, with a value for each integer that has only been narrowed down."""
        values = found.values()
        fixed = [(values[slot],) if slot in values else of for slot, of in enumerate(domains)]
        case = Case(fixed, [])
        error = None
        try:
            all(self._succeeds(step, case) for step in question.steps)
        except ProgramError as raised:
            error = raised
        read = sorted(slot for slot in case.cells if slot < self.layout.size)
        fluents = {show_call(*self.layout.ground_fluents[slot]): case.cells[slot] for slot in read}
        numbers = range(self.layout.size, len(domains))
        return Witness(
            fluents, tuple([values[n] if n in values else _any(domains[n]) for n in numbers]), error, found.guesses < 2
        )

    def _ask(self, question: Question, case: Case) -> bool:
        """Whether what is asked is so in a case."""
        fails = False
        try:
            for step in question.steps:
                if not self._succeeds(step, case):
                    return False
        except NotExecutedError as error:
            raise NeedsPythonError(error.why) from None
        except ProgramError:
            fails = True
        return fails is question.fails and self._is_assumed(case)

    def _succeeds(self, step: Step, case: Case) -> bool:
        match step:
            case Asked(false=false):
                return bool(self._function(step)(case)) is not false
            case Compared(left=left, right=right, equal=equal):
                return bool(self._function(left)(case) == self._function(right)(case)) is equal
            case Changed(action=action, effect=effect, env=env):
                self._clauses_of(action)[effect].changes(case, self._values(env, case))
                return True
            case Afterwards(term=term):
                return not self._function(Asked(term))(self._after(step, case))

    def _is_assumed(self, case: Case) -> bool:
        """Whether the invariants hold in a case; one that has no value there does not."""
        try:
            return all(self._function(Asked(invariant.body))(case) for invariant in self._assumed)
        except NotExecutedError as error:
            raise NeedsPythonError(error.why) from None
        except ProgramError:
            return False

    def _values(self, env: tuple[int, ...], case: Case) -> tuple[Value, ...]:
        return tuple([case[self.layout.size + number] for number in env])

    def _after(self, step: Afterwards, case: Case) -> _After:
        """The situation after an action, as far as the formula speaks of it."""
        args = self._values(step.env, case)
        fluents = fluents_read(self.theory, [step.term])
        changes: dict[int, Any] = {}
        for clause in self._clauses_of(step.action):
            if clause.effect.fluent in fluents:
                for env in clause.environments(args):
                    changes.update(clause.changes(case, env))
        return _After(case, changes)

    def _clauses_of(self, name: str) -> list[Clause]:
        if name not in self._clauses:
            action = self.theory.actions[name]
            depth = len(action.parameters)
            self._clauses[name] = [Clause(effect, depth, self.layout, self.compiler) for effect in action.effects]
        return self._clauses[name]

    def _function(self, asked: Asked) -> Callable[[Any], Any]:
        key = (asked.term, asked.env)
        if key not in self._compiled:
            cells = tuple([Cell(f"s[{self.layout.size + number}]") for number in asked.env])
            self._compiled[key] = self.compiler.function("s", [f"return {self.compiler.expression(asked.term, cells)}"])
        return self._compiled[key]


class _After:
    """A case with the changes of an action."""

    def __init__(self, case: Case, changes: dict[int, Any]) -> None:
        self._case = case
        self._changes = changes

    def __getitem__(self, slot: int) -> Value:
        slot = int(slot)
        self._case.look()
        if slot not in self._changes:
            return self._case[slot]
        value = self._changes[slot]
        if isinstance(value, Options):
            value = self._changes[slot] = value.values[self._case.choose(len(value.values))]
        return value  # type: ignore[no-any-return]

    def choose(self, ways: int) -> int:
        """Decide which of several ways things are."""
        return self._case.choose(ways)

    def guess(self) -> bool:
        """Decide something about what the agent knows, which is connected with what it knew before the action."""
        self._case.guesses += 1
        return self._case.guess()


def _worth(case: Case) -> tuple[bool, int]:
    """What makes a witness worse: that it may be none, and its size."""
    return case.guesses > 1, len(case.cells)


def _any(domain: Domain) -> Value:
    """Some value, for a variable that nothing depends on."""
    match domain:
        case Range() as range_:
            return range_.nearest_to_zero()
        case Some(values=values):
            return values[0]
        case values:
            return values[0]


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
