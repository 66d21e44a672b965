"""Questions without what cannot be gone through: sets, lists, strings.

A question of which some steps are left out has a witness wherever the whole one has, unless what is left out is what
fails. So if the weaker one has none, the whole one has none.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from golc.proofs.certain import NO_FACTS, Certainty, Facts
from golc.proofs.domains import Some, domain
from golc.proofs.questions import Afterwards, Asked, Changed, Compared, Question, Step, terms_of
from golc.proofs.rigid import is_open
from golc.proofs.symbols import MOST_CONCRETE, Range
from golc.theory.reading import reached
from golc.theory.terms import FluentTerm, Operation, Operator, StaticTerm, Term, Variable
from golc.theory.theory import BasicActionTheory, Effect
from golc.theory.types import Type


@dataclass
class Weakening:
    """Weakens questions about a theory."""

    theory: BasicActionTheory
    certainty: Certainty = field(init=False)

    def __post_init__(self) -> None:
        self.certainty = Certainty(self.theory)

    def definite_invariants(self) -> tuple[str, ...]:
        """The invariants that can be gone through."""
        names = self.theory.invariants
        return tuple([name for name in names if self._are_definite([self.theory.definitions[name].body])])

    def in_order(self, question: Question) -> Question:
        """The question with the steps first that tell few cases apart, unless it matters which step fails."""
        if question.fails:
            return question
        return replace(question, steps=tuple(sorted(_single(question.steps), key=self._weight)))

    def _weight(self, step: Step) -> int:
        """About how many values a step reads."""
        read = {part for part in reached(self.theory, terms_of(self.theory, step)) if _is_read(part)}
        return sum(MOST_CONCRETE if isinstance(of, Some | Range) else len(of) for of in [domain(p.type) for p in read])

    def weaker(self, question: Question) -> Question | None:
        """A question with fewer steps; none if all of them are needed."""
        steps = [*_single(question.steps)]
        certain = self._certain(steps) if question.fails else [True] * len(steps)
        if question.fails and all(certain):
            return replace(question, steps=())
        pairs = zip(steps, certain, strict=True)
        kept = [step for step, sure in pairs if not sure or self._are_definite(terms_of(self.theory, step))]
        return replace(question, steps=tuple(kept)) if len(kept) < len(steps) else None

    def _certain(self, steps: list[Step]) -> list[bool]:
        """Of each step whether it certainly does not fail where those before it have succeeded."""
        found = []
        facts = NO_FACTS
        for step in steps:
            found.append(self._is_certain(step, facts))
            if isinstance(step, Asked):
                facts |= self.certainty.facts(step.term, step.env, not step.false)
        return found

    def _is_certain(self, step: Step, facts: Facts) -> bool:
        """Whether a step certainly does not fail."""
        match step:
            case Asked(term=term, env=env):
                return self.certainty.has_some_value(term, env, facts)
            case Compared(left=left, right=right):
                return all(self.certainty.has_value(side.term, side.env, facts) for side in (left, right))
            case Changed(env=env):
                return self.certainty.succeeds(self._effect(step), env, facts)
            case Afterwards():
                return False

    def _effect(self, step: Changed) -> Effect:
        return self.theory.actions[step.action].effects[step.effect]

    def _are_definite(self, terms: Iterable[Term]) -> bool:
        """Whether all values that some terms read can be gone through, or calculated with."""
        parts = reached(self.theory, terms)
        return not any((_is_read(part) and _is_vague(part.type)) or self._is_kept_back(part) for part in parts)

    def _is_kept_back(self, part: Term) -> bool:
        return isinstance(part, StaticTerm) and is_open(self.theory.statics[part.static])


def _single(steps: Iterable[Step]) -> Iterator[Step]:
    """The steps, with each part of a conjunction by itself."""
    for step in steps:
        match step:
            case Asked(term=Operation(op=Operator.AND, args=args), env=env, false=False):
                yield from _single([Asked(part, env) for part in args])
            case _:
                yield step


def _is_read(part: Term) -> bool:
    return isinstance(part, FluentTerm | Variable)


def _is_vague(type_: Type) -> bool:
    return isinstance(domain(type_), Some) and "real" not in type_.kinds  # with real numbers a solver calculates
