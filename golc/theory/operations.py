"""What the operators make of values, where all operands are evaluated first."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from golc.diagnostics import Span
from golc.theory import errors
from golc.theory.terms import Operator
from golc.theory.types import Value, number

MEANINGS: Mapping[Operator, Callable[..., Any]] = {
    Operator.ADD: operator.add,
    Operator.SUBTRACT: operator.sub,
    Operator.MULTIPLY: operator.mul,
    Operator.DIVIDE: operator.floordiv,
    Operator.MODULO: operator.mod,
    Operator.NEGATE: operator.neg,
    Operator.ABSOLUTE: abs,
    Operator.MINIMUM: lambda *values: min(values),
    Operator.MAXIMUM: lambda *values: max(values),
    Operator.EQUAL: operator.eq,
    Operator.DIFFERENT: operator.ne,
    Operator.LESS: operator.lt,
    Operator.LESS_EQUAL: operator.le,
    Operator.GREATER: operator.gt,
    Operator.GREATER_EQUAL: operator.ge,
    Operator.UNION: operator.or_,
    Operator.DIFFERENCE: operator.sub,
    Operator.CONCATENATION: operator.add,
    Operator.REMOVAL: lambda left, right: tuple([element for element in left if element not in right]),
    Operator.ELEMENT: lambda element, collection: element in collection,
    Operator.INDEX: operator.getitem,
    Operator.LENGTH: len,
    Operator.FIRST: operator.itemgetter(0),
    Operator.REST: operator.itemgetter(slice(1, None)),
}


def takes_none(op: Operator, place: int) -> bool:
    """Whether the operand at a place, counted from 0, may be ``none``."""
    return op in (Operator.EQUAL, Operator.DIFFERENT) or (op is Operator.ELEMENT and place == 0)


def apply(op: Operator, values: Sequence[Any], span: Span, order: Sequence[Value] | None = None) -> Value:
    """The value of an operation on values; raises ``ProgramError`` where it has none, at ``span``.

    ``order``: for comparisons of symbols, the values in the order that decides.
    """
    if order is not None:
        values = [order.index(value) for value in values]
    match op, values:
        case ((Operator.DIVIDE | Operator.MODULO), (_, right)) if right == 0:
            raise errors.division_by_zero(span)
        case ((Operator.FIRST | Operator.REST), [()]):
            raise errors.empty_list(span, op.value)
        case Operator.INDEX, (whole, place) if not 0 <= place < len(whole):
            raise errors.index_outside(span, place, len(whole))
    return number(MEANINGS[op](*values))
