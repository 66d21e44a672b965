"""The journal of a run: one JSON object a line, written before anything further happens.

Every record has ``time`` (seconds since the run began) and ``event``. Actions stand as a name and a list of arguments,
values as JSON has them (symbols are strings, ``none`` is ``null``), places as ``file:line:column``.
"""

from __future__ import annotations

import hashlib
import json
import os
import stat
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from golc.diagnostics import DeviceError, Diagnostic
from golc.program.blame import Blocked as Why
from golc.runtime.loop.happenings import (
    Begun,
    Blocked,
    Done,
    Dropped,
    Ended,
    Failed,
    Happening,
    Refused,
    Remedied,
    Reset,
    Said,
    SourceEnded,
    Started,
    Stepped,
    TakenIn,
    Waiting,
)
from golc.situation.dynamics import Dynamics
from golc.syntax.text import unwritable
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value, writable

FORMAT = 1
"""The version of the records."""


def fingerprint(theory: BasicActionTheory) -> str:
    """A short text that differs for theories that differ: made of the file's text and the values of the constants."""
    facts = [theory.source.text, *(f"{name}={constant.value!r}" for name, constant in theory.constants.items())]
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

    def __call__(self, happening: Happening) -> None:
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
        os.close(self._file)

    def _record(self, happening: Happening) -> dict[str, object]:
        match happening:
            case Started(state=state):
                return {**self._header(), "state": self._dynamics.show(state)}
            case Stepped(span=span):
                return {"event": "test", "at": str(span)}
            case Begun(device=device, span=span):
                return {"event": "begin", **_call(happening), "device": device, "at": str(span)}
            case Done(results=results, duration=duration, surprises=surprises):
                unexpected = {surprise.fluent or "?": surprise.sensed for surprise in surprises}
                return {
                    "event": "done",
                    **_call(happening),
                    "results": list(results),
                    "duration": round(duration, 6),
                    **({"surprises": unexpected} if unexpected else {}),
                }
            case TakenIn(source=source, impossible=impossible):
                return {"event": "exogenous", **_call(happening), "source": source, "impossible": impossible}
            case Waiting(span=span):
                return {"event": "wait", "at": str(span)}
            case Ended(
                end=end, message=message, state=state, actions=actions, exogenous=exogenous, unstopped=unstopped
            ):
                return {
                    "event": "end",
                    "reason": end.value,
                    "message": message,
                    "state": self._dynamics.show(state),
                    "actions": actions,
                    "exogenous": exogenous,
                    **({"unstopped": dict(unstopped)} if unstopped else {}),
                }
            case _:
                return _rare(happening)

    def _header(self) -> dict[str, object]:
        theory = self._dynamics.theory
        return {
            "event": "start",
            "format": FORMAT,
            "golc": _version(),
            "at": datetime.now(UTC).isoformat(timespec="milliseconds"),
            "file": str(Path(theory.source.name).resolve()),
            "domain": theory.name,
            "fingerprint": fingerprint(theory),
            **self._program,
        }


def _rare(happening: Happening) -> dict[str, object]:
    match happening:
        case Said(text=text, span=span):
            return {"event": "say", "text": text, "at": str(span)}
        case Failed(error=error):
            return {"event": "failed", **_call(happening), "error": str(error)}
        case Remedied(remedy=remedy):
            return {"event": "remedy", **_call(happening), "remedy": remedy.value}
        case Dropped(source=source, reason=reason):
            return {"event": "dropped", **_call(happening), "source": source, "reason": reason}
        case Refused(text=text, source=source, diagnostics=diagnostics):
            return {"event": "refused", "text": text, "source": source, "errors": [_said(d) for d in diagnostics]}
        case SourceEnded(source=source):
            return {"event": "source ended", "source": source}
        case Blocked(reasons=reasons, sources=sources):
            return {"event": "blocked", "reasons": [_why(reason) for reason in reasons], "sources": list(sources)}
        case Reset(source=source):
            return {"event": "reset", "source": source}
        case _:
            raise TypeError(f"no record for {happening!r}")


def _call(happening: Begun | Done | Failed | Remedied | TakenIn | Dropped) -> dict[str, object]:
    return {"action": happening.action, "args": list(happening.args)}


def _said(diagnostic: Diagnostic) -> str:
    return diagnostic.message + (f"; {diagnostic.help}" if diagnostic.help else "")


def _why(reason: Why) -> dict[str, object]:
    return {"at": str(reason.span), "text": reason.text, "values": dict(reason.values)}


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


def read_journal(path: Path) -> Iterator[dict[str, Any]]:
    """The records of a journal; a last line that is not whole is left out, as after a loss of power.

    Raises ``DeviceError`` for any other line that is no record.
    """
    lines = path.read_bytes().split(b"\n")
    for number, line in enumerate(lines, 1):
        try:
            record = json.loads(line)
            if not isinstance(record, dict):
                raise ValueError("no object")
        except ValueError as error:
            if number == len(lines):
                return
            raise DeviceError(f"line {number} of {path} is no record of a journal: {error}") from error
        yield record
