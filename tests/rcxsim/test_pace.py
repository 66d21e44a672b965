"""How a served line keeps up with the clock, or does not."""

from __future__ import annotations

import pytest

from golc.runtime.rcxsim.serve import HEAVY, TURN, _Pace


def test_a_line_that_was_held_up_catches_up() -> None:
    pace = _Pace(100.0, float("inf"))
    assert pace.go(100.5) == 0.5
    pace.took(0.001)
    assert pace.go(107.0) == 7.0


def test_what_takes_long_to_compute_is_done_in_small_parts() -> None:
    """Computing takes twice as long as it takes to happen: each part is as much as can be computed in a turn."""
    pace, now, steps = _Pace(0.0, TURN), 0.0, []
    for _ in range(20):
        now += 0.0005
        before = pace.reached
        advanced = pace.go(now) - before
        steps.append(advanced)
        now += 2 * advanced
        pace.took(2 * advanced)
    assert max(steps) <= TURN
    assert steps[-1] == pytest.approx(TURN / 2)
    assert pace.reached < now / 2


def test_after_a_heavy_moment_the_parts_grow_again() -> None:
    pace = _Pace(0.0, TURN)
    pace.go(0.01)
    pace.took(10 * HEAVY)
    assert pace.go(1.0) == pytest.approx(0.015)
    for _ in range(8):
        pace.took(0.0001)
    assert pace.go(1.5) == pytest.approx(0.515)
