"""Sets and lists for an SMT solver: what the operations on them make of their elements."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from golc.proofs.encoded import (
    COLLECTION,
    NUMBER,
    Encoded,
    Formula,
    Part,
    Parts,
    as_set,
    both,
    either,
    equal,
    has,
    how_many,
    negated,
    places_of,
    same,
    selected,
    truth,
)
from golc.proofs.symbols import NotDecidedError
from golc.theory.terms import Operator

MOST_PARTS = 400
"""How many elements may be in a set or list that is calculated."""


def collection(parts: Parts, ok: Formula = True) -> Encoded:
    """A set or list; what may be in it need not be, so that there may be more than it has."""
    if len(parts.all) > MOST_PARTS:
        raise NotDecidedError(f"a set or list may have more than {MOST_PARTS} elements")
    return Encoded(COLLECTION, 0, ok, parts=parts)


def parts_of(value: Encoded) -> Parts:
    """The elements of a set or list; of ``none`` there are none."""
    return value.parts or Parts(False, ())


def distinct(parts: Parts) -> list[Part]:
    """The elements of a set, each once; those of a list as they are."""
    if parts.ordered:
        return [*parts.all]
    found: list[Part] = []
    for part in parts.all:
        earlier = [both(other.there, same(other.element, part.element)) for other in found]
        found.append(Part(part.element, both(part.there, negated(either(*earlier)))))
    return found


def operated(op: Operator, values: Sequence[Encoded], ok: Formula) -> Encoded:
    """What an operation on sets, lists and elements gives; raises ``NotDecidedError`` for any other."""
    match op, values:
        case Operator.ELEMENT, [element, whole]:
            return truth(has(parts_of(whole), element), ok)
        case Operator.LENGTH, [whole]:
            return Encoded(NUMBER, how_many([part.there for part in distinct(parts_of(whole))]), ok)
        case Operator.UNION, [left, right]:
            return collection(as_set((*parts_of(left).all, *parts_of(right).all)), ok)
        case Operator.CONCATENATION, [left, right]:
            return collection(Parts(True, (*parts_of(left).all, *parts_of(right).all)), ok)
        case Operator.DIFFERENCE | Operator.REMOVAL, [left, right]:
            kept = [
                Part(part.element, both(part.there, negated(has(parts_of(right), part.element))))
                for part in parts_of(left).all
            ]
            return collection(Parts(parts_of(left).ordered, tuple(kept)), ok)
        case Operator.FIRST, [whole]:
            return _at(parts_of(whole), 0, ok)
        case Operator.INDEX, [whole, place]:
            return _at(parts_of(whole), place.number, ok)
        case Operator.REST, [whole]:
            places = zip(parts_of(whole).all, places_of(parts_of(whole)), strict=True)
            behind = [Part(part.element, both(part.there, negated(equal(place, 0)))) for part, place in places]
            some = either(*[part.there for part in parts_of(whole).all])
            return collection(Parts(True, tuple(behind)), both(ok, some))
        case _:
            raise NotDecidedError("texts or quotients of real numbers are calculated with")


def _at(list_: Parts, place: Any, ok: Formula) -> Encoded:
    """The element at a place of a list, if there is one."""
    found: Encoded | None = None
    there: list[Formula] = []
    for part, here in zip(list_.all, places_of(list_), strict=True):
        wanted = both(part.there, equal(here, place))
        there.append(wanted)
        found = part.element if found is None else selected(wanted, part.element, found)
    if found is None:
        return Encoded(NUMBER, 0, False)
    return Encoded(found.kind, found.number, both(ok, either(*there)), found.formula, found.parts)
