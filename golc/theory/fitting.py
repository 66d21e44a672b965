"""Which types go together: what may stand where, what can ever be equal, what two branches have in common."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from golc.theory.types import INT, REAL, Collection, Enumeration, Interval, Optional, Type, Value


@dataclass(frozen=True)
class Broken(Type):
    """The type of what could not be elaborated: it fits everywhere, so that one mistake is one finding."""

    def __contains__(self, value: object) -> bool:
        return True

    @property
    def kinds(self) -> frozenset[str]:
        return frozenset()

    def __str__(self) -> str:
        return "unknown"


BROKEN = Broken()

MOST_INSTANCES = 100_000
"""How many ground actions of one action are gone through in a state."""

NOTHING = Enumeration(())
"""The type without values: that of the elements of ``{}`` and ``[]``, as long as nothing says more about them."""


@dataclass(frozen=True)
class Either(Type):
    """What is sometimes of the one, sometimes of the other type, though they have nothing in common."""

    one: Type
    other: Type

    def __contains__(self, value: object) -> bool:
        return value in self.one or value in self.other

    @property
    def kinds(self) -> frozenset[str]:
        return self.one.kinds | self.other.kinds

    def __str__(self) -> str:
        return f"{self.one} or {self.other}"


def overlap(left: Type, right: Type) -> bool:
    """Whether a value may belong to both; only by kind, for ranges are a matter of values.

    Sets and lists have to be able to share an element, though the empty one belongs to all of them.
    """
    if left is BROKEN or right is BROKEN:
        return True
    one, other = collection(left), collection(right)
    if one and other and one.kind == other.kind and not (None in left and None in right):
        return NOTHING in (one.element, other.element) or overlap(one.element, other.element)
    return not left.kinds.isdisjoint(right.kinds)


def may_be(found: Type, needed: Type) -> bool:
    """Whether a term of one type may stand where another is needed; a real number is no integer, even a whole one."""
    one, other = collection(found), collection(needed)
    if one and other and one.kind == other.kind:
        return one.element == NOTHING or may_be(one.element, other.element)
    return overlap(found, needed) and ("real" not in found.kinds or "real" in needed.kinds or needed is BROKEN)


def is_undetermined(type_: Type) -> bool:
    """Whether it is the type of an empty set or list, or of one with such elements, about which nothing is known."""
    found = collection(type_)
    return found is not None and (found.element == NOTHING or is_undetermined(found.element))


def strip_optional(type_: Type) -> Type:
    """The type without ``none``."""
    return type_.base if isinstance(type_, Optional) else type_


def collection(type_: Type | None) -> Collection | None:
    """The type of a set or list that a term of a type is, unless it is ``none``; none for every other type."""
    base = None if type_ is None else strip_optional(type_)
    return base if isinstance(base, Collection) else None


def join(left: Type, right: Type) -> Type | None:
    """A type for a term that is sometimes of the one, sometimes of the other type; none if they share nothing."""
    if left is BROKEN or right is BROKEN:
        return BROKEN
    if left == right or right == NOTHING:
        return left
    if left == NOTHING:
        return right
    if isinstance(left, Optional) or isinstance(right, Optional):
        base = join(strip_optional(left), strip_optional(right))
        return None if base is None else Optional(base)
    if isinstance(left, Collection) and isinstance(right, Collection) and left.kind == right.kind:
        element = join(left.element, right.element)
        return None if element is None else Collection(left.kind, element)
    if left.kinds == right.kinds == INT.kinds:
        return INT
    if left.kinds | right.kinds <= REAL.kinds:
        return REAL
    if left.kinds.isdisjoint(right.kinds) or not (left.finite and right.finite):
        return None
    return _join_enumerations(left, right)


def _join_enumerations(left: Type, right: Type) -> Type:
    if all(value in left for value in right.values):
        return left
    if all(value in right for value in left.values):
        return right
    return Enumeration(tuple(dict.fromkeys((*members(left), *members(right)))))


def size(type_: Type) -> int:
    """How many values a finite type has; ``len`` of a range would overflow for a large interval."""
    match type_:
        case Interval(low=low, high=high):
            return high - low + 1
        case Optional(base=base):
            return 1 + size(base)
        case _:
            return len(type_.values)


def combinations(types: Iterable[Type]) -> int | None:
    """How many ways there are to choose a value of each type; none if one of them is not finite."""
    count = 1
    for type_ in types:
        if not type_.finite:
            return None
        count *= size(type_)
    return count


def includes(whole: Type, part: Type) -> bool:
    """Whether the types prove that every value of one belongs to another; intervals are not enumerated."""
    if isinstance(part, Optional):
        return None in whole and includes(strip_optional(whole), part.base)
    if isinstance(part, Either):
        return includes(whole, part.one) and includes(whole, part.other)
    whole = strip_optional(whole)
    if isinstance(part, Interval) and isinstance(whole, Interval):
        return whole.low <= part.low and part.high <= whole.high
    if isinstance(part, Collection) and isinstance(whole, Collection):
        return part.kind == whole.kind and includes(whole.element, part.element)
    if not whole.finite:
        return part.kinds <= whole.kinds
    return part.finite and size(part) <= size(whole) and all(value in whole for value in part.values)


def meet(one: Type, other: Type) -> bool:
    """Whether two types have a value in common; intervals are not enumerated."""
    if not (one.finite and other.finite):
        return overlap(one, other)
    if None in one and None in other:
        return True
    one, other = sorted((strip_optional(one), strip_optional(other)), key=size)
    if isinstance(one, Interval) and isinstance(other, Interval):
        return one.low <= other.high and other.low <= one.high
    return any(value in other for value in one.values)


def members(type_: Type) -> tuple[tuple[Value, str], ...]:
    """The values of an interval or an enumeration, each with the enumeration that declared it."""
    match type_:
        case Enumeration(members=pairs):
            return pairs
        case _:
            return tuple([(value, "") for value in type_.values])
