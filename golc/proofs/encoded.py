"""Values as an SMT solver sees them.

A value has a kind (number, symbol, ``none``, truth value, collection, text) and a number, both terms of the solver or
integers of Python; a symbol's number is its place among all symbols, a truth value's is 0 or 1, equal texts have equal
numbers. Sets and lists have elements instead, each with the condition under which it is in them. What has no value
everywhere, such as a quotient, comes with the condition under which it has one.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import z3

NUMBER, SYMBOL, NONE, TRUTH, COLLECTION, TEXT = range(6)
"""The kinds of value."""

Formula: TypeAlias = Any
"""A truth value of Python, or a Boolean term of the solver, whose terms have no useful static types."""


class Part(NamedTuple):
    """What may be in a set or list, and whether it is."""

    element: Encoded
    there: Formula


@dataclass(frozen=True)
class Parts:
    """The elements of a set, of which some may be the same, or (``ordered``) those of a list in its order."""

    ordered: bool
    all: tuple[Part, ...]


@dataclass(frozen=True)
class Encoded:
    """A value: ``ok`` is whether there is one; ``formula`` the truth value, ``parts`` the elements, if it is of that
    kind."""

    kind: Any
    number: Any
    ok: Formula = True
    formula: Formula = None
    parts: Parts | None = None

    @property
    def truth(self) -> Formula:
        """Whether a truth value is true."""
        return equal(self.number, 1) if self.formula is None else self.formula

    @property
    def constant(self) -> tuple[int, int] | None:
        """Kind and number, if they are known and all there is."""
        known = isinstance(self.kind, int) and isinstance(self.number, int) and self.parts is None
        return (self.kind, self.number) if known else None


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


def chosen(condition: Formula, then: Any, otherwise: Any) -> Any:
    """One number or another."""
    if isinstance(condition, bool):
        return then if condition else otherwise
    return z3.If(condition, then, otherwise)


def total(numbers: Iterable[Any]) -> Any:
    """A sum of numbers."""
    added = [*numbers]
    return z3.Sum(added) if any(map(z3.is_expr, added)) else sum(added)


def how_many(formulas: Iterable[Formula]) -> Any:
    """How many of some formulas hold."""
    return total([chosen(formula, 1, 0) for formula in formulas])


def same(left: Encoded, right: Encoded) -> Formula:
    """Equality of values."""
    if left.formula is not None and right.formula is not None:
        return _iff(left.formula, right.formula)
    if left.parts is not None and right.parts is not None:
        contents = _same_parts(left.parts, right.parts)
    elif left.parts is not None or right.parts is not None:
        contents = False
    else:
        contents = equal(left.number, right.number)
    return both(equal(left.kind, right.kind), either(equal(left.kind, NONE), contents))


def _iff(left: Formula, right: Formula) -> Formula:
    if isinstance(left, bool):
        return right if left else negated(right)
    return negated(left) if right is False else left if right is True else left == right


def _same_parts(left: Parts, right: Parts) -> Formula:
    if left.ordered is not right.ordered:
        return False
    if not left.ordered:
        pairs = [(part, right) for part in left.all] + [(part, left) for part in right.all]
        return both(*[either(negated(part.there), has(other, part.element)) for part, other in pairs])
    places = [places_of(parts) for parts in (left, right)]
    alike = [
        either(negated(both(one.there, other.there, equal(place, opposite))), same(one.element, other.element))
        for one, place in zip(left.all, places[0], strict=True)
        for other, opposite in zip(right.all, places[1], strict=True)
    ]
    return both(equal(*[how_many(part.there for part in parts.all) for parts in (left, right)]), *alike)


def places_of(list_: Parts) -> list[Any]:
    """How many elements of a list stand before each."""
    return [how_many([part.there for part in list_.all[:index]]) for index in range(len(list_.all))]


def has(collection: Parts, element: Encoded) -> Formula:
    """Whether a value is in a set or list."""
    return either(*[both(part.there, same(part.element, element)) for part in collection.all])


def selected(condition: Formula, then: Encoded, otherwise: Encoded) -> Encoded:
    """One value or another."""
    if isinstance(condition, bool):
        return then if condition else otherwise
    ok = both(either(negated(condition), then.ok), either(condition, otherwise.ok))
    if then.formula is not None and otherwise.formula is not None:
        found = either(both(condition, then.formula), both(negated(condition), otherwise.formula))
        return truth(found, ok)
    kind = then.kind
    if not (isinstance(kind, int) and isinstance(otherwise.kind, int) and kind == otherwise.kind):
        kind = z3.If(condition, then.kind, otherwise.kind)
    if then.parts is None and otherwise.parts is None:
        return Encoded(kind, z3.If(condition, then.number, otherwise.number), ok)
    return Encoded(kind, 0, ok, parts=_selected_parts(condition, then.parts, otherwise.parts))


def _selected_parts(condition: Formula, then: Parts | None, otherwise: Parts | None) -> Parts:
    one, other = [() if parts is None else parts.all for parts in (then, otherwise)]
    every = [
        *[Part(part.element, both(condition, part.there)) for part in one],
        *[Part(part.element, both(negated(condition), part.there)) for part in other],
    ]
    ordered = any(parts is not None and parts.ordered for parts in (then, otherwise))
    return Parts(ordered, tuple(every)) if ordered else as_set(every)


def as_set(parts: Iterable[Part]) -> Parts:
    """A set; what is known to be the same is in it once."""
    known: dict[tuple[int, int], Part] = {}
    rest: list[Part] = []
    for part in parts:
        constant = part.element.constant
        if constant is None:
            rest.append(part)
        else:
            there = either(known[constant].there, part.there) if constant in known else part.there
            known[constant] = Part(part.element, there)
    return Parts(False, (*known.values(), *rest))
