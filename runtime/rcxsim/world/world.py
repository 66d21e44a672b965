"""The world in time: the robot drives, its sensors see, people act.

Time is in microseconds and belongs to the caller, who lets it pass in pieces of any length. What happens depends on
when the motors are told something and when people do something, never on the pieces.
"""

from __future__ import annotations

from enum import Enum
from math import degrees

from golc.runtime.rcxsim.trace import Trace
from golc.runtime.rcxsim.world.drive import Drive
from golc.runtime.rcxsim.world.geometry import Pose
from golc.runtime.rcxsim.world.people import Deed, Lift, People, Press, PutAt, PutBack, PutDown
from golc.runtime.rcxsim.world.record import Happening, Record
from golc.runtime.rcxsim.world.robot import SECOND
from golc.runtime.rcxsim.world.scene import Scene, pose_at_station
from golc.runtime.rcxsim.world.script import SOUNDS
from golc.runtime.rcxsim.world.senses import Senses


class Mode(Enum):
    """What an output does with its motor."""

    ON = "on"
    OFF = "off"
    """Brakes."""
    FLOAT = "float"
    """Lets the motor roll on."""


class World:
    """A scene in which time passes; ``seed`` is that of the sensors' noise."""

    def __init__(self, scene: Scene, seed: int, trace: Trace) -> None:
        self._scene = scene
        self._trace = trace
        self._drive = Drive(scene.robot, scene.floor.walls)
        self._senses = Senses(scene, self._drive, seed)
        self._people = People(scene.script)
        self._now = 0
        self._turning = False
        self._held = False
        self._station = scene.station_at(scene.robot.start)
        self.record = Record()
        self.record.begin(0.0, scene.robot.start)

    @property
    def now(self) -> int:
        return self._now

    @property
    def pose(self) -> Pose:
        """Where the robot's middle is."""
        return self._drive.at(self._now).pose

    @property
    def whereabouts(self) -> str:
        """Where the robot is, for people."""
        return "in the air" if self._drive.lifted else self._scene.whereabouts(self.pose)

    def advance(self, to: int) -> None:
        """Let time pass until then; does nothing if it is over."""
        while (due := self._people.next) is not None and due <= to:
            self._roll(due)
            for deed in self._people.take(self._now):
                self._do(deed)
        self._roll(to)

    def raw(self, port: int) -> int:
        """The raw value at an input, 0 to 2, now."""
        return self._senses.raw(port, self._now)

    def motor(self, output: int, mode: Mode, forward: bool, power: int) -> None:
        """An output, 0 to 2, does something else from now on."""
        robot = self._scene.robot
        for name, wheel in (("left", self._drive.left), ("right", self._drive.right)):
            if robot.wheels[name] == output:
                self._drive.settle(self._now)
                if mode is Mode.FLOAT:
                    wheel.let_go(self._now)
                else:
                    speed = robot.speeds[power] if mode is Mode.ON else 0.0
                    wheel.drive(speed if forward != (output in robot.reversed) else -speed, self._now)
                self._stop_or_go()

    def sound(self, number: int | None) -> None:
        """The brick makes one of its own sounds, or another one (None)."""
        name = SOUNDS[number] if number is not None and number < len(SOUNDS) else "tone"
        self._happen("sound", name)
        self._people.heard(number, self._scene.station_at(self.pose), self._now)

    def _stop_or_go(self) -> None:
        stands = self._drive.stands_from()
        if stands is None:
            self._people.started()
        elif self._turning:
            self._people.stopped(self._scene.station_at(self.pose), max(stands, self._now))
        self._turning = stands is None

    def _roll(self, to: int) -> None:
        for moment in self._drive.roll(to):
            seconds = moment.time / SECOND
            self.record.move(seconds, moment.pose)
            self._notice(moment.time, moment.pose, moment.held)
        self._now = max(self._now, to)

    def _notice(self, time: int, pose: Pose, held: bool) -> None:
        """Tell where the robot has come to."""
        if held != self._held:
            self._held = held
            if held:
                self._happen("touches", "a wall", time, pose)
        station = self._scene.station_at(pose)
        if station != self._station:
            self._station = station
            if station is not None:
                self._happen("reaches", f"station {station}", time, pose)

    def _do(self, deed: Deed) -> None:
        match deed:
            case Press(button, held):
                self._senses.press(button, self._now + held)
                self._happen("press", button)
            case Lift():
                self._drive.settle(self._now)
                self._drive.lifted = True
                self._happen("lift", "the robot")
            case PutBack():
                self._put(self._scene.back_on_line(self.pose))
            case PutAt():
                self._put(pose_at_station(self._scene.floor, deed))
            case PutDown(x, y, facing):
                self._put(Pose(x, y, facing))

    def _put(self, pose: Pose) -> None:
        if self._drive.put(pose, self._now):
            self._station = self._scene.station_at(self.pose)
            self.record.begin(self._now / SECOND, self.pose)
            self._happen("put", f"{self.whereabouts}, facing {degrees(self.pose.heading) % 360:.0f}")
        else:
            self._happen("no room", f"for the robot {self._scene.whereabouts(pose)}")

    def _happen(self, what: str, text: str, time: int | None = None, pose: Pose | None = None) -> None:
        at, where = self._now if time is None else time, self.pose if pose is None else pose
        self.record.happen(Happening(at / SECOND, where, what, text))
        details = {"x": round(where.x, 1), "y": round(where.y, 1), "heading": round(degrees(where.heading) % 360, 1)}
        self._trace.tell(at / SECOND, what, of=text, **details)
