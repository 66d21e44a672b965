"""A host and a simulated line with one clock, on a computer that is as busy as a test says."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import pytest

from golc.runtime.rcxsim import inprocess
from golc.runtime.rcxsim.inprocess import InProcess


@dataclass
class FakeTime:
    """A clock that goes on when somebody sleeps, or when something takes its time."""

    now: float = 100.0

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


@dataclass
class FakeLine:
    """Answers each byte 0.2 s after it has come; to simulate a second takes ``cost`` seconds."""

    time: FakeTime
    cost: float = 0.0
    now: float = 0.0
    answers: list[tuple[float, bytes]] = field(default_factory=list)

    def advance(self, now: float) -> bytes:
        self.time.now += (now - self.now) * self.cost
        self.now = max(self.now, now)
        come = b"".join(answer for at, answer in self.answers if at <= now)
        self.answers = [(at, answer) for at, answer in self.answers if at > now]
        return come

    def host_sent(self, data: bytes, now: float) -> bytes:
        received = self.advance(now)
        self.answers.append((now + 0.2, data.upper()))
        return received


@pytest.fixture
def time(monkeypatch: pytest.MonkeyPatch) -> FakeTime:
    fake = FakeTime()
    monkeypatch.setattr(inprocess, "time", fake)
    return fake


def port(time: FakeTime, speed: float = 10.0, cost: float = 0.0) -> Any:
    line: Any = FakeLine(time, cost)
    return InProcess(line, speed, "test")


def test_time_passes_at_its_speed(time: FakeTime) -> None:
    there = port(time)
    time.sleep(2)
    assert there.now() == pytest.approx(20)


def test_an_answer_is_read_when_it_comes(time: FakeTime) -> None:
    there = port(time)
    there.write(b"a")
    assert there.read(0.1) == b""
    assert there.now() == pytest.approx(0.1, abs=0.03)
    assert there.read(5.0) == b"A"
    assert there.now() == pytest.approx(0.2, abs=0.03)


def test_a_host_that_looks_too_late_has_missed_nothing(time: FakeTime) -> None:
    there = port(time)
    there.write(b"a")
    time.sleep(3)  # something else had the processor for half a minute of simulated time
    assert there.read(0.3) == b"A"
    assert there.read(0.3) == b""


def test_what_is_not_there_in_time_does_not_come(time: FakeTime) -> None:
    there = port(time)
    there.write(b"a")
    assert there.read(0.15) == b""


def test_a_computer_that_is_too_slow_makes_the_time_slow(time: FakeTime) -> None:
    there = port(time, speed=10.0, cost=0.2)  # half as fast as it should be
    there.now()
    before = time.now
    while there.now() < 10:
        time.sleep(0.01)
    assert time.now - before == pytest.approx(2.0, rel=0.2)  # not the one second that it should be, nor for ever
