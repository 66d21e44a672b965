"""What ``golc check --fix`` does with the texts that fixes have changed: it writes the files, or shows a patch."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from golc.cli.console import Console
from golc.cli.files import completed, patch

if TYPE_CHECKING:
    from golc.fixing.rounds import Outcome
    from golc.fixing.texts import Changed

MARK = b"\xef\xbb\xbf"
"""The byte order mark, which a file keeps that has one."""


def tell(console: Console, outcome: Outcome[Any], would: bool) -> None:
    """Say what was fixed, and what was not and why."""
    for finding in outcome.fixed:
        console.note(f"{'would fix' if would else 'fixed'} {finding.span} {finding.code.code}: {finding.message}")
    for refused in outcome.refused:
        finding, because = refused.finding, refused.because
        reason = "the fix does not help" if because is None else f"the fix would lead to “{because.message}”"
        console.err(f"not fixed {finding.span} {finding.code.code}: {finding.message}: {reason}")


def write(console: Console, files: Iterable[Changed]) -> bool:
    """Write each file in one piece, with its permissions; whether all could be written."""
    unwritten = [file for file in files if not _write(console, file)]
    return not unwritten


def _write(console: Console, file: Changed) -> bool:
    name = file.before.name
    try:
        if not file.path.is_file():
            raise OSError(errno.EINVAL, "it is no file")
        if not os.access(file.path, os.W_OK):
            raise PermissionError(errno.EACCES, "you may not write it")
        data = file.path.read_bytes()
        mark = data.startswith(MARK)
        if data.removeprefix(MARK) != file.before.text.encode():
            raise OSError(errno.EBUSY, "it has changed meanwhile")
        with completed(file.path) as stream:
            stream.write("\ufeff" * mark + file.text)
    except OSError as error:
        console.err(f"error: `{name}` cannot be written: {error.strerror or error}")
        return False
    return True


def show(files: Iterable[Changed]) -> None:
    """The patch that makes the files what they would be."""
    for file in files:
        sys.stdout.writelines(patch(file.before.name, file.before.text, file.text, "fixed"))
    sys.stdout.flush()
