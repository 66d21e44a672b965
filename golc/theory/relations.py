"""Operations and relations on terms that are elaborated already: what goes together, and what is a constant."""

from __future__ import annotations

import itertools
from typing import cast

from golc.diagnostics import Code, Span
from golc.theory.closed import NoValueError, arithmetic
from golc.theory.context import Context
from golc.theory.elaborate_types import home
from golc.theory.expectations import both, broken, mismatch, shown, typed
from golc.theory.fitting import BROKEN, describe, includes, join, overlap, size, strip_optional
from golc.theory.terms import Literal, Membership, Operation, Operator, Term, subterms
from golc.theory.types import BOOL, INT, Enumeration, Optional, Type, Value

LARGEST = 1000
"""How large the tests may be that stand for ``x in {a, b}``: each repeats x, so that nested ones would grow like 2ⁿ."""


def numeric(context: Context, op: Operator, args: list[Term], span: Span) -> Term:
    """An operation on integers; its value if all operands are constants."""
    if any(arg.type is BROKEN for arg in args):
        return broken(span)
    last = args[-1]
    values = [arg.value for arg in args if isinstance(arg, Literal)]
    division = op in (Operator.DIVIDE, Operator.MODULO) and isinstance(last, Literal) and last.value == 0
    if division:
        context.error(Code.NO_VALUE, "division by zero", span, "the divisor is 0")
        return broken(span)
    if len(values) < len(args):
        return Operation(op, tuple(args), type=INT, span=span)
    try:
        return Literal(arithmetic(op, cast(list[int], values), span), type=INT, span=span)
    except NoValueError as error:
        context.error(Code.NO_VALUE, f"`{shown(args[0])} …` has no value: {error.reason}", span)
        return broken(span)


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
        context.error(Code.TYPE_MISMATCH, message, span, "their types have nothing in common")
        return broken(span)
    return Operation(op, (left, right), type=BOOL, span=span)


def _comparable(left: Term, right: Term) -> bool:
    return left.type is BROKEN or right.type is BROKEN or not _kinds(left).isdisjoint(_kinds(right))


def ordering(context: Context, op: Operator, left: Term, right: Term, span: Span) -> Term:
    """A comparison of integers by value or of symbols by their place."""
    if left.type is BROKEN or right.type is BROKEN:
        return broken(span)
    kinds = (left.type.kinds | right.type.kinds) - {"none"}
    if kinds == INT.kinds:
        return Operation(op, (left, right), type=BOOL, span=span)
    order = _order(context, left, right) if _comparable(left, right) else None
    if order is None:
        message = f"{both(left, right)} have no order"
        context.error(Code.TYPE_MISMATCH, message, span, "integers, or values of one enumeration, have an order")
        return broken(span)
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
        message = f"{typed(element)} can never be in {describe(within)}"
        context.error(Code.TYPE_MISMATCH, message, span, "always false")
        return broken(span)
    return Membership(element, within, type=BOOL, span=span)


def one_of(context: Context, element: Term, choices: list[Term], span: Span) -> Term:
    """``element in {choices}``: a membership if the choices are constants, otherwise a disjunction."""
    if element.type is BROKEN or any(choice.type is BROKEN for choice in choices):
        return broken(span)
    strange = [choice for choice in choices if not _comparable(element, choice)]
    for choice in strange:
        mismatch(context, choice, describe(element.type), f"a value of `{shown(element)}`")
    if strange:
        return broken(span)
    pairs = [_member(choice) for choice in choices]
    constants = [pair for pair in pairs if pair is not None]
    if len(constants) < len(choices):
        return _one_of_terms(context, element, choices, span)
    values = Enumeration(tuple(dict.fromkeys([pair for pair in constants if pair[0] is not None])))
    within = values if len(values.members) == len({*constants}) else Optional(values)
    return Membership(element, within, type=BOOL, span=span)


def _one_of_terms(context: Context, element: Term, choices: list[Term], span: Span) -> Term:
    if len([*itertools.islice(subterms(element), LARGEST // len(choices) + 1)]) * len(choices) > LARGEST:
        context.error(Code.UNSUPPORTED, "this term is too large to be compared with several others", element.span)
        return broken(span)
    tests = [Operation(Operator.EQUAL, (element, choice), type=BOOL, span=choice.span) for choice in choices]
    return tests[0] if len(tests) == 1 else Operation(Operator.OR, tuple(tests), type=BOOL, span=span)


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
        type_ = hint
    if type_ is None:
        message = f"{both(then, otherwise)} cannot be two values of one term"
        context.error(Code.TYPE_MISMATCH, message, span, "their types have nothing in common")
        return broken(span)
    if BROKEN in (condition.type, type_):
        return broken(span)
    return Operation(Operator.CONDITIONAL, (then, condition, otherwise), type=type_, span=span)
