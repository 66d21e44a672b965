"""Which types go together: what may stand where, what can ever be equal, what two branches have in common."""

from __future__ import annotations

from dataclasses import dataclass

from golc.theory.types import BOOL, INT, Enumeration, Interval, Optional, Type, Value


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


def overlap(left: Type, right: Type) -> bool:
    """Whether a value may belong to both; only by kind, for ranges are a matter of values."""
    return left is BROKEN or right is BROKEN or not left.kinds.isdisjoint(right.kinds)


def strip_optional(type_: Type) -> Type:
    """The type without ``none``."""
    return type_.base if isinstance(type_, Optional) else type_


def join(left: Type, right: Type) -> Type | None:
    """A type for a term that is sometimes of the one, sometimes of the other type; none if they share nothing."""
    if left is BROKEN or right is BROKEN:
        return BROKEN
    if left == right:
        return left
    if isinstance(left, Optional) or isinstance(right, Optional):
        return _join_optional(left, right)
    if left.kinds == right.kinds == INT.kinds:
        return INT
    if left.kinds.isdisjoint(right.kinds) or not (left.finite and right.finite):
        return None
    return _join_enumerations(left, right)


def _join_optional(left: Type, right: Type) -> Type | None:
    left, right = strip_optional(left), strip_optional(right)
    if not left.kinds or not right.kinds:
        return Optional(left if left.kinds else right)
    base = join(left, right)
    return None if base is None else Optional(base)


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


def includes(whole: Type, part: Type) -> bool:
    """Whether every value of a finite type belongs to another one; intervals are not enumerated."""
    if isinstance(part, Optional):
        return None in whole and includes(strip_optional(whole), part.base)
    whole = strip_optional(whole)
    if isinstance(part, Interval) and isinstance(whole, Interval):
        return whole.low <= part.low and part.high <= whole.high
    if not whole.finite:
        return part.kinds <= whole.kinds
    return size(part) <= size(whole) and all(value in whole for value in part.values)


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


def describe(type_: Type) -> str:
    """A type for a message: what it is called and, if the name hides them, its values."""
    match type_:
        case Optional(base=base):
            return "`none`" if not base.kinds else f"{describe(base)} or `none`"
        case Interval(low=low, high=high, name=str(name)):
            return f"`{name}` ({low}..{high})"
        case Enumeration(name=str(name)) as enumeration:
            return f"`{name}` ({_some(enumeration)})"
        case _ if type_ == BOOL:
            return "`bool`"
        case _:
            return f"`{type_}`"


def _some(enumeration: Enumeration) -> str:
    shown = [str(value) for value in enumeration.values[:5]]
    return ", ".join(shown + ["…"] * (len(enumeration.values) > 5))
