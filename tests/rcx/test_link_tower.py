"""The tower: echoes, sleep, silence; on a line in virtual time."""

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.runtime.devices.rcx import Tower
from tests.rcx.frames import frame

AIR_SECONDS = 9 * 11 / 2400


def replying(number: int) -> Callable[[int, float], list[tuple[float, int]]]:
    return lambda heard, at: [(0.05, number)]


def test_an_echo_is_dropped_and_the_reply_is_heard(air: Any) -> None:
    line = air(replying(64), echo=True)
    tower = Tower(line)
    tower.send(36)
    assert tower.receive(line.now() + 1) == 64
    assert tower.statistics.echoes == 2  # the byte that wakes, and the message
    assert tower.statistics.noise == 0


def test_a_line_without_echo_needs_no_setting(air: Any) -> None:
    line = air(replying(64))
    tower = Tower(line)
    tower.send(36)
    assert tower.receive(line.now() + 1) == 64
    assert tower.statistics.echoes == 0


def test_the_echo_is_known_by_its_place_not_by_its_content(air: Any) -> None:
    line = air(replying(36), echo=True)
    tower = Tower(line)
    tower.send(36)
    assert tower.receive(line.now() + 1) == 36
    assert tower.receive(line.now() + 1) is None


def test_a_tower_that_does_not_echo_may_bring_what_was_just_sent(air: Any) -> None:
    line = air(lambda heard, at: [(0.05, heard)])
    tower = Tower(line)
    for number in (36, 37, 38):
        tower.send(number)
        line.arrive(line.now(), frame(64))
        assert tower.receive(line.now() + 0.1) == 64
        tower.receive(line.now() + 1)
    tower.send(82)
    assert tower.receive(line.now() + 1) == 82


def test_a_few_bytes_of_noise_may_come_before_the_echo(air: Any) -> None:
    line = air(replying(64), echo=True)
    tower = Tower(line)
    tower.send(36)
    line.arrive(line.now(), b"\x01\x55")
    assert tower.receive(line.now() + 1) == 64


def test_a_garbled_echo_is_noise(air: Any) -> None:
    line = air(replying(64))
    tower = Tower(line)
    tower.send(36)
    line.arrive(line.now(), frame(36)[:6] + b"\x00" + frame(36)[7:])
    assert tower.receive(line.now() + 1) == 64
    assert tower.receive(line.now() + 1) is None


def test_a_reply_in_pieces_is_not_taken_for_an_echo_that_is_to_come(air: Any) -> None:
    line = air(lambda heard, at: [])
    tower = Tower(line)
    tower.send(36)
    for place in range(9):
        line.arrive(line.now() + place, frame(65)[place : place + 1])
    assert tower.receive(line.now() + 20) == 65


@given(echo=st.booleans(), cuts=st.lists(st.integers(1, 30), max_size=8), noise=st.binary(max_size=3))
def test_however_the_bytes_are_cut_the_replies_are_what_is_heard(echo: bool, cuts: list[int], noise: bytes) -> None:
    class Pieces:
        name = "pieces"
        time = 0.0
        waiting = b""

        def __init__(self) -> None:
            self.sizes = list(cuts)

        def open(self) -> None: ...
        def close(self) -> None: ...
        def now(self) -> float:
            return self.time

        def read(self, deadline: float) -> bytes:
            size = self.sizes.pop(0) if self.sizes else 100
            data, self.waiting = self.waiting[:size], self.waiting[size:]
            self.time = self.time if data else max(self.time, deadline)
            return data

        def write(self, data: bytes) -> None:
            if len(data) == 9:
                self.waiting += (noise + data if echo else noise) + frame(64) + noise + frame(85)

    tower = Tower(Pieces())
    tower.send(36)
    assert [tower.receive(2.0), tower.receive(3.0), tower.receive(4.0)] == [64, 85, None]


def test_a_sleeping_tower_is_woken_before_the_frame(air: Any) -> None:
    line = air(replying(64), sleeps=True)
    tower = Tower(line)
    tower.send(36)
    assert tower.receive(line.now() + 1) == 64
    assert line.written == [b"\xff", frame(36)]
    line.time += 3.5
    tower.send(36)
    assert tower.receive(line.now() + 1) == 64
    line.time += 4.1
    tower.send(36)
    assert tower.receive(line.now() + 1) == 64
    assert line.written[1:] == [frame(36), frame(36), b"\xff", frame(36)]
    assert tower.statistics.wakes == 2


def test_the_brick_gets_silence_after_a_reply(air: Any) -> None:
    line = air(replying(64))
    tower = Tower(line)
    tower.send(36)
    tower.receive(line.now() + 1)
    replied = line.now()
    out = tower.send(36)
    assert out - AIR_SECONDS - replied == pytest.approx(0.035)


def test_two_messages_never_overlap(air: Any) -> None:
    line = air(lambda heard, at: [])
    tower = Tower(line)
    assert tower.send(81) + AIR_SECONDS <= tower.send(83)


def test_other_packets_and_message_0_are_not_messages(air: Any) -> None:
    line = air(lambda heard, at: [])
    tower = Tower(line)
    line.arrive(line.now(), bytes.fromhex("55ff00d22d00ff01fed32c") + frame(0) + frame(64))
    assert tower.receive(line.now() + 1) == 64
    assert tower.statistics.heard == 1


def test_a_line_that_is_never_silent_keeps_nobody(air: Any) -> None:
    class Babble:
        name = "babble"
        time = 0.0

        def open(self) -> None: ...
        def close(self) -> None: ...
        def write(self, data: bytes) -> None: ...
        def now(self) -> float:
            return self.time

        def read(self, deadline: float) -> bytes:
            self.time += 0.001
            return bytes(100)

    tower = Tower(Babble())
    tower.send(36)
    assert tower.receive(5.0) is None
    assert tower.statistics.noise > 10_000
