"""A robot with round figures on a floor that a test describes, and the time that passes there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import degrees
from typing import Any

import pytest

from golc.diagnostics import Source
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
