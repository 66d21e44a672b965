"""The datalog: values with where they come from, for a host to upload."""

from __future__ import annotations

import struct
from collections.abc import Sequence

from golc.bytecode.opcodes import LOGGED
from golc.bytecode.sources import Source, Value
from golc.runtime.rcxsim.machine.error import MachineError

ENTRY_BYTES = 3
TYPES = {Source.VARIABLE: 0x00, Source.TIMER: 0x20, Source.SENSOR: 0x40, Source.WATCH: 0x80}
"""The type of an entry, to which the number of the variable, timer or sensor is added."""
SIZE_TYPE = 0xFF
"""The type of the first entry, whose value is the number of entries, itself included."""


class Datalog:
    """``size`` entries at most, beside the first."""

    def __init__(self) -> None:
        self.size = 0
        self._entries: list[tuple[int, int]] = []

    @property
    def taken(self) -> int:
        """What it takes of the memory."""
        return (self.size + 1) * ENTRY_BYTES if self.size else 0

    @property
    def next(self) -> int:
        """Bytes that are filled."""
        return (len(self._entries) + 1) * ENTRY_BYTES if self.size else 0

    @property
    def entries(self) -> Sequence[tuple[int, int]]:
        """Type and value of each entry."""
        return [(SIZE_TYPE, len(self._entries) + 1), *self._entries]

    def entry(self, number: int) -> tuple[int, int]:
        """Type and value of one entry."""
        if not 0 <= number <= len(self._entries):
            raise MachineError(f"the datalog has no entry {number}")
        return self.entries[number]

    def byte(self, place: int) -> int:
        """One of the bytes that it takes."""
        type_, value = self.entry(place // ENTRY_BYTES)
        return (type_, value & 0xFF, value >> 8 & 0xFF)[place % ENTRY_BYTES]

    def upload(self, first: int, count: int) -> bytes:
        """Some entries, each as its type and its value; none if not all of them exist."""
        entries = self.entries
        if first + count > len(entries):
            return b""
        return b"".join(struct.pack("<Bh", *entry) for entry in entries[first : first + count])

    def resize(self, size: int) -> None:
        """Begin a new one."""
        self.size = size
        self._entries.clear()

    def add(self, origin: Value, value: int) -> bool:
        """Whether there was room for a value."""
        if len(self._entries) >= self.size:
            return False
        self._entries.append((entry_type(origin), value))
        return True


def entry_type(origin: Value) -> int:
    """The type of an entry; only some sources have one."""
    if origin.source not in LOGGED:
        raise MachineError(f"a value of source {origin.source} cannot be logged")
    return TYPES[Source(origin.source)] + origin.argument
