"""Packets on the infrared line as the brick sees them.

This codec shares nothing with the host's: the simulated brick is there to find the other's mistakes. A packet with n
payload bytes is ``55 ff 00``, each payload byte followed by its complement, and the sum of the payload with its
complement: as many ones as zeros, and every changed bit is noticed.
"""

from __future__ import annotations

from dataclasses import dataclass, field

HEADER = bytes((0x55, 0xFF, 0x00))
BITS_PER_BYTE = 11
"""Start bit, eight data bits, odd parity, stop bit."""
BYTE_SECONDS = BITS_PER_BYTE / 2400
"""Air time of one byte at 2400 baud: 4.58 ms."""
MESSAGE_BYTES = 9
SET_MESSAGE = 0xF7
"""Puts its one parameter into the receiver's message buffer; never answered."""
TRANSFER = 0x45
"""Carries a block of a download: the only request whose length is not in its op code."""
TOGGLE = 0x08
"""Bit of an op code that tells a new request from the same one sent again."""


def packet(payload: bytes) -> bytes:
    """The bytes on the line for a payload (an op code and its parameters)."""
    checked = (*payload, sum(payload) & 0xFF)
    return HEADER + bytes(byte for value in checked for byte in (value, value ^ 0xFF))


def message(value: int) -> bytes:
    """The packet that carries a user message, 1 to 255."""
    return packet(bytes((SET_MESSAGE, value)))


def message_in(payload: bytes) -> int | None:
    """The user message that a payload carries, if it is one."""
    return payload[1] if len(payload) == 2 and payload[0] | TOGGLE == SET_MESSAGE | TOGGLE else None


def payload_length(payload: bytes) -> int:
    """Bytes of a request whose beginning is known; an estimate that is too small while that is not enough to know it.

    The low three bits of its op code count the parameters, 6 and 7 stand for 0 and 1. A transfer says itself how many
    bytes it carries: op code, two bytes of sequence, two of length, so many, a check sum.
    """
    if payload[0] & ~TOGGLE == TRANSFER:
        return 6 + (int.from_bytes(payload[3:5], "little") if len(payload) >= 5 else 0)
    parameters = payload[0] & 7
    return 1 + (parameters - 6 if parameters > 5 else parameters)


@dataclass
class Receiver:
    """Finds packets in a stream of bytes, whatever noise, cut or damaged packets stand between them.

    After a bad pair it looks for the next header inside what it has: a packet that follows a broken one is not lost.
    """

    _pending: bytearray = field(default_factory=bytearray)

    @property
    def inside(self) -> bool:
        """Whether a packet has begun and is not complete."""
        return bool(self._pending)

    def reset(self) -> None:
        """Forget a packet that has begun: the line was quiet for too long."""
        self._pending.clear()

    def feed(self, byte: int) -> bytes | None:
        """Take the next byte; the payload of the packet that it completes, if it does."""
        self._pending.append(byte)
        while self._pending:
            match self._verdict():
                case bytes() as payload:
                    self._pending.clear()
                    return payload
                case True:
                    return None
                case False:
                    del self._pending[0]
        return None

    def _verdict(self) -> bytes | bool:
        """The payload of a complete packet; otherwise whether what is there may still become one."""
        pending = self._pending
        if not HEADER.startswith(pending[:3]):
            return False
        pairs = pending[3:]
        if any(a ^ b != 0xFF for a, b in zip(pairs[::2], pairs[1::2], strict=False)):
            return False
        if not pairs:
            return True
        length = payload_length(bytes(pairs[::2]))
        if len(pairs) < 2 * length + 2:
            return True
        payload = bytes(pairs[0 : 2 * length : 2])
        return payload if sum(payload) & 0xFF == pairs[2 * length] else False
