"""What the simulated brick did and why, one JSON object a line."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any, TextIO

from golc.theory.types import writable

Record = Mapping[str, Any]
"""``t`` (seconds since the start), ``what`` (``heard``, ``sent``, ``lost``, ``began``, …), and what belongs to it."""


class Trace:
    """Takes records and hands them to any number of readers."""

    def __init__(self, *readers: Callable[[Record], None]) -> None:
        self._readers = readers

    @property
    def read(self) -> bool:
        """Whether anybody reads it."""
        return bool(self._readers)

    def tell(self, now: float, what: str, **details: Any) -> None:
        """Record something that happens at ``now``."""
        if self._readers:
            record = {"t": round(now, 6), "what": what, **details}
            for reader in self._readers:
                reader(record)


def to_file(stream: TextIO) -> Callable[[Record], None]:
    """A reader that writes JSON lines, each flushed: the file is whole up to the last line however the process ends."""

    def write(record: Record) -> None:
        stream.write(json.dumps(writable(record)) + "\n")
        stream.flush()

    return write
