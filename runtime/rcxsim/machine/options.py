"""What the firmware is like: what is known of each version, and a named option for everything that is not known."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from golc.bytecode.image import RCX, RCX2


class Firmware(Enum):
    """A version of the firmware.

    Its first digit, the target of its images, its number as programs and as hosts read it, microseconds an op code,
    variables of a task's own.

    2.0 ms an op code were measured on a brick with firmware 1.0; 2.6 to 2.9 ms, and 3.2 ms, are reported of 2.0.
    """

    V1 = (1, RCX, 309, (3, 9), 2000, 0)
    V2 = (2, RCX2, 332, (3, 0x0302), 2800, 16)

    def __init__(
        self, major: int, target: int, version: int, words: tuple[int, int], op_time: int, own_variables: int
    ) -> None:
        self.major = major
        self.target = target
        self.version = version
        self.words = words
        self.op_time = op_time
        self.own_variables = own_variables


FIRMWARES = {firmware.target: firmware for firmware in Firmware}


class WhileSending(Enum):
    """What becomes of a message that is to be sent while another one is in the air."""

    DROP = "drop"
    REPLACE = "replace"
    """It is sent next, in the place of one that waits already."""
    QUEUE = "queue"


@dataclass(frozen=True)
class Options:
    """Times are in microseconds. What is called unknown was not measured on a brick: the default is a choice."""

    op_time: int | None = None
    """Of a usual op code; None: that of the firmware."""
    look: int = 3_000
    """From one look at sensors and buttons to the next; 3 ms are reported."""
    reply_delay: int = 10_000
    """From a request to its answer; unknown."""
    memory: int = 6000
    """Bytes for programs and datalog; about 6 KB are reported."""
    battery: int = 8700
    """Millivolts of six cells, neither new nor empty."""
    power_down: int = 15
    """Minutes of nothing to do after which the brick switches itself off, if no program sets another number."""
    seed: int = 0
    """Of the random source."""
    while_sending: WhileSending = WhileSending.DROP
    """What becomes of a message that is to be sent while another is in the air; unknown."""
    waits_end_on_ticks: bool = False
    """Whether a wait ends with a tick of the 10 ms clock, or so long after it began; the latter is nearer to what was
    measured."""
    timers_tick_together: bool = False
    """Whether all timers count at the same moments, or each so long after it was cleared; unknown."""
    start_clears_variables: bool = False
    """Whether variables are 0 when a program starts; unknown."""
    run_stops_motors: bool = True
    """Whether motors go off when the Run button stops a program; unknown."""
    select_starts: bool = False
    """Whether a program that selects another slot starts what is there; unknown."""
    repeats_by_op_code: bool = False
    """Whether a request is taken for the one before, sent again, if only its op code with the toggle bit is the same;
    unknown."""
    light: tuple[int, int] = (146, 7)
    """a and b in the light value a - raw/b per cent; widely used, not measured."""
    sounds: int = 10
    """How many sounds wait to be played; unknown."""
    fast_change: int = 50
    """Difference of raw values from one look to the next that is a fast change; unknown."""

    def __post_init__(self) -> None:
        if self.op_time == 0 or self.look == 0 or self.light[1] == 0:
            raise ValueError("op_time, look and the divisor of light are at least 1")
