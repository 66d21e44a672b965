"""Operations and relations on terms that are elaborated already: what goes together, and what is a constant."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import cast

from golc.diagnostics import Code, Span
from golc.theory.closed import NoValueError, arithmetic
from golc.theory.context import Context
from golc.theory.elaborate_types import home
from golc.theory.expectations import both, broken, cure, mismatch, parentheses, shown, suspects, typed
from golc.theory.fitting import (
    BROKEN,
    NOTHING,
    Either,
    collection,
    includes,
    join,
    may_be,
    overlap,
    size,
    strip_optional,
)
from golc.theory.forms import describe, word
from golc.theory.terms import Display, Literal, Membership, Operation, Operator, Term
from golc.theory.types import BOOL, INT, REAL, Collection, Enumeration, Interval, Optional, Type, Value, show


def numeric(context: Context, op: Operator, args: list[Term], span: Span) -> Term:
    """An operation on numbers; its value if all operands are constants."""
    if any(arg.type is BROKEN for arg in args):
        return broken(span)
    last = args[-1]
    values = [arg.value for arg in args if isinstance(arg, Literal)]
    division = op in (Operator.DIVIDE, Operator.MODULO) and isinstance(last, Literal) and last.value == 0
    if division:
        context.error(Code.NO_VALUE, "division by zero", span, "the divisor is 0")
        return broken(span)
    type_ = INT if op is Operator.DIVIDE else numeric_type(args)
    if len(values) < len(args):
        return Operation(op, tuple(args), type=type_, span=span)
    try:
        return Literal(arithmetic(op, cast(list[int], values), span), type=type_, span=span)
    except NoValueError as error:
        context.error(Code.NO_VALUE, f"`{shown(args[0])} …` has no value: {error.reason}", span)
        return broken(span)


def numeric_type(numbers: Sequence[Term]) -> Type:
    """The type of what is made of some numbers: ``real`` if one of them is."""
    return REAL if any("real" in number.type.kinds for number in numbers) else INT


def _kinds(found: Term) -> frozenset[str]:
    """The kinds of a term's values; of a symbol only the one that it has."""
    match found:
        case Literal(value=str(value), type=Enumeration(members=pairs)):
            return frozenset([f"symbol:{owner}" for symbol, owner in pairs if symbol == value])
        case _:
            return found.type.kinds


def equality(context: Context, op: Operator, left: Term, right: Term, span: Span) -> Term:
    """``=`` or ``!=`` of terms that have some kind of value in common."""
    if not _comparable(left, right):
        message = f"{both(left, right)} can never be equal"
        help_ = (
            _taken_in(op, left, span)
            or _asks_membership(left, right)
            or cure(right, left.type)
            or _values(left, right)
            or _values(right, left)
        )
        blamed = suspects(context, left, right)
        context.error(Code.TYPE_MISMATCH, message, span, "their types have nothing in common", help_, suspects=blamed)
        return broken(span)
    _clear(context, left, right)
    return Operation(op, (left, right), type=BOOL, span=span)


def _clear(context: Context, left: Term, right: Term) -> None:
    """Two terms that go together speak for each other's declarations."""
    if BROKEN not in (left.type, right.type):
        context.complaints.clear(suspects(context, left, right))


def _taken_in(op: Operator, left: Term, span: Span) -> str | None:
    """What helps where the formula that is counted is compared, not their number."""
    text = span.source.text
    before = text[text.rfind("\n", 0, span.start) + 1 : span.start]
    counted = left.type == BOOL and re.search(r"\bcount\b[^.]*\.[ \t]*$", before)
    return parentheses("count", op.value) if counted else None


def _asks_membership(left: Term, right: Term) -> str | None:
    """What helps where a value is compared with a set or list that may have it."""
    whole = collection(right.type)
    if whole is None or not overlap(left.type, whole.element):
        return None
    return f"`{shown(left)} in {shown(right)}` asks whether it is one of them"


def _values(found: Term, constant: Term) -> str | None:
    """What a term of few values can be, where it is compared with a constant that it cannot be."""
    type_ = strip_optional(found.type)
    if isinstance(found, Literal) or not isinstance(constant, Literal) or not isinstance(type_, Enumeration):
        return None
    values = [word(show(value), found.span) for value in type_.values[:6]]
    return f"`{shown(found)}` can be {', '.join(values)}{', …' if len(type_.values) > 6 else ''}"


def _comparable(left: Term, right: Term) -> bool:
    if collection(left.type) and collection(right.type):
        return overlap(left.type, right.type)
    return left.type is BROKEN or right.type is BROKEN or not _kinds(left).isdisjoint(_kinds(right))


def ordering(context: Context, op: Operator, left: Term, right: Term, span: Span) -> Term:
    """A comparison of numbers by value or of symbols by their place."""
    if left.type is BROKEN or right.type is BROKEN:
        return broken(span)
    kinds = (left.type.kinds | right.type.kinds) - {"none"}
    if kinds and kinds <= REAL.kinds:
        _clear(context, left, right)
        return Operation(op, (left, right), type=BOOL, span=span)
    order = _order(context, left, right) if _comparable(left, right) else None
    if order is None:
        message = f"{both(left, right)} have no order"
        marker, blamed = "numbers, or values of one enumeration, have an order", suspects(context, left, right)
        context.error(Code.TYPE_MISMATCH, message, span, marker, _taken_in(op, left, span), suspects=blamed)
        return broken(span)
    _clear(context, left, right)
    return Operation(op, (left, right), type=BOOL, span=span, order=order)


def _order(context: Context, left: Term, right: Term) -> tuple[Value, ...] | None:
    """The order that decides between two terms: of the enumeration that declares all their values, otherwise of the
    larger one of their types, if it has the values of both."""
    a, b = strip_optional(left.type), strip_optional(right.type)
    if not (a.finite and b.finite) or not (isinstance(a, Enumeration) or isinstance(b, Enumeration)):
        return None
    kinds = a.kinds | b.kinds
    first = next((value for value in (*a.values, *b.values) if isinstance(value, str)), "")
    entry = context.names.values.get(first)
    if len(kinds) == 1 and entry is not None:
        return tuple(home(context, entry).values)
    small, large = (a, b) if size(a) <= size(b) else (b, a)
    return tuple(large.values) if includes(large, small) else None


def within_type(context: Context, element: Term, within: Type, span: Span) -> Term:
    """``element in within``."""
    if within is BROKEN or element.type is BROKEN:
        return broken(span)
    if _kinds(element).isdisjoint(within.kinds):
        message = f"{typed(element)} can never be in {describe(within, span)}"
        context.error(Code.TYPE_MISMATCH, message, span, "always false", suspects=suspects(context, element))
        return broken(span)
    context.complaints.clear(suspects(context, element))
    if not may_be(element.type, within):
        name = shown(element)
        help_ = f"write `{within.low} <= {name} and {name} <= {within.high}`" if isinstance(within, Interval) else None
        message = f"`{name}` is of type {describe(element.type, span)}, and {describe(within, span)} has only integers"
        context.error(Code.TYPE_MISMATCH, message, span, "whole or not?", help_)
        return broken(span)
    return Membership(element, within, type=BOOL, span=span)


def within_collection(context: Context, element: Term, within: Term, span: Span) -> Term:
    """``element in within`` for a set or a list."""
    if element.type is BROKEN or within.type is BROKEN:
        return broken(span)
    whole = collection(within.type)
    if whole is None:
        mismatch(context, within, "a type, a set or a list", "`in`")
        return broken(span)
    never = _kinds(element).isdisjoint(whole.element.kinds) or not overlap(element.type, whole.element)
    if never and whole.element != NOTHING:
        message = f"{typed(element)} can never be in `{shown(within)}`, which is of type {describe(whole, span)}"
        context.error(Code.TYPE_MISMATCH, message, span, "always false", cure(element, whole.element))
        return broken(span)
    return Operation(Operator.ELEMENT, (element, within), type=BOOL, span=span)


def one_of(context: Context, element: Term, choices: list[Term], span: Span, place: Span) -> Term:
    """``element in {choices}``, where the choices stand at ``place``: a membership if all of them are constants."""
    if element.type is BROKEN or any(choice.type is BROKEN for choice in choices):
        return broken(span)
    strange = [choice for choice in choices if not _comparable(element, choice)]
    for choice in strange:
        needed = describe(element.type, choice.span)
        mismatch(context, choice, needed, f"a value of `{shown(element)}`", cure(choice, element.type))
    if strange:
        return broken(span)
    pairs = [_member(choice) for choice in choices]
    constants = [pair for pair in pairs if pair is not None]
    if len(constants) < len(choices):
        display = Display(tuple(choices), type=Collection("set", common(choices)), span=place)
        return Operation(Operator.ELEMENT, (element, display), type=BOOL, span=span)
    values = Enumeration(tuple(dict.fromkeys([pair for pair in constants if pair[0] is not None])))
    within = values if len(values.members) == len({*constants}) else Optional(values)
    return Membership(element, within, type=BOOL, span=span)


def common(terms: Sequence[Term]) -> Type:
    """A type that has the values of all terms."""
    found: Type = NOTHING
    for each in terms:
        found = join(found, each.type) or Either(found, each.type)
    return found


def _member(choice: Term) -> tuple[Value, str] | None:
    """A constant and the enumeration that declared it; none for what is no member of an enumeration."""
    match choice:
        case Literal(value=None):
            return None, ""
        case Literal(value=bool()):
            return None  # a truth value is an `int` to Python, but never a member of an enumeration
        case Literal(value=int(value)):
            return value, ""
        case Literal(value=str(value), type=Enumeration(members=pairs)):
            return next((pair for pair in pairs if pair[0] == value), None)
        case _:
            return None


def conditional(context: Context, then: Term, condition: Term, otherwise: Term, hint: Type | None, span: Span) -> Term:
    """``then if condition else otherwise``; where a type is needed (``hint``), it is enough that both fit there."""
    type_ = join(then.type, otherwise.type)
    if type_ is None and hint is not None and overlap(then.type, hint) and overlap(otherwise.type, hint):
        type_ = Either(then.type, otherwise.type)
    if type_ is None:
        message = f"{both(then, otherwise)} cannot be two values of one term"
        context.error(Code.TYPE_MISMATCH, message, span, "their types have nothing in common")
        return broken(span)
    if BROKEN in (condition.type, type_):
        return broken(span)
    return Operation(Operator.CONDITIONAL, (then, condition, otherwise), type=type_, span=span)
