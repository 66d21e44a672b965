"""The smallest counterexample: as few fluents as make sure that what is asked is so, whatever the others are.

The cases that a question distinguishes say, each for a *box* of situations, whether it is so. Values of some fluents
are a counterexample if they lie outside every box where it is not: the fewest are a smallest hitting set of these
boxes. Of as many fluents, those with the smallest values are taken, in the order of their types, or near 0.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

from golc.proofs.asking import Asking, Leaf
from golc.proofs.cases import Box, Budget, Case, explore
from golc.proofs.domains import Domain, Some, any_of
from golc.proofs.questions import Question
from golc.proofs.symbols import NotDecidedError, Range
from golc.theory.types import Value

MOST_TESTS = 400_000
"""How often a value is held against a box before the search is given up."""

MOST_LEAVES = 2_000
"""How many cases are told apart to see which of the values in one of them matter."""

MOST_LEFT_OUT = 50
"""Of how many values it is tried to leave them out one by one."""

FEW_LOOKS = 50_000
"""How often slots are looked at meanwhile."""

MOST_KINDS = 10
"""How many different errors are tried as what the smallest counterexample shows."""


class _GivenUpError(Exception):
    pass


def smallest(
    leaves: Sequence[Leaf], domains: Sequence[Domain], first: int, only: Mapping[int, Value] | None = None
) -> dict[int, Value] | None:
    """The fewest values of slots that make sure that it is so; those from slot ``first`` on are not counted.

    ``leaves`` are all there are, and one at least is a counterexample. ``only``: the values that slots may have. None
    if it takes too long.
    """
    kinds = dict.fromkeys([leaf.answer for leaf in leaves if leaf.is_witness])
    work = _Work()
    searches = [_Search(leaves, kind, domains, first, only, work) for kind in [*kinds][:MOST_KINDS]]
    try:
        for fluents in range(first + 1):
            for search in searches:
                search.run(fluents)
            found = [search.best for search in searches if search.best is not None]
            if found:
                return min(found, key=lambda best: best[0])[1]
    except _GivenUpError:
        pass
    return None


def reduced(asking: Asking, question: Question, values: Mapping[int, Value], answer: Hashable) -> set[int] | None:
    """Of the slots that make what is asked so, the fewest that suffice for the same answer, or, where that takes too
    long, as many as can be left out one by one. None if nothing is known of that."""
    first = asking.layout.size
    domains = asking.domains_of(question)
    for slot in range(first, len(domains)):
        domains[slot] = (values[slot] if slot in values else any_of(domains[slot]),)
    leaves = _leaves(asking, question, domains)
    if leaves is not None:
        alike = [Leaf(leaf.box, leaf.answer if leaf.answer == answer else None) for leaf in leaves]
        found = smallest(alike, domains, first, values)
        if found is not None:
            return {*found}

    def suffice(slots: set[int]) -> bool:
        some = [(values[slot],) if slot in slots else of for slot, of in enumerate(domains)]
        leaves = _leaves(asking, question, some)
        return leaves is not None and all(leaf.answer == answer for leaf in leaves)

    kept = {slot for slot in values if slot < first}
    if len(kept) > MOST_LEFT_OUT or not suffice(kept):
        return None
    for slot in sorted(kept, reverse=True):
        if suffice(kept - {slot}):
            kept.remove(slot)
    return kept


def _leaves(asking: Asking, question: Question, domains: Sequence[Domain]) -> list[Leaf] | None:
    """All cases of a question, whether or not the invariants hold; none if they cannot be told apart."""
    leaves: list[Leaf] = []
    new = partial(Case, domains, budget=Budget(FEW_LOOKS))
    try:
        for case, leaf in explore(new, partial(asking.leaf, question, assuming=False)):
            if case.open or not case.whole or len(leaves) == MOST_LEAVES:
                return None
            leaves.append(leaf)
    except NotDecidedError:
        return None
    return leaves


@dataclass
class _Work:
    left: int = MOST_TESTS

    def on(self, boxes: Sequence[Box]) -> Sequence[Box]:
        """The boxes, which are gone through."""
        self.left -= 1 + len(boxes)
        if self.left < 0:
            raise _GivenUpError
        return boxes


@dataclass
class _Search:
    """For a smallest counterexample that shows one error, or success."""

    leaves: Sequence[Leaf]
    kind: Hashable
    domains: Sequence[Domain]
    first: int
    only: Mapping[int, Value] | None
    work: _Work
    best: tuple[int, dict[int, Value]] | None = None
    """The smallest one found, and how large its values are together."""
    _candidates: dict[int, list[tuple[int, Value]]] = field(default_factory=dict)
    _seen: set[frozenset[tuple[int, Value]]] = field(default_factory=set)

    def run(self, fluents: int) -> None:
        """Look for one with so many fluents."""
        wrong = [leaf.box for leaf in self.leaves if leaf.answer != self.kind]
        right = [leaf.box for leaf in self.leaves if leaf.answer == self.kind and leaf.is_witness]
        self._seen.clear()
        self._extend({}, 0, sorted(wrong, key=len), right, fluents)

    def _extend(
        self, chosen: dict[int, Value], size: int, wrong: Sequence[Box], right: Sequence[Box], fluents: int
    ) -> None:
        if not right or (self.best is not None and size >= self.best[0]):
            return
        if not wrong:
            self.best = size, chosen
            return
        for slot, within in wrong[0].items():
            cost = int(slot < self.first)
            if slot in chosen or cost > fluents:
                continue
            for rank, value in self._values(slot):
                longer = {**chosen, slot: value}
                key = frozenset(longer.items())
                if key in self._seen or _fits(value, within):
                    continue
                self._seen.add(key)
                still = [box for box in self.work.on(wrong) if slot not in box or _fits(value, box[slot])]
                open_ = [box for box in self.work.on(right) if slot not in box or _fits(value, box[slot])]
                self._extend(longer, size + rank, still, open_, fluents - cost)

    def _values(self, slot: int) -> list[tuple[int, Value]]:
        """The values that a slot may be given, the smallest first, each with its rank."""
        if slot not in self._candidates:
            if self.only is not None:
                found = [(0, self.only[slot])] if slot in self.only else []
            else:
                ranges = [leaf.box[slot] for leaf in self.leaves if slot in leaf.box]
                found = sorted(_ranked(self.domains[slot], ranges), key=lambda pair: pair[0])
            self._candidates[slot] = found
        return self._candidates[slot]


def _ranked(domain: Domain, boxes: Iterable[Value | Range]) -> Iterator[tuple[int, Value]]:
    """The values of a domain that need to be told apart, with their ranks."""
    match domain:
        case Range():
            ends = {
                end for box in boxes if isinstance(box, Range) for end in (box.low, box.high, box.nearest_to_zero())
            }
            for value in {domain.nearest_to_zero(), *ends}:
                if value is not None:
                    yield rank(value, domain), value
        case Some(values=values):
            yield from enumerate(values)
        case values:
            yield from enumerate(values)


def rank(value: Value, domain: Domain) -> int:
    """How many values of a domain are smaller."""
    match domain:
        case Range():
            assert isinstance(value, int)
            return 2 * abs(value) - (value > 0)
        case Some(values=values):
            return values.index(value) if value in values else len(values)
        case values:
            return values.index(value)


def _fits(value: Value, within: Value | Range) -> bool:
    """Whether a value lies in one side of a box."""
    if isinstance(within, Range):
        assert isinstance(value, int)
        return (within.low is None or within.low <= value) and (within.high is None or value <= within.high)
    return value == within
