"""The order of values, in which a set is run through and written."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeAlias, cast

from golc.theory.types import (
    Collection,
    Enumeration,
    InOrder,
    Interval,
    Optional,
    Primitive,
    Quoted,
    Type,
    Unknown,
    Value,
    rank,
)

Key: TypeAlias = Callable[[Any], Any]


def sort_key(type_: Type) -> Key | None:
    """The key by which ``sorted`` puts values of a type in their order; none where that is Python's own.

    Symbols and enumerations have their declared order; numbers are compared by value, texts by their characters, false
    comes before true and ``none`` before everything; lists, and sets in their order, by the first place that differs.
    """
    match type_:
        case Enumeration(values=values):
            return {value: place for place, value in enumerate(values)}.__getitem__
        case Optional(base=base):
            inner = sort_key(base) or _itself
            return lambda value: (False,) if value is None else (True, inner(value))
        case Collection(kind=kind, element=element):
            return _collection_key(kind == "set", sort_key(element))
        case Primitive() | Interval():
            return None
        case _:
            return rank


def _collection_key(is_set: bool, inner: Key | None) -> Key | None:
    if is_set:
        return sorted if inner is None else lambda value: sorted(map(inner, value))
    return None if inner is None else lambda value: tuple(map(inner, value))


def _itself(value: Value) -> Value:
    return value


def elements(collection: Value, type_: Type | None) -> Sequence[Value]:
    """The elements of a list as they stand, or those of a set in the order of the type of its elements.

    ``type_`` is that of the collection; it may have the value ``none`` as well. Without one the order is any.
    """
    if isinstance(collection, tuple):
        return collection
    base = type_.base if isinstance(type_, Optional) else type_
    key = rank if base is None else sort_key(cast(Collection, base).element)
    return sorted(cast(Iterable[Any], collection), key=key)


def arranged(value: Value, type_: Type) -> Value:
    """A value of a type as it is to be written: an equal one that knows the order of sets, and what are strings.

    What is not known has its possible values in order.
    """
    if value is None or isinstance(value, int | str):
        return value
    whole = type_.base if isinstance(type_, Optional) else type_
    if isinstance(value, Unknown):
        values = sorted(cast(Iterable[Any], value.values), key=sort_key(type_))
        return Unknown(tuple([arranged(each, type_) for each in values]))
    if not isinstance(whole, Collection) or value not in whole:
        return value
    parts = [spelt(part, whole.element) for part in elements(value, whole)]
    return InOrder.of(parts) if isinstance(value, frozenset) else tuple(parts)


def spelt(value: Value, type_: Type) -> Value:
    """A value of a type as it is to be written where it stands beside a name or other values: a string in quotes."""
    return Quoted(value) if isinstance(value, str) and "string" in type_.kinds else arranged(value, type_)


def is_written_by_type(type_: Type) -> bool:
    """Whether a value of a type may be written in another way than if nothing was known of its type."""
    return not type_.kinds.isdisjoint({"string", "set", "list"})
