"""The way from a run to the bricks of its theory: at a port, or simulated here, by the theory or in a world."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from golc.diagnostics import Code, DeviceError, Diagnostic, Severity
from golc.nqc.numbering import number_bricks
from golc.runtime.clock import Clock
from golc.runtime.devices.bricks import Link
from golc.runtime.settings import SIMULATED, Settings
from golc.runtime.sources.schedule import Schedule
from golc.theory.ground import Call
from golc.theory.theory import BasicActionTheory

if TYPE_CHECKING:
    from golc.runtime.rcxsim.inprocess import InProcess
    from golc.runtime.rcxsim.trace import Record
    from golc.runtime.standin import Place, RobotInWorld

DOUBLE_HELP = "what happens to the robot is told by the brick: leave the line out"


class Connection:
    """How the bricks of a run are reached; ``maps`` are their numbers by name, none if the theory has no brick.

    ``robot``: the one in the world, once there is a ``link`` to it. Raises ``UserError`` if the numbers of a brick make
    no sense.
    """

    def __init__(self, theory: BasicActionTheory, settings: Settings) -> None:
        self.maps = number_bricks(theory)
        self.robot: RobotInWorld | None = None
        self._theory = theory
        self._settings = settings
        self._line: InProcess | None = None

    @property
    def simulated(self) -> bool:
        """Whether golc itself simulates the bricks."""
        return bool(self.maps) and self._settings.port in (None, SIMULATED)

    @cached_property
    def place(self) -> Place:
        """Where the brick is simulated, if it is; raises ``DeviceError`` for a world that it cannot be in."""
        from golc.runtime.standin import Place, place

        if not self.simulated and self.maps:
            return Place(None)
        world = self._settings.world
        return place(self._theory, self.maps, None if world is None else str(world), self._settings.events is not None)

    @property
    def described(self) -> str:
        """Where the run takes place, in words; nothing if no brick has a part in it."""
        settings, world = self._settings, self.place.world
        if not self.simulated:
            return f"on {settings.port}" if settings.port else ""
        speed = "" if settings.speed == 1 else f", {settings.speed:g} times as fast as a real one"
        unasked = "" if settings.port else " (no --port was given)"
        return f"on a simulated brick{f' in {world}' if world else ''}{speed}{unasked}"

    def link(self, schedule: Schedule | None, tell_fault: Callable[[str], None], stack: ExitStack) -> Link | None:
        """The way to the bricks, if the domain has any: to simulated ones where no port is given.

        ``schedule``: what happens to a brick that the theory simulates, by chance if none is given. ``tell_fault`` is
        told what has stopped the program of a brick in a world, whose picture is drawn when ``stack`` is left.
        """
        settings, world = self._settings, self.place.world
        if world is None and settings.picture is not None:
            raise DeviceError("there is no world of which a picture could be drawn", help="name one with --world")
        if not self.maps:
            return None
        if not self.simulated:
            return Link(settings.port or "", settings.speed)
        if world is not None:
            self.robot = robot = self._robot_in(world, tell_fault)
            if settings.picture is not None:
                stack.enter_context(robot.drawn(Path(settings.picture)))
            self._line = robot.transport
            return Link(str(world), settings.speed, self._line)
        from golc.runtime.standin import bricks_of_theory

        self._line = bricks_of_theory(self._theory, schedule, settings.speed, settings.seed)
        return Link(self._line.name, settings.speed, self._line)

    def _robot_in(self, world: Path, tell_fault: Callable[[str], None]) -> RobotInWorld:
        from golc.runtime.rcxsim.trace import Trace
        from golc.runtime.standin import RobotInWorld

        def heard(record: Record) -> None:
            if record["what"] == "fault":
                tell_fault("the brick has stopped its program: {task}, address {address}: {problem}".format(**record))

        (actions,) = self.maps.values()
        settings = self._settings
        return RobotInWorld(self._theory, actions, world, settings.speed, settings.seed, Trace(heard))

    def clock(self) -> Clock:
        """The time of the run, which is that of a brick that is simulated here: a slow computer makes both slow."""
        line, speed = self._line, self._settings.speed
        if line is None:
            return Clock(time.monotonic, time.monotonic(), speed)
        return Clock(lambda: line.now() / speed, line.now() / speed, speed)

    def is_ours(self, event: Call) -> bool:
        """Whether a line of the events file is reported from here, and not by the simulated brick."""
        if self.place.world is not None:
            return True
        return not (self.simulated and any(actions.handles(event.action, event.args) for actions in self.maps.values()))

    def doubles(self, schedule: Schedule) -> Iterator[Diagnostic]:
        """Warnings of the lines of the events file that are played here though the brick reports the same."""
        told = set[str]()
        for entry in schedule.only(self.is_ours).entries:
            name = entry.event.action
            bricks = [brick for brick, actions in self.maps.items() if actions.handles(name, entry.event.args)]
            if bricks and name not in told:
                told.add(name)
                message = f"`{name}` is reported by the script, and by the brick `{bricks[0]}` as well"
                yield Diagnostic(Code.EVENT_OF_BRICK, message, entry.span, Severity.WARNING, help=DOUBLE_HELP)
