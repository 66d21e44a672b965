"""A simulated line in the process of its host, which is its transport: both have one clock.

Between two processes a busy computer lets the time of one run on while the other waits its turn, and a host that is
fifty times as fast as a real one takes a few milliseconds of that for silence. Here time passes for the brick before
the host looks at the clock: whatever arrives in time has arrived.
"""

from __future__ import annotations

import threading
import time

from golc.runtime.rcxsim.line import Line

QUANTUM = 0.02
"""Simulated seconds between two looks at whether something has arrived, ..."""
LEAST_SLEEP = 0.001
"""... and real seconds at least."""


class InProcess:
    """The host's end of a simulated line; ``speed`` simulated seconds pass in one, fewer if that cannot be kept up.

    It is a ``Transport`` of the link. Any thread may use it, one at a time; what it has to simulate it does in theirs.
    """

    def __init__(self, line: Line, speed: float, name: str) -> None:
        self.name = name
        self._line = line
        self._speed = speed
        self.lock = threading.RLock()
        self._start = time.monotonic()
        self._now = 0.0
        self._received = bytearray()

    def open(self) -> None:
        """It always is."""

    def close(self) -> None:
        """Nothing is to be given back."""

    def now(self) -> float:
        """Simulated seconds since the beginning; the brick has done everything until then."""
        with self.lock:
            began = time.monotonic()
            goal = (began - self._start) * self._speed
            if goal > self._now:
                passed, self._now = goal - self._now, goal
                self._received += self._line.advance(goal)
                self._start += max(0.0, time.monotonic() - began - passed / self._speed)
            return self._now

    def write(self, data: bytes) -> None:
        """The host sends bytes now."""
        with self.lock:
            self._received += self._line.host_sent(data, self.now())

    def read(self, deadline: float) -> bytes:
        """What has arrived, after waiting for it until the deadline at most."""
        while True:
            with self.lock:
                now = self.now()
                if self._received or now >= deadline:
                    received, self._received = bytes(self._received), bytearray()
                    return received
            time.sleep(max(LEAST_SLEEP, min(QUANTUM, deadline - now) / self._speed))
