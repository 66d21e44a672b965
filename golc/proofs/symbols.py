"""Integers of which only an interval is known, for compiled terms to calculate with.

A ``Symbol`` stands for ``factor · x + offset``, where x is the integer in some slot of a case. It is compared with a
constant, or with a symbol of the same x, by dividing the interval of x where the answer changes: one case each. So
terms that treat each unbounded integer by itself are decided exactly, however large its type is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from golc.proofs.cases import Case

MOST_CONCRETE = 1_000
"""An interval with no more values is gone through where its values themselves are needed."""


class NotDecidedError(Exception):
    """Something is asked that intervals and enumeration do not answer: why."""


class NeedsPythonError(NotDecidedError):
    """What is asked depends on a function of Python, that of the static ``name``, which is not executed."""

    def __init__(self, name: str) -> None:
        super().__init__(f"it depends on `{name}`, which is not executed")
        self.name = name


class Range:
    """The integers from ``low`` to ``high``, where none is no bound."""

    __slots__ = ("high", "low")

    def __init__(self, low: int | None = None, high: int | None = None) -> None:
        self.low = low
        self.high = high

    def has(self, value: int) -> bool:
        """Whether an integer is one of them."""
        return (self.low is None or self.low <= value) and (self.high is None or value <= self.high)

    def nearest_to_zero(self) -> int:
        """The value that a reader finds simplest."""
        if self.low is not None and self.low > 0:
            return self.low
        return self.high if self.high is not None and self.high < 0 else 0

    @property
    def count(self) -> int | None:
        """How many integers there are; none if there is no end."""
        return None if self.low is None or self.high is None else self.high - self.low + 1


class Symbol(int):
    """``factor · x + offset`` for the integer x in a slot of a case. Arithmetic stays linear, or is not decided."""

    case: Case
    slot: int
    factor: int
    offset: int

    @staticmethod
    def of(case: Case, slot: int, factor: int = 1, offset: int = 0) -> Symbol:
        """The symbol of a slot."""
        symbol = Symbol(0)
        symbol.case, symbol.slot, symbol.factor, symbol.offset = case, slot, factor, offset
        return symbol

    def _times(self, factor: int) -> int:
        return 0 if factor == 0 else Symbol.of(self.case, self.slot, self.factor * factor, self.offset * factor)

    def __add__(self, other: Any) -> Any:
        if isinstance(other, Symbol):
            if other.slot != self.slot:
                raise NotDecidedError("two unbounded integers are added")
            factor, offset = self.factor + other.factor, self.offset + other.offset
            return Symbol.of(self.case, self.slot, factor, offset) if factor else offset
        if not isinstance(other, int):
            raise NotDecidedError("real numbers are calculated with")
        return Symbol.of(self.case, self.slot, self.factor, self.offset + other)

    __radd__ = __add__

    def __neg__(self) -> int:
        return self._times(-1)

    def __sub__(self, other: Any) -> Any:
        return self + -other

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Symbol):
            raise NotDecidedError("two unbounded integers are multiplied")
        return self._times(other)

    __rmul__ = __mul__

    def __abs__(self) -> int:
        return -self if self < 0 else self

    def __floordiv__(self, other: Any) -> Any:
        return self._concrete("divided") // other

    def __rfloordiv__(self, other: Any) -> Any:
        return other // self._concrete("a divisor")

    def __mod__(self, other: Any) -> Any:
        return self._concrete("divided") % other

    def __rmod__(self, other: Any) -> Any:
        return other % self._concrete("a divisor")

    def __lt__(self, other: Any) -> bool:
        return self._below(other, 0)

    def __le__(self, other: Any) -> bool:
        return self._below(other, 1)

    def __gt__(self, other: Any) -> bool:
        return not self._below(other, 1)

    def __ge__(self, other: Any) -> bool:
        return not self._below(other, 0)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, int) or isinstance(other, bool):
            return False
        difference = self - other
        if not isinstance(difference, Symbol):
            return bool(difference == 0)
        zero, rest = divmod(-difference.offset, difference.factor)
        return rest == 0 and self.case.is_equal(self.slot, zero)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __bool__(self) -> bool:
        return self != 0

    def __hash__(self) -> int:
        return hash(self._concrete("looked up"))

    def __index__(self) -> int:
        return self._concrete("counted with")

    def __int__(self) -> int:
        return self._concrete("counted with")

    def __repr__(self) -> str:
        return f"{self.factor}·s[{self.slot}]{self.offset:+d}"

    def _below(self, other: Any, strictness: int) -> bool:
        """Whether it is less than ``other + strictness``, which is an integer or a symbol of the same slot."""
        if not isinstance(other, int):
            raise NotDecidedError("real numbers are compared")
        difference = self - other - strictness
        if not isinstance(difference, Symbol):
            return bool(difference < 0)
        # factor · x + offset < 0
        if difference.factor > 0:
            return self.case.is_below(self.slot, -(difference.offset // difference.factor))
        return not self.case.is_below(self.slot, difference.offset // -difference.factor + 1)

    def _concrete(self, why: str) -> int:
        """Its value in this case, which is one of few."""
        return self.factor * self.case.concrete(self.slot, why) + self.offset
