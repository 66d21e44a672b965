"""Whether what a question asks is so in one case: its steps, evaluated by compiled terms."""

from __future__ import annotations

from collections.abc import Callable, Container, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from golc.diagnostics import ProgramError
from golc.proofs.cases import Box, Case
from golc.proofs.domains import Domain, any_of, domain
from golc.proofs.questions import Afterwards, Asked, Changed, Compared, Question, Step, Witness
from golc.proofs.symbols import NeedsPythonError
from golc.situation.branching import Clause, Options
from golc.situation.compile import Compiler
from golc.situation.layout import Layout
from golc.situation.worlds import Readable, State
from golc.theory.errors import NotExecutedError
from golc.theory.reading import fluents_read
from golc.theory.terms import Term, Variable, subterms
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value, show_call


@dataclass(frozen=True)
class Leaf:
    """A box of situations in which the answer to a question is the same.

    ``answer``: none if what is asked is not so; otherwise true, or, equal for equal errors, what goes wrong.
    ``assumed``: whether the invariants hold there. ``error`` is what goes wrong.
    """

    box: Box
    answer: Hashable | None
    assumed: bool = True
    error: ProgramError | None = None

    @property
    def is_witness(self) -> bool:
        """Whether situations in the box are witnesses."""
        return self.answer is not None and self.assumed


class Asking:
    """Evaluates the steps of questions. ``ask``, as for ``Compiler``, answers what the agent knows.

    The slots of a case are those of the ground fluents, followed by one for each variable of the question.
    """

    def __init__(self, theory: BasicActionTheory, ask: Mapping[str, Callable[..., bool]]) -> None:
        self.theory = theory
        self.layout = Layout(theory)
        self.compiler = Compiler(theory, self.layout, ask=ask)
        domains = {fluent.name: domain(fluent.type) for fluent in theory.fluents.values()}
        self.domains: list[Domain] = [domains[name] for name, _ in self.layout.ground_fluents]
        self._assumed = [Asked(theory.definitions[name].body) for name in theory.invariants]
        self._compiled: dict[tuple[Term, int], Callable[..., Any]] = {}
        self._clauses: dict[tuple[str, int], tuple[Clause, frozenset[int]]] = {}

    def domains_of(self, question: Question) -> list[Domain]:
        """What the slots of a case of a question may be."""
        return [*self.domains, *[domain(variable.type) for variable in question.variables]]

    def leaf(self, question: Question, case: Case, assuming: bool = True) -> Leaf:
        """The answer in a case. Without ``assuming`` the invariants are not asked for."""
        verdict = self.verdict(question, case)
        if not verdict:
            return Leaf(case.box(), None)
        assumed = not assuming or self.is_assumed(case)
        if isinstance(verdict, bool):
            return Leaf(case.box(), True, assumed)
        return Leaf(case.box(), (verdict.diagnostic.message, verdict.diagnostic.span), assumed, verdict)

    def witness(self, domains: Sequence[Domain], values: Mapping[int, Value], error: ProgramError | None) -> Witness:
        """The witness with some values in slots; a variable without one may have any."""
        names, first = self.layout.ground_fluents, self.layout.size
        fluents = {show_call(*names[slot]): values[slot] for slot in sorted(values) if slot < first}
        numbers = range(first, len(domains))
        return Witness(fluents, tuple([values[n] if n in values else any_of(domains[n]) for n in numbers]), error)

    def verdict(self, question: Question, case: Case) -> ProgramError | bool:
        """Whether every step succeeds; if one has no value, those before it having succeeded, what is wrong with it.
        Of what is not asked, success or an error, nothing is said but that it is not so."""
        try:
            return all(self._step(step, case) for step in question.steps) and not question.fails
        except NotExecutedError as error:
            raise NeedsPythonError(error.name) from None
        except ProgramError as error:
            return error if question.fails else False

    def is_assumed(self, case: Case) -> bool:
        """Whether the invariants hold in a case; one that has no value there does not."""
        try:
            return all(self._value(invariant, case, case) for invariant in self._assumed)
        except NotExecutedError as error:
            raise NeedsPythonError(error.name) from None
        except ProgramError:
            return False

    def _step(self, step: Step, case: Case) -> bool:
        match step:
            case Asked(false=false):
                return bool(self._value(step, case, case)) is not false
            case Compared(left=left, right=right, equal=equal):
                return bool(self._value(left, case, case) == self._value(right, case, case)) is equal
            case Changed(action=action, effect=effect, env=env):
                clause, levels = self._clause(action, effect)
                clause.changes(case, self._values(env, levels, case))
                return True
            case Afterwards(env=env, term=term):
                return not self._value(Asked(term), self._after(step, case), case)

    def _value(self, asked: Asked, situation: Case | After, case: Case) -> Any:
        """The value of a term in a situation, for the variables in a case."""
        key = (asked.term, len(asked.env))
        if key not in self._compiled:
            self._compiled[key] = self.compiler.term(*key)
        return self._compiled[key](situation, _Variables(case, self.layout.size, asked.env))

    def _values(self, env: tuple[int, ...], levels: frozenset[int], case: Case) -> tuple[Value, ...]:
        """The values of some variables; only those that matter are looked at."""
        first = self.layout.size
        return tuple([case[first + number] if level in levels else None for level, number in enumerate(env)])

    def _after(self, step: Afterwards, case: Case) -> After:
        """The situation after an action, as far as the formula speaks of it."""
        return After(case, dict(self.changes(step.action, step.env, case, fluents_read(self.theory, [step.term]))))

    def changes(
        self, action: str, env: tuple[int, ...], case: Case, fluents: Container[str]
    ) -> Iterator[tuple[int, Any]]:
        """The slots of some fluents that an action changes, each with its new value or with ``Options``."""
        for number, effect in enumerate(self.theory.actions[action].effects):
            if effect.fluent in fluents:
                clause, levels = self._clause(action, number)
                for values in clause.environments(self._values(env, levels, case)):
                    yield from clause.changes(case, values)

    def _clause(self, name: str, number: int) -> tuple[Clause, frozenset[int]]:
        """An effect, compiled, and the levels of the variables that matter to it."""
        key = (name, number)
        if key not in self._clauses:
            action = self.theory.actions[name]
            effect = action.effects[number]
            parts = [part for term in effect.terms for part in subterms(term)]
            levels = frozenset([part.level for part in parts if isinstance(part, Variable)])
            self._clauses[key] = Clause(effect, len(action.parameters), self.layout, self.compiler), levels
        return self._clauses[key]


class _Variables:
    """The variables of a term, looked up in a case when they are read."""

    def __init__(self, case: Case, first: int, env: tuple[int, ...]) -> None:
        self._case = case
        self._first = first
        self._env = env

    def __getitem__(self, level: int) -> Value:
        return self._case[self._first + self._env[level]]


class Situation(Case):
    """A world, with variables that are decided while they are read."""

    def __init__(
        self, world: Readable, first: int, domains: Mapping[int, Domain], decisions: list[tuple[int, int]]
    ) -> None:
        super().__init__(domains, decisions)
        self._world = world
        self._first = first

    @property
    def state(self) -> State:
        """What the agent knows."""
        return self._world if isinstance(self._world, tuple) else self._world.state

    def __getitem__(self, slot: int) -> Value:
        slot = int(slot)
        if slot >= self._first:
            return super().__getitem__(slot)
        self.look()
        if slot not in self.cells:
            self.cells[slot] = self._world[slot]
        return self.cells[slot]


class After:
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
            value = self._changes[slot] = value.values[self.choose(len(value.values))]
        return value  # type: ignore[no-any-return]

    def choose(self, ways: int) -> int:
        """Decide which of several ways things are."""
        return self._case.branch(ways)

    def guess(self) -> bool:
        """Decide something about what the agent knows, which is connected with what it knew before the action."""
        self._case.guesses += 1
        return self._case.guess()
