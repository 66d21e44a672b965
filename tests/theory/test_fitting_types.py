"""Which types go together."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.theory.fitting import BROKEN, includes, join, meet, size
from golc.theory.types import BOOL, INT, NONE, Enumeration, Interval, Optional, Type

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
    ],
)
def test_two_branches_have_the_narrowest_type_that_holds_both(one: Type, other: Type, joined: Type | None) -> None:
    assert join(one, other) == joined
