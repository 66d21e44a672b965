"""Writing generated files without ever overwriting what a person has edited.

Each generated text carries a seal, a line with a number computed from the rest. Where the number still fits, nobody has
touched the file and it may be written anew; otherwise it is left alone and the new text goes beside it.
"""

from __future__ import annotations

import errno
import hashlib
import re
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from golc.syntax.text import unwritable

SEAL = "golc made this file; edit it, and golc sees by this number that it has to leave it alone: "
_OPEN = "0" * 16
_SEAL = re.compile(r"(has to leave it alone: )([0-9a-f]{16})")


class Outcome(Enum):
    """What became of a file."""

    WRITTEN = "wrote"
    KEPT = "kept"
    """It was edited: the new text is beside it."""


@dataclass(frozen=True)
class Written:
    """A file that was to be written; ``path`` is the one that has the new text."""

    path: Path
    outcome: Outcome
    kept: Path | None = None


def seal(text: str) -> str:
    """Put the number into the first seal of a text."""
    return _SEAL.sub(lambda match: match[1] + _digest(text), text, count=1)


def open_seal() -> str:
    """The line that ``seal`` completes."""
    return SEAL + _OPEN


def is_sealed(text: str) -> bool:
    """Whether a text is as golc has written it."""
    match = _SEAL.search(text)
    return match is not None and match[2] == _digest(_SEAL.sub(lambda found: found[1] + _OPEN, text, count=1))


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def is_untouched(path: Path) -> bool:
    """Whether a file may be written: there is none, or it is as golc has written it."""
    try:
        if path.exists() and not path.is_file() and not path.is_dir():  # a pipe or a device, which may never end
            raise OSError(errno.EINVAL, "it is no file")
        return is_sealed(path.read_bytes().decode())
    except FileNotFoundError:
        return True
    except UnicodeDecodeError:
        return False
    except OSError as error:
        raise unwritable(path, error) from error


def write(path: Path, text: str) -> Written:
    """Write a sealed text, or leave an edited file alone and write ``NAME.new``; raises UserError if it cannot."""
    if is_untouched(path):
        _put(path, text)
        return Written(path, Outcome.WRITTEN)
    beside = path.with_name(path.name + ".new")
    _put(beside, text)
    return Written(beside, Outcome.KEPT, path)


def remove(path: Path) -> bool:
    """Remove a file that golc wrote and nobody edited; whether there was one."""
    if not path.exists() or not is_untouched(path):
        return False
    try:
        path.unlink()
    except OSError as error:
        raise unwritable(path, error) from error
    return True


def _put(path: Path, text: str) -> None:
    """Write a file that appears only when it is complete: half of one would look as if somebody had edited it."""
    partial = path.with_name(path.name + ".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial.write_text(text, encoding="utf-8")
        partial.replace(path)
    except OSError as error:
        raise unwritable(path, error) from error
