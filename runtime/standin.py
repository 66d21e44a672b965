"""The simulated brick that stands in for a real one where no port is given: in a world, or driven by the theory.

In a world the brick's compiled program drives the robot that it was written for. That needs a world file, and nqc; the
theory alone needs nothing.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from golc.diagnostics import DeviceError, Findings, Span
from golc.nqc.actionmap import ActionMap
from golc.nqc.build import build
from golc.nqc.toolchain import Target, find_nqc
from golc.runtime.rcxsim.inprocess import InProcess
from golc.runtime.rcxsim.line import LineOptions
from golc.runtime.rcxsim.machine import simulator
from golc.runtime.rcxsim.machine.options import Firmware, Options
from golc.runtime.rcxsim.theory import simulator as simulator_of_theory
from golc.runtime.rcxsim.trace import Trace
from golc.runtime.rcxsim.world.picture import draw, drawing
from golc.runtime.rcxsim.world.world import World
from golc.runtime.rcxsim.world.worldfile import read_world
from golc.runtime.sources.schedule import Schedule
from golc.theory.theory import BasicActionTheory

NO_WORLD = "none"
"""What stands for no world where one is named."""


@dataclass(frozen=True)
class Place:
    """Where the brick is simulated: in the world of a file, or by the theory; ``hint`` says how to get more."""

    world: Path | None
    hint: str = ""


def place(theory: BasicActionTheory, bricks: Mapping[str, ActionMap], world: str | None, scripted: bool) -> Place:
    """The world that was named, or the file beside the domain that has its name and ends in ``.toml``.

    That one is taken only for a single brick, if no script says what happens, and if nqc is there. Raises DeviceError
    if a world was named and there is not one brick to be in it.
    """
    if world == NO_WORLD:
        return Place(None)
    if world is not None:
        if len(bricks) != 1:
            raise DeviceError(f"there is one brick in a world, but the domain has {', '.join(bricks) or 'none'}")
        return Place(Path(world))
    beside = Path(theory.source.name).with_suffix(".toml")
    if len(bricks) != 1 or scripted or not beside.is_file():
        return Place(None)
    try:
        find_nqc()
    except DeviceError as error:
        return Place(None, f"with nqc, the program of the brick would drive the robot in {beside}: {error.help}")
    return Place(beside)


def bricks_of_theory(theory: BasicActionTheory, schedule: Schedule | None, speed: float, seed: int) -> InProcess:
    """The end of a line to bricks that do what the theory says; without a schedule events come by chance."""
    line = simulator_of_theory.build(theory, LineOptions(), schedule, seed, Trace())
    return InProcess(line, speed, "a simulated brick")


class RobotInWorld:
    """A brick with the program of a domain's behaviours, in a world, at the end of a line in this process.

    Raises UserError if the world or the program is wrong, DeviceError if the program cannot be compiled.
    """

    def __init__(
        self, theory: BasicActionTheory, actions: ActionMap, path: Path, speed: float, seed: int, trace: Trace
    ) -> None:
        self._world = World(read_world(path), seed, trace)
        with tempfile.TemporaryDirectory() as folder:
            image = build(theory, actions.device, Target.RCX2, Path(folder)).image
        line, _ = simulator.build(Firmware.V2, image, self._world, Options(seed=seed), LineOptions(), trace)
        self.transport = InProcess(line, speed, str(path))

    def whereabouts(self) -> str:
        """Where the robot is now."""
        with self.transport.lock:
            return self._world.whereabouts

    def act(self, text: str, where: Span, findings: Findings) -> str:
        """Somebody at the robot does something now; what became of it, nothing if the words are wrong."""
        with self.transport.lock:
            self.transport.now()
            return self._world.act(text, where, findings)

    def drawn(self, path: Path) -> AbstractContextManager[None]:
        """Draw the world from above into a file in the end, with the way of the robot until then, as SVG.

        Raises UserError, in the beginning, if the file cannot be written.
        """
        return drawing(path, self._picture)

    def _picture(self) -> str:
        with self.transport.lock:
            return draw(self._world.scene, self._world.record, self._world.pose)
