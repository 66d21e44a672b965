"""The user's NQC files of a brick: where they are, and what they define together."""

from __future__ import annotations

import errno
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from golc.diagnostics import Code, Diagnostic, Source, Span, UserError
from golc.nqc.files import is_untouched
from golc.nqc.source import EMPTY, Definition, NqcSource, scan
from golc.theory.theory import Device

CONTROL = "control.nqh"
"""The event loop, under the name by which Legolog's applications include it."""


def user_file(device: Device) -> Path | None:
    """Where a brick's own NQC file is, or is to be."""
    return None if device.file is None else Path(device.folder) / device.file


def read_nqc(path: Path) -> Source | None:
    """An NQC file as a source; None if there is none. Raises UserError if it cannot be read.

    Old files have all sorts of encodings in their comments, and NQC does not care: bytes that are no UTF-8 are taken as
    Latin-1.
    """
    try:
        if path.exists() and not path.is_file() and not path.is_dir():  # a pipe or a device, which may never end
            raise OSError(errno.EINVAL, "it is no file")
        data = path.read_bytes()
    except (FileNotFoundError, NotADirectoryError):
        return None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        span = Span(Source(str(path), ""), 0, 0)
        raise UserError(Diagnostic(Code.UNREADABLE, f"`{path}` cannot be read: {reason}", span)) from error
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return Source(str(path), text)


def scan_file(path: Path) -> NqcSource | None:
    """The names of an NQC file and of those that it includes from its own folder; None if there is no such file."""
    source = read_nqc(path)
    if source is None:
        return None
    return scan(source, lambda name: None if Path(name).name == CONTROL else read_nqc(path.parent / name))


def merge(sources: Sequence[NqcSource]) -> NqcSource:
    """Several files as one program has them."""
    if not sources:
        return EMPTY
    definitions: dict[str, Definition] = {}
    variables: dict[str, Span] = {}
    macros: dict[str, str] = {}
    for source in sources:
        definitions = {**source.definitions, **definitions}
        variables = {**source.variables, **variables}
        macros = {**source.macros, **macros}
    return NqcSource(
        tuple(text for source in sources for text in source.sources),
        definitions,
        variables,
        macros,
        frozenset().union(*(source.words for source in sources)),
        frozenset().union(*(source.includes for source in sources)),
    )


@dataclass(frozen=True)
class UserFiles:
    """The NQC files of a brick: ``own`` is the device's, if it is there; ``edited`` are stubs that somebody has filled
    in; ``fresh`` is the first name that is free for new stubs; ``all`` is what they define together."""

    own: NqcSource | None
    edited: tuple[Path, ...]
    fresh: Path
    all: NqcSource


def program_name(domain: str, device: Device) -> str:
    """How the generated files of a brick begin."""
    return f"{domain}-{device.name}"


def user_files(domain: str, device: Device, folder: Path) -> UserFiles:
    """The files of a brick whose program goes into a folder. Raises UserError if one cannot be read."""
    path = user_file(device)
    own = None if path is None else scan_file(path)
    edited: list[Path] = []
    while not is_untouched(fresh := folder / f"{program_name(domain, device)}-stubs{_number(len(edited))}.nqc"):
        edited.append(fresh)
    found = [nqc for nqc in (own, *map(scan_file, edited)) if nqc is not None]
    return UserFiles(own, tuple(edited), fresh, merge(found))


def _number(before: int) -> str:
    return str(before + 1) if before else ""
