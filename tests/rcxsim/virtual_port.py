"""A port to a simulated line in virtual time."""

from __future__ import annotations

from golc.runtime.rcxsim.line import Line


class VirtualPort:
    """A transport whose other end is a simulated line; waiting for bytes is what makes time pass."""

    name = "virtual"

    def __init__(self, line: Line) -> None:
        self._line = line
        self._now = 0.0
        self._arrived = b""

    def open(self) -> None:
        """There is nothing to open."""

    def close(self) -> None:
        """There is nothing to close."""

    def now(self) -> float:
        return self._now

    def write(self, data: bytes) -> None:
        self._arrived += self._line.host_sent(data, self._now)

    def read(self, deadline: float) -> bytes:
        while not self._arrived and self._now < deadline:
            due = self._line.due()
            self._now = deadline if due is None else min(deadline, max(due, self._now))
            self._arrived += self._line.advance(self._now)
        data, self._arrived = self._arrived, b""
        return data
