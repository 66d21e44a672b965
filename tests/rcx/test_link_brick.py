"""The classic protocol, exchange by exchange, in virtual time: what is sent when, and what comes of it."""

import itertools
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest

from golc.runtime.devices.rcx import (
    Brick,
    ClassicParameters,
    NonsenseError,
    OverdueError,
    PanicError,
    ParameterError,
    SilentBrickError,
    Timing,
    Tower,
)

Script = Callable[..., Any]


def test_an_action_of_one_digit(talk: Script) -> None:
    line, brick = talk({36: [[64]]})
    assert brick.perform(4) == 0
    assert line.numbers == [36]
    assert brick.statistics.actions == 1


def test_action_65_goes_in_two_parts(talk: Script) -> None:
    line, brick = talk({49: [[82]], 36: [[69]]})
    assert brick.perform(65) == 5
    assert line.numbers == [49, 36]


def test_a_value_of_three_digits(talk: Script) -> None:
    line, brick = talk({36: [[76]], 82: [[76], [65]]})
    assert brick.perform(4) == 100
    assert line.numbers == [36, 82, 82]


def test_a_brick_may_ask_for_more_time_again_and_again(talk: Script) -> None:
    line, brick = talk({36: [[(3.3, 85)]], 82: [[(3.3, 85)], [(3.3, 85)], [(2.0, 67)]]})
    assert brick.perform(4, timeout=30) == 3
    assert line.numbers == [36, 82, 82, 82]
    assert brick.statistics.more_time == 3
    assert brick.statistics.resent == 0


def test_more_time_ends_with_the_time_of_the_action(talk: Script) -> None:
    line, brick = talk({36: [[(3.3, 85)]], 82: [[(3.3, 85)]]})
    started = line.now()
    with pytest.raises(OverdueError, match="action 4 has not ended within its 8 s") as caught:
        brick.perform(4, timeout=8)
    assert caught.value.help == "give the action a longer timeout"
    assert 8 <= line.now() - started < 12


def test_an_action_without_answer_is_sent_again_after_3_and_a_half_seconds(talk: Script) -> None:
    line, brick = talk({36: [[], [], [64]]})
    assert brick.perform(4) == 0
    times = [at for at, _ in line.sent]
    assert line.numbers == [36, 36, 36]
    assert all(3.5 < later - earlier < 3.6 for earlier, later in itertools.pairwise(times))
    assert brick.statistics.resent == 2


def test_each_part_is_sent_again_as_it_is(talk: Script) -> None:
    line, brick = talk({49: [[], [82]], 36: [[], [74]], 82: [[], [65]]})
    assert brick.perform(65) == 10
    assert line.numbers == [49, 49, 36, 36, 82, 82]


def test_a_brick_that_never_answers_is_silent(talk: Script) -> None:
    line, brick = talk({})
    started = line.now()
    with pytest.raises(SilentBrickError, match=r"does not answer action 4 \(sent 6 times, 3.5 s apart\)") as caught:
        brick.perform(4)
    assert line.numbers == [36] * 6
    assert 21 <= line.now() - started < 22
    assert caught.value.exit_code == 4
    assert caught.value.help is not None
    assert "green Run button" in caught.value.help


def test_the_number_of_sends_is_bounded_however_long_the_action_may_take(talk: Script) -> None:
    line, brick = talk({})
    with pytest.raises(SilentBrickError):
        brick.perform(4, timeout=3600)
    assert line.numbers == [36] * 6


def test_the_time_of_an_action_is_not_used_up_by_lost_messages(talk: Script) -> None:
    line, brick = talk({36: [[], [], [64]]})
    assert brick.perform(4, timeout=2) == 0
    assert line.numbers == [36, 36, 36]


def test_a_later_part_is_sent_four_times_at_most(talk: Script) -> None:
    line, brick = talk({49: [[82]]})
    with pytest.raises(SilentBrickError):
        brick.perform(65)
    assert line.numbers == [49, 36, 36, 36, 36]


def test_an_action_that_must_not_be_done_twice_is_not_sent_twice(talk: Script) -> None:
    line, brick = talk({})
    with pytest.raises(SilentBrickError, match="whether it was done is not known"):
        brick.perform(4, repeat=False)
    assert line.numbers == [36]


def test_a_poll_without_event(talk: Script) -> None:
    line, brick = talk({})
    assert brick.poll() is None
    assert line.numbers == [83]
    assert brick.statistics.unanswered == 0


def test_a_poll_brings_the_number_of_an_exogenous_action(talk: Script) -> None:
    line, brick = talk({83: [[37], [53]], 82: [[36]]})
    assert brick.poll() == 5
    assert brick.poll() == 69
    assert line.numbers == [83, 83, 82]
    assert brick.statistics.events == 2


def test_a_poll_waits_0_3_seconds(talk: Script) -> None:
    line, brick = talk({83: [[]]})
    started = line.now()
    assert brick.poll() is None
    assert 0.34 < line.now() - started - 0.05 < 0.36  # the tower had to be woken
    assert brick.statistics.unanswered == 1


def test_many_polls_without_answer_are_a_silent_brick(talk: Script) -> None:
    line, brick = talk({83: [[]]})
    started = line.now()
    with pytest.raises(SilentBrickError, match="has not answered any poll for 15 s"):
        while line.now() < started + 60:
            assert brick.poll() is None
            line.time += 0.25
    assert 15 < line.now() - started < 17


def test_polls_far_apart_are_not_a_silence_of_their_own(talk: Script) -> None:
    line, brick = talk({83: [[], [], [], [84]]})
    for _ in range(4):
        assert brick.poll() is None
        line.time += 60


def test_an_answered_poll_ends_the_silence(talk: Script) -> None:
    line, brick = talk({83: [[[], [84]][n % 6 == 5] for n in range(120)]})
    for _ in range(120):
        assert brick.poll() is None
        line.time += 1
    assert brick.statistics.unanswered == 100


def test_an_event_that_comes_after_its_poll_is_kept(talk: Script) -> None:
    _line, brick = talk({83: [[(0.5, 37)], [84]], 36: [[(0.5, 64)]]})
    assert brick.poll() is None
    assert brick.perform(4) == 0
    assert brick.poll() == 5
    assert brick.poll() is None
    assert brick.statistics.late == 1


def test_a_late_event_of_two_digits_waits_for_the_next_poll(talk: Script) -> None:
    line, brick = talk({83: [[(0.5, 53)], [53], [84]], 36: [[(0.5, 64)]], 82: [[36]]})
    assert brick.poll() is None
    assert brick.perform(4) == 0
    assert brick.poll() == 69
    assert line.numbers == [83, 36, 83, 82]


def test_a_late_event_of_two_digits_between_exchanges_is_acknowledged(talk: Script) -> None:
    line, brick = talk({83: [[(0.5, 53)], [84]], 36: [[64]], 82: [[36]]})
    assert brick.poll() is None
    line.time += 1
    assert brick.perform(4) == 0
    assert brick.poll() == 69
    assert line.numbers == [83, 82, 36]


def test_without_memory_a_late_event_of_two_digits_is_acknowledged_at_once(talk: Script) -> None:
    line, brick = talk({83: [[(0.5, 53)], [84]], 36: [[(0.5, 64)]], 82: [[36]]}, remembers=False)
    assert brick.poll() is None
    assert brick.perform(4) == 0
    assert brick.poll() == 69
    assert line.numbers == [83, 36, 82]


def test_an_event_that_is_no_late_answer_is_nonsense(talk: Script) -> None:
    _line, brick = talk({36: [[37, (0.1, 64)]]})
    assert brick.perform(4) == 0
    assert brick.poll() is None
    assert brick.statistics.nonsense == 1


def test_a_late_answer_is_not_the_answer_to_the_next_action(talk: Script) -> None:
    line, brick = talk({36: [[(3.7, 65)], [(3.6, 65)]], 37: [[(0.5, 66)]]})
    assert brick.perform(4) == 1
    assert brick.perform(5) == 2
    assert line.numbers[:2] == [36, 36]
    assert 83 in line.numbers[2:-1]


def test_the_same_action_anew_is_marked_off_by_a_poll(talk: Script) -> None:
    line, brick = talk({36: [[64]]})
    brick.perform(4)
    brick.perform(4)
    assert line.numbers == [36, 83, 36]


def test_the_same_action_anew_is_not_sent_before_that_poll_is_answered(talk: Script) -> None:
    line, brick = talk({36: [[64]], 83: [[]]})
    brick.perform(4)
    with pytest.raises(SilentBrickError, match=r"action 4 \(6 polls before it were not answered\)"):
        brick.perform(4)
    assert line.numbers == [36] + [83] * 6


def test_a_poll_that_was_lost_does_not_mark_off(talk: Script) -> None:
    line, brick = talk({36: [[64]], 83: [[], [84]]})
    brick.perform(4)
    assert brick.poll() is None
    brick.perform(4)
    assert line.numbers == [36, 83, 83, 36]


def test_a_value_whose_second_continue_was_sent_again_is_asked_for_again(talk: Script) -> None:
    line, brick = talk({36: [[76], [77]], 82: [[76], [], [65], [77], [65]]})
    assert brick.perform(4) == 109
    assert line.numbers == [36, 82, 82, 82, 83, 36, 82, 82]


def test_panic_is_answered_by_an_abort(talk: Script) -> None:
    line, brick = talk({36: [[80]], 81: [[]]})
    with pytest.raises(PanicError, match="the brick panics") as caught:
        brick.perform(4)
    assert line.numbers == [36, 81, 81, 81, 83]
    assert caught.value.help == "it was told to stop and has confirmed that; what it was doing is unknown"
    assert brick.statistics.panics == 1


def test_panic_in_a_poll(talk: Script) -> None:
    line, brick = talk({83: [[80], [84]]})
    with pytest.raises(PanicError):
        brick.poll()
    assert line.numbers == [83, 81, 81, 81, 83]
    assert brick.poll() is None


def test_a_brick_that_goes_on_panicking(talk: Script) -> None:
    line, brick = talk({36: [[80]], 83: [[80]]})
    with pytest.raises(PanicError) as caught:
        brick.perform(4)
    assert caught.value.help is not None
    assert "does not obey the abort" in caught.value.help
    assert line.numbers.count(81) > 3


def test_meaningless_answers_are_ignored_and_counted(talk: Script) -> None:
    _line, brick = talk({36: [[100, 1, 84, 64]]})
    assert brick.perform(4) == 0
    assert brick.statistics.nonsense == 3


def test_too_many_meaningless_answers_are_an_error(talk: Script) -> None:
    _line, brick = talk({36: [[100] * 9]})
    with pytest.raises(NonsenseError, match=r"numbers that mean nothing here \(100, 100") as caught:
        brick.perform(4)
    assert caught.value.help is not None
    assert "numbers that the device declares" in caught.value.help


def test_a_brick_that_only_answers_nonsense_is_not_called_silent(talk: Script) -> None:
    _line, brick = talk({36: [[100]]})
    with pytest.raises(NonsenseError, match=r"\(100, 100, 100, 100, 100, 100\)"):
        brick.perform(4)


def test_nonsense_in_polls_is_an_error_in_the_end(talk: Script) -> None:
    _line, brick = talk({83: [[100]]})
    with pytest.raises(NonsenseError):
        for _ in range(20):
            assert brick.poll() is None


def test_a_number_without_end_is_nonsense(talk: Script) -> None:
    _line, brick = talk({36: [[72]], 82: [[72]]})
    with pytest.raises(NonsenseError, match=r"a number without end \(72, 72, 72, 72, ...\)"):
        brick.perform(4)


def test_abort_is_confirmed_by_an_answer(talk: Script) -> None:
    line, brick = talk({})
    brick.abort()
    assert line.numbers == [81, 81, 81, 83]
    times = [time for time, _ in line.sent]
    assert [later - earlier for earlier, later in pairwise(times)] == pytest.approx([0.1, 0.1, 0.3])


def test_abort_is_sent_until_it_is_confirmed(talk: Script) -> None:
    line, brick = talk({83: [[], [], [84]]})
    brick.abort()
    assert line.numbers == [81, 81, 81, 83] * 3


def test_an_event_that_confirms_an_abort_is_not_lost(talk: Script) -> None:
    _line, brick = talk({83: [[37], [84]]})
    brick.abort()
    assert brick.poll() == 5
    assert brick.poll() is None


def test_an_abort_that_is_never_confirmed(talk: Script) -> None:
    line, brick = talk({83: [[]]})
    started = line.now()
    with pytest.raises(SilentBrickError, match="does not confirm the abort"):
        brick.abort()
    assert 4 < line.now() - started < 5


def test_an_abort_in_passing(talk: Script) -> None:
    line, brick = talk({})
    brick.abort(confirm=False)
    assert line.numbers == [81]


def test_a_number_that_does_not_fit_the_wire(talk: Script) -> None:
    line, brick = talk({})
    with pytest.raises(ParameterError):
        brick.perform(-1)
    assert line.numbers == []


def test_two_bricks_on_one_tower(air: Any, script: Script) -> None:
    line = air(script({36: [[64]], 83: [[84]], 100: [[129]], 147: [[101]]}))
    tower = Tower(line)
    first = Brick(tower)
    second = Brick(tower, ClassicParameters(action_base=96, value_base=128, control_base=144))
    assert first.perform(4) == 0
    assert second.perform(4) == 1
    assert first.poll() is None
    assert second.poll() == 5
    assert line.numbers == [36, 100, 83, 147]


def test_other_timing(talk: Script) -> None:
    line, brick = talk({}, timing=Timing(answer=1.0, sends=2))
    started = line.now()
    with pytest.raises(SilentBrickError, match="sent 2 times"):
        brick.perform(4)
    assert line.now() - started < 2.2


def test_a_brick_that_goes_silent_after_asking_for_time(talk: Script) -> None:
    line, brick = talk({36: [[85]], 82: [[]]})
    with pytest.raises(SilentBrickError):
        brick.perform(4, timeout=60)
    assert line.numbers == [36, 82, 82, 82, 82]


def test_an_abort_that_is_answered_with_nonsense(talk: Script) -> None:
    _line, brick = talk({83: [[100] * 9]})
    with pytest.raises(NonsenseError):
        brick.abort()
