"""Files that a command writes: all of a file or nothing, or a patch."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from io import StringIO
from pathlib import Path
from typing import TextIO

from golc.cli.console import Console


def patch(name: str, before: str, after: str, how: str) -> Iterator[str]:
    """The lines of a patch that makes one text of a file another one; ``how`` tells the second one's name."""
    from difflib import unified_diff

    old, new = (list(StringIO(text, newline="\n")) for text in (before, after))
    for line in unified_diff(old, new, name, f"{name} ({how})"):
        yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


@contextlib.contextmanager
def completed(path: Path) -> Iterator[TextIO]:
    """A stream to a file that takes its place, with its permissions, at the end; a pipe or a device is written to and
    never replaced."""
    if path.exists() and not path.is_file():
        with path.open("w", encoding="utf-8", newline="") as stream:
            yield stream
        return
    partial = path.with_name(f".golc-{os.getpid()}.part")
    with partial.open("x", encoding="utf-8", newline="") as stream:
        try:
            yield stream
            stream.flush()
            if path.exists():
                partial.chmod(path.stat().st_mode & 0o7777)
            partial.replace(path)
        finally:
            partial.unlink(missing_ok=True)


def written(console: Console, name: str, text: str) -> bool:
    """Write the text of a file, all of it or nothing, where it really is; whether that has gone well, which is said."""
    try:
        with completed(Path(os.path.realpath(name))) as stream:
            stream.write(text)
    except OSError as error:
        console.err(f"error: `{name}` cannot be written: {error.strerror or error}")
        return False
    if console.verbosity >= 0:
        console.out(f"wrote {name}")
    return True
