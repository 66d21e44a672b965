"""Somebody at the keyboard beside a simulated robot, who presses its buttons, lifts it and puts it somewhere."""

from __future__ import annotations

import os
from collections.abc import Callable

from golc.runtime.rcxsim.ports import Port
from golc.runtime.sources.exogenous import Splitter


class AttendedPort:
    """A port beside which lines of text are read from another descriptor, until that ends.

    A terminal is only read while this process is in its foreground: otherwise the terminal would stop the process, and
    the lines are for somebody else.
    """

    def __init__(self, port: Port, descriptor: int, take: Callable[[str], None]) -> None:
        self.description = port.description
        self._port = port
        self._descriptor = descriptor
        self._take = take
        self._splitter = Splitter()
        self._open = True

    def watched(self) -> list[int]:
        return [*self._port.watched(), *([self._descriptor] if self._open and self._is_ours() else [])]

    def read(self, descriptor: int) -> bytes:
        if descriptor != self._descriptor:
            return self._port.read(descriptor)
        try:
            data = os.read(descriptor, 4096)
        except OSError:
            data = b""
        self._open = bool(data)
        for line in self._splitter.feed(data) if data else self._splitter.end():
            if text := line.decode("utf-8", "replace").strip():
                self._take(text)
        return b""

    def write(self, data: bytes) -> None:
        self._port.write(data)

    def close(self) -> None:
        self._port.close()

    def _is_ours(self) -> bool:
        try:
            return not os.isatty(self._descriptor) or os.tcgetpgrp(self._descriptor) == os.getpgrp()
        except OSError:  # a terminal that does not control this process cannot stop it
            return True
