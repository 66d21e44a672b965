"""A host that is fifty times as fast as a real one, at a line that does not keep up; in virtual time."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import pytest

from golc.runtime.devices.rcx import Brick, Tower
from golc.runtime.devices.rcx.errors import SilentBrickError
from golc.runtime.devices.rcx.timing import Patience

SPEED = 50.0


@pytest.fixture
def fast(air: Any, script: Any) -> Any:
    """A line and the host's end of it; the line echoes and is behind by some seconds."""

    def start(table: dict[int, Any], behind: float, echo: bool = True) -> tuple[Any, Brick]:
        line = air(script({83: [[84]], **table}), echo=echo, behind=behind)
        return line, Brick(Tower(line, Patience(SPEED)))

    return start


@pytest.mark.parametrize("behind", [0.0, 1.0, 8.0, 20.0])
def test_an_answer_that_is_held_up_is_waited_for(fast: Any, behind: float) -> None:
    line, brick = fast({33: [[64]]}, behind)
    assert brick.poll() is None
    assert brick.perform(1) == 0
    assert line.numbers == [83, 33]
    assert brick.statistics.unanswered == 0


def test_nothing_is_sent_before_what_was_sent_is_out(fast: Any) -> None:
    line, brick = fast({}, behind=5.0)
    brick.abort()
    times = [time for time, _ in line.sent]
    assert line.numbers == [81, 81, 81, 83]
    assert all(later - sooner > 5.0 for sooner, later in pairwise(times))


def test_a_fast_line_that_keeps_up_is_as_fast_as_ever(fast: Any) -> None:
    line, brick = fast({}, behind=0.0)
    start = line.now()
    for _ in range(10):
        brick.poll()
    assert line.now() - start < 10 * 0.2


def test_a_lost_message_is_not_waited_for_much_longer_than_a_slow_process(fast: Any) -> None:
    line, brick = fast({33: [[], [64]]}, behind=0.0)
    start = line.now()
    assert brick.perform(1) == 0
    assert line.now() - start == pytest.approx(0.2 * SPEED, abs=1.0)  # 0.2 real seconds


def test_a_line_that_was_once_behind_is_given_time_again(fast: Any) -> None:
    line, brick = fast({}, behind=4.0)
    brick.poll()
    line.behind = 0.0
    line.brick = lambda heard, at: [(25.0, 84)]
    assert brick.poll() is None
    assert brick.statistics.unanswered == 0


def test_a_tower_without_echo_is_found_out_once(fast: Any) -> None:
    line, brick = fast({}, behind=0.0, echo=False)
    for _ in range(4):
        brick.poll()
    start = line.now()
    brick.poll()
    assert line.now() - start < 0.3


def test_a_brick_that_is_not_there_is_given_up(fast: Any) -> None:
    line, brick = fast({83: [[]]}, behind=0.0)
    start = line.now()
    with pytest.raises(SilentBrickError, match="does not confirm the abort"):
        brick.abort()
    assert line.now() - start < 2 * SPEED


def test_a_host_in_no_haste_has_the_patience_of_a_real_one(air: Any, script: Any) -> None:
    line = air(script({83: [[(0.6, 84)]]}), echo=True)
    brick = Brick(Tower(line))
    brick.poll()
    assert brick.statistics.unanswered == 1
