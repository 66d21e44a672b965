"""The display: the watch, a sensor, a motor, or what a program shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.inputs import Input
from golc.runtime.rcxsim.machine.outputs import Outputs
from golc.runtime.rcxsim.surroundings import INPUTS, OUTPUTS

WATCH, USER = 0, INPUTS + OUTPUTS + 1
LEAST, MOST = -9999, 9999
"""What four digits show."""


@dataclass(frozen=True)
class User:
    """What a program shows; ``decimals`` of its digits stand behind the point."""

    read: Callable[[], int]
    decimals: int


class Display:
    """What the brick shows at any time."""

    def __init__(self, watch: Callable[[], int], inputs: Sequence[Input], outputs: Outputs, views: int) -> None:
        self._watch = watch
        self._inputs = inputs
        self._outputs = outputs
        self._views = views
        self.view = WATCH
        self.user = User(lambda: 0, 0)

    def select(self, view: int) -> None:
        """Show the watch, one of the sensors, of the motors, or what the program shows (firmware 2.0)."""
        if not 0 <= view < self._views:
            raise MachineError(f"the display has no view {view}")
        self.view = view

    def next(self) -> None:
        """The View button: go through what is connected."""
        self.view = (self.view + 1) % USER

    @property
    def text(self) -> str:
        """The digits with their point."""
        if self.view == WATCH:
            hours, minutes = divmod(self._watch(), 60)
            return f"{hours:02d}.{minutes:02d}"
        if self.view == USER:
            return _digits(self.user.read(), self.user.decimals)
        if self.view <= INPUTS:
            return str(self._inputs[self.view - 1].value)
        return str(self._outputs.now[self.view - INPUTS - 1].power)


def _digits(value: int, decimals: int) -> str:
    shown = max(LEAST, min(MOST, value))
    return f"{shown / 10**decimals:.{decimals}f}" if 0 < decimals <= 3 else str(shown)
