"""The .rcx image that nqc writes: its chunks and symbols, and which variables their byte code uses.

The layout of the file is that of nqc 3.1, found by reading images back until the listing agreed with ``nqc -L``.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import IntEnum

from golc.bytecode.opcodes import Condition, Decoded, Instruction, Operand, instructions
from golc.bytecode.sources import Source, Value
from golc.diagnostics import DeviceError

_HEADER = struct.Struct("<4sHHHBB")
_CHUNK = struct.Struct("<BBH")
_SYMBOL = struct.Struct("<BBBB")
MAGIC = b"RCXI"
VERSION = 0x0102
RCX, RCX2 = 0, 3
"""The targets of an image that are firmware 1.0 and 2.0; the others are other toys."""


class ChunkType(IntEnum):
    TASK = 0
    SUB = 1


SYMBOL_OF_VARIABLE = 2
"""A symbol has the type of a chunk, or this one."""


@dataclass(frozen=True, order=True)
class Chunk:
    """The byte code of a task or sub."""

    type: ChunkType
    number: int
    code: bytes

    def __str__(self) -> str:
        return f"{self.type.name.lower()} {self.number}"


@dataclass(frozen=True)
class Symbol:
    """What a task, a sub or a variable is called in the source; a variable may have several names."""

    type: int
    number: int
    name: str


@dataclass(frozen=True)
class Image:
    """``target`` is ``RCX`` or ``RCX2``; the symbols, in the order of the file, do not matter to the brick."""

    target: int
    chunks: tuple[Chunk, ...]
    symbols: tuple[Symbol, ...] = field(default=())

    @property
    def size(self) -> int:
        """Bytes that the program takes on the brick."""
        return sum(len(chunk.code) for chunk in self.chunks)

    def count(self, type_: ChunkType) -> int:
        """The number of tasks or subs."""
        return sum(chunk.type == type_ for chunk in self.chunks)

    def name(self, type_: ChunkType, number: int) -> str:
        """What a task or sub is called; nothing if the image does not say."""
        names = [symbol.name for symbol in self.symbols if (symbol.type, symbol.number) == (type_, number)]
        return names[-1] if names else ""


def read_image(data: bytes) -> Image:
    """Read an image; raises DeviceError if it is none."""
    try:
        magic, version, count, symbols, target, _ = _HEADER.unpack_from(data)
        if magic != MAGIC or version != VERSION:
            raise DeviceError("the compiled file is no RCX image of a known version")
        if target not in (RCX, RCX2):
            raise DeviceError(f"the compiled file is for another toy than the RCX (target {target})")
        chunks: list[Chunk] = []
        place = _HEADER.size
        for _ in range(count):
            chunk, place = _read_chunk(data, place)
            if any((other.type, other.number) == (chunk.type, chunk.number) for other in chunks):
                raise DeviceError(f"the compiled file has {chunk} twice")
            chunks.append(chunk)
    except struct.error as error:
        raise DeviceError("the compiled file is cut off") from error
    return Image(target, tuple(chunks), tuple(_read_symbols(data, place, symbols)))


def _read_chunk(data: bytes, place: int) -> tuple[Chunk, int]:
    """The chunk at a place and the place of the next."""
    type_, number, length = _CHUNK.unpack_from(data, place)
    if type_ not in list(ChunkType):
        raise DeviceError(f"the compiled file has a part that is neither task nor sub (type {type_})")
    start = place + _CHUNK.size
    if start + length > len(data):
        raise DeviceError("the compiled file is cut off")
    padded = (length + 3) // 4 * 4  # to whole words
    return Chunk(ChunkType(type_), number, data[start : start + length]), start + padded


def _read_symbols(data: bytes, place: int, count: int) -> Iterator[Symbol]:
    """The symbols up to the first that makes no sense: nqc itself gets the length of a very long name wrong."""
    for _ in range(count):
        if place + _SYMBOL.size > len(data):
            return
        type_, number, length, _ = _SYMBOL.unpack_from(data, place)
        name = data[place + _SYMBOL.size : place + _SYMBOL.size + length]
        if len(name) < length or not name.endswith(b"\0"):
            return
        yield Symbol(type_, number, name[:-1].decode("latin-1"))
        place += _SYMBOL.size + length


def variables_used(chunk: Chunk) -> set[int]:
    """The numbers of the variables that a chunk reads or writes: 0..31 are the brick's, 32..47 the task's own."""
    return {number for instruction in instructions(chunk.code) for number in variables_in(instruction)}


def variables_in(instruction: Instruction) -> Iterator[int]:
    """The numbers of the variables that an instruction names."""
    for operand, decoded in zip(instruction.op.operands, instruction.operands, strict=True):
        if operand is Operand.VARIABLE and isinstance(decoded, int):
            yield decoded
        for value in _values(decoded):
            if value.source in (Source.VARIABLE, Source.INDIRECT):
                yield value.argument


def _values(decoded: Decoded) -> tuple[Value, ...]:
    match decoded:
        case Value():
            return (decoded,)
        case Condition(first=first, second=second):
            return first, second
        case _:
            return ()
