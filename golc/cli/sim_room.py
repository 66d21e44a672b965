"""``golc sim --world``: the room around the brick, and what somebody in it does."""

from __future__ import annotations

import os
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING

from golc.cli.console import Console

if TYPE_CHECKING:
    from golc.runtime.rcxsim.ports import Port
    from golc.runtime.rcxsim.trace import Trace


class Room:
    """The world of a file, with a console for whoever is there; raises ``UserError`` if the file is wrong."""

    def __init__(self, file: Path, seed: int, trace: Trace, console: Console) -> None:
        from golc.runtime.rcxsim.world.world import World
        from golc.runtime.rcxsim.world.worldfile import read_world

        self.world = World(read_world(file), seed, trace)
        self._console = console

    def drawing(self, picture: Path) -> AbstractContextManager[None]:
        """Draw the world as it is in the end."""
        from golc.runtime.rcxsim.world.picture import draw, drawing

        world = self.world
        return drawing(picture, lambda: draw(world.scene, world.record, world.pose))

    def tell_place(self) -> None:
        """Say where the robot is."""
        self._console.out(f"the robot is {self.world.whereabouts}")

    def attended(self, port: Port) -> Port:
        """The port of a brick at which somebody may type what people do."""
        from golc.runtime.rcxsim.attended import AttendedPort
        from golc.runtime.sources.exogenous import standard_input

        descriptor = standard_input()
        if descriptor is None:
            return port
        if os.isatty(descriptor):
            self._console.note("type what you do at the robot, such as `press run`, `lift`, `put back`")
        return AttendedPort(port, descriptor, self._do)

    def _do(self, text: str) -> None:
        """Do what somebody has typed, or say why not."""
        from golc.diagnostics import Findings, Source, Span

        findings = Findings()
        told = self.world.act(text, Span(Source("<stdin>", text), 0, len(text)), findings)
        self._console.findings(findings.diagnostics, gap=False)
        if told:
            self._console.note(f"you: {told}")
