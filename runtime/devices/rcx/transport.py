"""What the link needs of the machine it runs on, and serial ports as pySerial has them.

All times in this package are *simulated* seconds: a clock with speed 10 lets ten of them pass in one real second, so
that a simulated brick that runs ten times faster than a real one sees a host that does the same.
"""

from __future__ import annotations

import contextlib
import errno
import io
import logging
import os
import select
import stat
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from golc.runtime.devices.rcx.errors import (
    LinkError,
    NotATowerError,
    PortBusyError,
    PortFailedError,
    PortForbiddenError,
    PortGoneError,
    PortMissingError,
)
from golc.runtime.devices.rcx.packets import BAUD

if TYPE_CHECKING:
    import serial

logger = logging.getLogger(__name__)

WRITE_SECONDS = 5.0
"""Real seconds after which a port that takes no bytes counts as gone."""
CHUNK = 4096
"""Bytes after which a read returns even if there are more."""
PTY_MAJORS = range(136, 144)
"""Device numbers of pseudo terminals on Linux."""
TICK_SECONDS = 0.01
"""Real seconds between two looks at a port on which one cannot wait (rfc2217, Windows)."""


class Transport(Protocol):
    """A line of bytes and the clock that belongs to it."""

    name: str

    def open(self) -> None:
        """Open the line; LinkError with help if that cannot be done."""

    def close(self) -> None:
        """Close the line; does nothing if it is closed."""

    def read(self, deadline: float) -> bytes:
        """Wait for bytes until ``now()`` reaches the deadline; empty if none came. PortGoneError."""

    def write(self, data: bytes) -> None:
        """Hand all bytes over for sending. PortGoneError."""

    def now(self) -> float:
        """Simulated seconds since some fixed moment."""


@dataclass(frozen=True, slots=True)
class Clock:
    """The monotonic clock of the system, ``speed`` times faster."""

    speed: float = 1.0

    def now(self) -> float:
        """Simulated seconds."""
        return time.monotonic() * self.speed

    def real_seconds_until(self, deadline: float) -> float:
        """Real seconds until ``now()`` reaches the deadline, not negative."""
        return max(0.0, (deadline - self.now()) / self.speed)


class SerialPort:
    """A tty, a pty, or whatever pySerial opens by URL (``socket://``, ``spy://``, ``rfc2217://``), at 2400 8O1."""

    def __init__(self, name: str, clock: Clock) -> None:
        self.name = name
        self._clock = clock
        self._port: serial.Serial | None = None

    def now(self) -> float:
        """Simulated seconds of the clock."""
        return self._clock.now()

    def open(self) -> None:
        """Open the port for this program alone; LinkError with help if that cannot be done."""
        import serial

        if "://" not in self.name:
            check_device(self.name)
        try:
            port = serial.serial_for_url(
                self.name,
                baudrate=BAUD,
                bytesize=serial.EIGHTBITS,
                parity=serial.PARITY_NONE if is_pty(self.name) else serial.PARITY_ODD,
                stopbits=serial.STOPBITS_ONE,
                exclusive=True,
                timeout=TICK_SECONDS,
                # pySerial's RFC 2217 has no time-out for writing.
                write_timeout=None if "rfc2217://" in self.name else WRITE_SECONDS,
            )
        except Exception as error:  # whatever the system (termios.error) or an URL's handler finds
            raise opening_error(self.name, error) from error
        _make_ready(port)
        self._port = port

    def close(self) -> None:
        """Close the port; one that has gone away is closed too."""
        port, self._port = self._port, None
        if port is not None:
            with contextlib.suppress(OSError):
                port.close()

    def read(self, deadline: float) -> bytes:
        """What has arrived, after waiting for it until the deadline at most."""
        port = self._opened()
        try:
            while True:
                left = self._clock.real_seconds_until(deadline)
                if data := _read_some(port, left):
                    return data
                if left <= 0.0:
                    return b""
        except (OSError, TypeError) as error:  # TypeError: pySerial, when the port was closed by another thread
            raise gone_error(self.name, error) from error

    def write(self, data: bytes) -> None:
        """Hand the bytes to the port, which sends them at its own pace."""
        port = self._opened()
        try:
            port.write(data)
        except (OSError, TypeError) as error:
            raise gone_error(self.name, error) from error

    def _opened(self) -> serial.Serial:
        if self._port is None:
            raise PortGoneError(f"the port {self.name} is not open")
        return self._port


def _make_ready(port: serial.Serial) -> None:
    """Power for the tower and no waiting in the driver; a pty or a socket has neither line nor setting."""
    # A serial tower takes its power from RTS.
    with contextlib.suppress(OSError, ValueError, AttributeError, NotImplementedError):
        port.rts = True
    with contextlib.suppress(OSError, ValueError, AttributeError, NotImplementedError):
        port.set_low_latency_mode(True)


def _read_some(port: serial.Serial, seconds: float) -> bytes:
    """Bytes that came within ``seconds`` (real), or fewer seconds where one cannot wait on the port itself."""
    try:
        waitable = port.fileno()
    except (AttributeError, io.UnsupportedOperation):
        waitable = None
    if waitable is not None and not select.select([waitable], [], [], seconds)[0]:
        return b""
    data = bytes(port.read(max(1, port.in_waiting)))
    # A socket does not tell how many bytes wait. What came before an error counts; the error will come again.
    with contextlib.suppress(OSError):
        while data and len(data) < CHUNK and port.in_waiting:
            data += port.read(port.in_waiting)
    return data


def check_device(name: str) -> None:
    """Refuse what is there but is no device, before anything is written to it."""
    if not name:
        raise PortMissingError("the name of the port is empty", "name the device of the tower, such as /dev/ttyS0")
    try:
        mode = Path(name).stat().st_mode
    except OSError as error:
        # On systems where ports have no path (COM1), the driver decides.
        if os.name == "posix":
            raise opening_error(name, error) from error
        return
    except ValueError as error:
        raise opening_error(name, error) from error
    if os.name == "posix" and not stat.S_ISCHR(mode):
        kind = "a directory" if stat.S_ISDIR(mode) else "a regular file" if stat.S_ISREG(mode) else "no serial device"
        raise NotATowerError(
            f"the port {name} is {kind}", "name the device of the tower, such as /dev/ttyS0 or /dev/ttyUSB0"
        )


def is_pty(name: str) -> bool:
    """Whether the port is a pseudo terminal, which has no parity: asked for it a second time, it refuses."""
    path = name.partition("?")[0].removeprefix("spy://")
    try:
        return os.name == "posix" and os.major(Path(path).stat().st_rdev) in PTY_MAJORS
    except (OSError, ValueError):
        return False


_FORBIDDEN = (
    PortForbiddenError,
    "may not be opened by this user",
    "join the group of the port (`sudo adduser $USER dialout`) and log in again",
)
_BUSY = (PortBusyError, "is in use", "another program holds it: end that one first (`fuser -v PORT`)")
_NOTHING_BEHIND = (PortMissingError, "has no device behind it", "is the tower plugged in?")
# What the system says when a port cannot be opened: the class of the error, what happened, what to do.
_REASONS: dict[int, tuple[type[LinkError], str, str]] = {
    errno.ENOENT: (
        PortMissingError,
        "does not exist",
        "is the tower plugged in? `ls /dev/tty*` shows the serial ports of this machine",
    ),
    errno.ENODEV: _NOTHING_BEHIND,
    errno.ENXIO: _NOTHING_BEHIND,
    errno.EIO: (PortMissingError, "has nothing at its far end", "start the simulated brick, or plug in the tower"),
    errno.ECONNREFUSED: (
        PortMissingError,
        "cannot be reached: nobody listens there",
        "start the simulated brick: `golc sim FILE --tcp HOST:NUMBER`",
    ),
    errno.EACCES: _FORBIDDEN,
    errno.EPERM: _FORBIDDEN,
    errno.EAGAIN: _BUSY,
    errno.EBUSY: _BUSY,
    errno.ENOTTY: (
        NotATowerError,
        "is not a serial port",
        "a USB tower is named with `usb:` in front, as in usb:/dev/usb/legousbtower0",
    ),
}


def opening_error(name: str, error: Exception) -> LinkError:
    """The error that says why a port could not be opened, and what to do."""
    # pySerial wraps some errors without their number, and some not at all.
    numbers = [error.errno] if isinstance(error, OSError) else []
    numbers += [number for cause in (error, error.__context__) if cause is not None for number in cause.args[:1]]
    number = next((number for number in numbers if isinstance(number, int) and number in _REASONS), None)
    if number is not None:
        kind, what, help = _REASONS[number]
        return kind(f"the port {name} {what}", help.replace("PORT", name))
    return PortFailedError(f"the port {name} cannot be opened: {error}", _advice(name))


def gone_error(name: str, error: Exception | None = None) -> PortGoneError:
    """The error for a port that was open and is no longer there."""
    if error is not None:
        logger.debug("%s: %s", name, error)
    return PortGoneError(f"the port {name} has gone away", "was the tower unplugged, or the simulated brick ended?")


def _advice(name: str) -> str:
    if "://" in name:
        return "URLs are those of pySerial, such as socket://localhost:7000"
    return "is this the device of a tower?"
