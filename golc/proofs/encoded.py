"""Values as an SMT solver sees them.

A value has a kind (number, symbol, ``none``, truth value) and a number, both terms of the solver or integers of Python;
a symbol's number is its place among all symbols, a truth value's is 0 or 1. What has no value everywhere, such as a
quotient, comes with the condition under which it has one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import z3

NUMBER, SYMBOL, NONE, TRUTH = range(4)
"""The kinds of value."""

Formula: TypeAlias = Any
"""A truth value of Python, or a Boolean term of the solver, whose terms have no useful static types."""


@dataclass(frozen=True)
class Encoded:
    """A value: ``ok`` is whether there is one; ``formula`` the truth value, if it is one."""

    kind: Any
    number: Any
    ok: Formula = True
    formula: Formula = None

    @property
    def truth(self) -> Formula:
        """Whether a truth value is true."""
        return equal(self.number, 1) if self.formula is None else self.formula


def truth(formula: Formula, ok: Formula = True) -> Encoded:
    """A truth value."""
    number = int(formula) if isinstance(formula, bool) else z3.If(formula, 1, 0)
    return Encoded(TRUTH, number, ok, formula)


def both(*formulas: Formula) -> Formula:
    """Conjunction."""
    rest = [formula for formula in formulas if formula is not True]
    if any(formula is False for formula in rest):
        return False
    return True if not rest else z3.And(rest)


def either(*formulas: Formula) -> Formula:
    """Disjunction."""
    rest = [formula for formula in formulas if formula is not False]
    if any(formula is True for formula in rest):
        return True
    return False if not rest else z3.Or(rest)


def negated(formula: Formula) -> Formula:
    """Negation."""
    return not formula if isinstance(formula, bool) else z3.Not(formula)


def equal(left: Any, right: Any) -> Formula:
    """Equality of numbers."""
    return left == right if z3.is_expr(left) or z3.is_expr(right) else bool(left == right)


def same(left: Encoded, right: Encoded) -> Formula:
    """Equality of values."""
    if left.formula is not None and right.formula is not None:
        return _iff(left.formula, right.formula)
    return both(equal(left.kind, right.kind), either(equal(left.kind, NONE), equal(left.number, right.number)))


def _iff(left: Formula, right: Formula) -> Formula:
    if isinstance(left, bool):
        return right if left else negated(right)
    return left == right


def selected(condition: Formula, then: Encoded, otherwise: Encoded) -> Encoded:
    """One value or another."""
    if isinstance(condition, bool):
        return then if condition else otherwise
    ok = both(either(negated(condition), then.ok), either(condition, otherwise.ok))
    if then.formula is not None and otherwise.formula is not None:
        chosen = either(both(condition, then.formula), both(negated(condition), otherwise.formula))
        return truth(chosen, ok)
    kind = then.kind
    if not (isinstance(kind, int) and isinstance(otherwise.kind, int) and kind == otherwise.kind):
        kind = z3.If(condition, then.kind, otherwise.kind)
    return Encoded(kind, z3.If(condition, then.number, otherwise.number), ok)
