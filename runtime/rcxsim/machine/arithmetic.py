"""Numbers of 16 bits in two's complement, and what the op codes do with them.

The results at the borders are those measured on the firmware: see the golden values in the tests.
"""

from __future__ import annotations

import operator
from collections.abc import Callable

from golc.bytecode.opcodes import Relation

LEAST, MOST = -0x8000, 0x7FFF


def wrap(number: int) -> int:
    """The number of 16 bits with the same lowest bits."""
    return ((number + 0x8000) & 0xFFFF) - 0x8000


def add(a: int, b: int) -> int:
    return ((a + b + 0x8000) & 0xFFFF) - 0x8000


def subtract(a: int, b: int) -> int:
    return ((a - b + 0x8000) & 0xFFFF) - 0x8000


def multiply(a: int, b: int) -> int:
    return ((a * b + 0x8000) & 0xFFFF) - 0x8000


def divide(a: int, b: int) -> int:
    """The quotient toward zero; a number divided by zero stays as it is."""
    if b == 0:
        return a
    return wrap(abs(a) // abs(b) if (a < 0) == (b < 0) else -(abs(a) // abs(b)))


def absolute(_: int, b: int) -> int:
    """The absolute value; the least number has none, and becomes the greatest."""
    return min(abs(b), MOST)


def sign(_: int, b: int) -> int:
    return (b > 0) - (b < 0)


ARITHMETIC: dict[str, Callable[[int, int], int]] = {
    "sumv": add,
    "subv": subtract,
    "mulv": multiply,
    "divv": divide,
    "andv": operator.and_,
    "orv": operator.or_,
    "absv": absolute,
    "sgnv": sign,
}
"""What becomes of a variable and a value, for each op code that changes a variable."""

COMPARISONS: dict[Relation, Callable[[int, int], bool]] = {
    Relation.LESS_OR_EQUAL: operator.le,
    Relation.GREATER_OR_EQUAL: operator.ge,
    Relation.UNEQUAL: operator.ne,
    Relation.EQUAL: operator.eq,
}
