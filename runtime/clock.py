"""The time of a run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Clock:
    """Seconds since the start of a run, in simulated time: ``speed`` of them pass in a real second."""

    monotonic: Callable[[], float]
    start: float
    speed: float = 1.0

    def now(self) -> float:
        """Simulated seconds since the start."""
        return (self.monotonic() - self.start) * self.speed

    def until(self, moment: float) -> float:
        """How many real seconds are left until a simulated moment, at least 0."""
        return max(0.0, self.real(moment - self.now()))

    def real(self, seconds: float) -> float:
        """How long so many simulated seconds really take."""
        return seconds / self.speed
