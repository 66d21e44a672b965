"""The infrared line in virtual time: air time, echo, half duplex, sleep, noise."""

from __future__ import annotations

import random
from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.runtime.rcxsim.frames import Receiver, message, message_in
from golc.runtime.rcxsim.line import Line, LineOptions, damage
from golc.runtime.rcxsim.theory.programs import Programs
from golc.runtime.rcxsim.trace import Trace

POLL = bytes.fromhex("55 ff 00 f7 08 53 ac 4a b5")
NONE = bytes.fromhex("55 ff 00 f7 08 54 ab 4b b4")


class Parrot:
    """A program that answers every message with the next number."""

    def __init__(self) -> None:
        self.heard: list[int] = []

    def hear(self, value: int, now: float) -> Sequence[int]:
        self.heard.append(value)
        return [value + 1]

    def tick(self, now: float) -> Sequence[int]:
        return []

    def due(self) -> float | None:
        return None

    def reset(self, now: float) -> None:
        self.heard.append(0)


def line(*, seed: int = 0, **options: object) -> tuple[Line, Parrot]:
    parrot = Parrot()
    return Line(Programs([parrot], Trace()), LineOptions(**options), random.Random(seed), Trace()), parrot  # type: ignore[arg-type]


def messages(data: bytes) -> list[int | None]:
    receiver = Receiver()
    return [message_in(payload) for byte in data if (payload := receiver.feed(byte)) is not None]


def test_answer_without_air_time_comes_at_once() -> None:
    tower, _ = line(air_time=0.0, echo=False)
    assert tower.host_sent(POLL, 1.0) == NONE


def test_echo_comes_before_the_answer() -> None:
    tower, _ = line(air_time=0.0)
    assert tower.host_sent(POLL, 1.0) == POLL + NONE


def test_air_time_of_nine_bytes_is_41_ms() -> None:
    tower, parrot = line(echo=False)
    tower.host_sent(POLL, 0.0)
    tower.advance(0.04124)
    assert parrot.heard == []
    tower.advance(0.04126)
    assert parrot.heard == [83]


def test_echo_is_paced_like_the_line() -> None:
    tower, _ = line()
    assert tower.host_sent(POLL, 0.0) == b""
    assert tower.advance(0.0046) == POLL[:1]
    assert tower.advance(0.0250) == POLL[1:5]


def test_exchange_takes_air_time_both_ways_and_the_brick_s_reaction() -> None:
    tower, _ = line(echo=False)
    tower.host_sent(POLL, 0.0)
    assert tower.advance(0.1124) == NONE[:8]
    assert tower.advance(0.1126) == NONE[8:]


def test_brick_hears_nothing_while_it_sends() -> None:
    tower, parrot = line(echo=False)
    tower.host_sent(POLL, 0.0)
    tower.advance(0.08)
    tower.host_sent(POLL, 0.08)
    tower.advance(1.0)
    assert parrot.heard == [83]


def test_half_a_packet_is_forgotten_after_a_pause() -> None:
    tower, parrot = line(echo=False)
    tower.host_sent(POLL[:6], 0.0)
    tower.host_sent(POLL[6:], 0.5)
    tower.host_sent(POLL, 1.0)
    tower.advance(2.0)
    assert parrot.heard == [83]


def test_packet_may_come_in_pieces() -> None:
    tower, parrot = line(echo=False)
    for place in range(9):
        tower.host_sent(POLL[place : place + 1], place * 0.01)
    tower.advance(1.0)
    assert parrot.heard == [83]


def test_tower_that_sleeps_misses_the_answer() -> None:
    class Slow(Parrot):
        def hear(self, value: int, now: float) -> Sequence[int]:
            self.at: float | None = now + 4.5
            return []

        def tick(self, now: float) -> Sequence[int]:
            self.at = None
            return [7]

        def due(self) -> float | None:
            return getattr(self, "at", None)

    for sleep, expected in ((4.0, b""), (None, message(7))):
        tower = Line(Programs([Slow()], Trace()), LineOptions(echo=False, sleep=sleep), random.Random(0), Trace())
        tower.host_sent(POLL, 0.0)
        assert tower.advance(10.0) == expected


def test_every_brick_in_sight_hears_everything() -> None:
    left, right = Parrot(), Parrot()
    tower = Line(Programs([left, right], Trace()), LineOptions(air_time=0.0), random.Random(0), Trace())
    tower.host_sent(POLL, 0.0)
    assert left.heard == right.heard == [83]


def test_firmware_answers_alive_battery_and_versions() -> None:
    tower, _ = line(air_time=0.0, echo=False)
    assert tower.host_sent(bytes.fromhex("55 ff 00 10 ef 10 ef"), 0.0) == bytes.fromhex("55 ff 00 ef 10 ef 10")
    assert tower.host_sent(bytes.fromhex("55 ff 00 38 c7 38 c7"), 1.0) == bytes.fromhex(
        "55 ff 00 c7 38 fc 03 21 de e4 1b"
    )
    assert tower.host_sent(bytes.fromhex("55 ff 00 15 ea 01 fe 03 fc 05 fa 07 f8 0b f4 30 cf"), 2.0) == bytes.fromhex(
        "55 ff 00 ea 15 00 ff 03 fc 00 ff 01 fe 00 ff 03 fc 00 ff 09 f6 fa 05"
    )


def test_loss_takes_its_share_of_both_directions() -> None:
    tower, parrot = line(air_time=0.0, echo=False, loss=0.25)
    answers = sum(tower.host_sent(POLL, float(second)) == NONE for second in range(2000))
    assert 0.72 < len(parrot.heard) / 2000 < 0.78
    assert 0.72 < answers / len(parrot.heard) < 0.78


def test_garbled_messages_do_not_arrive_as_others() -> None:
    tower, parrot = line(air_time=0.0, echo=False, garble=0.5)
    answers = [value for second in range(1000) for value in messages(tower.host_sent(POLL, float(second)))]
    assert set(parrot.heard) == {83}
    assert set(answers) == {84}
    assert 400 < len(parrot.heard) < 600


def test_a_packet_that_is_repeated_is_heard_twice() -> None:
    tower, parrot = line(repeat=1.0, echo=False)
    tower.host_sent(POLL, 0.0)
    assert messages(tower.advance(1.0)) == [84, 84]
    assert parrot.heard == [83]  # while it answered the first, it did not hear the second


def test_a_packet_that_is_repeated_to_a_brick_that_does_not_answer_at_once() -> None:
    class Silent(Parrot):
        def hear(self, value: int, now: float) -> Sequence[int]:
            self.heard.append(value)
            return []

    silent = Silent()
    tower = Line(Programs([silent], Trace()), LineOptions(repeat=1.0), random.Random(0), Trace())
    tower.host_sent(POLL, 0.0)
    tower.advance(1.0)
    assert silent.heard == [83, 83]


def test_late_packets_keep_their_order() -> None:
    tower, parrot = line(late=0.5, echo=False, air_time=0.0, sleep=None)
    sent = list(range(1, 101))
    received = b"".join(tower.host_sent(message(value), value / 20) for value in sent)
    received += tower.advance(100.0)
    assert parrot.heard == sent
    assert messages(received) == [value + 1 for value in sent]


def test_a_late_packet_is_at_most_half_a_second_late() -> None:
    tower, parrot = line(late=1.0, echo=False, air_time=0.0)
    tower.host_sent(POLL, 0.0)
    assert parrot.heard == []
    tower.advance(0.51)
    assert parrot.heard == [83]


def test_noise_before_a_packet_does_not_hide_it() -> None:
    tower, parrot = line(noise=1.0, echo=False, air_time=0.0)
    received = b"".join(tower.host_sent(POLL, float(second)) for second in range(50))
    assert parrot.heard == [83] * 50
    assert len(received) > 50 * 9
    assert messages(received).count(84) == 50


def test_a_brick_that_is_off_hears_nothing_and_starts_anew() -> None:
    tower, parrot = line(outages=((1.0, 2.0),), air_time=0.0, echo=False)
    for time in (0.5, 1.5, 2.5):
        tower.host_sent(POLL, time)
    assert parrot.heard == [83, 0, 83]


def test_same_seed_same_noise() -> None:
    def run(seed: int) -> list[bytes]:
        tower, _ = line(seed=seed, air_time=0.0, loss=0.2, garble=0.2, repeat=0.2, late=0.2, noise=0.2)
        return [tower.host_sent(POLL, float(second)) for second in range(200)]

    assert run(1) == run(1)
    assert run(1) != run(2)


def test_certain_loss() -> None:
    tower, parrot = line(air_time=0.0, loss=1.0)
    assert tower.host_sent(POLL, 0.0) == POLL
    assert parrot.heard == []


@given(st.integers(1, 255), st.integers())
def test_damage_never_makes_another_message(value: int, seed: int) -> None:
    assert set(messages(damage(message(value), random.Random(seed)))) <= {value}


@pytest.mark.parametrize("chunk", [1, 2, 5, 9, 100])
def test_how_bytes_are_bundled_changes_nothing(chunk: int) -> None:
    tower, parrot = line(echo=False)
    data = POLL + b"\x00\x17" + message(200)
    for place in range(0, len(data), chunk):
        tower.host_sent(data[place : place + chunk], 0.0)
    tower.advance(1.0)
    assert parrot.heard[0] == 83
