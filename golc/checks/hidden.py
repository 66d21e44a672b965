"""Fluents that are hidden from the agent for ever, and what can be known all the same of terms that read them.

A fluent is hidden if each of its instances is unknown at first, and nothing can narrow it down: no action senses it or
anything connected with it, no exogenous action shows by having been possible what it is, no effect gives it a value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import cast

from golc.checks.beginning import Beginning
from golc.diagnostics import ProgramError
from golc.situation.layout import World
from golc.situation.worlds import Readable, TooManyCasesError, survey
from golc.theory.errors import NotExecutedError
from golc.theory.fitting import size
from golc.theory.reading import fluents_read, reached
from golc.theory.terms import Choice, Comprehension, Epistemic, Literal, Quantified, Term, Variable, subterms
from golc.theory.theory import BasicActionTheory, Effect
from golc.theory.types import Type, Unknown, Value

MOST = 2_000
"""How often a term is evaluated before it is left undecided."""

UNKNOWN = Unknown(())
"""The answer where it differs from one possible world to another."""


class UndecidedError(Exception):
    """It would take too much to find out what can be known of a term."""


def _hidden_fluents(theory: BasicActionTheory, beginning: Beginning) -> frozenset[str]:
    """The fluents that are hidden for ever."""
    values = beginning.dynamics.values(beginning.state)
    certain = {name for (name, _), value in values if not isinstance(value, Unknown)}
    return frozenset(theory.fluents) - certain - _told(theory)


def _told(theory: BasicActionTheory) -> frozenset[str]:
    """The fluents of which sensing, exogenous actions or effects tell something, and those connected with them."""
    actions = theory.actions.values()
    asked = [term for action in actions for term in action.senses]
    asked += [term for action in actions if action.exogenous for term in action.preconditions]
    effects = [effect for action in actions for effect in action.effects]
    told = _read(theory, asked) | {effect.fluent for effect in effects if not _says_nothing(effect)}
    links = [_read(theory, [constraint]) for constraint in theory.initially]
    links += [_read(theory, effect.terms) | {effect.fluent} for effect in effects]
    while any(told & link and not link <= told for link in links):
        told = told.union(*[link for link in links if told & link])
    return told


def _read(theory: BasicActionTheory, terms: Iterable[Term]) -> frozenset[str]:
    """What is known is the same in all worlds, so asking for it tells nothing."""
    return fluents_read(theory, terms, into_knowledge=False)


def _says_nothing(effect: Effect) -> bool:
    """Whether an effect makes its fluent unknown altogether."""
    among = effect.value.among if isinstance(effect.value, Choice) else None
    return isinstance(among, Literal) and among.value == tuple(effect.value.type.values)


class _UnreadError(Exception):
    """A slot was read of which nothing is supposed yet."""

    def __init__(self, slot: int) -> None:
        super().__init__(slot)
        self.slot = slot


@dataclass(frozen=True)
class _Case:
    """A world that has the hidden slots of a possible one, and what is supposed in all others."""

    possible: Readable
    hidden: frozenset[int]
    supposed: Mapping[int, Value]

    def __getitem__(self, slot: int) -> Value:
        if slot in self.hidden:
            return self.possible[slot]
        if slot not in self.supposed:
            raise _UnreadError(slot)
        return self.supposed[slot]


class Hidden:
    """What can be known of terms that read hidden fluents."""

    def __init__(self, theory: BasicActionTheory, beginning: Beginning) -> None:
        self.theory = theory
        self.fluents = _hidden_fluents(theory, beginning)
        self._interpreter = beginning.dynamics.interpreter
        self._state = beginning.state
        names = [name for name, _ in beginning.dynamics.layout.ground_fluents]
        self._slots = frozenset(slot for slot, name in enumerate(names) if name in self.fluents)
        self._left = 0

    def read_by(self, term: Term) -> list[str]:
        """The hidden fluents that a term reads, in alphabetical order."""
        return sorted(self.fluents & fluents_read(self.theory, [term]))

    def answers(self, term: Term) -> Iterator[Value]:
        """What can be known of a term, whatever all other fluents and the variables are: values, or ``UNKNOWN``.

        Raises ``UndecidedError`` if that takes too much.
        """
        if any(isinstance(part, Epistemic) for part in reached(self.theory, [term])):
            raise UndecidedError
        self._left = MOST
        try:
            for env in _environments(term):
                yield from self._in(term, env)
        except (TooManyCasesError, RecursionError):
            raise UndecidedError from None

    def _in(self, term: Term, env: tuple[Value, ...]) -> Iterator[Value]:
        """What can be known in each case of what the other fluents may be, which are supposed as they are read."""
        cases: list[dict[int, Value]] = [{}]
        while cases:
            supposed = cases.pop()
            try:
                yield self._known(term, env, supposed)
            except _UnreadError as unread:
                name, _ = self._interpreter.layout.ground_fluents[unread.slot]
                cases += [{**supposed, unread.slot: value} for value in _values(self.theory.fluents[name].type)]
            except NotExecutedError:
                raise UndecidedError from None
            except ProgramError:
                continue  # what has no value here is another matter

    def _known(self, term: Term, env: tuple[Value, ...], supposed: Mapping[int, Value]) -> Value:
        def ask(world: Readable) -> Value:
            self._left -= 1
            if self._left < 0:
                raise UndecidedError
            case = _Case(world, self._slots, supposed)
            return self._interpreter.evaluate(term, cast(World, case), env)

        answers = (answer for _, answer in survey(self._state, ask))
        first = next(answers)
        return first if all(answer == first for answer in answers) else UNKNOWN


def _environments(term: Term) -> Iterator[tuple[Value, ...]]:
    """Every environment of the variables of a program that a term mentions; those that it does not are ``None``."""
    parts = [*subterms(term)]
    binders = [binder for part in parts if isinstance(part, Quantified | Comprehension) for binder in part.binders]
    bound = {binder.variable.level for binder in binders}
    free = {part.level: part.type for part in parts if isinstance(part, Variable) and part.level not in bound}
    depth = min(bound, default=max(free, default=-1) + 1)
    return product(*[_values(free[level]) if level in free else (None,) for level in range(depth)])


def _values(type_: Type) -> Iterable[Value]:
    if not type_.finite or size(type_) > MOST:
        raise UndecidedError
    return type_.values
