"""Signals that end a run in an orderly way."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator
from types import FrameType

ENDING = ("SIGINT", "SIGTERM", "SIGHUP")
"""Ctrl-C, a request to end, and a terminal that was closed."""


class Interrupted(KeyboardInterrupt):
    """A signal has asked the run to end; the text names it."""


@contextlib.contextmanager
def ending_on_signals() -> Iterator[None]:
    """Within the block, the first of the signals raises ``Interrupted`` in the main thread, later ones are ignored.

    So nothing can disturb the brick being told to stop. A signal that was ignored before (``nohup``) stays ignored.
    Does nothing in any other thread, where Python gives no signals.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    caught: list[int] = []

    def handle(number: int, frame: FrameType | None) -> None:
        caught.append(number)
        if len(caught) == 1:
            raise Interrupted(f"interrupted by {signal.Signals(number).name}")

    before = {number: signal.getsignal(number) for number in map(_number, ENDING) if number is not None}
    before = {number: handler for number, handler in before.items() if handler is not signal.SIG_IGN}
    for number in before:
        signal.signal(number, handle)
    # Reading a terminal from the background would stop the process with the robot moving; so it is an error instead.
    if (reading := _number("SIGTTIN")) is not None:
        before[reading] = signal.signal(reading, signal.SIG_IGN)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _number(name: str) -> signal.Signals | None:
    """A signal, where the system has it."""
    return getattr(signal, name, None)
