"""The robot: two driven wheels and what they roll, and the sensors that it carries.

Lengths are in mm, speeds in mm/s, times in microseconds of the world's clock.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from golc.runtime.rcxsim.world.geometry import Pose, Segment

SECOND = 1_000_000
LEVELS = 8
"""Power levels of an output, 0 to 7."""


@dataclass(frozen=True)
class LightSensor:
    """Looks down at a disc of the floor."""

    ahead: float
    left: float
    radius: float
    noise: float = 0.0
    """Standard deviation of what it shows, in percent."""


@dataclass(frozen=True)
class TouchSensor:
    """Pressed by a person, by its name, or by a wall at the bumper, which is a segment as the robot sees it."""

    name: str | None = None
    bumper: Segment | None = None


@dataclass(frozen=True)
class RotationSensor:
    """Counts sixteenths of the turns of a wheel; ``gear`` is how often its axle turns while the wheel turns once."""

    wheel: str
    gear: float = 1.0


Sensor: TypeAlias = LightSensor | TouchSensor | RotationSensor


@dataclass(frozen=True)
class Robot:
    """How the robot is built; its reference point is the middle between its wheels.

    ``wheels`` says for ``left`` and ``right`` which output (0 to 2) drives the wheel; those in ``reversed`` drive it
    backwards when they turn forward. ``speeds`` are those of the power levels.
    """

    start: Pose
    radius: float
    wheel_base: float
    wheel_diameter: float
    speeds: tuple[float, ...]
    wheels: Mapping[str, int]
    reversed: frozenset[int] = frozenset()
    coasts: float = 0.0
    """Seconds that a wheel rolls on when its motor is floating."""
    sensors: Mapping[int, Sensor] = field(default_factory=dict)
    """By port, 0 to 2."""


class Wheel:
    """What one wheel has rolled at any time since its motor was last told something."""

    def __init__(self, coasts: float) -> None:
        self._coasts = coasts
        self._since = 0
        self._rolled = 0.0
        self._speed = 0.0
        self._coasting = False

    def drive(self, speed: float, now: int) -> None:
        """Turn at this speed from now on; 0 brakes."""
        self._rolled, self._since = self.rolled(now), now
        self._speed, self._coasting = speed, False

    def let_go(self, now: int) -> None:
        """Roll on, slower and slower, until the wheel stands."""
        if not self._coasting:
            self._rolled, self._since = self.rolled(now), now
            self._coasting = True

    def rolled(self, now: int) -> float:
        """How far the wheel has rolled forward by a time that is not before the last change."""
        passed = (now - self._since) / SECOND
        if not self._coasting:
            return self._rolled + self._speed * passed
        if passed >= self._coasts:
            return self._rolled + self._speed * self._coasts / 2
        return self._rolled + self._speed * (passed - passed * passed / (2 * self._coasts))

    def stands_from(self) -> int | None:
        """The time from which the wheel stands if nothing is changed; None if it turns."""
        if self._speed == 0:
            return self._since
        return self._since + round(self._coasts * SECOND) if self._coasting else None
