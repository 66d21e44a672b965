"""What can go wrong while a term is evaluated or an action is carried out; one function for each, with its place."""

from __future__ import annotations

from golc.diagnostics import Code, Diagnostic, Label, ProgramError, Severity, Span, counted
from golc.theory.fitting import collection
from golc.theory.forms import describe, word
from golc.theory.order import elements
from golc.theory.types import Number, Type, Value, show


def argument_outside(span: Span, what: str, value: Value, type_: Type) -> ProgramError:
    """An argument is outside its parameter's type; ``what`` names what it is an argument of."""
    if value is None:
        return nothing(span, f"an argument of `{what}`")
    message = f"argument {show(value)} of `{what}` {_outside(value, type_, span)}"
    return ProgramError(Diagnostic(Code.ARGUMENT_OUTSIDE_TYPE, message, span, marker=f"{show(value)} here"))


def value_outside(span: Span, what: str, value: Value, type_: Type) -> ProgramError:
    """A fluent or a static function would have a value outside its type."""
    message = f"`{what}` would be {show(value)}, which {_outside(value, type_, span)}"
    return ProgramError(Diagnostic(Code.VALUE_OUTSIDE_TYPE, message, span, marker=f"{show(value)} here"))


def _outside(value: Value, type_: Type, place: Span) -> str:
    """Of which type a value is not; of a set or list, which element is wrong."""
    whole, element = collection(type_), value
    while whole is not None and isinstance(element, frozenset if whole.kind == "set" else tuple):
        type_ = whole.element
        element = next(part for part in elements(element, None) if part not in type_)
        whole = collection(type_)
    outside = f"is outside {describe(type_, place)}"
    return outside if element is value else f"has the element {show(element)}, which {outside}"


def negative_cost(span: Span, call: str, value: Number) -> ProgramError:
    """An action would cost less than nothing."""
    message = f"the cost of `{call}` would be {show(value)}, but a cost is at least 0"
    return ProgramError(Diagnostic(Code.VALUE_OUTSIDE_TYPE, message, span, marker=f"{show(value)} here"))


def nothing(span: Span, where: str) -> ProgramError:
    """``none`` where a value is needed."""
    none = word("none", span)
    message = f"{where} is `{none}`, where a value is needed"
    help_ = f"ask `{span.either('… != none and …', '… != None')}` first"
    return ProgramError(Diagnostic(Code.NOTHING, message, span, marker=f"`{none}` here", help=help_))


def division_by_zero(span: Span) -> ProgramError:
    """The right side of ``//`` or ``%`` is 0."""
    return ProgramError(Diagnostic(Code.DIVISION_BY_ZERO, "division by zero", span, marker="the divisor is 0 here"))


def empty_extremum(span: Span, kind: str) -> ProgramError:
    """``min`` or ``max`` over no binding at all."""
    message, where = f"`{kind}` over nothing has no value", span.either("where", "if")
    return ProgramError(Diagnostic(Code.EMPTY_EXTREMUM, message, span, marker=f"no binding satisfies its `{where}`"))


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


def too_large(span: Span, what: str, limit: str) -> ProgramError:
    """A number or a collection that would fill the memory sooner or later."""
    message = f"{what} grows too large: golc goes up to {limit}"
    return ProgramError(Diagnostic(Code.TOO_LARGE, message, span, marker="too large here"))


class ExternError(ProgramError):
    """A Python function has no value that could be used. What is said of it says all: nobody has to say it again."""


class NotExecutedError(ExternError):
    """A Python function, that of the static ``name``, would have to be called, and nobody has said that it may."""

    def __init__(self, diagnostic: Diagnostic, name: str) -> None:
        super().__init__(diagnostic)
        self.name = name


def extern_failed(span: Span, message: str, labels: tuple[Label, ...], help: str | None) -> ExternError:
    """A Python function fails, or gives what is not of its type; ``labels`` show the line of its file."""
    return ExternError(Diagnostic(Code.EXTERN, message, span, marker="called here", labels=labels, help=help))


def not_executed(span: Span, name: str, why: str) -> NotExecutedError:
    """A value depends on a Python function in a file that is not trusted."""
    message = f"this has no value yet: it depends on `{name}`, and {why}"
    help_ = "`--trust` executes it"
    finding = Diagnostic(Code.NOT_EXECUTED, message, span, Severity.NOTE, "a function of Python", help=help_)
    return NotExecutedError(finding, name)


class UndecidedError(ProgramError):
    """The agent does not know what it needs to go on: a dead end of look-ahead."""


def undecided(span: Span, problem: str, notes: tuple[str, ...], help: str | None) -> UndecidedError:
    """A condition is neither known to be true nor known to be false, or a value is not known."""
    message = f"{problem}, so that the program cannot go on"
    return UndecidedError(Diagnostic(Code.UNDECIDED, message, span, marker="not known", notes=notes, help=help))


def too_many_worlds(span: Span, most: int) -> ProgramError:
    """A question would have to be asked in more cases than can be gone through."""
    message = f"more than {most} cases of what is unknown would have to be told apart here"
    help_ = "sense or settle some of it first, or say less in one formula"
    return ProgramError(Diagnostic(Code.TOO_MANY_WORLDS, message, span, help=help_))


def no_initial_world(span: Span) -> ProgramError:
    """The constraints on the initial situation contradict the initial values or one another."""
    message = "no initial world is possible: this contradicts the initial values, or what is said before"
    return ProgramError(Diagnostic(Code.NO_INITIAL_WORLD, message, span, marker="true in no world that is left"))


def nothing_possible(span: Span, what: str) -> ProgramError:
    """``one of`` an empty collection."""
    message = f"`{what}` would have no possible value: the collection is empty"
    return ProgramError(Diagnostic(Code.VALUE_OUTSIDE_TYPE, message, span, marker="empty here"))
