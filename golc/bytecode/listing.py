"""The byte code of an image for people to read: the same text, byte for byte, as ``nqc -L`` writes for the file."""

from __future__ import annotations

from collections.abc import Iterator

from golc.bytecode.image import SYMBOL_OF_VARIABLE, ChunkType, Image
from golc.bytecode.opcodes import Condition, Decoded, Instruction, Operand, decode

TITLES = {ChunkType.TASK: "Task", ChunkType.SUB: "Sub"}
ROOM = 16
"""Characters of the first value of a comparison that nqc has room for. A longer one runs into the second value, which
overwrites it: what is printed is the beginning of the first, then the second."""
MOTORS = ("0", "A", "B", "AB", "C", "AC", "BC", "ABC")
OUTPUTS = ("Float", "Off", "On", "?")
DIRECTIONS = ("Rev", "Flip", "Fwd", "?")
SENSOR_TYPES = ("None", "Switch", "Temp", "Light", "Angle")
SENSOR_MODES = ("Raw", "Boolean", "Edge", "Pulse", "Percent", "Celcius", "Fahrenheit", "Angle")


def listing(image: Image) -> str:
    """The names of the variables, each task and sub with its instructions, and the total size."""
    lines = [f"*** Var {s.number} = {s.name}" for s in image.symbols if s.type == SYMBOL_OF_VARIABLE]
    for chunk in sorted(image.chunks):
        name = image.name(chunk.type, chunk.number)
        lines += ["", f"*** {TITLES[chunk.type]} {chunk.number} = {name}, size: {len(chunk.code)} bytes"]
        lines += _instructions(chunk.code)
    lines += ["", f"Total size: {image.size} bytes", ""]
    return "\n".join(lines)


def describe(instruction: Instruction, code: bytes) -> str:
    """An instruction of a chunk without its place and bytes."""
    texts = [
        text
        for operand, decoded in zip(instruction.op.operands, instruction.operands, strict=True)
        if (text := _text(operand, decoded, instruction, code)) is not None
    ]
    return f"{instruction.op.name:<8} {', '.join(texts)}" if texts else instruction.op.name


def _instructions(code: bytes) -> Iterator[str]:
    place = 0
    while place < len(code):
        instruction = decode(code, place)
        end = place + 1 if instruction is None else instruction.end
        text = "?" if instruction is None else describe(instruction, code)
        yield f"{place:03d} {text:<42} {code[place:end].hex(' ')} "
        place = end


def _text(operand: Operand, decoded: Decoded, instruction: Instruction, code: bytes) -> str | None:
    match operand, decoded:
        case Operand.HIDDEN, _:
            return None
        case Operand.VARIABLE, _:
            return f"var[{decoded}]"
        case _, Condition(relation=relation, first=first, second=second):
            shown = str(first)
            return f"{shown[:ROOM] + str(second) if len(shown) >= ROOM else shown} {relation.sign} {second}"
        case Operand.AHEAD, int(target):
            return str(target - _sign(code[instruction.end - 1], 8))
        case Operand.FAR_AHEAD, int(target):
            return str(target - _sign(code[instruction.end - 1], 16))
        case Operand.MOTORS, int(bits):
            return MOTORS[bits & 7]
        case Operand.OUTPUTS, int(bits):
            return f"{MOTORS[bits & 7]}, {OUTPUTS[bits >> 6]}"
        case Operand.DIRECTIONS, int(bits):
            return f"{MOTORS[bits & 7]}, {DIRECTIONS[bits >> 6]}"
        case Operand.SENSOR_TYPE, int(number):
            return SENSOR_TYPES[number] if number < len(SENSOR_TYPES) else "?"
        case Operand.SENSOR_MODE, int(bits):
            return SENSOR_MODES[bits >> 5]
        case _:
            return str(decoded)


def _sign(last: int, bits: int) -> int:
    """What is taken away from an offset whose last byte has the highest bit set: nqc shows those that only lead forward
    as if they could be negative. The brick does not take them so, nor does nqc when it compiles."""
    return 1 << bits if last & 0x80 else 0
