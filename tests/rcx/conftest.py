"""What the tests of the link have at the other end: a brick as a process of its own, and a line in virtual time."""

from __future__ import annotations

import heapq
import json
import re
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from golc.runtime.devices.rcx import Brick, Tower
from tests.rcx.frames import frame

SMALL_BRICK = Path(__file__).with_name("small_brick.py")
ANSWERS: dict[str, list[Any]] = {"36": [[64]], "83": [[84]], "81": [[]]}


@dataclass
class SmallBrick:
    """A running small brick."""

    process: subprocess.Popen[str]
    port: str

    def heard(self) -> list[int]:
        """End the brick; the messages that it has heard."""
        output, _ = self.process.communicate(timeout=30)
        return [int(number) for number in json.loads(output)]


@pytest.fixture
def small_brick() -> Iterator[Callable[..., SmallBrick]]:
    """Starts a brick process: ``small_brick("pty" or "tcp", answers, "echo")``."""
    started: list[subprocess.Popen[str]] = []

    def start(kind: str = "pty", answers: Mapping[str, list[Any]] = ANSWERS, *options: str) -> SmallBrick:
        command = [sys.executable, str(SMALL_BRICK), kind, json.dumps(answers), *options]
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        started.append(process)
        assert process.stdout is not None
        return SmallBrick(process, process.stdout.readline().strip())

    yield start
    for process in started:
        process.kill()
        process.communicate()


FRAME = re.compile(rb"\x55\xff\x00\xf7\x08(.)...", re.DOTALL)
AIR = 9 * 11 / 2400

Answerer = Callable[[int, float], Sequence[tuple[float, int]]]
"""A brick: a message and its time; the messages it answers, each with the seconds until it begins to send them."""
Damage = Callable[[bytes, bool], tuple[float, bytes]]
"""What happens to a frame on the air, from the brick or from the host: how late it comes, and what is left of it."""


@dataclass
class Air:
    """A transport in virtual time: no thread, no waiting; what the host writes reaches a brick after its air time."""

    brick: Answerer
    echo: bool = False
    damage: Damage = lambda data, from_brick: (0.0, data)
    sleeps: bool = False
    behind: float = 0.0
    """So much later than it should everything happens that is not the host's."""
    name: str = "air"
    time: float = 100.0
    sent: list[tuple[float, int]] = field(default_factory=list)
    """What the host sent: when its last bit was out, and the message."""
    written: list[bytes] = field(default_factory=list)
    _arriving: list[tuple[float, int, bytes]] = field(default_factory=list)
    _awake_until: float = 0.0
    _held_up_until: float = 0.0
    _order: int = 0

    def open(self) -> None:
        self.time += 1.0

    def close(self) -> None:
        self.time += 1.0

    def now(self) -> float:
        return self.time

    def read(self, deadline: float) -> bytes:
        if self._arriving and self._arriving[0][0] <= max(deadline, self.time):
            at, _, data = heapq.heappop(self._arriving)
            self.time = max(self.time, at)
            return data if not self.sleeps or at <= self._awake_until + AIR else self.read(deadline)
        self.time = max(self.time, deadline)
        return b""

    def write(self, data: bytes) -> None:
        self.written.append(data)
        awake = self.time <= self._awake_until
        out = self.time + AIR * len(data) / 9
        self._awake_until = out + 4.0
        if self.echo and (awake or not self.sleeps):
            self.arrive(out + self.behind, data)
        for match in FRAME.finditer(data):
            self.sent.append((out, match[1][0]))
            if awake or not self.sleeps:
                delay, left = self.damage(match[0], False)
                if left == match[0]:
                    self._hear(match[1][0], out + self.behind + delay)
                elif left:
                    self.arrive(out, b"\xc3")  # what a tower makes of a disturbance

    def _hear(self, number: int, at: float) -> None:
        for wait, answer in self.brick(number, at):
            delay, left = self.damage(frame(answer), True)
            # What comes late holds up what follows: nothing overtakes.
            start = at + wait + delay
            if delay or self._held_up_until > at + wait:
                start = self._held_up_until = max(start, self._held_up_until + AIR)
            self.arrive(start + AIR, left)

    def arrive(self, at: float, data: bytes) -> None:
        """Let bytes arrive at the host, at a virtual time."""
        if data:
            self._order += 1
            heapq.heappush(self._arriving, (at, self._order, data))

    @property
    def numbers(self) -> list[int]:
        """The messages that the host sent."""
        return [number for _, number in self.sent]


@pytest.fixture
def air() -> type[Air]:
    return Air


def scripted(table: Mapping[int, Sequence[Sequence[int | tuple[float, int]]]]) -> Answerer:
    """A brick from a table: for each message the answers of the first, second, ... time; the last one stays."""
    left = {number: list(answers) for number, answers in table.items()}

    def answer(number: int, at: float) -> list[tuple[float, int]]:
        answers = left.get(number, [[]])
        chosen = answers.pop(0) if len(answers) > 1 else answers[0]
        return [entry if isinstance(entry, tuple) else (0.05, entry) for entry in chosen]

    return answer


@pytest.fixture
def script() -> Callable[..., Answerer]:
    return scripted


@pytest.fixture
def talk(air: type[Air], script: Callable[..., Answerer]) -> Callable[..., tuple[Air, Brick]]:
    """A line to a brick with a table of answers, and the host's end of it."""

    def start(table: dict[int, Any], **options: Any) -> tuple[Air, Brick]:
        line = air(script({83: [[84]], **table}))
        return line, Brick(Tower(line), **options)

    return start
