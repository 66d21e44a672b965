"""Intervals that are too long to be listed."""

from __future__ import annotations

import pytest

from golc.situation.dynamics import Dynamics
from tests.theories import theory_of

DOMAIN = """domain d
type long = 1..10000000000
fluent x: int? = none
fluent y: long? = none
fluent z: long = 7
exog set_x(n: int):
    causes x := n
action a:
    poss x in long
    causes y := z
"""


@pytest.mark.parametrize(("number", "possible"), [(0, False), (1, True), (10**10, True), (10**10 + 1, False)])
def test_a_value_that_may_be_none_is_looked_for_without_listing_the_interval(number: int, possible: bool) -> None:
    dynamics = Dynamics(theory_of(DOMAIN))

    state = dynamics.progress(dynamics.initial(), "set_x", (number,))

    assert not dynamics.possible(dynamics.initial(), "a", ())
    assert dynamics.possible(state, "a", ()) == possible
    assert dynamics.value(dynamics.progress(state, "a", ()), "y") == 7
