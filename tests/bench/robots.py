"""Simulated robots: how many seconds of a world, alone or with the machine that drives in it, pass in one."""

from __future__ import annotations

import tempfile
from functools import cache
from pathlib import Path

from golc.bytecode.image import Image
from golc.loading import load
from golc.nqc.build import build
from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.machine import Machine
from golc.runtime.rcxsim.machine.messages import Alone
from golc.runtime.rcxsim.machine.options import Firmware
from golc.runtime.rcxsim.surroundings import Mode, Output
from golc.runtime.rcxsim.trace import Trace
from golc.runtime.rcxsim.world.scene import Scene
from golc.runtime.rcxsim.world.world import World
from golc.runtime.rcxsim.world.worldfile import read_world
from tests.bench.measure import Row, Unit, seconds

DELIVERY = Path(__file__).parent.parent.parent / "examples/delivery"
DRIVEN = 10
"""Simulated seconds, in which the robot does not come to the next station."""
GO = 34
"""The message of the action `start_to_next_station`."""


@cache
def _scene() -> Scene:
    return read_world(DELIVERY / "delivery.toml")


@cache
def _program() -> Image:
    theory = load(DELIVERY / "delivery.gl")
    with tempfile.TemporaryDirectory() as folder:
        return build(theory, theory.devices[0], Target.RCX2, Path(folder)).image


def _world_alone() -> float:
    """Along the line in arcs, with a look at the sensors every 5 ms."""
    world = World(_scene(), 0, Trace())
    fast, slow = Output(Mode.ON, True, 2), Output(Mode.ON, True, 1)

    def drive() -> None:
        for step in range(DRIVEN * 200):
            if step % 50 == 0:
                world.drive([fast, Output(), slow] if step % 100 else [slow, Output(), fast], step * 5000)
            world.sense((True, True, True), step * 5000)

    return DRIVEN / seconds(drive)


def _delivery() -> float:
    """The compiled program drives to the next station."""
    world = World(_scene(), 0, Trace())
    machine = Machine(Firmware.V2, world, Alone(), Trace())
    machine.load(_program())
    machine.start(0)
    machine.run(500_000)
    machine.hear(GO)
    return DRIVEN / seconds(lambda: machine.run(machine.now + DRIVEN * 1_000_000))


ROWS = [
    Row("world", "seconds of a world: a robot, a curved line, three sensors every 5 ms", 100, Unit.RATE, _world_alone),
    Row("driving", "seconds of the delivery robot with its compiled program", 50, Unit.RATE, _delivery),
]
