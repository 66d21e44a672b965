"""A tower that is a character device but no tty: the LEGO USB tower under its kernel driver (``legousbtower``)."""

from __future__ import annotations

import contextlib
import fcntl
import os
import select
import time

from golc.runtime.devices.rcx.errors import PortGoneError
from golc.runtime.devices.rcx.transport import CHUNK, WRITE_SECONDS, Clock, check_device, gone_error, opening_error


class CharacterDevice:
    """A device file with bytes in both directions and nothing to configure; the driver knows rate and parity."""

    def __init__(self, path: str, clock: Clock) -> None:
        self.name = path
        self._clock = clock
        self._descriptor: int | None = None

    def now(self) -> float:
        """Simulated seconds of the clock."""
        return self._clock.now()

    def open(self) -> None:
        """Open the device for this program alone; LinkError with help if that cannot be done."""
        check_device(self.name)
        try:
            descriptor = os.open(self.name, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK | os.O_CLOEXEC)
        except OSError as error:
            raise opening_error(self.name, error) from error
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            os.close(descriptor)
            raise opening_error(self.name, error) from error
        self._descriptor = descriptor

    def close(self) -> None:
        """Close the device; does nothing if it is closed."""
        descriptor, self._descriptor = self._descriptor, None
        if descriptor is not None:
            with contextlib.suppress(OSError):
                os.close(descriptor)

    def read(self, deadline: float) -> bytes:
        """What has arrived, after waiting for it until the deadline at most."""
        descriptor = self._opened()
        while True:
            seconds = self._clock.real_seconds_until(deadline)
            if not _ready(descriptor, select.POLLIN, seconds):
                return b""
            try:
                data = os.read(descriptor, CHUNK)
            except BlockingIOError:
                continue
            except OSError as error:
                raise gone_error(self.name, error) from error
            if not data:
                raise gone_error(self.name)
            return data

    def write(self, data: bytes) -> None:
        """Hand all bytes to the driver, which may take them in pieces."""
        descriptor = self._opened()
        rest = memoryview(data)
        end = time.monotonic() + WRITE_SECONDS
        while rest:
            if not _ready(descriptor, select.POLLOUT, max(0.0, end - time.monotonic())):
                raise gone_error(self.name)
            try:
                rest = rest[os.write(descriptor, rest) :]
            except BlockingIOError:
                continue
            except OSError as error:
                raise gone_error(self.name, error) from error

    def _opened(self) -> int:
        if self._descriptor is None:
            raise PortGoneError(f"the port {self.name} is not open")
        return self._descriptor


def _ready(descriptor: int, event: int, seconds: float) -> bool:
    """Whether the device has something to say about ``event`` within real ``seconds``; trouble counts as well."""
    waiter = select.poll()
    waiter.register(descriptor, event)
    return bool(waiter.poll(seconds * 1000))
