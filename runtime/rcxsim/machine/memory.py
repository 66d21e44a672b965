"""The memory of the brick: five slots of tasks and subs, and what is left of some 6 KB."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from golc.bytecode.image import ChunkType

SLOTS = 5
MOST = {ChunkType.TASK: 10, ChunkType.SUB: 8}
"""Tasks and subs of a slot."""

Step = tuple[Callable[..., object], int, int]
"""An instruction made ready: what it does, the place after it, and its time in microseconds."""


@dataclass(eq=False)
class Code:
    """The byte code of a task or sub in a slot; ``steps`` are the instructions that were executed already."""

    type: ChunkType
    number: int
    bytes: bytes
    name: str = ""
    steps: dict[int, Step] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.type.name.lower()} {self.number}" + (f" ({self.name})" if self.name else "")


class Memory:
    """Programs by slot; ``room`` bytes for all of them and the datalog, of which ``taken`` says the size."""

    def __init__(self, room: int, taken: Callable[[], int]) -> None:
        self.room = room
        self._taken = taken
        self._slots: list[dict[tuple[ChunkType, int], Code]] = [{} for _ in range(SLOTS)]

    @property
    def used(self) -> int:
        """Bytes of all programs and the datalog."""
        return sum(len(code.bytes) for slot in self._slots for code in slot.values()) + self._taken()

    def find(self, slot: int, type_: ChunkType, number: int) -> Code | None:
        return self._slots[slot].get((type_, number))

    def chunks(self, slot: int) -> Iterator[Code]:
        """The tasks and subs of a slot."""
        yield from self._slots[slot].values()

    def fits(self, slot: int, type_: ChunkType, number: int, length: int) -> bool:
        """Whether there is room for a task or sub in the place of the one with its number."""
        before = self.find(slot, type_, number)
        return self.used - (0 if before is None else len(before.bytes)) + length <= self.room

    def store(self, slot: int, type_: ChunkType, number: int, code: bytes, name: str = "") -> None:
        self._slots[slot][type_, number] = Code(type_, number, code, name)

    def delete(self, slot: int, type_: ChunkType, number: int | None = None) -> None:
        """Delete a task or sub, or all of a slot."""
        for key in list(self._slots[slot]):
            if key[0] is type_ and number in (None, key[1]):
                del self._slots[slot][key]
