"""The op codes of the RCX: names, operands, who may use them, how long they take.

The same codes are commands in a program and requests of a host, most of them either. A program's disassembler and the
machine that executes it share this table, and so do the machine and the firmware's answers to requests. Codes, names
and operands are those of nqc 3.1 (the names of its listing); which are requests, and the sources that firmware 1.0
allows, are from Kekoa Proudfoot's opcode reference.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum, Flag, auto

from golc.bytecode.sources import Source, Value
from golc.diagnostics import DeviceError

TOGGLE = 0x08
"""A bit of an op code that tells a request from the same one sent again; it does not change the meaning."""


class Operand(Enum):
    """What stands after an op code; the value is the number of its bytes."""

    BYTE = (1, "a number")
    HIDDEN = (1, "a byte without meaning")
    WORD = (2, "a number of 16 bits")
    VARIABLE = (1, "the number of a variable")
    VALUE8 = (2, "a source and an argument of 8 bits")
    VALUE16 = (3, "a source and an argument of 16 bits")
    CONDITION = (5, "a comparison of a value with 16 bits and one with 8")
    NEAR = (1, "an offset: bit 7 is its sign")
    FAR = (2, "an offset: seven bits and a sign, then eight more bits")
    AHEAD = (1, "an offset that only leads forward")
    FAR_AHEAD = (2, "an offset of 16 bits that only leads forward")
    OFFSET = (2, "an offset of 16 bits in two's complement")
    MOTORS = (1, "some motors")
    OUTPUTS = (1, "some motors, and on, off or float")
    DIRECTIONS = (1, "some motors, and forward, reverse or flip")
    SENSOR_TYPE = (1, "the type of a sensor")
    SENSOR_MODE = (1, "mode and slope of a sensor")

    def __init__(self, length: int, meaning: str) -> None:
        self.length = length
        self.meaning = meaning


class Relation(Enum):
    """How a condition compares its values; by the two highest bits of its first byte."""

    LESS_OR_EQUAL = (0, "<=")
    GREATER_OR_EQUAL = (1, ">=")
    UNEQUAL = (2, "!=")
    EQUAL = (3, "==")

    def __init__(self, bits: int, sign: str) -> None:
        self.bits = bits
        self.sign = sign


RELATIONS = {relation.bits: relation for relation in Relation}


@dataclass(frozen=True, slots=True)
class Condition:
    """A comparison of two values."""

    relation: Relation
    first: Value
    second: Value


Decoded = int | Value | Condition
"""An operand of an instruction; of an offset, the place that it leads to."""


class Use(Flag):
    """Where an op code may stand."""

    PROGRAM = auto()
    REQUEST = auto()
    BOTH = PROGRAM | REQUEST


BASIC = frozenset((Source.VARIABLE, Source.CONSTANT))
EXTENDED = BASIC | {Source.RANDOM}
LOGGED = frozenset((Source.VARIABLE, Source.TIMER, Source.SENSOR, Source.WATCH))


@dataclass(frozen=True, slots=True)
class OpCode:
    """A row of the table.

    ``firmware`` is the first that has it. ``sources`` are those that firmware 1.0 allows for its value, None for all.
    ``time`` is how long it takes, in times of a usual one: all that were measured are within some hundredths.
    """

    code: int
    name: str
    operands: tuple[Operand, ...] = ()
    use: Use = Use.BOTH
    firmware: int = 1
    sources: frozenset[Source] | None = None
    time: float = 1.0

    @property
    def length(self) -> int:
        """Bytes with the operands."""
        return 1 + sum(operand.length for operand in self.operands)


def _rows() -> Iterator[OpCode]:
    program, request = Use.PROGRAM, Use.REQUEST
    byte, word, hidden, variable = Operand.BYTE, Operand.WORD, Operand.HIDDEN, Operand.VARIABLE
    value8, value16 = Operand.VALUE8, Operand.VALUE16

    # Variables.
    yield OpCode(0x14, "setv", (variable, value16))
    yield OpCode(0x24, "sumv", (variable, value16), sources=BASIC)
    yield OpCode(0x34, "subv", (variable, value16), sources=BASIC)
    yield OpCode(0x44, "divv", (variable, value16), sources=BASIC)
    yield OpCode(0x54, "mulv", (variable, value16), sources=BASIC, time=1.03)
    yield OpCode(0x64, "sgnv", (variable, value16), sources=BASIC)
    yield OpCode(0x74, "absv", (variable, value16), sources=BASIC)
    yield OpCode(0x84, "andv", (variable, value16), sources=BASIC)
    yield OpCode(0x94, "orv", (variable, value16), sources=BASIC)
    yield OpCode(0x05, "set", (value8, value16), firmware=2)
    # Jumps, loops, subs, tasks.
    yield OpCode(0x27, "jmp", (Operand.NEAR,), program)
    yield OpCode(0x72, "jmpl", (Operand.FAR,), program)
    yield OpCode(0x85, "chk", (Operand.CONDITION, Operand.AHEAD), program)
    yield OpCode(0x95, "chkl", (Operand.CONDITION, Operand.OFFSET), program)
    yield OpCode(0x82, "loops", (value8,), program, sources=EXTENDED)
    yield OpCode(0x37, "loopc", (Operand.AHEAD,), program)
    yield OpCode(0x92, "loopcl", (Operand.FAR_AHEAD,), program)
    yield OpCode(0xF2, "decvjn", (variable, Operand.NEAR), program, firmware=2)
    yield OpCode(0xF3, "decvjnl", (variable, Operand.FAR), program, firmware=2)
    yield OpCode(0x43, "wait", (value16,), program, sources=EXTENDED)
    yield OpCode(0x71, "start", (byte,))
    yield OpCode(0x81, "stop", (byte,))
    yield OpCode(0x50, "stop")
    yield OpCode(0x17, "calls", (byte,), program)
    yield OpCode(0xF6, "rets", (), program)
    yield OpCode(0xD7, "setp", (byte,), program, firmware=2)
    # Motors.
    yield OpCode(0x21, "out", (Operand.OUTPUTS,))
    yield OpCode(0xE1, "dir", (Operand.DIRECTIONS,))
    yield OpCode(0x13, "pwr", (Operand.MOTORS, value8), sources=EXTENDED)
    yield OpCode(0x67, "gout", (Operand.OUTPUTS,), firmware=2)
    yield OpCode(0x77, "gdir", (Operand.DIRECTIONS,), firmware=2)
    yield OpCode(0xA3, "gpwr", (Operand.MOTORS, value8), firmware=2)
    # Sensors, timers, counters.
    yield OpCode(0x32, "sent", (byte, Operand.SENSOR_TYPE))
    yield OpCode(0x42, "senm", (byte, Operand.SENSOR_MODE))
    yield OpCode(0xD1, "senz", (byte,))
    yield OpCode(0xA1, "tmrz", (byte,))
    yield OpCode(0x97, "cnti", (byte,), firmware=2)
    yield OpCode(0xA7, "cntd", (byte,), firmware=2)
    yield OpCode(0xB7, "cntz", (byte,), firmware=2)
    # Messages, sound, display.
    yield OpCode(0x90, "msgz", (), program)
    yield OpCode(0xB2, "msg", (value8,), program, sources=BASIC)
    yield OpCode(0xF7, "msgs", (byte,))
    yield OpCode(0x31, "txs", (byte,))
    yield OpCode(0xC2, "uart", (byte, byte), firmware=2)
    yield OpCode(0x51, "plays", (byte,))
    yield OpCode(0x23, "playt", (word, byte))
    yield OpCode(0x02, "playv", (variable, byte), firmware=2)
    yield OpCode(0x80, "playz", firmware=2)
    yield OpCode(0xD0, "mute", firmware=2)
    yield OpCode(0xE0, "speak", firmware=2)
    yield OpCode(0x33, "view", (value16,), sources=BASIC)
    yield OpCode(0xE5, "disp", (hidden, byte, value16), firmware=2)
    # The datalog.
    yield OpCode(0x52, "logz", (word,))
    yield OpCode(0x62, "log", (value8,), sources=LOGGED)
    yield OpCode(0xA4, "polld", (word, word))
    # Events and access control.
    yield OpCode(0x93, "sete", (byte, byte, byte), firmware=2)
    yield OpCode(0x06, "dele", firmware=2)
    yield OpCode(0x04, "cale", (byte, byte, byte, byte), firmware=2)
    yield OpCode(0x03, "event", (value16,), firmware=2)
    yield OpCode(0xB4, "mone", (value16, Operand.NEAR), program, firmware=2)
    yield OpCode(0xB5, "monel", (value16, Operand.FAR), program, firmware=2)
    yield OpCode(0xB0, "monex", (), program, firmware=2)
    yield OpCode(0x73, "monal", (byte, Operand.FAR), program, firmware=2)
    yield OpCode(0xA0, "monax", (), program, firmware=2)
    # The brick as a whole.
    yield OpCode(0x10, "ping", time=0.94)
    yield OpCode(0x22, "setw", (byte, byte))
    yield OpCode(0xB1, "tout", (byte,))
    yield OpCode(0x60, "offp")
    yield OpCode(0x91, "prgm", (byte,))
    # What only a host says.
    yield OpCode(0x12, "poll", (value8,), request)
    yield OpCode(0x15, "pollp", (byte,) * 5, request)
    yield OpCode(0x20, "memmap", (), request)
    yield OpCode(0x30, "pollb", (), request)
    yield OpCode(0x63, "pollm", (word, byte), request, firmware=2)
    yield OpCode(0x25, "_task", (hidden, byte, hidden, word), request)
    yield OpCode(0x35, "_sub", (hidden, byte, hidden, word), request)
    yield OpCode(0x40, "delt", (), request)
    yield OpCode(0x61, "delt", (byte,), request)
    yield OpCode(0x70, "dels", (), request)
    yield OpCode(0xC1, "dels", (byte,), request)
    yield OpCode(0x75, "_firm", (word, word, hidden), request)
    yield OpCode(0xA5, "boot", (byte,) * 5, request)
    yield OpCode(0xD2, "remote", (word,), request)


OPCODES = {row.code: row for row in _rows()}


@dataclass(frozen=True, slots=True)
class Instruction:
    """An op code at its place in the code of a task or a sub, with its operands."""

    place: int
    op: OpCode
    operands: tuple[Decoded, ...]

    @property
    def end(self) -> int:
        """The place after it."""
        return self.place + self.op.length


def find(code: int) -> OpCode | None:
    """The row of an op code, with or without its toggle bit."""
    return OPCODES.get(code & ~TOGGLE)


def decode(code: bytes, place: int) -> Instruction | None:
    """The instruction at a place; None if the op code is unknown or its operands are cut off."""
    op = find(code[place]) if 0 <= place < len(code) else None
    if op is None or place + op.length > len(code):
        return None
    operands, at = [], place + 1
    for operand in op.operands:
        operands.append(_decode(operand, code, at))
        at += operand.length
    return Instruction(place, op, tuple(operands))


def instructions(code: bytes) -> Iterator[Instruction]:
    """The instructions of a chunk one after the other; raises DeviceError at what is none."""
    place = 0
    while place < len(code):
        instruction = decode(code, place)
        if instruction is None:
            what = "an op code that is cut off" if find(code[place]) else f"an unknown op code {code[place]:02x}"
            raise DeviceError(f"the compiled file has {what} at {place}")
        yield instruction
        place = instruction.end


def _decode(operand: Operand, code: bytes, at: int) -> Decoded:
    match operand:
        case Operand.WORD:
            return _word(code, at)
        case Operand.VALUE8:
            return Value(code[at], code[at + 1])
        case Operand.VALUE16:
            return Value(code[at], _word(code, at + 1))
        case Operand.CONDITION:
            first = Value(code[at] & 0x3F, _word(code, at + 2))
            return Condition(RELATIONS[code[at] >> 6], first, Value(code[at + 1] & 0x3F, code[at + 4]))
        case Operand.NEAR:
            return at + _signed(code[at], code[at] & 0x7F)
        case Operand.FAR:
            return at + _signed(code[at], (code[at] & 0x7F) + (code[at + 1] << 7))
        case Operand.AHEAD:
            return at + code[at]
        case Operand.FAR_AHEAD:
            return at + (_word(code, at) & 0xFFFF)
        case Operand.OFFSET:
            return at + _word(code, at)
        case _:
            return code[at]


def _word(code: bytes, at: int) -> int:
    number: int = struct.unpack_from("<h", code, at)[0]
    return number


def _signed(first: int, size: int) -> int:
    return -size if first & 0x80 else size
