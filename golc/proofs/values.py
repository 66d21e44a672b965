"""Known and unknown values of the types of a theory, for an SMT solver, and what its models say of them."""

from __future__ import annotations

import itertools
from fractions import Fraction
from typing import Any, cast

import z3

from golc.proofs.collected import collection, parts_of
from golc.proofs.encoded import (
    COLLECTION,
    NONE,
    NUMBER,
    SYMBOL,
    TEXT,
    TRUTH,
    Encoded,
    Formula,
    Part,
    Parts,
    both,
    chosen,
    either,
    equal,
    negated,
    same,
    truth,
)
from golc.proofs.symbols import NotDecidedError
from golc.theory.fitting import size
from golc.theory.theory import BasicActionTheory
from golc.theory.types import BOOL, REAL, STRING, Collection, Interval, Optional, Type, Value
from golc.theory.types import number as simplified

MOST_MEMBERS = 64
"""Of how many possible elements a set is told apart whether it has them."""

LONGEST = 4
"""How many elements lists have, and sets of elements without end, that are looked at."""


MOST_ONCE = 6
"""Lists of so many possible elements are long enough to have each of them."""


class Values:
    """Values of one theory. Raises ``NotDecidedError`` for what it has no encoding for.

    ``facts`` are formulas that are true in every situation: the unknown values are of their types. ``shortened``: some
    situations that matter were left out, with lists that are longer than ``LONGEST``.
    """

    def __init__(self, theory: BasicActionTheory) -> None:
        self.theory = theory
        self.facts: list[Formula] = []
        self.shortened = False
        self.symbols = sorted(map(str, theory.symbols))
        self._places = {symbol: place for place, symbol in enumerate(self.symbols)}
        self._texts: dict[str, int] = {}
        self._fresh = itertools.count()

    def fresh(self, name: str) -> str:
        """A name that nothing else has."""
        return f"{name}!{next(self._fresh)}"

    def variable(self, name: str, type_: Type) -> Encoded:
        """A variable of some type."""
        return self.of_type(self.fresh(name), type_, ())

    def of_type(self, name: str, type_: Type, places: tuple[Any, ...]) -> Encoded:
        """What a function of places has for a value, with the fact that it is of its type."""
        base = type_.base if isinstance(type_, Optional) else type_
        sorts = [z3.IntSort()] * len(places)
        if base == BOOL and base is type_:
            function = z3.Function(name, *sorts, z3.BoolSort())
            return truth(function(*places))
        if isinstance(base, Collection):
            return self._some_collection(name, base, base is not type_, places)
        number = z3.Function(name, *sorts, z3.RealSort() if base == REAL else z3.IntSort())(*places)
        kinds = {_kind(kind) for kind in type_.kinds}
        kind = kinds.pop() if len(kinds) == 1 else z3.Function(f"{name} kind", *sorts, z3.IntSort())(*places)
        found = Encoded(kind, number)
        self.facts.append(self.within(found, type_))
        return found

    def _some_collection(self, name: str, type_: Collection, optional: bool, places: tuple[Any, ...]) -> Encoded:
        """Any set or list of a type; of those without end, only short ones."""
        sorts = [z3.IntSort()] * len(places)
        kind: Any = COLLECTION
        if optional:
            kind = z3.If(z3.Function(f"{name} none", *sorts, z3.BoolSort())(*places), NONE, COLLECTION)
        if type_.kind == "set" and type_.element.finite and size(type_.element) <= MOST_MEMBERS:
            parts = [
                Part(self.literal(value), z3.Function(f"{name} has {index}", *sorts, z3.BoolSort())(*places))
                for index, value in enumerate(type_.element.values)
            ]
            return Encoded(kind, 0, parts=Parts(False, tuple(parts)))
        # Who only asks what is in a list, and which comes first, sees no difference to one that has each element once.
        once = type_.kind == "list" and type_.element.finite and size(type_.element) <= MOST_ONCE
        self.shortened |= not once
        longest = max(LONGEST, size(type_.element)) if once else LONGEST
        length = z3.Function(f"{name} length", *sorts, z3.IntSort())(*places)
        self.facts.append(both(length >= 0, length <= longest))
        elements = [self.of_type(f"{name} {index}", type_.element, places) for index in range(longest)]
        there = [Part(element, length > index) for index, element in enumerate(elements)]
        return Encoded(kind, 0, parts=Parts(type_.kind == "list", tuple(there)))

    def literal(self, value: Value, type_: Type | None = None) -> Encoded:
        """A known value; that it is a text, only its type says."""
        match value:
            case None:
                return Encoded(NONE, 0)
            case bool():
                return truth(value)
            case int():
                return Encoded(NUMBER, value)
            case Fraction():
                return Encoded(NUMBER, z3.Q(value.numerator, value.denominator))
            case str() if type_ != STRING:
                return Encoded(SYMBOL, self._places[value])
            case str():
                return Encoded(TEXT, self._texts.setdefault(value, len(self._texts)))
            case frozenset() | tuple():
                of = type_.element if isinstance(type_, Collection) else None
                parts = tuple([Part(self.literal(element, of), True) for element in value])
                return collection(Parts(isinstance(value, tuple), parts))
            case _:
                raise AssertionError(value)

    def within(self, value: Encoded, type_: Type) -> Formula:
        """Whether a value belongs to a type."""
        match type_:
            case Optional(base=base):
                return either(equal(value.kind, NONE), self.within(value, base))
            case Interval(low=low, high=high):
                return both(equal(value.kind, NUMBER), low <= value.number, value.number <= high)
            case _ if type_.finite:
                return either(*[same(value, self.literal(each)) for each in type_.values])
            case _ if type_.kinds <= REAL.kinds:
                return equal(value.kind, NUMBER)
            case Collection(element=element):
                parts = [
                    either(negated(part.there), self.within(part.element, element)) for part in parts_of(value).all
                ]
                return both(equal(value.kind, COLLECTION), *parts)
            case _ if type_ == STRING:
                return equal(value.kind, TEXT)
            case _:
                raise NotDecidedError(f"values of type `{type_}` are compared")

    def place(self, value: Encoded, type_: Type) -> Any:
        """Where a value stands in the order of a type."""
        if isinstance(type_, Interval):
            return value.number - type_.low
        place: Any = 0
        for index, each in enumerate(type_.values):
            place = chosen(same(value, self.literal(each)), index, place)
        return place

    def decoded(self, value: Encoded, model: Any) -> Value:
        """A value in a model of the solver."""
        kind, number = evaluated(value.kind, model), evaluated(value.number, model)
        match kind:
            case 0:
                return cast(Value, number)
            case 1:
                return cast(Value, self.symbols[number])
            case 2:
                return None
            case 3:
                return bool(number)
            case 4:
                parts = parts_of(value)
                there = [self.decoded(part.element, model) for part in parts.all if _holds(part.there, model)]
                return tuple(there) if parts.ordered else frozenset(there)
            case _:
                texts = {place: text for text, place in self._texts.items()}
                return cast(Value, texts.get(number, f"text {number}"))


def evaluated(term: Any, model: Any) -> Any:
    """What a model says of a number."""
    if not z3.is_expr(term):
        return term
    found = model.eval(term, model_completion=True)
    return found.as_long() if z3.is_int_value(found) else simplified(found.as_fraction())


def _holds(formula: Formula, model: Any) -> bool:
    """What a model says of a formula."""
    return formula if isinstance(formula, bool) else z3.is_true(model.eval(formula, model_completion=True))


def _kind(kind: str) -> int:
    return {"int": NUMBER, "real": NUMBER, "none": NONE, "bool": TRUTH, "string": TEXT}.get(kind, SYMBOL)
