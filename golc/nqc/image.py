"""The .rcx image that nqc writes: its chunks, and which variables their byte code uses.

The layout of the file and the lengths of the op codes are those of nqc 3.1, found by reading images back until the
decoder agreed with ``nqc -L``.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum

from golc.diagnostics import DeviceError

_HEADER = struct.Struct("<4sHHHBB")
_CHUNK = struct.Struct("<BBH")
VERSION = 0x0102


class ChunkType(IntEnum):
    TASK = 0
    SUB = 1


@dataclass(frozen=True)
class Chunk:
    """The byte code of a task or sub."""

    type: int
    number: int
    code: bytes


@dataclass(frozen=True)
class Image:
    """``target`` is 0 for firmware 1.0, 3 for firmware 2.0."""

    target: int
    chunks: tuple[Chunk, ...]

    @property
    def size(self) -> int:
        """Bytes that the program takes on the brick."""
        return sum(len(chunk.code) for chunk in self.chunks)

    def count(self, type_: ChunkType) -> int:
        """The number of tasks or subs."""
        return sum(chunk.type == type_ for chunk in self.chunks)


def read_image(data: bytes) -> Image:
    """Read the chunks of an image; raises DeviceError if it is none. The symbols at the end are not needed."""
    try:
        magic, version, count, _symbols, target, _ = _HEADER.unpack_from(data)
        if magic != b"RCXI" or version != VERSION:
            raise DeviceError("the compiled file is no RCX image of a known version")
        chunks = []
        place = _HEADER.size
        for _ in range(count):
            type_, number, length = _CHUNK.unpack_from(data, place)
            start = place + _CHUNK.size
            if start + length > len(data):
                raise DeviceError("the compiled file is cut off")
            chunks.append(Chunk(type_, number, data[start : start + length]))
            place = start + (length + 3) // 4 * 4  # padded to whole words
    except struct.error as error:
        raise DeviceError("the compiled file is cut off") from error
    return Image(target, tuple(chunks))


@dataclass(frozen=True)
class Operands:
    """How long an op code is with its operands, and where the operands are that may name a variable.

    ``variables``: places of a variable's number; ``sources``: places of a source byte with its 16-bit argument,
    ``short`` with an 8-bit one; ``conditions``: places of a comparison (two sources, a 16-bit and an 8-bit argument).
    """

    length: int
    variables: tuple[int, ...] = ()
    sources: tuple[int, ...] = ()
    short: tuple[int, ...] = ()
    conditions: tuple[int, ...] = ()


_ARITHMETIC = Operands(5, variables=(1,), sources=(2,))
OPERANDS = {
    **dict.fromkeys((0x14, 0x24, 0x34, 0x44, 0x54, 0x64, 0x74, 0x84, 0x94), _ARITHMETIC),
    0x05: Operands(6, short=(1,), sources=(3,)),
    0x27: Operands(2),
    0x72: Operands(3),
    0x85: Operands(7, conditions=(1,)),
    0x95: Operands(8, conditions=(1,)),
    0x82: Operands(3, short=(1,)),
    0x37: Operands(2),
    0x92: Operands(3),
    0xF2: Operands(3, variables=(1,)),
    0xF3: Operands(4, variables=(1,)),
    0x43: Operands(4, sources=(1,)),
    0x13: Operands(4, short=(2,)),
    0xA3: Operands(4, short=(2,)),
    0xB2: Operands(3, short=(1,)),
    0x02: Operands(3, variables=(1,)),
    0x33: Operands(4, sources=(1,)),
    0xE5: Operands(6, sources=(3,)),
    0x62: Operands(3, short=(1,)),
    0xB4: Operands(5, sources=(1,)),
    0xB5: Operands(6, sources=(1,)),
    0x03: Operands(4, sources=(1,)),
    **dict.fromkeys((0x50, 0xF6, 0x90, 0x80, 0xD0, 0xE0, 0x60, 0xB0, 0xA0, 0x10, 0x06), Operands(1)),
    **dict.fromkeys((0x71, 0x81, 0x17, 0xD7, 0x21, 0xE1, 0x67, 0x77, 0xD1, 0xA1), Operands(2)),
    **dict.fromkeys((0xF7, 0x31, 0x51, 0x91, 0xB1, 0x97, 0xA7, 0xB7), Operands(2)),
    **dict.fromkeys((0x32, 0x42, 0x22, 0x52, 0xC2), Operands(3)),
    **dict.fromkeys((0x23, 0x73, 0x93), Operands(4)),
    **dict.fromkeys((0x04, 0xA4), Operands(5)),
}
"""Every op code that nqc writes into programs, by its first byte."""

VARIABLE, INDIRECT = 0, 36


def instructions(code: bytes) -> Iterator[tuple[int, int]]:
    """Each instruction of a chunk as its place and its op code; raises DeviceError at an unknown one."""
    place = 0
    while place < len(code):
        operands = OPERANDS.get(code[place])
        if operands is None:
            raise DeviceError(f"the compiled file has an unknown op code {code[place]:02x} at {place}")
        yield place, code[place]
        place += operands.length


def variables_used(chunk: Chunk) -> set[int]:
    """The numbers of the variables that a chunk reads or writes: 0..31 are the brick's, 32..47 the task's own."""
    used: set[int] = set()
    code = chunk.code
    for place, op in instructions(code):
        operands = OPERANDS[op]
        used.update(code[place + offset] for offset in operands.variables)
        pairs = [(code[place + offset], code[place + offset + 1]) for offset in operands.sources + operands.short]
        for offset in operands.conditions:
            first, second, low, _, argument = code[place + offset : place + offset + 5]
            pairs += [(first & 0x3F, low), (second, argument)]
        used.update(number for source, number in pairs if source in (VARIABLE, INDIRECT))
    return used
