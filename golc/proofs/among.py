"""Questions about the states that can be reached, instead of all situations of the right types."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from golc.proofs.asking import Asking, Leaf, Situation
from golc.proofs.cases import Case, explore
from golc.proofs.effort import Effort
from golc.proofs.prover import MOST_CASES, Prover
from golc.proofs.questions import Afterwards, Asked, Question, Step, Undecided, Witness, terms_of
from golc.proofs.reachable import MOST_EFFORT, Reached, Scope, leads_on, reachable
from golc.proofs.slices import dependence, sliced
from golc.proofs.smallest import rank, reduced
from golc.proofs.symbols import NotDecidedError
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import ASK, Readable, State, TooManyCasesError, survey
from golc.theory.reading import fluents_read
from golc.theory.reading import reached as reached_terms
from golc.theory.terms import Epistemic
from golc.theory.theory import BasicActionTheory
from golc.theory.types import BOOL

SECONDS = 3.0
"""How long to go on finding states, and, once more, to look for witnesses among these or those that matter for some
questions."""

MORE_WITNESSES = 50
"""How many more are looked at in states that take as many actions, for a smaller one."""


class Among:
    """Answers questions as a ``Prover`` does, but only with states that can be reached, as far as these are known."""

    def __init__(self, theory: BasicActionTheory) -> None:
        self._theory = theory
        self._everywhere = Prover(theory)
        self._asking = Asking(theory, ASK)
        self._first = self._asking.layout.size
        self._effort = Effort(theory)
        self._dynamics = Dynamics(theory)
        self._states, self._scope = reachable(self._dynamics, SECONDS)
        self._slices: dict[frozenset[str], tuple[list[Reached], Scope]] = {}
        effects = [effect for action in theory.actions.values() for effect in action.effects]
        self._changing = frozenset([effect.fluent for effect in effects])
        self._left = SECONDS
        self._narrowed = 0
        self.nowhere: Scope | None = None
        """The states that can be reached, if the last answer was none because it is so in none of them."""

    @property
    def scope(self) -> Scope:
        """The states that can be reached, and how many questions were answered with regard to them."""
        return replace(self._scope, narrowed=self._narrowed)

    def answer(self, question: Question, small: bool = True) -> Witness | Undecided | None:
        """A witness that takes as few actions as possible, with these; none if there is provably none.

        Where it is not known whether a witness can be reached, one of all situations.
        """
        self.nowhere = None
        answer = self._everywhere.answer(question, small)
        if answer is None or self._is_too_much(question):
            return answer
        started = time.monotonic()
        try:
            found = self._narrower(question, small, started + self._left)
        except (NotDecidedError, TooManyCasesError):
            return answer
        finally:
            self._left -= time.monotonic() - started
        self._narrowed += not isinstance(found, Undecided)
        return answer if isinstance(found, Undecided) else found

    def _narrower(self, question: Question, small: bool, deadline: float) -> Witness | Undecided | None:
        """The answer with regard to what can be reached."""
        parts = [(self._states, self._scope)]
        if not self._scope.whole and not self._asking.compiler.uncertain:
            parts.insert(0, self._slice(question, deadline))
        for states, scope in parts:
            found = self._search(question, states, small, deadline)
            if found is None and scope.whole:
                self.nowhere = scope
                return None
            if found is not None and (states is self._states or leads_on(self._dynamics, found[1])):
                return replace(found[0], way=found[1].way)
        return Undecided("it is not known whether it can be reached")

    def _slice(self, question: Question, deadline: float) -> tuple[list[Reached], Scope]:
        """The states that can be reached, as far as they matter."""
        terms = [term for step in question.steps for term in terms_of(self._theory, step)]
        fluents = dependence(self._theory, fluents_read(self._theory, terms))
        if fluents >= self._changing:
            return self._states, self._scope
        if fluents not in self._slices:
            dynamics = Dynamics(sliced(self._theory, fluents))
            self._slices[fluents] = reachable(dynamics, deadline - time.monotonic())
        return self._slices[fluents]

    def _is_too_much(self, question: Question) -> bool:
        """Whether it takes too long to evaluate, or depends on what is known after an action."""
        after = any(isinstance(step, Afterwards) and self._is_about_knowledge(step) for step in question.steps)
        effort = 0
        for step in question.steps:
            effort += self._effort.of(terms_of(self._theory, step))
            if isinstance(step, Afterwards):
                effort += self._effort.of_action(self._theory.actions[step.action])
        return after or effort > MOST_EFFORT

    def _search(
        self, question: Question, states: list[Reached], small: bool, deadline: float
    ) -> tuple[Witness, Reached] | None:
        """A witness in some states, and its state."""
        found: list[tuple[Reached, Case, Leaf]] = []
        for reached in states:
            if found and (not small or reached.actions > found[0][0].actions or len(found) >= MORE_WITNESSES):
                break
            found += [(reached, case, leaf) for case, leaf in self._witnesses(question, reached.state, deadline)]
        shown = [(*self._shown(question, case, leaf), reached) for reached, case, leaf in found[:MORE_WITNESSES]]
        return min(shown, key=lambda each: each[0])[1:] if shown else None

    def _witnesses(self, question: Question, state: State, deadline: float) -> Iterator[tuple[Case, Leaf]]:
        """The cases of a state, and of each world in it, in which what is asked is so."""
        domains = dict(enumerate(self._asking.domains_of(question)[self._first :], start=self._first))
        acts = Question(question.variables, tuple(_known(question.steps)))
        known = (acts, replace(acts, fails=True)) if question.fails else (acts,)

        def ask(world: Readable) -> list[tuple[Case, Leaf]]:
            def leaf(case: Case) -> Leaf:
                if any(self._asking.verdict(each, case) for each in known):
                    return self._asking.leaf(question, case, assuming=False)
                return Leaf({}, None)

            every: list[tuple[Case, Leaf]] = []
            for case, found in explore(partial(Situation, world, self._first, domains), leaf):
                every.append((case, found))
                if len(every) > MOST_CASES or time.monotonic() > deadline:
                    raise NotDecidedError("there are too many cases in the states that can be reached")
            witnesses = [(case, leaf) for case, leaf in every if leaf.is_witness]
            if not witnesses and not all(case.whole for case, _ in every):
                raise NotDecidedError("a value is asked for that cannot be enumerated")
            return witnesses

        for _, found in survey(state, ask):
            yield from found

    def _shown(self, question: Question, case: Case, leaf: Leaf) -> tuple[tuple[int, int], Witness]:
        """A witness with the values that matter, and how large it is: how many values, and how large they are."""
        values = case.values()
        matter = None
        if not case.open and not any(map(self._is_about_knowledge, question.steps)):
            matter = reduced(self._asking, question, values, leaf.answer)
        domains = self._asking.domains_of(question)
        kept = {*values} if matter is None else matter
        shown = {slot: value for slot, value in values.items() if slot in kept or slot >= self._first}
        size = sum(rank(value, domains[slot]) for slot, value in shown.items())
        fluents = sum(slot < self._first for slot in shown)
        return (fluents, size), self._asking.witness(domains, shown, leaf.error)

    def _is_about_knowledge(self, step: Step) -> bool:
        terms = terms_of(self._theory, step)
        return any(isinstance(part, Epistemic) for part in reached_terms(self._theory, terms))


def _known(steps: tuple[Step, ...]) -> Iterator[Step]:
    """What an agent has to know for an action."""
    for step in steps:
        if isinstance(step, Asked) and step.known:
            yield Asked(Epistemic("knows", step.term, type=BOOL, span=step.term.span), step.env)
