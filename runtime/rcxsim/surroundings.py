"""What stands between the brick and the world around it.

The brick looks at its inputs and buttons, and says what its outputs do; the world is whatever answers. Times are in
microseconds since the brick was made, and never go back. Between two calls the outputs stay as they were said to be
last, so a world may move in steps of its own, from the time of one call to that of the next.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Protocol

INPUTS = OUTPUTS = 3
OPEN = 1023
"""The raw value of an input with nothing connected to it; a touch sensor that is pressed brings it below 100."""
ROTATION_LEVELS = (1000, 780, 520, 260)
"""The raw values that a rotation sensor goes through, sixteen of them a turn, forward in this order, then from the
beginning. The brick takes the nearest, and loses what goes faster than it looks."""


class Mode(Enum):
    """What an output does with its motor."""

    OFF = "off"
    """It is short-circuited, and brakes."""
    FLOAT = "float"
    ON = "on"


@dataclass(frozen=True, slots=True)
class Output:
    """One of the outputs A, B and C; ``power`` is from 0 (the least) to 7, and matters if it is on."""

    mode: Mode = Mode.OFF
    forward: bool = True
    power: int = 7


class Button(Enum):
    """The buttons of the brick."""

    POWER = "on-off"
    RUN = "run"
    PROGRAM = "prgm"
    VIEW = "view"


@dataclass(frozen=True, slots=True)
class Tone:
    """A sound; ``duration`` is in hundredths of a second."""

    frequency: int
    duration: int


class Surroundings(Protocol):
    """The world as the brick sees it."""

    def sense(self, powered: Sequence[bool], now: int) -> Sequence[int]:
        """The raw values, 0 to 1023, of the three inputs; called every 3 ms, and at other times.

        ``powered``: which inputs feed their sensor, as light and rotation sensors need it.
        """

    def pressed(self, now: int) -> Sequence[Button]:
        """The buttons that have been pressed since the last call, which was a few milliseconds ago."""

    def drive(self, outputs: Sequence[Output], now: int) -> None:
        """From now on the outputs do this."""

    def hear(self, tones: Sequence[Tone], now: int) -> None:
        """The brick begins to play some tones."""


@dataclass
class Bench:
    """A brick on a table: its inputs have the values that somebody has set, and its motors turn nothing."""

    raw: list[int] = field(default_factory=lambda: [OPEN] * INPUTS)
    buttons: list[Button] = field(default_factory=list)

    def sense(self, powered: Sequence[bool], now: int) -> Sequence[int]:
        return self.raw

    def pressed(self, now: int) -> Sequence[Button]:
        if not self.buttons:
            return ()
        buttons, self.buttons = self.buttons, []
        return buttons

    def drive(self, outputs: Sequence[Output], now: int) -> None:
        """Nothing moves."""

    def hear(self, tones: Sequence[Tone], now: int) -> None:
        """Nobody listens."""
