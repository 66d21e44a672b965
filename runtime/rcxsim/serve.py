"""Runs a simulated line in real time behind a port, until it is told to stop."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import time
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from types import FrameType

from golc.runtime.rcxsim.line import Line
from golc.runtime.rcxsim.ports import Port

STOPPING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


TURN = 0.05
"""Seconds of computing after which it looks again whether anybody wants something, about."""
HEAVY = 0.01
"""Seconds of computing that say how much there is to compute; less is mere overhead."""


def serve(line: Line, port: Port, stops: Collection[int], speed: float, rest: float = 0.0) -> None:
    """Carry bytes between port and line until one of the descriptors in ``stops`` is readable or at its end.

    ``speed``: how many of the line's seconds pass in one. ``rest``, for a line on which something happens all the time:
    for how many seconds it sleeps at least if nobody sends anything; fewer seconds pass then if computing them takes
    too long.
    """
    pace = _Pace(time.monotonic(), TURN if rest else float("inf"))
    while True:
        due = line.due()
        left = None if due is None else max(rest, due / speed - pace.wanted(time.monotonic()))
        watched = port.watched()
        ready = select.select([*stops, *watched], [], [], left)[0]
        if any(descriptor in stops for descriptor in ready):
            return
        data = b"".join(port.read(descriptor) for descriptor in watched if descriptor in ready)
        before = time.thread_time()
        received = line.host_sent(data, pace.go(time.monotonic()) * speed)
        pace.took(time.thread_time() - before)
        if received:
            port.write(received)


@dataclass
class _Pace:
    """The seconds that have passed for the line, at speed 1, ``most`` of them at a time.

    Without a limit, what took long to compute would leave more to compute next, and nobody would be heard meanwhile.
    """

    start: float
    most: float
    reached: float = 0.0
    _before: float = 0.0

    def wanted(self, now: float) -> float:
        """How far it should be."""
        return now - self.start

    def go(self, now: float) -> float:
        """How far to go now."""
        self.start += max(0.0, self.wanted(now) - self.reached - self.most)
        self._before, self.reached = self.reached, self.wanted(now)
        return self.reached

    def took(self, seconds: float) -> None:
        """How long the last going was to compute."""
        if seconds > HEAVY:
            self.most = (self.reached - self._before) * TURN / seconds
        else:
            self.most *= 2


@contextlib.contextmanager
def stopped_by_signals() -> Iterator[int]:
    """A descriptor that becomes readable when the process is asked to end: Ctrl-C, ``kill``, a closed terminal."""
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    before_wakeup = signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    before = {number: signal.signal(number, _ignore) for number in STOPPING}
    try:
        yield reader
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(before_wakeup)
        os.close(reader)
        os.close(writer)


def _ignore(number: int, frame: FrameType | None) -> None:
    """The wake-up descriptor says it all."""
