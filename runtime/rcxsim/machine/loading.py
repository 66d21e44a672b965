"""Putting an image into the memory at once, as if it had been downloaded, after looking at all of it."""

from __future__ import annotations

from golc.bytecode.image import Chunk, Image
from golc.bytecode.opcodes import decode, find
from golc.diagnostics import DeviceError
from golc.runtime.rcxsim.machine.memory import MOST, Memory


def load(memory: Memory, image: Image, slot: int) -> None:
    """Replace what is in a slot; raises DeviceError if the image is no program that fits."""
    for chunk in image.chunks:
        if chunk.number >= MOST[chunk.type]:
            what = chunk.type.name.lower()
            raise DeviceError(f"the program has a {what} {chunk.number}, but a brick has {MOST[chunk.type]} {what}s")
        _check(chunk)
    for type_ in MOST:
        memory.delete(slot, type_)
    if memory.used + image.size > memory.room:
        left = memory.room - memory.used
        raise DeviceError(f"the program takes {image.size} bytes, but the brick has room for {left}")
    for chunk in image.chunks:
        memory.store(slot, chunk.type, chunk.number, chunk.code, image.name(chunk.type, chunk.number))


def _check(chunk: Chunk) -> None:
    """Every byte of a chunk belongs to an instruction."""
    place = 0
    while place < len(chunk.code):
        instruction = decode(chunk.code, place)
        if instruction is None:
            raise DeviceError(f"{chunk}, address {place}: {no_instruction(chunk.code, place)}")
        place = instruction.end


def no_instruction(code: bytes, place: int) -> str:
    """Why there is none at a place."""
    op = find(code[place])
    return f"unknown op code {code[place]:02x}" if op is None else f"`{op.name}` is cut off"
