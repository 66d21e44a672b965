"""A brick with Legolog's own control program, which does not recognise what is sent again; in virtual time."""

from collections.abc import Callable
from typing import Any

import pytest

from golc.runtime.devices.rcx import SilentBrickError

Script = Callable[..., Any]


def test_without_memory_an_idle_brick_gets_the_number_from_its_beginning(talk: Script) -> None:
    line, brick = talk({49: [[], [82]], 36: [[69]]}, remembers=False)
    assert brick.perform(65) == 5
    assert line.numbers == [49, 83, 49, 36]


def test_without_memory_a_last_digit_is_never_sent_alone_to_an_idle_brick(talk: Script) -> None:
    line, brick = talk({49: [[82]], 36: [[], [69]]}, remembers=False)
    assert brick.perform(65) == 5
    assert line.numbers == [49, 36, 83, 49, 36]
    assert brick.statistics.repeated == 1


def test_without_memory_a_brick_that_waits_for_a_digit_gets_it(talk: Script) -> None:
    line, brick = talk({49: [[82]], 36: [[], [69]], 83: [[]]}, remembers=False)
    assert brick.perform(65) == 5
    assert line.numbers == [49, 36, *[83] * 6, 36]


def test_without_memory_a_brick_that_waits_has_received_the_first_digit(talk: Script) -> None:
    line, brick = talk({49: [[]], 36: [[69]], 83: [[]]}, remembers=False)
    assert brick.perform(65) == 5
    assert line.numbers == [49, *[83] * 6, 36]


def test_without_memory_it_is_not_guessed_which_digit_was_received(talk: Script) -> None:
    line, brick = talk({48: [[82], []], 83: [[]]}, remembers=False)
    with pytest.raises(SilentBrickError, match=r"which of the digits \[48, 48, 33\] it has received"):
        brick.perform(256)
    assert line.numbers == [48, 48, *[83] * 6]


def test_without_memory_a_late_answer_to_the_last_digit_counts(talk: Script) -> None:
    line, brick = talk({49: [[82]], 36: [[(3.6, 69)]], 83: [[]]}, remembers=False)
    assert brick.perform(65) == 5
    assert line.numbers == [49, 36, 83]


def test_without_memory_a_value_with_a_gap_is_asked_for_again(talk: Script) -> None:
    line, brick = talk({36: [[74]], 82: [[], [65], [66]]}, remembers=False)
    assert brick.perform(4) == 18
    assert line.numbers == [36, 82, 82, 83, 36, 82] or line.numbers == [36, 82, 82, 36, 82]


def test_without_memory_a_gap_is_an_error_if_the_action_must_not_be_repeated(talk: Script) -> None:
    _line, brick = talk({36: [[74]], 82: [[], [65]]}, remembers=False)
    with pytest.raises(SilentBrickError, match="arrived with gaps"):
        brick.perform(4, repeat=False)


def test_without_memory_half_an_event_is_lost_and_counted(talk: Script) -> None:
    _line, brick = talk({83: [[53], [84]], 82: [[]]}, remembers=False)
    assert brick.poll() is None
    assert brick.statistics.lost == 1


def test_without_memory_a_granted_action_that_is_never_answered_is_begun_again(talk: Script) -> None:
    line, brick = talk({36: [[85], [66]], 82: [[]]}, remembers=False)
    assert brick.perform(4) == 2
    assert line.numbers == [36, 82, 82, 83, 36]
    assert brick.statistics.repeated == 1


def test_without_memory_a_granted_action_may_have_been_done(talk: Script) -> None:
    _line, brick = talk({36: [[85]], 82: [[]]}, remembers=False)
    with pytest.raises(SilentBrickError, match="it was begun, and whether it was done is not known"):
        brick.perform(4, repeat=False)


def test_without_memory_an_action_is_not_begun_for_ever(talk: Script) -> None:
    line, brick = talk({36: [[74]], 82: [[]]}, remembers=False)
    with pytest.raises(SilentBrickError, match="begun 6 times, and no answer was complete"):
        brick.perform(4)
    assert line.numbers.count(36) == 6
