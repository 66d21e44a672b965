"""A transport that another thread can end a wait on."""

from __future__ import annotations

from collections.abc import Callable

from golc.runtime.devices.rcx.errors import InterruptedLinkError
from golc.runtime.devices.rcx.transport import Transport

SLICE_SECONDS = 0.1
"""Simulated seconds between two looks at whether to give up."""


class Interruptible:
    """Passes everything on to a transport; a read fails while ``interrupted`` says so.

    Raises InterruptedLinkError instead of PortGoneError in that case: the line is whole, and the exchange is given up.
    """

    def __init__(self, transport: Transport, interrupted: Callable[[], bool]) -> None:
        self.name = transport.name
        self._transport = transport
        self._interrupted = interrupted

    def open(self) -> None:
        self._transport.open()

    def close(self) -> None:
        self._transport.close()

    def now(self) -> float:
        return self._transport.now()

    def write(self, data: bytes) -> None:
        self._transport.write(data)

    def read(self, deadline: float) -> bytes:
        """Wait for bytes as the transport does, in slices."""
        while True:
            if self._interrupted():
                raise InterruptedLinkError("the exchange with the brick was given up")
            data = self._transport.read(min(deadline, self.now() + SLICE_SECONDS))
            if data or self.now() >= deadline:
                return data
