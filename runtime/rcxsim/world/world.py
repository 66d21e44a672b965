"""The world in time: the robot drives, its sensors see, people act.

Time is in microseconds and belongs to the caller, who lets it pass in pieces of any length. What happens depends on
when the motors are told something and when people do something, never on the pieces.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

from golc.diagnostics import Findings, Span
from golc.runtime.rcxsim.machine.sounds import SYSTEM_SOUNDS
from golc.runtime.rcxsim.surroundings import OUTPUTS, Button, Mode, Output, Tone
from golc.runtime.rcxsim.trace import Trace
from golc.runtime.rcxsim.world.drive import Drive
from golc.runtime.rcxsim.world.geometry import Pose
from golc.runtime.rcxsim.world.people import Deed, Lift, People, Press, PutAt, PutBack, PutDown
from golc.runtime.rcxsim.world.record import Happening, Record
from golc.runtime.rcxsim.world.robot import SECOND
from golc.runtime.rcxsim.world.scene import Scene, pose_at_station
from golc.runtime.rcxsim.world.script import BRICK_BUTTONS, SOUNDS, read_deed
from golc.runtime.rcxsim.world.senses import Senses


class World:
    """A scene in which time passes; ``seed`` is that of the sensors' noise."""

    def __init__(self, scene: Scene, seed: int, trace: Trace) -> None:
        self.scene = scene
        self._trace = trace
        self._drive = Drive(scene.robot, scene.floor.walls)
        self._senses = Senses(scene, self._drive, seed)
        self._people = People(scene.script)
        self._now = 0
        self._outputs = [Output()] * OUTPUTS
        self._turning = False
        self._pressed: list[Button] = []
        self._held = False
        self._told = ""
        self._station = scene.station_seen(scene.robot.start)
        self.record = Record()
        self.record.begin(0.0, scene.robot.start)

    @property
    def pose(self) -> Pose:
        """Where the robot's middle is."""
        return self._drive.at(self._now).pose

    @property
    def whereabouts(self) -> str:
        """Where the robot is, for people."""
        return "in the air" if self._drive.lifted else self.scene.whereabouts(self.pose)

    def advance(self, to: int) -> None:
        """Let time pass until then; does nothing if it is over."""
        while (due := self._people.next) is not None and due <= to:
            self._roll(due)
            for deed in self._people.take(self._now):
                self._do(deed)
        self._roll(to)

    def sense(self, powered: Sequence[bool], now: int) -> Sequence[int]:
        """The raw values of the three inputs."""
        self.advance(now)
        return [self._senses.raw(port, on, self._now) for port, on in enumerate(powered)]

    def pressed(self, now: int) -> Sequence[Button]:
        """The buttons of the brick that people have pressed since the last call."""
        self.advance(now)
        if not self._pressed:
            return ()
        pressed, self._pressed = self._pressed, []
        return pressed

    def drive(self, outputs: Sequence[Output], now: int) -> None:
        """From now on the outputs do this."""
        self.advance(now)
        robot = self.scene.robot
        for name, wheel in (("left", self._drive.left), ("right", self._drive.right)):
            number = robot.wheels[name]
            output = outputs[number]
            if output == self._outputs[number]:
                continue
            self._drive.settle(self._now)
            if output.mode is Mode.FLOAT:
                wheel.let_go(self._now)
            else:
                speed = robot.speeds[output.power] if output.mode is Mode.ON else 0.0
                wheel.drive(speed if output.forward != (number in robot.reversed) else -speed, self._now)
        if self._outputs != list(outputs):
            self._outputs = list(outputs)
            self._stop_or_go()

    def hear(self, tones: Sequence[Tone], now: int) -> None:
        """The brick begins to play some tones: perhaps one of its own sounds."""
        self.advance(now)
        number = SYSTEM_SOUNDS.index(tuple(tones)) if tuple(tones) in SYSTEM_SOUNDS else None
        self._happen("plays", "tone" if number is None else SOUNDS[number])
        self._people.heard(number, self.scene.station_at(self.pose), self._now)

    def act(self, text: str, where: Span, findings: Findings) -> str:
        """Somebody does something now, in the words of a script; what became of it, nothing if the words are wrong."""
        deed = read_deed(text, where, self.scene.names, findings)
        if deed is None:
            return ""
        self._do(deed)
        return self._told

    def _stop_or_go(self) -> None:
        stands = self._drive.stands_from()
        if stands is None:
            self._people.started()
        elif self._turning:
            self._people.stopped(self.scene.station_at(self.pose), max(stands, self._now))
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
        station = self.scene.station_seen(pose)
        if station != self._station:
            self._station = station
            if station is not None:
                self._happen("reaches", f"station {station}", time, pose)

    def _do(self, deed: Deed) -> None:
        match deed:
            case Press(button, held):
                if button in BRICK_BUTTONS:
                    self._pressed.append(Button(button))
                else:
                    self._senses.press(button, self._now + held)
                self._happen("press", button)
            case Lift():
                self._drive.settle(self._now)
                self._drive.lifted = True
                self._happen("lift", "the robot")
            case PutBack():
                self._put(self.scene.back_on_line(self.pose))
            case PutAt():
                self._put(pose_at_station(self.scene.floor, deed))
            case PutDown(x, y, facing):
                self._put(Pose(x, y, facing))

    def _put(self, pose: Pose) -> None:
        if self._drive.put(pose, self._now):
            self._station = self.scene.station_seen(self.pose)
            self.record.begin(self._now / SECOND, self.pose)
            self._happen("put", f"{self.whereabouts}, facing {degrees(self.pose.heading) % 360:.0f}")
        else:
            self._happen("no room", f"for the robot {self.scene.whereabouts(pose)}")

    def _happen(self, what: str, text: str, time: int | None = None, pose: Pose | None = None) -> None:
        self._told = f"{what} {text}"
        at, where = self._now if time is None else time, self.pose if pose is None else pose
        self.record.happen(Happening(at / SECOND, where, what, text))
        details = {"x": round(where.x, 1), "y": round(where.y, 1), "heading": round(degrees(where.heading) % 360, 1)}
        self._trace.tell(at / SECOND, what, of=text, **details)
