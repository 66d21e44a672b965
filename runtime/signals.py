"""Signals that end a run in an orderly way."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import FrameType
from typing import Any, TypeAlias

ENDING = ("SIGINT", "SIGTERM", "SIGHUP")
"""Ctrl-C, a request to end, and a terminal that was closed."""


Handler: TypeAlias = Callable[[int, FrameType | None], Any] | int


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

    handlers = {number: handler for number, handler in _handlers(ENDING).items() if handler is not signal.SIG_IGN}
    # Reading a terminal from the background would stop the process with the robot moving; so it is an error instead.
    with _replaced(handlers, handle), _replaced(_handlers(("SIGTTIN",)), signal.SIG_IGN):
        yield


@contextlib.contextmanager
def undisturbed() -> Iterator[None]:
    """Within the block the signals do nothing: what is to be done at the end of a run is short, and is done to its end.

    Does nothing in any other thread than the main one.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    with _replaced(_handlers(ENDING), signal.SIG_IGN):
        yield


@contextlib.contextmanager
def _replaced(before: Mapping[signal.Signals, Handler], handler: Handler) -> Iterator[None]:
    """Within the block a signal goes to another handler than before."""
    for number in before:
        signal.signal(number, handler)
    try:
        yield
    finally:
        for number, original in before.items():
            signal.signal(number, original)


def _handlers(names: Iterable[str]) -> dict[signal.Signals, Handler]:
    """The handlers of some signals, as far as the system has them and Python knows who handles them."""
    numbers = [number for name in names if (number := getattr(signal, name, None)) is not None]
    return {number: handler for number in numbers if (handler := signal.getsignal(number)) is not None}
