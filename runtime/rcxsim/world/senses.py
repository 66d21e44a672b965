"""What the robot's sensors say, as the brick measures it: raw values from 0 to 1023."""

from __future__ import annotations

import random
from math import floor, hypot, pi

from golc.runtime.rcxsim.surroundings import OPEN, ROTATION_LEVELS
from golc.runtime.rcxsim.world.drive import STEP, Drive, Moment
from golc.runtime.rcxsim.world.floor import Brightness
from golc.runtime.rcxsim.world.geometry import Pose, apart
from golc.runtime.rcxsim.world.robot import LightSensor, RotationSensor, TouchSensor
from golc.runtime.rcxsim.world.scene import Scene

PRESSED = 50
"""The raw value of a pressed switch."""
COUNTS_A_TURN = 16
NEAR = 1.0
"""mm between bumper and wall at which the bumper is pressed."""
NOISES = 4096


class Senses:
    """The sensors of a robot; ``seed`` is that of their noise, which is a new one at every full step of 5 ms."""

    def __init__(self, scene: Scene, drive: Drive, seed: int) -> None:
        self._scene = scene
        self._drive = drive
        self._held_until: dict[str, int] = {}
        lights = [sensor for sensor in scene.robot.sensors.values() if isinstance(sensor, LightSensor)]
        self._brightness = Brightness(scene.floor, max((sensor.radius for sensor in lights), default=0.0))
        self._seen: dict[int, tuple[Pose, float]] = {}
        chance = random.Random(f"{seed}: light")
        noisy = any(sensor.noise for sensor in lights)
        self._noise = [chance.gauss(0, 1) for _ in range(NOISES)] if noisy else []

    def press(self, button: str, until: int) -> None:
        """Hold a button until a time, at least."""
        self._held_until[button] = max(until, self._held_until.get(button, 0))

    def raw(self, port: int, powered: bool, now: int) -> int:
        """What the brick measures at an input (0 to 2) now; without power, light and rotation sensors say nothing."""
        match self._scene.robot.sensors.get(port):
            case TouchSensor() as sensor:
                return PRESSED if self.pressed(sensor, now) else OPEN
            case LightSensor() as sensor if powered:
                return raw_light(self.light(port, sensor, now))
            case RotationSensor() as sensor if powered:
                return ROTATION_LEVELS[self.counts(sensor, now) % len(ROTATION_LEVELS)]
            case _:
                return OPEN

    def light(self, port: int, sensor: LightSensor, now: int) -> float:
        """What a light sensor sees, in percent; in the air nothing."""
        if self._drive.lifted:
            return 0.0
        pose = self._drive.at(now).pose
        seen = self._seen.get(port)
        if seen is None or seen[0] is not pose:
            light = self._brightness.at(*pose.place(sensor.ahead, sensor.left), sensor.radius)
            seen = self._seen[port] = (pose, light)
        if not sensor.noise:
            return seen[1]
        return seen[1] + sensor.noise * self._noise[hash((port, now // STEP)) % NOISES]

    def pressed(self, sensor: TouchSensor, now: int) -> bool:
        """Whether a person holds it or a wall is at its bumper."""
        if sensor.name is not None and now < self._held_until.get(sensor.name, 0):
            return True
        return sensor.bumper is not None and not self._drive.lifted and self._bumps(sensor, self._drive.at(now))

    def _bumps(self, sensor: TouchSensor, moment: Moment) -> bool:
        assert sensor.bumper is not None
        ax, ay, bx, by = sensor.bumper
        reach = max(hypot(ax, ay), hypot(bx, by)) + NEAR
        if moment.room + self._scene.robot.radius > reach:
            return False
        # A robot that pushes bends its bumper in: what is between its middle and the bumper presses that, too.
        middle, one, other = moment.pose[:2], moment.pose.place(ax, ay), moment.pose.place(bx, by)
        sides = [(*one, *other), (*middle, *one), (*middle, *other)]
        return any(apart(side, wall) <= NEAR for wall in self._scene.floor.walls for side in sides)

    def counts(self, sensor: RotationSensor, now: int) -> int:
        """Sixteenths of a turn since the beginning, forward less backward."""
        moment = self._drive.at(now)
        rolled = moment.left if sensor.wheel == "left" else moment.right
        turns = rolled * sensor.gear / (pi * self._scene.robot.wheel_diameter)
        return floor(turns * COUNTS_A_TURN)


def raw_light(percent: float) -> int:
    """The raw value at which the brick shows a percentage; the inverse of its formula 146 - raw / 7."""
    return min(OPEN, max(0, round((146 - percent) * 7)))
