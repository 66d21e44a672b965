"""Values of Python that golc did not make, as values of golc."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from numbers import Integral

from golc.theory.fitting import collection
from golc.theory.types import Type, Value, number

FOREIGN: Value = object()
"""What stands for a Python value that is none of golc's: it belongs to no type."""


def golc_value(value: object, type_: Type) -> Value:
    """The value that a Python object stands for where a type is needed.

    A symbol is a string with its name. A real number may be a ``float``, which means the decimals that Python writes;
    lists and sets may be mutable.
    """
    whole = collection(type_)
    match value:
        case None | bool():
            return value
        case Integral():
            return int(value)
        case str():
            return str.__str__(value)
        case Fraction() if "real" in type_.kinds:
            return number(value)
        case float() | Decimal() if "real" in type_.kinds and math.isfinite(value):
            return number(Fraction(str(value)))
        case list() | tuple() if whole is not None and whole.kind == "list":
            return tuple([golc_value(element, whole.element) for element in value])
        case set() | frozenset() if whole is not None and whole.kind == "set":
            return frozenset([golc_value(element, whole.element) for element in value])
        case _:
            return FOREIGN
