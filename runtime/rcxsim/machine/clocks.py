"""Timers and the watch: clocks that are read, cleared and set, and need nothing done while they run."""

from __future__ import annotations

TENTH, HUNDREDTH, MINUTE = 100_000, 10_000, 60_000_000
"""Microseconds of a timer's tick, of a fast one's, of the watch's."""
TIMER_WRAPS, WATCH_WRAPS = 0x8000, 24 * 60
"""The number that a timer, and the watch, never reach."""


class Timer:
    """Counts ticks since it was cleared; ``together``: at the same moments as every other timer."""

    def __init__(self, together: bool) -> None:
        self._together = together
        self._start = 0

    def read(self, now: int, tick: int) -> int:
        if self._together:
            return (now // tick - self._start // tick) % TIMER_WRAPS
        return (now - self._start) // tick % TIMER_WRAPS

    def set(self, value: int, now: int, tick: int) -> None:
        self._start = now - (value % TIMER_WRAPS) * tick


class Watch:
    """The time of day in minutes; 0 when the brick is made."""

    def __init__(self) -> None:
        self._start = 0

    def read(self, now: int) -> int:
        return (now - self._start) // MINUTE % WATCH_WRAPS

    def set(self, minutes: int, now: int) -> None:
        self._start = now - minutes * MINUTE
