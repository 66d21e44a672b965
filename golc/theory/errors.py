"""What can go wrong while a term is evaluated or an action is carried out; one function for each, with its place."""

from __future__ import annotations

from golc.diagnostics import Code, Diagnostic, ProgramError, Span, counted
from golc.theory.fitting import describe
from golc.theory.types import Type, Value, show


def argument_outside(span: Span, what: str, value: Value, type_: Type) -> ProgramError:
    """An argument is outside its parameter's type; ``what`` names what it is an argument of."""
    if value is None:
        return nothing(span, f"an argument of `{what}`")
    message = f"argument {show(value)} of `{what}` is outside {describe(type_)}"
    return ProgramError(Diagnostic(Code.ARGUMENT_OUTSIDE_TYPE, message, span, marker=f"{show(value)} here"))


def value_outside(span: Span, what: str, value: Value, type_: Type) -> ProgramError:
    """A fluent or a static function would have a value outside its type."""
    message = f"`{what}` would be {show(value)}, which is outside {describe(type_)}"
    return ProgramError(Diagnostic(Code.VALUE_OUTSIDE_TYPE, message, span, marker=f"{show(value)} here"))


def negative_cost(span: Span, call: str, value: int) -> ProgramError:
    """An action would cost less than nothing."""
    message = f"the cost of `{call}` would be {show(value)}, but a cost is at least 0"
    return ProgramError(Diagnostic(Code.VALUE_OUTSIDE_TYPE, message, span, marker=f"{show(value)} here"))


def nothing(span: Span, where: str) -> ProgramError:
    """``none`` where a value is needed."""
    return ProgramError(
        Diagnostic(
            Code.NOTHING,
            f"{where} is `none`, where a value is needed",
            span,
            marker="`none` here",
            help="ask `… != none and …` first",
        )
    )


def division_by_zero(span: Span) -> ProgramError:
    """The right side of ``//`` or ``%`` is 0."""
    return ProgramError(Diagnostic(Code.DIVISION_BY_ZERO, "division by zero", span, marker="the divisor is 0 here"))


def empty_extremum(span: Span, kind: str) -> ProgramError:
    """``min`` or ``max`` over no binding at all."""
    message = f"`{kind}` over nothing has no value"
    return ProgramError(Diagnostic(Code.EMPTY_EXTREMUM, message, span, marker="no binding satisfies its `where`"))


def empty_list(span: Span, what: str) -> ProgramError:
    """``first`` or ``rest`` of an empty list."""
    message = f"`{what}` of an empty list has no value"
    return ProgramError(Diagnostic(Code.NO_ELEMENT, message, span, marker="the list is empty here"))


def index_outside(span: Span, place: int, length: int) -> ProgramError:
    """A place that a list does not have."""
    message = f"place {show(place)} is outside a list of {counted(length, 'element')}"
    help_ = f"places are counted from 0 to {length - 1}" if length else None
    return ProgramError(Diagnostic(Code.NO_ELEMENT, message, span, marker=f"{show(place)} here", help=help_))


def conflicting_effects(span: Span, fluent: str, first: Value, second: Value) -> ProgramError:
    """Two effects of one action give one ground fluent two values."""
    message = f"two effects give `{fluent}` the values {show(first)} and {show(second)}"
    return ProgramError(Diagnostic(Code.CONFLICTING_EFFECTS, message, span, marker=f"{show(second)} here"))


def endless(span: Span, what: str) -> ProgramError:
    """A recursion that goes deeper than anything sensible."""
    message = f"the recursion of `{what}` does not end, or goes too deep"
    return ProgramError(Diagnostic(Code.ENDLESS_RECURSION, message, span))
