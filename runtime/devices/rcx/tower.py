"""The infra-red tower: user messages out and in, over any transport, whatever the tower does to the bytes.

A serial tower hears its own light, so everything that the host sends comes back first; a USB tower, a pty or a socket
may not do that. A tower falls asleep about four seconds after it last sent. After a reply the brick needs some silence
before it listens again.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from types import TracebackType
from typing import Self

from golc.runtime.devices.rcx.interruptible import Interruptible
from golc.runtime.devices.rcx.packets import BYTE_SECONDS, MESSAGE, MESSAGE_SECONDS, Decoder, encode_message
from golc.runtime.devices.rcx.timing import Patience
from golc.runtime.devices.rcx.transport import Clock, SerialPort, Transport

logger = logging.getLogger(__name__)

USB = "usb:"
"""In front of a path: a character device without serial settings."""

QUIET_SECONDS = 0.035
"""Silence after a reply: a brick that is addressed earlier misses the first bytes (a defect in its ROM)."""
AWAKE_SECONDS = 4.0
"""A tower hears nothing when it has not sent for so long."""
WAKE = b"\xff"
"""Sent to a sleeping tower: it is no part of a frame, so a brick that hears it does nothing."""
WAKE_SECONDS = BYTE_SECONDS + 0.045
"""From the byte that wakes the tower to the frame; a brick gives up an unfinished frame after 30 ms of silence."""
ECHO_SLACK = 4
"""Bytes of noise (and the wake byte) that may stand before an echo."""

NO_ECHO = 3
"""Echoes in a row that were missed, after which a tower counts as one that does not echo."""


@dataclass
class TowerStatistics:
    """What went through a tower."""

    sent: int = 0
    """User messages sent."""
    heard: int = 0
    """User messages received, echoes not counted."""
    echoes: int = 0
    """Times that what was sent came back as an echo."""
    wakes: int = 0
    """Times that the tower had to be woken."""
    noise: int = 0
    """Bytes received that belong to no frame and to no echo."""


class Tower:
    """User messages over a transport; used by one exchange at a time."""

    def __init__(self, transport: Transport, patience: Patience | None = None) -> None:
        """``patience`` is for a line that may be behind the clock of the transport."""
        self.statistics = TowerStatistics()
        self._patience = patience
        self._transport = transport
        self._decoder = Decoder()
        self._inbox: deque[int] = deque()
        self._held = b""  # received after the last send, and possibly the beginning of its echo
        self._expected = b""  # the echo that has not come yet
        self._echoes_missed = 0
        self._sending_until = float("-inf")
        self._heard_at = float("-inf")

    @property
    def name(self) -> str:
        """The port as the user named it."""
        return self._transport.name

    def open(self) -> None:
        """Open the port; LinkError with help if that cannot be done."""
        self._transport.open()

    def close(self) -> None:
        """Close the port; does nothing if it is closed."""
        self._transport.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def now(self) -> float:
        """Simulated seconds."""
        return self._transport.now()

    @property
    def least_wait(self) -> float:
        """Simulated seconds in which an answer may come, if it need not come sooner."""
        return 0.0 if self._patience is None else self._patience.answer

    def send(self, number: int) -> float:
        """Send a user message; the simulated time at which its last bit is out. PortGoneError.

        Waits for the silence that the brick needs after a reply, and for the end of a message that is still on the
        air; wakes the tower if it sleeps.
        """
        self._listen(max(self._heard_at + QUIET_SECONDS, self._sending_until))
        if self.now() - self._sending_until > AWAKE_SECONDS:
            self._wake()
        self._write(encode_message(number))
        self._sending_until = self.now() + MESSAGE_SECONDS
        if self._patience is not None and self._expected:
            self._await_echo(self._patience)
        self.statistics.sent += 1
        logger.debug("%s: -> %d", self.name, number)
        return self._sending_until

    def receive(self, deadline: float) -> int | None:
        """The next user message that arrives until the deadline (simulated), or None. PortGoneError."""
        while not self._inbox:
            data = self._transport.read(deadline)
            self._take(data)
            # The clock is asked as well: a line that is never silent must not keep the caller for ever.
            if not self._inbox and (not data or self.now() >= deadline):
                return None
        number = self._inbox.popleft()
        logger.debug("%s: <- %d", self.name, number)
        return number

    def _listen(self, until: float) -> None:
        """Take in whatever arrives until then; what is there already in any case."""
        while data := self._transport.read(until):
            self._take(data)
            if self.now() >= until:
                return

    def _await_echo(self, patience: Patience) -> None:
        """See a message go out: no answer to it can come before."""
        until = self.now() + patience.echo(known=self.statistics.echoes > 0)
        while self._expected and (data := self._transport.read(until)):
            self._take(data)
        if self._expected:
            self._settle_echo()
            self._echoes_missed += 1
        else:
            patience.note(self.now() - self._sending_until)
            self._sending_until = max(self._sending_until, self.now())

    def _wake(self) -> None:
        self.statistics.wakes += 1
        self._write(WAKE)
        self._listen(self.now() + WAKE_SECONDS)

    def _write(self, data: bytes) -> None:
        self._settle_echo()
        # Without echoes, a reply may well be the same message: both sides say "continue".
        self._expected = data if self._echoes_missed < NO_ECHO else b""
        self._transport.write(data)

    def _take(self, data: bytes) -> None:
        """Sort received bytes into the echo of what was just sent and what came from elsewhere.

        The echo is what stands at its place, right after the sending, and equals the sent bytes; a message that equals
        them later on is a message. An echo that was garbled on the way is noise and needs no care.
        """
        self._held += data
        size = len(self._expected)
        if size and (start := self._held.find(self._expected, 0, size + ECHO_SLACK)) >= 0:
            self.statistics.echoes += 1
            self._echoes_missed = 0
            self._held = self._held[:start] + self._held[start + size :]
            self._expected = b""
        elif size and self._echo_may_come():
            return
        self._settle_echo()

    def _echo_may_come(self) -> bool:
        """Whether the held bytes are the beginning of the echo, after a few bytes of noise at most."""
        return any(self._expected.startswith(self._held[start:]) for start in range(ECHO_SLACK + 1))

    def _settle_echo(self) -> None:
        """Wait for no echo any longer: what is held goes to the decoder."""
        held, self._held = self._held, b""
        for packet in self._decoder.feed(held):
            if packet.opcode == MESSAGE and packet.parameters != b"\0":
                self._inbox.append(packet.parameters[0])
                self.statistics.heard += 1
                self._heard_at = self.now()
                self._echoes_missed += bool(self._expected)
                self._expected = b""
        self._expected = b""
        self.statistics.noise = self._decoder.noise


def open_tower(port: str | Transport, speed: float = 1.0, interrupted: Callable[[], bool] | None = None) -> Tower:
    """An open tower on a port: a tty, a pty's path, a pySerial URL, or ``usb:`` and the path of a character device.

    Any other transport, which has a clock of its own, will do as well. ``speed`` is the number of simulated seconds in
    a real one; an exchange is given up when ``interrupted`` says so.
    Raises a LinkError with help if the port cannot be opened: missing, not permitted, busy, not a tty.
    """
    clock = Clock(speed)
    transport: Transport
    if not isinstance(port, str):
        transport = port
    elif port.startswith(USB):
        # Only this kind needs what Windows does not have.
        from golc.runtime.devices.rcx.chardev import CharacterDevice

        transport = CharacterDevice(port.removeprefix(USB), clock)
    else:
        transport = SerialPort(port, clock)
    patience = Patience(speed) if isinstance(port, str) and speed > 1 else None
    tower = Tower(transport if interrupted is None else Interruptible(transport, interrupted), patience)
    tower.open()
    return tower
