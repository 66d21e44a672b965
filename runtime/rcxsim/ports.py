"""Where the simulated tower is plugged in: a pseudo terminal, or a TCP port. Clients come and go."""

from __future__ import annotations

import contextlib
import os
import socket
import tty
from pathlib import Path
from typing import Protocol

from golc.diagnostics import DeviceError


class Port(Protocol):
    """One end of a cable: bytes come from whoever holds the other end, if anybody does."""

    description: str
    """``pty PATH`` or ``tcp HOST:PORT``: what a person or a program needs to reach it."""

    def watched(self) -> list[int]:
        """The file descriptors that become readable when there is something to do, in the order to read them."""

    def read(self, descriptor: int) -> bytes:
        """The bytes that have come, perhaps none."""

    def write(self, data: bytes) -> None:
        """Send bytes; what nobody takes is lost, as on a serial line."""

    def close(self) -> None:
        """Give everything back."""


class PtyPort:
    """A pseudo terminal; ``link`` is a symbolic link that is made to it and removed at the end.

    The slave is held open, so that the master outlives its clients, and is raw: no byte means anything to the terminal.
    """

    def __init__(self, link: Path | None = None) -> None:
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        os.set_blocking(self._master, False)
        self._target = os.ttyname(self._slave)
        self._link = link
        if link is not None:
            try:
                _make_link(link, self._target)
            except OSError as error:
                os.close(self._master)
                os.close(self._slave)
                raise DeviceError(
                    f"cannot make the link {link} to the pseudo terminal: {error.strerror}",
                    help="choose a path in a directory that you may write to, at which nothing is",
                ) from None
        self.description = f"pty {link or self._target}"

    def watched(self) -> list[int]:
        return [self._master]

    def read(self, descriptor: int) -> bytes:
        with contextlib.suppress(BlockingIOError):
            return os.read(descriptor, 4096)
        return b""

    def write(self, data: bytes) -> None:
        with contextlib.suppress(BlockingIOError):  # nobody has read for a long time
            os.write(self._master, data)

    def close(self) -> None:
        if self._link is not None and self._link.is_symlink() and str(self._link.readlink()) == self._target:
            self._link.unlink()
        os.close(self._master)
        os.close(self._slave)


def _make_link(link: Path, target: str) -> None:
    """Make a symbolic link; one that a killed process left behind is replaced.

    It leads nowhere, or to the new terminal itself: the system gives out the same names again.
    """
    if link.is_symlink() and (not link.exists() or str(link.readlink()) == target):
        link.unlink()
    link.symlink_to(target)


class TcpPort:
    """A TCP port for one client at a time: a second one is turned away, as a serial port does."""

    def __init__(self, host: str, port: int) -> None:
        try:
            self._listener = socket.create_server((host, port), family=_family(host))
        except (OSError, OverflowError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise DeviceError(
                f"cannot listen on {host}:{port}: {reason}",
                help="choose another port, or 0 for any that is free",
            ) from None
        self._listener.setblocking(False)
        self._client: socket.socket | None = None
        shown = f"[{host}]" if ":" in host else host
        self.description = f"tcp {shown}:{self._listener.getsockname()[1]}"

    def watched(self) -> list[int]:
        # The client first: one that has hung up must not keep out one that calls at the same time.
        return ([] if self._client is None else [self._client.fileno()]) + [self._listener.fileno()]

    def read(self, descriptor: int) -> bytes:
        if descriptor == self._listener.fileno():
            self._accept()
            return b""
        assert self._client is not None
        try:
            data = self._client.recv(4096)
        except BlockingIOError:
            return b""
        except OSError:
            data = b""
        if not data:
            self._hang_up()
        return data

    def write(self, data: bytes) -> None:
        if self._client is not None:
            try:
                self._client.send(data)
            except BlockingIOError:
                return
            except OSError:
                self._hang_up()

    def close(self) -> None:
        self._hang_up()
        self._listener.close()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            client, _ = self._listener.accept()
            if self._client is not None:
                client.close()
                return
            client.setblocking(False)
            client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._client = client

    def _hang_up(self) -> None:
        if self._client is not None:
            self._client.close()
            self._client = None


def _family(host: str) -> socket.AddressFamily:
    return socket.AF_INET6 if ":" in host else socket.AF_INET
