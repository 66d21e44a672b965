"""Downloads: a task or a sub comes in numbered blocks, of which the last has the number 0."""

from __future__ import annotations

from dataclasses import dataclass, field

from golc.bytecode.image import ChunkType
from golc.runtime.rcxsim.machine.machine import Machine
from golc.runtime.rcxsim.machine.memory import MOST
from golc.runtime.rcxsim.trace import Trace

OK, NO_MEMORY, BAD_NUMBER = b"\0", b"\1", b"\2"
BAD_CHECK_SUM, NO_DOWNLOAD = b"\3", b"\6"
LAST_BLOCK = 0
BLOCK_HEAD = 5
"""Bytes of a block's packet before the data: op code, number, length."""


@dataclass
class _Download:
    type: ChunkType
    number: int
    length: int
    data: bytearray = field(default_factory=bytearray)
    next: int = 1


class Downloads:
    """Takes the blocks of one task or sub after the other into the current program."""

    def __init__(self, machine: Machine, trace: Trace) -> None:
        self._machine = machine
        self._trace = trace
        self._now: _Download | None = None

    def begin(self, type_: ChunkType, number: int, length: int) -> bytes:
        """Make room for a task or sub."""
        machine, length = self._machine, length & 0xFFFF
        self._now = None
        if number >= MOST[type_]:
            return BAD_NUMBER
        if not machine.memory.fits(machine.slot, type_, number, length):
            return NO_MEMORY
        machine.stop_all()
        machine.memory.store(machine.slot, type_, number, bytes(length))
        self._now = _Download(type_, number, length)
        return OK

    def block(self, payload: bytes) -> bytes | None:
        """Take a block; one that is out of order is not answered."""
        download = self._now
        if download is None:
            return NO_DOWNLOAD
        sequence = int.from_bytes(payload[1:3], "little")
        data = payload[BLOCK_HEAD:-1]
        if sequence not in (LAST_BLOCK, download.next):
            return None
        if sequence != LAST_BLOCK and sum(data) & 0xFF != payload[-1]:
            return BAD_CHECK_SUM
        download.data += data
        download.next += 1
        if sequence == LAST_BLOCK:
            self._finish(download)
        return OK

    def _finish(self, download: _Download) -> None:
        """The brick itself does not look whether as much has come as was announced; here the length is kept."""
        code = bytes(download.data[: download.length].ljust(download.length, b"\0"))
        memory, slot = self._machine.memory, self._machine.slot
        memory.store(slot, download.type, download.number, code)
        problem = f"{len(download.data)} bytes came" if len(download.data) != download.length else None
        self._trace.tell(
            self._machine.seconds,
            "downloaded",
            program=slot + 1,
            part=str(memory.find(slot, download.type, download.number)),
            bytes=download.length,
            **({} if problem is None else {"problem": problem}),
        )
        self._now = None
