"""What the fluents and variables of a question may be."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from golc.proofs.symbols import MOST_CONCRETE, Range
from golc.theory.fitting import collection, size
from golc.theory.types import INT, STRING, Collection, Interval, Optional, Type, Value

MOST_MEMBERS = 9
"""Sets of so many possible elements are gone through; there are 512 of them."""

MOST_ELEMENTS = 6
"""Of how many elements other sets, and lists, are made to find a witness among them."""


@dataclass(frozen=True)
class Some:
    """A few of more values than can be gone through: a witness may be among them, but no proof that there is none."""

    values: tuple[Value, ...]


Domain: TypeAlias = Sequence[Value] | Range | Some
"""Values that can be gone through, a range of integers, or more than that."""


def domain(type_: Type) -> Domain:
    """What something of a type may be."""
    if type_ == INT:
        return Range()
    if isinstance(type_, Interval) and size(type_) > MOST_CONCRETE:
        return Range(type_.low, type_.high)
    if type_.finite and size(type_) <= MOST_CONCRETE:
        return type_.values
    whole = collection(type_)
    if whole and whole.kind == "set" and whole.element.finite and size(whole.element) <= MOST_MEMBERS:
        return [*([None] if None in type_ else []), *_subsets(whole.element.values)]
    return Some(_few(type_))


def _subsets(members: Sequence[Value]) -> list[frozenset[Value]]:
    """All sets of some elements, the smallest first."""
    return [frozenset(chosen) for count in range(len(members) + 1) for chosen in itertools.combinations(members, count)]


def _few(type_: Type) -> tuple[Value, ...]:
    """A few values of a type that has too many."""
    match type_:
        case Optional(base=base):
            return (None, *_few(base))
        case Collection(kind=kind, element=element):
            parts = _few(element)[:MOST_ELEMENTS]
            pairs = itertools.permutations(parts[:2], 2)
            lists = [(), *[(part,) for part in parts], *pairs, parts[:1] * 2, parts[:1] * 8, parts]
            return tuple(dict.fromkeys(map(frozenset, lists) if kind == "set" else lists))
        case _ if type_.finite:
            return tuple(type_.values[:MOST_ELEMENTS])
        case _ if type_ == STRING:
            return ("", "a", "b")
        case _:
            return (0, 1, 2, -1, *([Fraction(1, 2)] if "real" in type_.kinds else []))


def any_of(domain: Domain) -> Value:
    """Some value, for a variable that nothing depends on."""
    match domain:
        case Range() as range_:
            return range_.nearest_to_zero()
        case Some(values=values):
            return values[0]
        case values:
            return values[0]
