"""Operations on truth values and numbers for an SMT solver."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import z3

from golc.proofs.collected import operated
from golc.proofs.encoded import (
    NONE,
    NUMBER,
    Encoded,
    Formula,
    both,
    chosen,
    either,
    equal,
    negated,
    same,
    selected,
    truth,
)
from golc.theory.terms import Operation, Operator
from golc.theory.types import REAL, Value


def calculated(term: Operation, values: Sequence[Encoded], literal: Callable[[Value], Encoded]) -> Encoded:
    """What an operation gives; ``literal`` encodes a value. Raises ``NotDecidedError`` for what has no encoding."""
    match term.op:
        case Operator.AND:
            return conjunction(values)
        case Operator.OR:
            return disjunction(values)
        case Operator.IMPLIES:
            return disjunction([truth(negated(values[0].truth), values[0].ok), values[1]])
        case Operator.NOT:
            return truth(negated(values[0].truth), values[0].ok)
        case Operator.CONDITIONAL:
            then, condition, otherwise = values
            return with_ok(selected(condition.truth, then, otherwise), condition.ok)
        case Operator.EQUAL | Operator.IFF:
            return truth(same(*values), both(*[value.ok for value in values]))
        case Operator.DIFFERENT:
            return truth(negated(same(*values)), both(*[value.ok for value in values]))
        case _:
            return _arithmetic(term, values, literal)


def with_ok(value: Encoded, ok: Formula) -> Encoded:
    """The value, if something more is so."""
    return Encoded(value.kind, value.number, both(value.ok, ok), value.formula, value.parts)


def conjunction(parts: Sequence[Encoded]) -> Encoded:
    """From left to right; what follows a false part need have no value."""
    oks: list[Formula] = []
    before: list[Formula] = []
    for part in parts:
        oks.append(either(part.ok, negated(both(*before))))
        before.append(part.truth)
    return truth(both(*before), both(*oks))


def disjunction(parts: Sequence[Encoded]) -> Encoded:
    """From left to right; what follows a true part need have no value."""
    oks: list[Formula] = []
    before: list[Formula] = []
    for part in parts:
        oks.append(either(part.ok, *before))
        before.append(part.truth)
    return truth(either(*before), both(*oks))


def _arithmetic(term: Operation, values: Sequence[Encoded], literal: Callable[[Value], Encoded]) -> Encoded:
    first = 1 if term.op is Operator.ELEMENT else 0  # what is looked for may be `none`
    ok = both(*[v.ok for v in values], *[negated(equal(value.kind, NONE)) for value in values[first:]])
    numbers = [value.number for value in values]
    if term.order is not None:
        numbers = [_ranked(value, term.order, literal) for value in values]
    match term.op:
        case Operator.LESS:
            return truth(_formula(numbers[0] < numbers[1]), ok)
        case Operator.LESS_EQUAL:
            return truth(_formula(numbers[0] <= numbers[1]), ok)
        case Operator.GREATER:
            return truth(_formula(numbers[0] > numbers[1]), ok)
        case Operator.GREATER_EQUAL:
            return truth(_formula(numbers[0] >= numbers[1]), ok)
        case Operator.ADD:
            return Encoded(NUMBER, numbers[0] + numbers[1], ok)
        case Operator.SUBTRACT:
            return Encoded(NUMBER, numbers[0] - numbers[1], ok)
        case Operator.MULTIPLY:
            return Encoded(NUMBER, numbers[0] * numbers[1], ok)
        case Operator.NEGATE:
            return Encoded(NUMBER, -numbers[0], ok)
        case Operator.ABSOLUTE:
            return Encoded(NUMBER, chosen(_formula(numbers[0] < 0), -numbers[0], numbers[0]), ok)
        case Operator.MINIMUM | Operator.MAXIMUM:
            return Encoded(NUMBER, _extremum(term.op, numbers), ok)
        case Operator.DIVIDE | Operator.MODULO if term.type != REAL:
            return _quotient(term.op, numbers, ok)
        case _:
            return operated(term.op, values, ok)


def _quotient(op: Operator, numbers: list[Any], ok: Formula) -> Encoded:
    """The solver's division rounds down for positive divisors only."""
    left, right = [number if z3.is_expr(number) else z3.IntVal(number) for number in numbers]
    quotient = z3.If(right > 0, left / right, (-left) / (-right))
    number = quotient if op is Operator.DIVIDE else left - right * quotient
    return Encoded(NUMBER, number, both(ok, right != 0))


def _ranked(value: Encoded, order: Sequence[Value], literal: Callable[[Value], Encoded]) -> Any:
    rank: Any = 0
    for index, each in enumerate(order):
        rank = chosen(same(value, literal(each)), index, rank)
    return rank


def _formula(found: Any) -> Formula:
    return found if z3.is_expr(found) else bool(found)


def _extremum(op: Operator, numbers: Sequence[Any]) -> Any:
    found = numbers[0]
    for number in numbers[1:]:
        found = chosen(_formula(number < found if op is Operator.MINIMUM else number > found), number, found)
    return found
