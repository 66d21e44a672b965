"""What generated code calls where the types alone do not prove that nothing goes wrong: each knows its place."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from fractions import Fraction
from itertools import islice

from golc.diagnostics import Span
from golc.situation.layout import Slots
from golc.theory import errors
from golc.theory.border import PythonFunction, extern_value
from golc.theory.evaluate import DEPTH, MOST_REMEMBERED
from golc.theory.order import arranged
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.terms import Comprehension, Operation, Quantified, Term
from golc.theory.theory import Static
from golc.theory.types import Type, Value, show, show_call

LARGEST_BITS = 100_000
LARGEST = 1 << LARGEST_BITS
"""No product of numbers reaches it: repeated squaring fills any memory in a few steps."""
MOST_ELEMENTS = 1_000_000
"""How many elements may be put together in one list or set."""


class Depth:
    """How many calls of static functions are open, whichever they are."""

    open = 0


class Positions(dict[Value, int]):
    """The places of a parameter's values; asked for another one, it raises the error with its place."""

    def __init__(self, positions: Mapping[Value, int], arg: Term, what: str, type_: Type) -> None:
        super().__init__(positions)
        self._failure = argument_failure(arg, what, type_)

    def __missing__(self, value: Value) -> int:
        raise self._failure(value)


class Calls:
    """Calls of a static function whose body is a term: in a state, with arguments."""

    function: Callable[..., Value]

    def __init__(self, static: Static, depth: Depth) -> None:
        self._static = static
        self._depth = depth

    def __call__(self, state: Slots, *args: Value) -> Value:
        if self._depth.open:
            return self._compute(state, args)
        with deep_recursion(EVALUATION):
            return self._compute(state, args)

    def _compute(self, state: Slots, args: tuple[Value, ...]) -> Value:
        static, depth = self._static, self._depth
        if depth.open >= DEPTH:
            raise errors.endless(static.span, static.name)
        depth.open += 1
        try:
            value = self.function(state, *args)
        except RecursionError:
            raise errors.endless(static.span, static.name) from None
        finally:
            depth.open -= 1
        if value not in static.type:
            assert not isinstance(static.body, Mapping | PythonFunction)
            raise errors.value_outside(static.body.span, show_call(static.name, args), value, static.type)
        return value


class Memo(dict[tuple[Value, ...], Value]):
    """The values of a static function, computed when they are first asked for; they are the same in every state."""

    def __init__(self, calls: Calls) -> None:
        super().__init__()
        self._calls = calls

    def __missing__(self, args: tuple[Value, ...]) -> Value:
        value = self._calls((), *args)
        if len(self) >= MOST_REMEMBERED:
            self.clear()
        self[args] = value
        return value


def extern(static: Static, span: Span) -> Callable[..., Value]:
    """The function of Python that is called at a place."""
    return lambda *args: extern_value(static, args, span)


def argument_failure(arg: Term, what: str, type_: Type) -> Callable[[Value], Exception]:
    """The error for a value of an argument that is outside its parameter's type."""
    return lambda value: errors.argument_outside(arg.span, what, value, type_)


def check(type_: Type, failure: Callable[[Value], Exception]) -> Callable[[Value], Value]:
    """A function that gives its argument back if it belongs to a type, and raises otherwise."""

    def check(value: Value) -> Value:
        if value in type_:
            return value
        raise failure(value)

    return check


def some(term: Term, what: str) -> Callable[[Value], Value]:
    """A function that gives its argument back unless it is ``none``; ``what`` says what the term is."""

    def some(value: Value) -> Value:
        if value is None:
            raise errors.nothing(term.span, what)
        return value

    return some


def divisor(term: Operation) -> Callable[[int], int]:
    """A function that gives its argument back unless it is 0."""

    def divisor(value: int) -> int:
        if value == 0:
            raise errors.division_by_zero(term.span)
        return value

    return divisor


def extremum(term: Quantified) -> Callable[[list[int]], int]:
    """``min`` or ``max`` of a list that must not be empty."""
    choose = min if term.kind == "min" else max

    def extremum(values: list[int]) -> int:
        if not values:
            raise errors.empty_extremum(term.span, term.kind)
        return choose(values)

    return extremum


def first(term: Operation) -> Callable[[tuple[Value, ...]], Value]:
    """The first element of a list, which must not be empty."""

    def first(whole: tuple[Value, ...]) -> Value:
        if not whole:
            raise errors.empty_list(term.span, "first")
        return whole[0]

    return first


def rest(term: Operation) -> Callable[[tuple[Value, ...]], Value]:
    """A list without its first element; it must not be empty."""

    def rest(whole: tuple[Value, ...]) -> Value:
        if not whole:
            raise errors.empty_list(term.span, "rest")
        return whole[1:]

    return rest


def index(term: Operation) -> Callable[[tuple[Value, ...], int], Value]:
    """The element of a list at a place that the list must have."""

    def index(whole: tuple[Value, ...], place: int) -> Value:
        if not 0 <= place < len(whole):
            raise errors.index_outside(term.span, place, len(whole))
        return whole[int(place)]  # Python takes what stands for all integers (`golc.proofs`) for 0

    return index


def removal(whole: tuple[Value, ...], gone: tuple[Value, ...]) -> tuple[Value, ...]:
    """The elements of a list that do not occur in another one."""
    without = set(gone)
    return tuple([element for element in whole if element not in without])


def product(term: Operation) -> Callable[[int, int], int]:
    """The product of two numbers, unless it has too many digits."""

    def product(left: int, right: int) -> int:
        found = left * right
        # Neither is it asked how large the symbols are that stand for all numbers (`golc.proofs`).
        if type(found) in (int, Fraction) and max(abs(found.numerator), found.denominator) >= LARGEST:
            raise errors.too_large(term.span, "a number", f"{LARGEST_BITS:,} bits")
        return found

    return product


def joined(term: Operation) -> Callable[[tuple[Value, ...], tuple[Value, ...]], tuple[Value, ...]]:
    """Two lists as one, unless it is too long."""

    def joined(left: tuple[Value, ...], right: tuple[Value, ...]) -> tuple[Value, ...]:
        if len(left) + len(right) > MOST_ELEMENTS:
            raise errors.too_large(term.span, "a list", f"{MOST_ELEMENTS:,} elements")
        return left + right

    return joined


def gathered(term: Comprehension, kind: str) -> Callable[[Iterator[Value]], Collection[Value]]:
    """The collection of some values, unless it is too long."""

    def gathered(values: Iterator[Value]) -> Collection[Value]:
        found: Collection[Value] = (
            frozenset(islice(values, MOST_ELEMENTS)) if kind == "set" else tuple(islice(values, MOST_ELEMENTS))
        )
        for _ in values:
            raise errors.too_large(term.span, f"a {kind}", f"{MOST_ELEMENTS:,} elements")
        return found

    return gathered


def text(type_: Type) -> Callable[[Value], str]:
    """What a value of a type looks like in a text."""
    return lambda value: show(arranged(value, type_))
