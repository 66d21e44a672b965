"""The simulated brick that stands in for a real one where no port is given: in a world, or driven by the theory.

A world is the better one: the compiled program drives the robot that it is for. That needs a world file, nqc, and
behaviours that were written for that robot; the theory alone needs nothing.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from golc.diagnostics import DeviceError
from golc.nqc.actionmap import ActionMap
from golc.nqc.build import build
from golc.nqc.toolchain import Target, find_nqc
from golc.runtime.rcxsim.process import BrickOptions, BrickProcess, spawn
from golc.runtime.rcxsim.world.worldfile import read_world
from golc.theory.theory import BasicActionTheory

NO_WORLD = "none"
"""What stands for no world where one is named."""


@dataclass(frozen=True)
class Setting:
    """Where the brick is simulated: in the world of a file, or by the theory; ``hint`` says how to get more."""

    world: Path | None
    hint: str = ""


def setting(theory: BasicActionTheory, bricks: Mapping[str, ActionMap], world: str | None, scripted: bool) -> Setting:
    """The world that was named, or the file beside the domain that has its name and ends in ``.toml``.

    That one is taken only for a single brick, if no script says what happens, and if nqc is there.
    """
    if world is not None:
        return Setting(None if world == NO_WORLD else Path(world))
    beside = Path(theory.source.name).with_suffix(".toml")
    if len(bricks) != 1 or scripted or not beside.is_file():
        return Setting(None)
    try:
        find_nqc()
    except DeviceError as error:
        return Setting(None, f"with nqc, its program would drive the robot in {beside}: {error.help}")
    return Setting(beside)


def stand_in(
    theory: BasicActionTheory, bricks: Mapping[str, ActionMap], where: Setting, options: BrickOptions, stack: ExitStack
) -> BrickProcess:
    """Start the simulated brick, which the stack ends.

    Raises UserError if the world or the brick's program is wrong, DeviceError if it cannot be started.
    """
    path = Path(theory.source.name)
    if where.world is not None:
        read_world(where.world)  # wrong ones are told of here, where somebody reads it
        [actions] = bricks.values()
        folder = stack.enter_context(tempfile.TemporaryDirectory())
        path = build(theory, actions, Target.RCX2, Path(folder)).path
        options = replace(options, world=where.world, events=None, constants={})
    return stack.enter_context(spawn(path, options))
