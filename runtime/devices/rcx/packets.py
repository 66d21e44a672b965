"""Frames on the infra-red line: bytes of a user message, and the messages in a stream of bytes.

A frame is a header, then the op code, its parameters and the sum of both modulo 256, each byte followed by its
complement, so that light and dark are in balance and every garbled byte shows::

    55 ff 00   f7 08   m ~m   s ~s

(Kekoa Proudfoot, RCX Internals, packet layer; line: 2400 baud, 8 data bits, odd parity, 1 stop bit.)
"""

from __future__ import annotations

from dataclasses import dataclass, field

HEADER = bytes((0x55, 0xFF, 0x00))
MESSAGE = 0xF7

# Parameter bytes of each op code that can be heard without having been asked for. A frame is recognised as a whole or
# not at all, so every row spares its bytes from being searched for another frame.
PARAMETERS = {
    MESSAGE: 1,  # user message: the only packet of which programs on host and brick can read the content
    0xD2: 2,  # a key of the LEGO remote control, which may be used in the same room
}

BITS_PER_BYTE = 11  # start bit, 8 data bits, parity, stop bit
BAUD = 2400
BYTE_SECONDS = BITS_PER_BYTE / BAUD
MESSAGE_BYTES = 9
MESSAGE_SECONDS = MESSAGE_BYTES * BYTE_SECONDS


@dataclass(frozen=True, slots=True)
class Packet:
    """The content of a frame: an op code and its parameters."""

    opcode: int
    parameters: bytes


def encode(packet: Packet) -> bytes:
    """The bytes of a frame, header included (3 + 2n + 4 bytes for n parameters)."""
    payload = bytes((packet.opcode, *packet.parameters))
    checked = payload + bytes((sum(payload) & 0xFF,))
    return HEADER + b"".join(bytes((byte, byte ^ 0xFF)) for byte in checked)


def encode_message(number: int) -> bytes:
    """The nine bytes of the user message ``number`` (1..255; the brick takes 0 for no message)."""
    if not 1 <= number <= 255:
        raise ValueError(f"a user message is a number from 1 to 255, not {number}")
    return encode(Packet(MESSAGE, bytes((number,))))


@dataclass
class Decoder:
    """Finds the frames in a stream that arrives in pieces, with noise anywhere.

    Only the last header byte is required: a USB tower swallows the first one, and an awake tower makes bytes out of
    ambient light. After a byte that does not fit, the search goes on with the byte after the supposed header, so a
    frame that begins inside of what looked like another one is not lost.
    """

    noise: int = 0
    """Bytes so far that belong to no frame."""
    _pending: bytearray = field(default_factory=bytearray, repr=False)

    def feed(self, data: bytes) -> list[Packet]:
        """The packets that are complete with ``data``; an unfinished one waits for the next call."""
        self._pending += data
        packets: list[Packet] = []
        while (start := self._pending.find(HEADER[-1])) >= 0:
            size = frame_size(self._pending, start)
            if size is None:
                self._drop(start + 1)
                continue
            header = _header_length(self._pending[:start])
            self._drop(start - header)
            end = header + size
            if len(self._pending) < end:
                return packets
            packets.append(_packet(self._pending[header:end]))
            # The last byte is a complement and may be 00: then it can be the header of the next frame as well.
            del self._pending[: end - 1 if self._pending[end - 1] == HEADER[-1] else end]
        self._drop(len(self._pending) - _header_length(self._pending))
        return packets

    def _drop(self, count: int) -> None:
        self.noise += count
        del self._pending[:count]


def frame_size(data: bytes | bytearray, start: int) -> int | None:
    """Bytes of the frame whose header ends with the 00 at ``start``, that 00 included; None if this is no frame.

    The data may end before the frame does: then the size says what it will have if the rest fits.
    """
    if start + 1 >= len(data):
        return 2
    opcode = data[start + 1]
    if opcode not in PARAMETERS:
        return None
    checked = data[start + 1 : start + 1 + 2 * (PARAMETERS[opcode] + 2)]
    values, complements = checked[0::2], checked[1::2]
    if any(value ^ 0xFF != complement for value, complement in zip(values, complements, strict=False)):
        return None
    payload = values[: PARAMETERS[opcode] + 1]
    if len(values) > len(payload) and values[-1] != sum(payload) & 0xFF:
        return None
    return 1 + 2 * (PARAMETERS[opcode] + 2)


def _packet(frame: bytes | bytearray) -> Packet:
    payload = frame[1:-2:2]
    return Packet(payload[0], bytes(payload[1:]))


def _header_length(before: bytes | bytearray) -> int:
    """How many bytes at the end of ``before`` can be the beginning of a header."""
    return next((length for length in (2, 1) if before.endswith(HEADER[:length])), int(before.endswith(HEADER[1:2])))
