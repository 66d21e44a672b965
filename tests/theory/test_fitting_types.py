"""Which types go together."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.theory.fitting import BROKEN, NOTHING, includes, is_undetermined, join, may_be, meet, overlap, size
from golc.theory.types import (
    BOOL,
    INT,
    NONE,
    REAL,
    STRING,
    Collection,
    Enumeration,
    Interval,
    Optional,
    Type,
    Value,
)

COLOUR = Enumeration((("red", "colour"), ("green", "colour"), ("blue", "colour")), "colour")
WARM = Enumeration((("red", "colour"),))
MIXED = Enumeration((("blue", "colour"), (1, ""), (2, "")))


def types() -> st.SearchStrategy[Type]:
    pair = st.tuples(st.integers(-3, 5), st.integers(-3, 5))
    intervals = pair.map(lambda bounds: Interval(min(bounds), max(bounds)))
    enumerations = st.sets(st.sampled_from([*COLOUR.members, (1, ""), (2, "")]), min_size=1).map(
        lambda pairs: Enumeration(tuple(sorted(pairs, key=str)))
    )
    bases = st.one_of(intervals, enumerations, st.just(BOOL))
    return st.one_of(bases, bases.map(Optional))


@given(types(), types())
def test_inclusion_is_that_of_the_values(whole: Type, part: Type) -> None:
    assert includes(whole, part) == all(value in whole for value in part.values)


@given(types(), types())
def test_meeting_is_having_a_value_in_common(one: Type, other: Type) -> None:
    assert meet(one, other) == any(value in other for value in one.values)


@given(types())
def test_the_size_is_the_number_of_values(type_: Type) -> None:
    assert size(type_) == len(type_.values) == len([*type_.values])


@given(types(), types())
def test_a_join_has_the_values_of_both(one: Type, other: Type) -> None:
    joined = join(one, other)
    if joined is not None:
        assert all(value in joined for type_ in (one, other) for value in type_.values)
    else:
        assert one.kinds - other.kinds
        assert other.kinds - one.kinds


def any_types() -> st.SearchStrategy[Type]:
    """Also types that cannot be enumerated, and sets and lists."""
    bases = st.one_of(types(), st.sampled_from([INT, REAL, STRING]))
    kinds = st.sampled_from(["set", "list"])
    return st.recursive(bases, lambda inner: st.builds(Collection, kinds, inner), max_leaves=3)


def values_of(type_: Type) -> st.SearchStrategy[Value]:
    match type_:
        case Collection(kind="set", element=element):
            return st.frozensets(values_of(element), max_size=2)
        case Collection(element=element):
            return st.lists(values_of(element), max_size=2).map(tuple)
        case Optional(base=base):
            return st.none() | values_of(base)
        case _ if type_.finite:
            return st.sampled_from(type_.values)
        case _ if type_ == STRING:
            return st.sampled_from(["", "red"])
        case _:
            return st.sampled_from([-9, 2, Fraction(1, 2)] if type_ == REAL else [-9, 2])


@given(st.data(), any_types(), any_types())
def test_what_includes_a_type_has_its_values(data: st.DataObject, whole: Type, part: Type) -> None:
    value = data.draw(values_of(part))
    assert value in part
    assert value in whole or not includes(whole, part)


@given(any_types(), any_types())
def test_a_join_includes_both(one: Type, other: Type) -> None:
    joined = join(one, other)
    assert joined is None or (includes(joined, one) and includes(joined, other))
    assert overlap(one, other) == overlap(other, one)


@given(any_types(), any_types())
def test_the_empty_set_says_nothing_of_its_elements(one: Type, other: Type) -> None:
    empty = Collection("set", NOTHING)
    assert join(empty, Collection("set", one)) == Collection("set", one)
    assert includes(Collection("set", one), empty)
    assert overlap(empty, Collection("set", other))
    assert is_undetermined(Collection("list", empty))


@pytest.mark.parametrize(
    ("found", "needed", "may"),
    [
        (INT, REAL, True),
        (REAL, INT, False),
        (REAL, Interval(1, 3), False),
        (Optional(REAL), Optional(INT), False),
        (Collection("list", REAL), Collection("list", INT), False),
        (Collection("list", INT), Collection("list", REAL), True),
        (Collection("list", INT), Collection("set", INT), False),
        (Collection("list", COLOUR), Collection("list", INT), False),
        (NONE, Optional(Collection("list", INT)), True),
        (REAL, BROKEN, True),
    ],
)
def test_what_may_stand_where_a_type_is_needed(found: Type, needed: Type, may: bool) -> None:
    assert may_be(found, needed) is may


def test_intervals_are_compared_without_listing_them() -> None:
    vast = Interval(0, 2**80)
    assert includes(vast, Interval(1, 2**79))
    assert meet(vast, Optional(Interval(-5, 0)))
    assert size(Optional(vast)) == 2**80 + 2


@pytest.mark.parametrize(
    ("one", "other", "joined"),
    [
        (INT, Interval(1, 3), INT),
        (WARM, COLOUR, COLOUR),
        (NONE, Interval(1, 3), Optional(Interval(1, 3))),
        (NONE, NONE, NONE),
        (Optional(WARM), COLOUR, Optional(COLOUR)),
        (WARM, MIXED, Enumeration((("red", "colour"), ("blue", "colour"), (1, ""), (2, "")))),
        (BROKEN, BOOL, BROKEN),
        (BOOL, INT, None),
        (INT, REAL, REAL),
        (Collection("list", WARM), Collection("list", NONE), Collection("list", Optional(WARM))),
        (Collection("list", INT), Collection("set", INT), None),
        (Collection("list", INT), Collection("list", BOOL), None),
    ],
)
def test_two_branches_have_the_narrowest_type_that_holds_both(one: Type, other: Type, joined: Type | None) -> None:
    assert join(one, other) == joined
