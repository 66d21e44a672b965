"""A robot with round figures on a floor that a test describes, and the time that passes there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import degrees
from pathlib import Path
from typing import Any

import pytest

from golc.bytecode.image import Image
from golc.diagnostics import Source
from golc.loading import load
from golc.nqc.build import build
from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.machine import Machine
from golc.runtime.rcxsim.machine.options import Firmware
from golc.runtime.rcxsim.surroundings import Mode, Output, Tone
from golc.runtime.rcxsim.trace import Trace
from golc.runtime.rcxsim.world.scene import Scene
from golc.runtime.rcxsim.world.world import World
from golc.runtime.rcxsim.world.worldfile import parse_world

BUILD = {
    "left": '"A"',
    "right": '"C"',
    "radius": "50",
    "wheel_base": "100",
    "wheel_diameter": "50",
    "speed": "160",  # 20 for each level of power
    "coasts": "0",
    "start": "{ at = [0, 0] }",
}
SECOND = 1_000_000
FEED = (True, True, True)


@dataclass
class Lab:
    """A world, its clock in seconds, and hands at its motors."""

    world: World
    records: list[dict[str, Any]]
    now: int = 0

    def drive(self, left: int, right: int, mode: Mode = Mode.ON) -> None:
        """Power for the wheels from now on, from -8 to 8; 0 brakes."""
        self.world.drive([output(left, mode), Output(), output(right, mode)], self.now)

    def wait(self, seconds: float) -> None:
        self.now += round(seconds * SECOND)
        self.world.advance(self.now)

    def raw(self, port: int) -> int:
        return self.world.sense(FEED, self.now)[port - 1]

    def light(self, port: int) -> float:
        """What the brick shows of a light sensor: the formula of its firmware."""
        return 146 - self.raw(port) / 7

    def hear(self, *tones: tuple[int, int]) -> None:
        self.world.hear([Tone(*tone) for tone in tones], self.now)

    @property
    def pose(self) -> tuple[float, float, float]:
        """x and y in mm, heading in degrees."""
        x, y, heading = self.world.pose
        return x, y, degrees(heading)

    def told(self, what: str) -> list[tuple[float, str]]:
        """When and of what the trace tells."""
        return [(record["t"], record["of"]) for record in self.records if record["what"] == what]


def output(power: int, mode: Mode = Mode.ON) -> Output:
    return Output(mode, power > 0, abs(power) - 1) if power else Output(Mode.OFF if mode is Mode.ON else mode)


MakeLab = Callable[..., Lab]
MakeScene = Callable[[str], Scene]


@pytest.fixture
def scene() -> MakeScene:
    return lambda text: parse_world(Source("test.toml", text))


@pytest.fixture
def lab() -> MakeLab:
    """Makes a world with the round robot, built otherwise where that is said, and what a text adds to the file."""

    def make(more: str = "", seed: int = 0, **otherwise: str) -> Lab:
        build = "".join(f"{key} = {value}\n" for key, value in {**BUILD, **otherwise}.items() if value)
        records: list[dict[str, Any]] = []
        trace = Trace(lambda record: records.append(dict(record)))
        text = f"[floor]\nlight = 50\n[robot]\n{build}{more}"
        return Lab(World(parse_world(Source("test.toml", text)), seed, trace), records)

    return make


DELIVERY = Path(__file__).parent.parent.parent / "examples/delivery"
FIRMWARES = {Target.RCX: Firmware.V1, Target.RCX2: Firmware.V2}
DONE, MORE_TIME, PROCEED, ASK, NOTHING = 64, 85, 82, 83, 84
"""Messages of the classic protocol."""


class Radio:
    """Hears the messages of the brick."""

    def __init__(self) -> None:
        self.heard: list[int] = []

    def send(self, payload: bytes, now: int) -> int:
        self.heard.append(payload[1])
        return now + 41_250


class DeliveryRobot:
    """The delivery robot with its compiled program; a host says numbers to it. Times are in simulated seconds."""

    def __init__(self, world: str, image: Image, firmware: Firmware) -> None:
        self.records: list[dict[str, Any]] = []
        trace = Trace(lambda record: self.records.append(dict(record)))
        self.world = World(parse_world(Source("delivery.toml", world)), 0, trace)
        self._radio = Radio()
        self._machine = Machine(firmware, self.world, self._radio, trace)
        self._machine.load(image)
        self._machine.start(0)
        self.wait(0.5)

    @property
    def now(self) -> float:
        return self._machine.now / 1e6

    def wait(self, seconds: float) -> None:
        self._machine.run(self._machine.now + round(seconds * 1e6))

    def say(self, message: int) -> int:
        """Send a message; the answer."""
        before = len(self._radio.heard)
        self._machine.hear(message)
        for _ in range(300):
            self.wait(0.01)
            if len(self._radio.heard) > before:
                self.wait(0.1)
                return self._radio.heard[-1]
        raise AssertionError(f"no answer to {message}")

    def act(self, number: int) -> float:
        """Have an action done; how long it took."""
        began, answer = self.now, self.say(32 + number)
        while answer == MORE_TIME:
            answer = self.say(PROCEED)
        assert answer == DONE
        return self.now - began

    def event(self, within: float) -> int | None:
        """The number of the event that the brick reports next."""
        end = self.now + within
        while self.now < end:
            self.wait(0.2)
            if (digit := self.say(ASK)) != NOTHING:
                assert self.say(PROCEED) == 32  # 48 + n and a last digit of 0
                return digit - 48
        return None

    def told(self, what: str) -> list[str]:
        return [record["of"] for record in self.records if record["what"] == what]


@pytest.fixture(scope="session")
def program(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Target], Image]:
    """The compiled program of the delivery robot."""
    theory = load(DELIVERY / "delivery.gl")

    @cache
    def compiled(target: Target) -> Image:
        return build(theory, theory.devices[0], target, tmp_path_factory.mktemp("program")).image

    return compiled


MakeRobot = Callable[..., DeliveryRobot]


@pytest.fixture
def delivery_robot(program: Callable[[Target], Image]) -> MakeRobot:
    """Makes a delivery robot in the world of the example, with some texts in the file replaced by others."""

    def make(*changes: tuple[str, str], target: Target = Target.RCX2) -> DeliveryRobot:
        text = (DELIVERY / "delivery.toml").read_text()
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        return DeliveryRobot(text, program(target), FIRMWARES[target])

    return make
