"""Did you mean."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.theory.suggest import closest, distance

NAMES = ["location", "motion", "direction", "holding_delivery_for", "stopped", "up", "n"]


@pytest.mark.parametrize(
    ("word", "name"),
    [
        ("motoin", "motion"),
        ("Motion", "motion"),
        ("locaton", "location"),
        ("lokation", "location"),
        ("stoped", "stopped"),
        ("holding_deliveries_for", "holding_delivery_for"),
        ("u", None),
        ("m", None),
        ("emotional", None),
        ("speed", None),
        ("motion", None),
    ],
)
def test_the_closest_name_is_proposed(word: str, name: str | None) -> None:
    assert closest(word, NAMES) == name


@pytest.mark.parametrize(
    ("one", "other", "slips"),
    [("ab", "ba", 1), ("abc", "ac", 1), ("abc", "abd", 1), ("", "abc", 3), ("kitten", "sitting", 3)],
)
def test_slips_are_counted(one: str, other: str, slips: int) -> None:
    assert distance(one, other, 9) == slips


WORDS = st.text("abc", max_size=6)


@given(WORDS, WORDS)
def test_slips_are_a_distance(one: str, other: str) -> None:
    assert distance(one, other, 99) == distance(other, one, 99)
    assert (distance(one, other, 99) == 0) == (one == other)
    assert distance(one, other, 99) >= abs(len(one) - len(other))


@given(WORDS, WORDS, st.integers(1, 6))
def test_a_limit_only_cuts_off(one: str, other: str, limit: int) -> None:
    assert distance(one, other, limit) == min(limit, distance(one, other, 99))
