"""What an agent holds possible: a set of worlds, kept as what they agree on and independent factors of the rest.

A formula is asked in all worlds at once by running its compiled function on a ``View``, which notes what it reads: only
the factors that matter are gone through, so that the time does not depend on how many worlds there are, but on how many
differ in what is asked.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import TypeAlias, TypeVar, cast

from golc.situation.factors import Factor, distinct, factored
from golc.situation.layout import World
from golc.theory.types import Unknown, Value

T = TypeVar("T")

Assignment: TypeAlias = tuple[tuple[int, World], ...]
"""Which row some factors, given by their numbers, have in a world."""

MOST_CASES = 500_000
"""How many cases are gone through to answer one question, or kept as rows of one factor."""

LONG = 16
"""A case that is given by so many factors takes as long as another one, and counts once more for each as many."""


class TooManyCasesError(Exception):
    """A question would have to be asked in more cases than can be gone through."""

    def __init__(self, most: int) -> None:
        super().__init__(most)
        self.most = most


OPEN: Value = Unknown(())
"""Stands in the slots on which the worlds do not agree."""


class Worlds:
    """At least two possible worlds: equal if they are the same set of worlds.

    ``base`` has the values on which all agree and ``OPEN`` in the slots of the factors; ``owner`` says which factor a
    slot belongs to. (Factors too large to be divided may make equal sets of worlds unequal.)
    """

    def __init__(self, base: World, factors: tuple[Factor, ...]) -> None:
        self.base = base
        self.factors = factors
        self.owner = {slot: number for number, factor in enumerate(factors) for slot in factor.slots}

    @cached_property
    def _content(self) -> tuple[World, frozenset[object]]:
        return self.base, frozenset([factor.content for factor in self.factors])

    @cached_property
    def _hash(self) -> int:
        return hash(self._content)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return self is other or (
            isinstance(other, Worlds) and self._hash == other._hash and self._content == other._content
        )

    def __len__(self) -> int:
        """How many worlds there are."""
        return prod(len(factor.rows) for factor in self.factors)

    def __iter__(self) -> Iterator[World]:
        """Each world; the rows of the last factor change fastest."""
        for rows in itertools.product(*[factor.rows for factor in self.factors]):
            yield self.world(rows)

    def world(self, rows: Sequence[World]) -> World:
        """The world in which each factor has the row given."""
        cells = [*self.base]
        for factor, row in zip(self.factors, rows, strict=True):
            for slot, value in zip(factor.slots, row, strict=True):
                cells[slot] = value
        return tuple(cells)

    def shown(self) -> World:
        """The value of each slot, or an ``Unknown`` with the possible ones."""
        cells = [*self.base]
        for factor in self.factors:
            for column, slot in enumerate(factor.slots):
                cells[slot] = Unknown(tuple(dict.fromkeys(row[column] for row in factor.rows)))
        return tuple(cells)


State: TypeAlias = World | Worlds
"""What the agent knows: the only possible world, or several."""


class View:
    """One of several worlds as compiled code reads it; what is not assigned yet is when it is read.

    ``state``: what the agent knows, of which the world is one. ``trail``: the factors that were assigned by reading.
    """

    __slots__ = ("_base", "_cells", "state", "trail")

    def __init__(self, worlds: Worlds, assignment: Assignment = ()) -> None:
        self.state: State = worlds
        self.trail: list[tuple[int, World]] = []
        self._base = worlds.base
        self._cells: dict[int, Value] = {}
        for number, row in assignment:
            self.assign(worlds.factors[number], row)

    def assign(self, factor: Factor, row: World) -> None:
        """Look at a world in which a factor has this row."""
        self._cells.update(zip(factor.slots, row, strict=True))

    def __getitem__(self, slot: int) -> Value:
        value = self._base[slot]
        if value is not OPEN:
            return value
        if slot not in self._cells:
            worlds = cast(Worlds, self.state)
            number = worlds.owner[slot]
            factor = worlds.factors[number]
            self.assign(factor, factor.rows[0])
            self.trail.append((number, factor.rows[0]))
        return self._cells[slot]


class ActualWorld(tuple[Value, ...]):
    """The world as it really is, for formulas that speak both of it and of what an agent knows (``state``)."""

    state: State

    @classmethod
    def of(cls, world: World, state: State) -> ActualWorld:
        """The world together with what the agent knows."""
        actual = cls(world)
        actual.state = state
        return actual


Readable: TypeAlias = World | View
"""A world as terms are evaluated in it."""


def survey(state: State, ask: Callable[[Readable], T]) -> Iterator[tuple[Assignment, T]]:
    """What ``ask`` answers in each case that it distinguishes by what it reads, in the order of the worlds.

    A case is given by the rows of the factors that were read; each world belongs to exactly one. Raises
    ``TooManyCasesError`` if there are too many.
    """
    if not isinstance(state, Worlds):
        yield (), ask(state)
        return
    stack: list[_Alternatives] = []
    path: list[tuple[int, World]] = []
    view: View | None = View(state)
    cases = 0
    while view is not None:
        answer = ask(view)
        for number, row in view.trail:
            stack.append(_Alternatives(state, len(path), number, iter(state.factors[number].rows[1:])))
            path.append((number, row))
        yield tuple(path), answer
        cases += 1 + len(path) // LONG
        if cases > MOST_CASES:
            raise TooManyCasesError(MOST_CASES)
        view = None
        while stack and view is None:
            view = stack[-1].next(path)
            if view is None:
                stack.pop()


@dataclass(slots=True)
class _Alternatives:
    """The rows of a factor that are still to be looked at, below the first so many assignments of a path."""

    worlds: Worlds
    depth: int
    number: int
    rows: Iterator[World]
    view: View | None = None

    def next(self, path: list[tuple[int, World]]) -> View | None:
        """The next case, to which the path then leads; its view is used again unless reading has assigned it more."""
        del path[self.depth :]
        row = next(self.rows, None)
        if row is None:
            return None
        if self.view is None or self.view.trail:
            self.view = View(self.worlds, tuple(path))
        self.view.assign(self.worlds.factors[self.number], row)
        path.append((self.number, row))
        return self.view


def _everywhere(ask: Callable[..., Value], world: Readable, *rest: Value) -> Iterator[Value]:
    """What a function answers in the worlds that are possible in the state to which a world belongs."""
    state = world if type(world) is tuple else cast("View | ActualWorld", world).state
    return (answer for _, answer in survey(state, lambda other: ask(other, *rest)))


def knows(ask: Callable[..., Value], world: Readable, *rest: Value) -> bool:
    """*Knows(φ)*: a formula is true in all possible worlds."""
    return all(_everywhere(ask, world, *rest))


def possible(ask: Callable[..., Value], world: Readable, *rest: Value) -> bool:
    """A formula is true in some possible world."""
    return any(_everywhere(ask, world, *rest))


def known(ask: Callable[..., Value], world: Readable, *rest: Value) -> bool:
    """*Kref(e)*: all possible worlds agree on a term."""
    answers = _everywhere(ask, world, *rest)
    first = next(answers)
    return all(answer == first for answer in answers)


ASK: Mapping[str, Callable[..., bool]] = {"knows": knows, "possible": possible, "known": known}
"""The functions behind ``knows(φ)``, ``possible(φ)`` and ``known(e)``."""


def keep(state: State, cases: Iterable[Assignment]) -> State:
    """Those worlds that belong to one of the cases of a survey; there must be one."""
    kept = list(cases)
    numbers = sorted({number for case in kept for number, _ in case})
    if not isinstance(state, Worlds) or not numbers:
        return state
    factors = [state.factors[number] for number in numbers]
    slots = [slot for factor in factors for slot in factor.slots]
    rows: list[World] = [row for ((_, row),) in kept] if len(numbers) == 1 else []
    for case in kept if len(numbers) > 1 else ():
        chosen = dict(case)
        parts = [(chosen[number],) if number in chosen else state.factors[number].rows for number in numbers]
        rows += [tuple(itertools.chain.from_iterable(combined)) for combined in itertools.product(*parts)]
        if len(rows) > MOST_CASES:
            raise TooManyCasesError(MOST_CASES)
    if len(rows) == prod(len(factor.rows) for factor in factors):
        return state
    return rebuilt(state.base, state.factors, set(numbers), [(slots, rows)])


def rebuilt(
    base: World,
    factors: Sequence[Factor],
    replaced: set[int],
    tables: Iterable[tuple[Sequence[int], Sequence[World]]],
) -> State:
    """A state with tables of distinct rows in place of some factors and of what was agreed on in their slots."""
    cells = [*base]
    rest = [factor for number, factor in enumerate(factors) if number not in replaced]
    for slots, rows in tables:
        constants, found = factored(slots, rows)
        for slot, value in constants.items():
            cells[slot] = value
        rest += found
    for factor in rest:
        for slot in factor.slots:
            cells[slot] = OPEN
    rest.sort(key=lambda factor: factor.slots)
    return Worlds(tuple(cells), tuple(rest)) if rest else tuple(cells)


def shown(state: State) -> World:
    """The value of each slot, or an ``Unknown`` where the worlds disagree."""
    return state.shown() if isinstance(state, Worlds) else state


def agreed(answers: Iterable[Value]) -> Value:
    """The answer, if all are the same; otherwise an ``Unknown`` with the different ones."""
    values = tuple(dict.fromkeys(answers))
    return values[0] if len(values) == 1 else Unknown(values)


def with_value(state: State, slot: int, value: Value) -> State:
    """A state in which a slot has a value in every world."""
    worlds = state if isinstance(state, Worlds) else Worlds(state, ())
    tables: list[tuple[Sequence[int], Sequence[World]]] = [((slot,), [(value,)])]
    replaced = {worlds.owner[slot]} if slot in worlds.owner else set()
    for number in replaced:
        tables.append(worlds.factors[number].without({slot}))
    return rebuilt(worlds.base, worlds.factors, replaced, tables)


def choices(base: World, options: Mapping[int, Sequence[Value]]) -> State:
    """A state in which each of some slots may have any of several values, independently."""
    tables = [((slot,), distinct([(value,) for value in values], (0,))) for slot, values in options.items()]
    return rebuilt(base, (), set(), tables)
