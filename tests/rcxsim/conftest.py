"""A small domain, and simulated bricks for it: in virtual time, and as processes."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from golc.loading import load
from golc.runtime.rcxsim.frames import Receiver, message, message_in
from golc.runtime.rcxsim.line import Line, LineOptions
from golc.runtime.rcxsim.theory.simulator import build
from golc.runtime.rcxsim.trace import Trace
from golc.runtime.sources.schedule import Schedule, read_schedule
from golc.theory.theory import BasicActionTheory

LIFT = """\
domain lift

type floor = 1..3
type colour = {red, green, blue}

fluent at: floor = 1
fluent moving: bool = false
fluent called(n: floor): bool = false
fluent paint(n: floor): colour = green
fluent load: 0..100 = 9

action up:
    poss not moving and at < 3
    causes at := at + 1
action go:
    poss not moving
    causes moving := true
action look(n: floor):
    senses paint(n)
action weigh:
    senses load
action turn_off(n: floor):
    causes called(n) := false
action unload:
    causes load := 0

exog arrived:
    poss moving
    causes moving := false
exog stuck:
    poss moving
    causes moving := false
exog call(n: floor):
    causes called(n) := true
exog bell

device rcx "lift.nqc":
    0 up by call up
    1 go by start go
    2 .. look(n: floor) by call look
    5 weigh by call weigh
    65 .. turn_off(n: floor) by call turnOff
    6 unload by call unload timeout 2 s
    8 arrived
    9 stuck
    16 .. call(n: floor)
    10 bell
"""


@dataclass
class Wire:
    """The host's end of a simulated line: says messages, hears messages, and owns the clock."""

    line: Line
    records: list[dict[str, Any]]
    now: float = 0.0
    received: bytearray = field(default_factory=bytearray)
    _receiver: Receiver = field(default_factory=Receiver)

    def say(self, value: int, within: float = 1.0) -> list[int]:
        """Send a message; the messages that come in the time after it."""
        return self.write(message(value)) + self.wait(within)

    def write(self, data: bytes) -> list[int]:
        """Send bytes; the messages that have come by now."""
        return self._read(self.line.host_sent(data, self.now))

    def wait(self, seconds: float) -> list[int]:
        """The messages that come in the seconds that follow."""
        self.now += seconds
        return self._read(self.line.advance(self.now))

    def act(self, *messages: int) -> list[int]:
        """Have an action done, granting time and acknowledging digits; the digits of its value."""
        for value in messages[:-1]:
            assert self.say(value) == [82]
        heard, digits = self.say(messages[-1], 3.3), []
        while heard:
            digits += [value for value in heard if value != 85]
            if digits and 64 <= digits[-1] < 72:
                return digits
            heard = self.say(82, 3.3)
        raise AssertionError(f"no answer; digits {digits}")

    def poll(self) -> list[int]:
        """The event that the brick reports, as its messages; none if there is none."""
        [first] = self.say(83, 0.2)
        return [] if first == 84 else [first, *self.say(82, 0.2)]

    def events(self, seconds: float) -> list[tuple[float, list[int]]]:
        """The events reported to a host that polls all the time, each with its time."""
        found, end = [], self.now + seconds
        while self.now < end:
            if event := self.poll():
                found.append((self.now, event))
        return found

    def told(self, what: str) -> list[dict[str, Any]]:
        """The records of one kind in the trace."""
        return [record for record in self.records if record["what"] == what]

    def _read(self, data: bytes) -> list[int]:
        self.received += data
        payloads = [payload for byte in data if (payload := self._receiver.feed(byte)) is not None]
        return [value for payload in payloads if (value := message_in(payload)) is not None]


@pytest.fixture(scope="session")
def lift_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("lift") / "lift.gl"
    path.write_text(LIFT)
    return path


@pytest.fixture(scope="session")
def lift(lift_file: Path) -> BasicActionTheory:
    return load(lift_file)


MakeWire = Callable[..., Wire]


@pytest.fixture
def wire(lift: BasicActionTheory, tmp_path: Path) -> MakeWire:
    """Makes a line to a simulated lift; no events unless a script (or None, for chance) is given."""

    def make(script: str | None = "", seed: int = 1, theory: BasicActionTheory = lift, **options: Any) -> Wire:
        records: list[dict[str, Any]] = []
        schedule: Schedule | None = Schedule()
        if script is None:
            schedule = None
        elif script:
            events = tmp_path / "lift.events"
            events.write_text(script)
            schedule = read_schedule(events, theory)
        options = {"echo": False, "air_time": 0.0, **options}
        trace = Trace(lambda record: records.append(dict(record)))
        return Wire(build(theory, LineOptions(**options), schedule, seed, trace), records)

    return make


Sim = Callable[..., "subprocess.Popen[str]"]


@pytest.fixture
def sim() -> Iterator[Sim]:
    """Starts ``golc sim`` with the given arguments; ends what is still running after the test."""
    running: list[subprocess.Popen[str]] = []

    def start(*arguments: object, **options: Any) -> subprocess.Popen[str]:
        child = subprocess.Popen(
            [sys.executable, "-m", "golc", "sim", *map(str, arguments)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **options,
        )
        running.append(child)
        return child

    yield start
    for child in running:
        if child.poll() is None:
            child.kill()
        child.communicate()
