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


def serve(line: Line, port: Port, stops: Collection[int], speed: float) -> None:
    """Carry bytes between port and line until one of the descriptors in ``stops`` is readable or at its end.

    ``speed``: how many of the line's seconds pass in one.
    """
    start = time.monotonic()
    while True:
        due = line.due()
        left = None if due is None else max(0.0, due / speed - (time.monotonic() - start))
        watched = port.watched()
        ready = select.select([*stops, *watched], [], [], left)[0]
        if any(descriptor in stops for descriptor in ready):
            return
        data = b"".join(port.read(descriptor) for descriptor in watched if descriptor in ready)
        received = line.host_sent(data, (time.monotonic() - start) * speed)
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
