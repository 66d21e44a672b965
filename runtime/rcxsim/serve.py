"""Runs a simulated line in real time behind a port, until it is told to stop."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import time
from collections.abc import Collection, Iterator
from types import FrameType

from golc.runtime.rcxsim.line import Line
from golc.runtime.rcxsim.ports import Port

STOPPING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


SLACK = 0.05
"""Real seconds by which computing what has happened may take longer than it took to happen."""


def serve(line: Line, port: Port, stops: Collection[int], speed: float, rest: float = 0.0) -> None:
    """Carry bytes between port and line until one of the descriptors in ``stops`` is readable or at its end.

    ``speed``: how many of the line's seconds pass in one; fewer if the machine that this runs on cannot keep up.
    ``rest``: for how many real seconds it sleeps at least if nobody sends anything.
    """
    start = before = time.monotonic()
    while True:
        due = line.due()
        left = None if due is None else max(rest, due / speed - (time.monotonic() - start))
        watched = port.watched()
        ready = select.select([*stops, *watched], [], [], left)[0]
        if any(descriptor in stops for descriptor in ready):
            return
        data = b"".join(port.read(descriptor) for descriptor in watched if descriptor in ready)
        now = time.monotonic()
        received = line.host_sent(data, (now - start) * speed)
        late = (time.monotonic() - now) - (now - before) - SLACK
        if late > 0:
            start += late  # without this it would have ever more to catch up with, and hear nobody meanwhile
        before = now
        if received:
            port.write(received)


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
