"""Every situation at once: what a compiled term answers in all cases that it distinguishes.

A ``Case`` is a situation that comes into being while it is read. What a slot holds is decided when it is first asked
for; ``explore`` asks again and again until every decision has gone each way. So a question costs as many cases as it
tells apart, and a case says which fluents the answer depends on: all others may have any value.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeAlias, TypeVar

from golc.proofs.domains import Domain, Some
from golc.proofs.symbols import MOST_CONCRETE, NotDecidedError, Range, Symbol
from golc.theory.types import Value

T = TypeVar("T")
C = TypeVar("C", bound="Case")
Box: TypeAlias = Mapping[int, "Value | Range"]
"""What each of some slots may be: one value, or the integers of a range."""

MOST_LOOKS = 200_000
"""How often one question may look at a slot: what uses a definition twice, which uses another one twice, takes long."""


class Budget:
    """How often slots may still be looked at."""

    def __init__(self, left: int = MOST_LOOKS) -> None:
        self.left = left

    def spend(self) -> None:
        """Count a look; raises ``NotDecidedError`` when there have been enough."""
        self.left -= 1
        if self.left < 0:
            raise NotDecidedError("it takes too long to evaluate")


class Case:
    """A situation as far as it is decided: ``cells`` are the slots that were read.

    What is not among the ``decisions`` goes the first way, or any by ``chance``.
    """

    def __init__(
        self,
        domains: Sequence[Domain] | Mapping[int, Domain],
        decisions: list[tuple[int, int]],
        chance: random.Random | None = None,
        budget: Budget | None = None,
    ) -> None:
        self.cells: dict[int, Value] = {}
        self.whole = True
        """Whether every value of each slot that was read has its turn."""
        self.decisions = decisions
        """What was decided so far, in order: which way, of how many."""
        self.guesses = 0
        """How often it was guessed what the agent knows. One guess may be right; several need not go together."""
        self.open = False
        """Whether something was decided that no slot holds."""
        self._domains = domains
        self._ranges: dict[int, Range] = {}
        self._next = 0
        self._chance = chance
        self._budget = budget or Budget()

    def choose(self, ways: int) -> int:
        """Decide which of several ways things are."""
        if ways == 1:
            return 0
        if self._next == len(self.decisions):
            self.decisions.append((0 if self._chance is None else self._chance.randrange(ways), ways))
        self._next += 1
        return self.decisions[self._next - 1][0]

    def branch(self, ways: int) -> int:
        """Decide something that no slot holds."""
        self.open = True
        return self.choose(ways)

    def guess(self) -> bool:
        """Decide something about what the agent knows."""
        self.guesses += 1
        return self.branch(2) == 0

    def look(self) -> None:
        """Count a look at a slot."""
        self._budget.spend()

    def __getitem__(self, slot: int) -> Value:
        slot = int(slot)
        self.look()
        if slot not in self.cells:
            domain = self._domains[slot]
            match domain:
                case Some(values=values):
                    self.whole = False
                    self.cells[slot] = values[self.choose(len(values))]
                case Range(low=low, high=high):
                    self._ranges[slot] = Range(low, high)
                    self.cells[slot] = Symbol.of(self, slot)
                case _:
                    self.cells[slot] = domain[self.choose(len(domain))]
        return self.cells[slot]

    def is_below(self, slot: int, bound: int) -> bool:
        """Whether the integer in a slot is less than a bound."""
        self.look()
        range_ = self._ranges[slot]
        if range_.high is not None and range_.high < bound:
            return True
        if range_.low is not None and range_.low >= bound:
            return False
        below = self.choose(2) == 0
        self._ranges[slot] = Range(range_.low, bound - 1) if below else Range(bound, range_.high)
        return below

    def is_equal(self, slot: int, value: int) -> bool:
        """Whether the integer in a slot has a value."""
        return not self.is_below(slot, value) and self.is_below(slot, value + 1)

    def concrete(self, slot: int, why: str) -> int:
        """The integer in a slot itself."""
        range_ = self._ranges[slot]
        count = range_.count
        if count is None or count > MOST_CONCRETE:
            raise NotDecidedError(f"an integer of a large type is {why}")
        assert range_.low is not None
        value = range_.low + self.choose(count)
        self._ranges[slot] = Range(value, value)
        return value

    def values(self) -> dict[int, Value]:
        """A value for each slot that was read: of an integer the one nearest to 0."""
        return {slot: self.value(slot) for slot in self.cells}

    def box(self) -> Box:
        """What each slot that was read may be in this case."""
        return {slot: self._ranges.get(slot, value) for slot, value in self.cells.items()}

    def value(self, slot: int) -> Value:
        """The value of a slot that was read."""
        return self._ranges[slot].nearest_to_zero() if slot in self._ranges else self.cells[slot]


def explore(new: Callable[[list[tuple[int, int]]], C], ask: Callable[[C], T]) -> Iterator[tuple[C, T]]:
    """What ``ask`` answers in each case that it distinguishes; the last decision changes fastest. ``new`` makes a case
    of decisions.

    Raises ``NotDecidedError`` where a case is beyond enumeration and intervals.
    """
    decisions: list[tuple[int, int]] = []
    while True:
        case = new(decisions)
        answer = ask(case)
        yield case, answer
        decisions = list(case.decisions)
        while decisions and decisions[-1][0] + 1 == decisions[-1][1]:
            decisions.pop()
        if not decisions:
            return
        way, ways = decisions[-1]
        decisions[-1] = (way + 1, ways)


def sample(domains: Sequence[Domain], ask: Callable[[Case], T], seed: int, budget: Budget) -> Iterator[tuple[Case, T]]:
    """What ``ask`` answers in cases by chance, without end; the same ones for the same seed."""
    chance = random.Random(seed)
    while True:
        case = Case(domains, [], chance, budget)
        yield case, ask(case)
