"""What a row of the table is."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum


class Unit(Enum):
    """What a row measures, and which way is better."""

    SECONDS = "s"
    RATE = "/s"
    FACTOR = "×"
    BYTES = "bytes"
    OP_CODES = "op codes"
    SIMULATED = "simulated s"

    def scaled(self, value: float, slower: float) -> float:
        """What it would be on the machine of the aims, given how many times slower this one is."""
        match self:
            case Unit.SECONDS:
                return value / slower
            case Unit.RATE:
                return value * slower
            case _:
                return value

    def ratio(self, value: float, aim: float) -> float:
        """How many times better than the aim."""
        return value / aim if self is Unit.RATE else aim / value

    def show(self, value: float) -> str:
        """The value with its unit, in few digits."""
        if self is Unit.RATE:
            return f"{value:,.0f} /s"
        if self is Unit.FACTOR:
            return f"{value:.2f} ×"
        if self in (Unit.BYTES, Unit.OP_CODES):
            return f"{value:,.0f} {self.value}"
        return f"{value:.3f} s" if value >= 0.01 else f"{value * 1e6:,.1f} µs"


@dataclass(frozen=True)
class Row:
    """``sample`` measures once; the first sample, in which caches are filled, does not count."""

    name: str
    work: str
    aim: float
    unit: Unit
    sample: Callable[[], float]

    def median(self, repeat: int) -> float:
        self.sample()
        return statistics.median(self.sample() for _ in range(repeat))


def seconds(work: Callable[[], object]) -> float:
    """How long some work takes."""
    started = time.perf_counter()
    work()
    return time.perf_counter() - started
