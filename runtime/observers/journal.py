"""The journal of a run: one JSON object a line, written before anything further happens.

Every record has ``time`` (seconds since the run began) and ``event``. Actions stand as a name and a list of arguments,
values as JSON has them (symbols are strings, ``none`` is ``null``), places as ``file:line:column``.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Callable, Iterable, Mapping
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from golc.diagnostics import DeviceError, Diagnostic
from golc.program.blame import Blocked as Why
from golc.runtime.loop import happenings as hp
from golc.situation.dynamics import Dynamics, Surprise
from golc.syntax.text import unwritable
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value, writable

FORMAT = 1
"""The version of the records."""

EVENTS: Mapping[type[hp.Happening], tuple[str, ...]] = {
    hp.Started: ("start", "state"),
    hp.Stepped: ("test", "span"),
    hp.Said: ("say", "text", "span"),
    hp.Begun: ("begin", "action", "args", "device", "span"),
    hp.Done: ("done", "action", "args", "results", "duration", "surprises"),
    hp.Failed: ("failed", "action", "args", "error"),
    hp.Remedied: ("remedy", "action", "args", "remedy"),
    hp.TakenIn: ("exogenous", "action", "args", "source", "impossible"),
    hp.Dropped: ("dropped", "action", "args", "source", "reason"),
    hp.Refused: ("refused", "text", "source", "diagnostics"),
    hp.SourceEnded: ("source ended", "source"),
    hp.Waiting: ("wait", "span"),
    hp.Blocked: ("blocked", "reasons", "sources"),
    hp.Reset: ("reset", "source"),
    hp.Ended: ("end", "end", "message", "state", "actions", "exogenous", "unstopped"),
}
"""The name of each event, and the fields of the happening that are in its record."""


def _said(diagnostics: Iterable[Diagnostic]) -> list[str]:
    return [each.message + (f"; {each.help}" if each.help else "") for each in diagnostics]


def _why(reasons: Iterable[Why]) -> list[dict[str, object]]:
    return [{"at": str(each.span), "text": each.text, "values": dict(each.values)} for each in reasons]


def _unexpected(surprises: Iterable[Surprise]) -> dict[str, Value]:
    return {surprise.fluent or "?": surprise.sensed for surprise in surprises}


WRITTEN: Mapping[str, tuple[str, Callable[[Any], object]]] = {
    "span": ("at", str),
    "error": ("error", str),
    "remedy": ("remedy", lambda remedy: remedy.value),
    "end": ("reason", lambda end: end.value),
    "duration": ("duration", lambda seconds: round(seconds, 6)),
    "diagnostics": ("errors", _said),
    "reasons": ("reasons", _why),
    "surprises": ("surprises", _unexpected),
    "unstopped": ("unstopped", dict),
}
"""The fields that a record has under another name or in another form; what is left out if nothing is in it follows."""
OPTIONAL = ("surprises", "unstopped")


def fingerprint(theory: BasicActionTheory) -> str:
    """A short text that differs for theories that differ: made of their texts and the values of their constants."""
    tables = (theory.constants, theory.statics, theory.fluents, theory.definitions, theory.actions, theory.procedures)
    sources = dict.fromkeys([theory.source, *(entry.span.source for table in tables for entry in table.values())])
    constants = [f"{name}={constant.value!r}" for name, constant in theory.constants.items()]
    facts = [*(source.text for source in sources), *constants]
    return hashlib.sha256("\0".join(facts).encode()).hexdigest()[:16]


class Journal:
    """An observer that writes records to a file; every line reaches the system whole or not at all.

    Opening raises ``UserError`` where the file cannot be written, ``FileExistsError`` where there is one already.
    """

    def __init__(self, path: Path, dynamics: Dynamics, procedure: str, args: tuple[Value, ...]) -> None:
        self._path = path
        self._dynamics = dynamics
        self._program = {"procedure": procedure, "args": list(args)}
        self._size = 0
        self._file = _create(path)

    def __call__(self, happening: hp.Happening) -> None:
        self.write({"time": round(happening.time, 6), **self._record(happening)})

    def write(self, record: Mapping[str, object]) -> None:
        """Append a record. A line that the disk does not take as a whole is taken back."""
        text = json.dumps(writable(record), ensure_ascii=False, separators=(",", ":"), default=str)
        line = text.encode() + b"\n"
        try:
            if os.write(self._file, line) == len(line):
                self._size += len(line)
                return
            os.ftruncate(self._file, self._size)
            reason = "the disk is full"
        except OSError as error:
            reason = error.strerror or str(error)
        raise DeviceError(f"cannot write the journal {self._path}: {reason}")

    def close(self) -> None:
        """Let go of the file."""
        os.close(self._file)

    def _record(self, happening: hp.Happening) -> dict[str, object]:
        event, *fields = EVENTS[type(happening)]
        record: dict[str, object] = {"event": event}
        if isinstance(happening, hp.Started):
            record |= self._header()
        for field in fields:
            value = getattr(happening, field)
            if field == "state":
                record[field] = self._dynamics.show(value)
            elif value or field not in OPTIONAL:
                name, written = WRITTEN.get(field, (field, None))
                record[name] = value if written is None else written(value)
        return record

    def _header(self) -> dict[str, object]:
        theory = self._dynamics.theory
        return {
            "format": FORMAT,
            "golc": _version(),
            "at": datetime.now(UTC).isoformat(timespec="milliseconds"),
            "file": str(Path(theory.source.name).resolve()),
            "domain": theory.name,
            "fingerprint": fingerprint(theory),
            **self._program,
        }


def _version() -> str:
    try:
        return version("golc")
    except PackageNotFoundError:
        return "unknown"


def _create(path: Path) -> int:
    """A new file, or an empty one, or something that is no file (a pipe, the null device)."""
    try:
        file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
    except OSError as error:
        raise unwritable(path, error) from error
    status = os.fstat(file)
    if stat.S_ISREG(status.st_mode) and status.st_size > 0:
        os.close(file)
        raise FileExistsError(path)
    return file
