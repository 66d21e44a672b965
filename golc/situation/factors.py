"""Sets of rows as products of smaller ones, so that what is unknown independently is kept independently.

Twenty switches of which nothing is known are twenty factors of two rows each, not a million worlds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence, Set
from dataclasses import dataclass
from functools import cached_property
from math import prod

from golc.situation.layout import World
from golc.theory.types import Value

MOST_ROWS_DIVIDED = 4_096
"""Larger tables are kept whole: the time to divide one grows with its rows and the square of its columns."""


@dataclass(frozen=True, eq=False)
class Factor:
    """Some slots (in ascending order), and the tuples of values that they may have together: at least two."""

    slots: tuple[int, ...]
    rows: tuple[World, ...]

    @cached_property
    def content(self) -> tuple[tuple[int, ...], frozenset[World]]:
        """What makes two factors equal: the order of the rows does not count."""
        return self.slots, frozenset(self.rows)

    def without(self, slots: Set[int]) -> tuple[tuple[int, ...], list[World]]:
        """The other slots, and the rows that remain of them."""
        columns = [index for index, slot in enumerate(self.slots) if slot not in slots]
        return tuple([self.slots[column] for column in columns]), distinct(self.rows, columns)


def distinct(rows: Iterable[World], columns: Sequence[int]) -> list[World]:
    """The distinct rows that remain of some columns, in order of first appearance."""
    pick = _picker(columns)
    return list(dict.fromkeys(map(pick, rows)))


def factored(slots: Sequence[int], rows: Sequence[World]) -> tuple[dict[int, Value], list[Factor]]:
    """A table, whose rows are distinct, as what is the same in all its rows and the finest factors of the rest."""
    constants = {slot: rows[0][column] for column, slot in enumerate(slots) if _is_constant(rows, column)}
    columns = [column for column, slot in enumerate(slots) if slot not in constants]
    rest = rows if len(columns) == len(slots) else distinct(rows, columns)
    open_ = [slots[column] for column in columns]
    factors = []
    for block in _blocks(rest, len(open_)):
        block.sort(key=lambda column: open_[column])
        factors.append(Factor(tuple([open_[column] for column in block]), tuple(distinct(rest, block))))
    return constants, factors


def _is_constant(rows: Sequence[World], column: int) -> bool:
    first = rows[0][column]
    return all(row[column] == first for row in rows)


def _picker(columns: Sequence[int]) -> Callable[[World], World]:
    return lambda row: tuple([row[column] for column in columns])


def _blocks(rows: Sequence[World], width: int) -> Iterator[list[int]]:
    """The finest division of the columns such that the rows are the product of what remains of each block.

    The columns are taken in one by one: a block that was found so far either is still independent of all the others,
    or belongs to the block of the new column.
    """
    if len(rows) > MOST_ROWS_DIVIDED:
        return iter([[*range(width)]])
    if len(rows) == prod(len({row[column] for row in rows}) for column in range(width)):
        return iter([[column] for column in range(width)])
    blocks: list[list[int]] = []
    for column in range(width):
        so_far = distinct(rows, range(column + 1))
        joined, independent = [column], []
        for block in blocks:
            rest = [other for other in range(column + 1) if other not in block]
            if len(distinct(so_far, block)) * len(distinct(so_far, rest)) == len(so_far):
                independent.append(block)
            else:
                joined += block
        blocks = [*independent, joined]
    return iter(blocks)
