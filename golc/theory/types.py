"""The types of golc's terms, and the Python values that stand for theirs.

An integer is an ``int``, a symbol its name as a ``str``, a truth value a ``bool``, ``none`` is ``None``. A real number
is an ``int`` if it is whole, otherwise a ``Fraction``; a string is a ``str``, a set a ``frozenset``, a list a
``tuple``. Types are compared by structure; names are for messages.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, Literal, TypeAlias, cast, overload

Value: TypeAlias = Hashable

Number: TypeAlias = int | Fraction


@dataclass(frozen=True)
class Type:
    """The base of all types."""

    @property
    def finite(self) -> bool:
        """Whether ``values`` can enumerate it."""
        return False

    @property
    def values(self) -> Sequence[Value]:
        """The values in the declared order; only of a finite type."""
        raise TypeError(f"{self} has no finite list of values")

    def __contains__(self, value: object) -> bool:
        """Whether a value belongs to the type."""
        raise NotImplementedError

    @property
    def kinds(self) -> frozenset[str]:
        """What sorts of value it has: ``int``, ``bool``, ``real``, ``string``, ``none``, ``set``, ``list``, or
        ``symbol:E`` for the enumeration E. Terms of disjoint kinds are never equal: comparing them is a type error."""
        raise NotImplementedError


@dataclass(frozen=True)
class Primitive(Type):
    """``bool``, ``int``, ``real``, ``string``."""

    name: str

    @property
    def finite(self) -> bool:
        return self.name == "bool"

    @property
    def values(self) -> Sequence[Value]:
        return (False, True) if self.name == "bool" else super().values

    def __contains__(self, value: object) -> bool:
        match self.name:
            case "bool":
                return isinstance(value, bool)
            case "string":
                return isinstance(value, str)
            case "real":
                return isinstance(value, int | Fraction) and not isinstance(value, bool)
            case _:
                return isinstance(value, int) and not isinstance(value, bool)

    @property
    def kinds(self) -> frozenset[str]:
        return frozenset({"int", "real"} if self.name == "real" else {self.name})

    def __str__(self) -> str:
        return self.name


BOOL = Primitive("bool")
INT = Primitive("int")
REAL = Primitive("real")
STRING = Primitive("string")


@dataclass(frozen=True)
class Interval(Type):
    """``low .. high``, both inclusive; ``low <= high``."""

    low: int
    high: int
    name: str | None = field(default=None, compare=False)

    @property
    def finite(self) -> bool:
        return True

    @property
    def values(self) -> Sequence[Value]:
        return range(self.low, self.high + 1)

    def __contains__(self, value: object) -> bool:
        return isinstance(value, int) and not isinstance(value, bool) and self.low <= value <= self.high

    @property
    def kinds(self) -> frozenset[str]:
        return frozenset({"int"})

    def __str__(self) -> str:
        return self.name or f"{self.low}..{self.high}"


@dataclass(frozen=True)
class Enumeration(Type):
    """Integers and symbols in declared order: an enumeration, or a union written out.

    ``members`` pairs each value with the enumeration that declared it (``""`` for an integer).
    """

    members: tuple[tuple[Value, str], ...]
    name: str | None = field(default=None, compare=False)

    @property
    def finite(self) -> bool:
        return True

    @cached_property
    def values(self) -> Sequence[Value]:
        return tuple(value for value, _ in self.members)

    @cached_property
    def _set(self) -> frozenset[Value]:
        return frozenset(self.values)

    def __contains__(self, value: object) -> bool:
        return not isinstance(value, bool) and value in self._set

    @cached_property
    def kinds(self) -> frozenset[str]:
        return frozenset(f"symbol:{owner}" if owner else "int" for _, owner in self.members)

    def __str__(self) -> str:
        return self.name or "{" + ", ".join(map(str, self.values)) + "}"


@dataclass(frozen=True)
class Optional(Type):
    """``base?``: the base and ``none``, which comes first in the order."""

    base: Type

    @property
    def finite(self) -> bool:
        return self.base.finite

    @cached_property
    def values(self) -> Sequence[Value]:
        return _NoneFirst(self.base.values)

    def __contains__(self, value: object) -> bool:
        return value is None or value in self.base

    @property
    def kinds(self) -> frozenset[str]:
        return self.base.kinds | {"none"}

    def __str__(self) -> str:
        return f"{self.base}?"


@dataclass(frozen=True)
class _NoneFirst(Sequence[Value]):
    """``none`` before other values, which are not copied: a ``range`` may be longer than memory."""

    rest: Sequence[Value]

    def __len__(self) -> int:
        return 1 + len(self.rest)

    @overload
    def __getitem__(self, place: int) -> Value: ...
    @overload
    def __getitem__(self, place: slice) -> tuple[Value, ...]: ...
    def __getitem__(self, place: int | slice) -> Value | tuple[Value, ...]:
        if isinstance(place, slice):
            return tuple([self[each] for each in range(len(self))[place]])
        place = range(len(self))[place]
        return self.rest[place - 1] if place else None

    def __contains__(self, value: object) -> bool:
        return value is None or value in self.rest


@dataclass(frozen=True)
class Collection(Type):
    """``set[element]`` or ``list[element]``: as values a ``frozenset`` and a ``tuple``."""

    kind: Literal["set", "list"]
    element: Type

    def __contains__(self, value: object) -> bool:
        is_one = isinstance(value, frozenset) if self.kind == "set" else isinstance(value, tuple)
        return is_one and all(part in self.element for part in cast(Iterable[Value], value))

    @property
    def kinds(self) -> frozenset[str]:
        return frozenset({self.kind})

    def __str__(self) -> str:
        return f"{self.kind}[{self.element}]" if self.element.kinds else f"empty {self.kind}"


@dataclass(frozen=True)
class Unknown:
    """What is shown in place of a value that the agent does not know: the possible ones."""

    values: tuple[Value, ...]


class InOrder(frozenset[Value]):
    """A set to be written, with its elements in the order in which they are."""

    order: tuple[Value, ...] = ()

    @classmethod
    def of(cls, order: Iterable[Value]) -> InOrder:
        """The set of some elements."""
        made = cls(order := tuple(order))
        made.order = order
        return made


class Quoted(str):
    """A string to be written in quotes."""


NONE = Optional(Enumeration(()))
"""The type of ``none`` alone."""


def number(value: Value) -> Value:
    """A number in its only form: as an ``int`` if it is whole. Other values stay as they are."""
    return value.numerator if isinstance(value, Fraction) and value.denominator == 1 else value


MOST_BITS = 14_000
"""Larger integers are not shown in full: Python refuses to write more than 4,300 decimal digits."""

MOST_DECIMALS = 100
"""With more decimals than these a real number is shown as a quotient."""

ESCAPED = str.maketrans({'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "{": "{{", "}": "}}"})
"""How characters of a string are written between quotes."""


def show(value: Value) -> str:
    """A value as golc writes it: ``true``, ``none``, ``3``, ``0.5``, ``stopped``, ``{1, 2}``; a string as its text,
    unless it is known to be one."""
    match value:
        case None:
            return "none"
        case Quoted():
            return '"' + value.translate(ESCAPED) + '"'
        case Unknown(values=values):
            return _alternatives([show(each) for each in values[:MOST_ALTERNATIVES]], len(values))
        case bool():
            return "true" if value else "false"
        case int() if value.bit_length() > MOST_BITS:
            return f"{hex(value)[:12]}… ({value.bit_length()} bits)"
        case Fraction(denominator=1):
            return show(value.numerator)
        case Fraction():
            return _decimal(value)
        case frozenset():
            return "{" + ", ".join(map(_part, _in_order(value))) + "}"
        case tuple():
            return "[" + ", ".join(map(_part, value)) + "]"
        case _:
            return str(value)


MOST_ALTERNATIVES = 5
"""How many possible values are named for one that is not known."""


def _alternatives(named: list[str], count: int) -> str:
    if count > len(named):
        return f"{', '.join(named)}, … ({count} possible values)"
    return " or ".join(filter(None, [", ".join(named[:-1]), named[-1]]))


def _decimal(value: Fraction) -> str:
    """A real number with all its decimals; as a quotient if they do not end, or are too many."""
    places = 1
    while 10**places % value.denominator and places < MOST_DECIMALS:
        places += 1
    scaled = value * 10**places
    if scaled.denominator > 1 or scaled.numerator.bit_length() > MOST_BITS:
        return f"{show(value.numerator)}/{show(value.denominator)}"
    digits = str(abs(scaled.numerator)).rjust(places + 1, "0")
    return f"{'-' * (value < 0)}{digits[:-places]}.{digits[-places:]}"


def _part(value: Value) -> str:
    """A value beside others: there a string that is no single word stands in quotes."""
    is_word = not isinstance(value, str) or re.fullmatch("[A-Za-z][A-Za-z0-9_]*", value)
    return show(value if is_word else Quoted(value))


def _in_order(value: frozenset[Value]) -> Iterable[Value]:
    return value.order if isinstance(value, InOrder) else sorted(value, key=rank)


def rank(value: Value) -> tuple[int, Any]:
    """A key for values of any types: what brings the elements of a set into an order where their type says none."""
    match value:
        case None:
            return 0, 0
        case bool():
            return 1, value
        case int() | Fraction():
            return 2, value
        case frozenset():
            return 4, sorted(map(rank, value))
        case tuple():
            return 5, tuple(map(rank, value))
        case _:
            return 3, value


def writable(thing: object) -> object:
    """A structure of values for JSON: a set is a list, a number that would not be exact there the text of ``show``."""
    match thing:
        case Unknown(values=values):
            return {"one of": writable(values)}
        case Mapping():
            return {name: writable(part) for name, part in thing.items()}
        case list() | tuple():
            return [writable(part) for part in thing]
        case frozenset():
            return [writable(part) for part in _in_order(thing)]
        case Fraction():
            return _number(show(thing)) if thing.denominator > 1 else writable(thing.numerator)
        case int() if thing.bit_length() > MOST_BITS:
            return show(thing)
        case _:
            return thing


def _number(text: str) -> float | str:
    """A number with decimals for JSON, as a text if it has more of them than JSON's readers keep."""
    is_exact = re.fullmatch(r"-?\d+\.\d+", text) and repr(float(text)) == text
    return float(text) if is_exact else text


def show_call(name: str, args: Sequence[Value]) -> str:
    """``a`` or ``a(1, b)``."""
    return f"{name}({', '.join(map(_part, args))})" if args else name
