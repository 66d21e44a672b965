"""Python values as terms: which of them mean something in a theory, and the trees that they stand for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from decimal import Decimal
from typing import TypeVar

from golc.diagnostics import Code, Span
from golc.embed import asked
from golc.embed.errors import Refused, refused
from golc.syntax import tree
from golc.syntax.layout import LONGEST_NUMBER

MOST_ELEMENTS = 100_000
"""How many elements of a Python collection are written out."""

_LARGEST = 10**LONGEST_NUMBER
T = TypeVar("T")


class Meaningful:
    """A Python object of this package that stands for a term of the language."""

    __slots__ = ()

    def _tree_at(self, span: Span) -> tree.Expr:
        """The term, for an object that is named at a place."""
        raise NotImplementedError

    def _is_unsettled(self) -> bool:
        """Whether it has a value only in a situation."""
        return False


def expr(value: object, span: Span) -> tree.Expr:
    """The tree of a Python value that means something in a theory; a name and a literal stand at ``span``.

    Raises ``Refused`` for a value that means nothing.
    """
    match value:
        case Meaningful():
            return value._tree_at(span)
        case bool():
            if wrong := asked.answered(span, is_unsettled):
                raise wrong
            return tree.Truth(value, span=span)
        case int():
            if value.bit_length() > _LARGEST.bit_length():
                raise _too_long(span)
            number = tree.Number(abs(value), span=span)
            return number if value >= 0 else tree.Unary("-", number, span=span)
        case float() | Decimal():
            return _real(value, span)
        case str():
            return tree.Message((value,) if value else (), span=span)
        case None:
            return tree.Nothing(span=span)
        case set() | frozenset():
            return tree.SetLiteral(tuple(expr(each, span) for each in sorted(value, key=repr)), span=span)
        case list() | tuple() | range():
            return tree.ListLiteral(tuple(expr(each, span) for each in elements(value, span)), span=span)
    raise refused(Code.PYTHON_VALUE, f"{described(value)} means nothing in a theory", span, _instead(value))


def is_unsettled(value: object) -> bool:
    """Whether a Python value is a term that has a value only in a situation."""
    return isinstance(value, Meaningful) and value._is_unsettled()


def _real(value: float | Decimal, span: Span) -> tree.Expr:
    number = Decimal(repr(value)) if isinstance(value, float) else value
    if not number.is_finite():
        raise refused(Code.PYTHON_VALUE, f"{value} is no number of the language", span)
    if abs(number.adjusted()) > LONGEST_NUMBER or len(number.as_tuple().digits) > LONGEST_NUMBER:
        raise _too_long(span)
    text = format(abs(number), "f")
    real = tree.Real(Decimal(text if "." in text else f"{text}.0"), span=span)
    return real if number >= 0 else tree.Unary("-", real, span=span)


def _too_long(span: Span) -> Refused:
    message = f"a number of so many digits is too long: the limit is {LONGEST_NUMBER}"
    return refused(Code.PYTHON_VALUE, message, span)


def elements(values: Iterable[T], span: Span) -> Iterator[T]:
    """What is to be written out, one by one. Raises ``Refused`` where there is no end of it."""
    for count, value in enumerate(values):
        if count == MOST_ELEMENTS:
            message = f"this has more than {MOST_ELEMENTS} elements, which would all be written out"
            raise refused(Code.PYTHON_VALUE, message, span, "write `interval(1, n)` for integers in a row")
        yield value


def described(value: object) -> str:
    """What a Python value is, for a message."""
    match value:
        case type():
            return f"the Python class `{value.__name__}`"
        case dict():
            return "a dictionary"
    name = getattr(value, "__name__", None)
    if callable(value) and isinstance(name, str):
        return f"the Python function `{name}`"
    return f"a Python value of type `{type(value).__name__}`"


def _instead(value: object) -> str:
    if isinstance(value, dict):
        return "a table is the value of a static: `start = theory.static(…)`; a term can use it: `start(x)`"
    if callable(value):
        return "call it, or declare it with a decorator of the theory"
    return "numbers, strings, truth values, `None`, lists, sets and what the theory declares can stand here"
