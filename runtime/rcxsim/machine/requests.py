"""The firmware's answers to the packets of a host: asking, commanding, downloading.

Requests that are op codes as well do what these do. The others, and what is answered beyond an acknowledgement, are
here. What a request needs and gives is from Kekoa Proudfoot's opcode reference, checked with the real nqc.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

from golc.bytecode.image import ChunkType, variables_in
from golc.bytecode.opcodes import TOGGLE, Instruction, Use, decode
from golc.bytecode.sources import Source, Value
from golc.runtime.rcxsim.frames import TRANSFER
from golc.runtime.rcxsim.machine.download import Downloads
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.execute import build
from golc.runtime.rcxsim.machine.machine import Machine
from golc.runtime.rcxsim.machine.memory import MOST, SLOTS
from golc.runtime.rcxsim.machine.values import VARIABLES, reader
from golc.runtime.rcxsim.trace import Trace

VERSION_KEY = (1, 3, 5, 7, 11)
ROM_VERSION = (3, 1)
MEMORY_START = 0xC000
"""Where programs begin in the memory map; unknown."""
FULL = 1
"""The answer of the datalog when it has no room."""


class Requests:
    """Answers requests, each once: one that comes again, its toggle bit included, gets the same answer."""

    def __init__(self, machine: Machine, trace: Trace) -> None:
        self._machine = machine
        self._trace = trace
        self._downloads = Downloads(machine, trace)
        self._last: tuple[bytes, bytes] | None = None
        self._own: dict[int, Callable[..., bytes]] = {
            0x12: self._get,
            0x15: self._versions,
            0x20: self._memory_map,
            0x30: lambda: struct.pack("<H", machine.options.battery),
            0x25: lambda _, number, __, length: self._downloads.begin(ChunkType.TASK, number, length),
            0x35: lambda _, number, __, length: self._downloads.begin(ChunkType.SUB, number, length),
            0x40: lambda: self._delete(ChunkType.TASK, None),
            0x61: lambda number: self._delete(ChunkType.TASK, number),
            0x70: lambda: self._delete(ChunkType.SUB, None),
            0xC1: lambda number: self._delete(ChunkType.SUB, number),
            0x52: lambda size: bytes((0 if machine.resize_log(size & 0xFFFF) else FULL,)),
            0x62: self._log,
            0xA4: lambda first, count: machine.datalog.upload(first & 0xFFFF, count & 0xFFFF),
        }

    def answer(self, payload: bytes) -> bytes | None:
        """The payload that answers a request's payload; None if the brick does not answer it."""
        if self._last is not None and self._same(payload, self._last[0]):
            self._tell(payload, repeated=True)
            return self._last[1]
        try:
            data = self._do(payload)
        except MachineError as error:
            self._tell(payload, problem=error.reason)
            return None
        if data is None:
            self._tell(payload, problem="the brick does not answer it")
            return None
        self._tell(payload)
        reply = bytes((payload[0] ^ 0xFF,)) + data
        self._last = payload, reply
        return reply

    def _same(self, payload: bytes, before: bytes) -> bool:
        if self._machine.options.repeats_by_op_code:
            return payload[0] == before[0]
        return payload == before

    def _tell(self, payload: bytes, **details: Any) -> None:
        self._trace.tell(self._machine.seconds, "request", payload=payload.hex(" "), **details)

    def _do(self, payload: bytes) -> bytes | None:
        """What an answer says beyond its op code."""
        if payload[0] & ~TOGGLE == TRANSFER:
            return self._downloads.block(payload)
        instruction = decode(payload, 0)
        if instruction is None or Use.REQUEST not in instruction.op.use:
            return None
        if instruction.op.firmware > self._machine.firmware.major:
            return None
        if any(number >= VARIABLES for number in variables_in(instruction)):
            raise MachineError("a host has no variables of its own")
        own = self._own.get(instruction.op.code)
        if own is not None:
            return own(*instruction.operands)
        return self._execute(instruction)

    def _execute(self, instruction: Instruction) -> bytes:
        build(self._machine, instruction)(self._machine.host)
        return b""

    def _get(self, value: Value) -> bytes:
        if value.source in (Source.CONSTANT, Source.RANDOM):
            raise MachineError(f"source {value.source} cannot be asked for")
        return struct.pack("<h", reader(self._machine, value)(self._machine.host))

    def _versions(self, *key: int) -> bytes:
        if key != VERSION_KEY:
            raise MachineError("the key is wrong")
        return struct.pack(">4H", *ROM_VERSION, *self._machine.firmware.words)

    def _log(self, value: Value) -> bytes:
        added = self._machine.datalog.add(value, reader(self._machine, value)(self._machine.host))
        return bytes((0 if added else FULL,))

    def _delete(self, type_: ChunkType, number: int | None) -> bytes:
        """Delete a task or a sub of the current program, or all.

        Everything stops if a task is deleted that runs, or all tasks are; of a sub, the tasks that are in it.
        """
        machine = self._machine
        codes = [code for code in machine.memory.chunks(machine.slot) if code.type is type_]
        deleted = [code for code in codes if number in (None, code.number)]
        hit = [task for task in machine.processor.tasks if any(code in deleted for code in task.within)]
        if type_ is ChunkType.TASK and (hit or number is None):
            machine.stop_all()
        for task in hit:
            machine.processor.stop(task)
        machine.memory.delete(machine.slot, type_, number)
        return b""

    def _memory_map(self) -> bytes:
        """Where each sub and task begins, by slot and number, then the datalog, the free memory, the last byte."""
        memory, address, words = self._machine.memory, MEMORY_START, []
        for type_ in (ChunkType.SUB, ChunkType.TASK):
            for slot in range(SLOTS):
                for number in range(MOST[type_]):
                    words.append(address)
                    code = memory.find(slot, type_, number)
                    address += 0 if code is None else len(code.bytes)
        log = self._machine.datalog
        words += [address, address + log.next, address + log.taken, MEMORY_START + memory.room - 1]
        return struct.pack(">94H", *words)
