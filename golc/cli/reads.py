"""Which files a process reads, whatever reads them."""

from __future__ import annotations

import contextlib
import importlib.util
import os
import stat
import sys
import sysconfig
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeAlias

import golc

Status: TypeAlias = tuple[int, ...] | None
"""What tells one state of a file from another: when it was written, its size, its number; None if there is none."""

WRITING = os.O_WRONLY | os.O_RDWR
OWN = tuple(
    f"{Path(place).absolute()}{os.sep}"
    for place in (*golc.__path__, *map(sysconfig.get_path, ("stdlib", "platstdlib", "purelib", "platlib")))
)
"""Where Python and golc have files of their own."""


def status(path: str | Path) -> Status:
    """The status of a file; of what is no file, such as a pipe, always the same."""
    try:
        found = os.stat(path)  # noqa: PTH116
    except (OSError, ValueError):
        return None
    return (found.st_mtime_ns, found.st_size, found.st_ino) if stat.S_ISREG(found.st_mode) else ()


@contextlib.contextmanager
def reads() -> Iterator[Callable[[], dict[str, Status]]]:
    """Within the block: gives the files that have been opened for reading, and how they were then; also those that are
    not there. A file that this process itself has written anew counts as it is now.

    The interpreter tells of every file it opens (PEP 578), to hooks that stay as long as the process.
    """
    seen: dict[str, Status] = {}
    renamed: set[str] = set()
    on = True

    def hook(event: str, args: tuple[Any, ...]) -> None:
        if not on:
            return
        if event == "open" and isinstance(args[0], str | bytes | os.PathLike) and not _writes(*args[1:3]):
            path = _source(os.path.abspath(os.fsdecode(args[0])))  # noqa: PTH100
            if path not in seen and not path.startswith(OWN) and (found := status(path)) != ():
                seen[path] = found
        elif event == "os.rename":
            renamed.add(os.path.abspath(os.fsdecode(args[1])))  # noqa: PTH100

    def so_far() -> dict[str, Status]:
        return seen | {path: status(path) for path in seen if os.path.realpath(path) in renamed}

    sys.addaudithook(hook)
    try:
        yield so_far
    finally:
        on = False


def _writes(mode: str | None, flags: int) -> bool:
    return bool(set(mode or "") & set("wax+")) or bool(mode is None and flags & WRITING)


def _source(path: str) -> str:
    """The source of a compiled Python module; any other file itself."""
    if not path.endswith(".pyc"):
        return path
    try:
        return importlib.util.source_from_cache(path)
    except ValueError:
        return path
