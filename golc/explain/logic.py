"""Formulas taken apart and put together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from golc.theory.terms import Operation, Operator, Term
from golc.theory.types import BOOL


def conjuncts(formula: Term | None) -> Iterator[Term]:
    """The parts of a conjunction, from left to right; no recursion, for the depth is the input's."""
    stack = [] if formula is None else [formula]
    while stack:
        part = stack.pop()
        if isinstance(part, Operation) and part.op is Operator.AND:
            stack.extend(reversed(part.args))
        else:
            yield part


def equal(left: Term, right: Term) -> Term:
    """``left = right``."""
    return Operation(Operator.EQUAL, (left, right), type=BOOL)


def negated(formula: Term) -> Term:
    """``¬φ``, without a double negation; of an equality the inequality."""
    match formula:
        case Operation(op=Operator.NOT, args=(operand,)):
            return operand
        case Operation(op=Operator.EQUAL):
            return replace(formula, op=Operator.DIFFERENT)
        case Operation(op=Operator.DIFFERENT):
            return replace(formula, op=Operator.EQUAL)
        case _:
            return Operation(Operator.NOT, (formula,), type=BOOL)
