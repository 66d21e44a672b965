"""What ``golc sim`` tells of what the brick does: trouble to a person, everything to a file."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from golc.cli.console import Console

if TYPE_CHECKING:
    from golc.runtime.rcxsim.trace import Record, Trace

TROUBLE = {
    "fault": "{task}, address {address}: {problem}; the program is stopped",
    "dropped": "{why}",
    "downloaded": "{part}: {problem}",
    "request": "a request is not answered ({payload}): {problem}",
    "unknown": "the host sent number {number}, which the brick has no action for; answered 0",
    "panicked": "{why}: the brick panics until it is aborted",
    "senseless": "{action} could not be sensed, answered 0: {problem}",
}
"""What is said on stderr of records that mean trouble; of some only if they have a ``problem``."""
ONLY_WITH_PROBLEM = ("downloaded", "request")


@contextlib.contextmanager
def tracing(console: Console, file: Path | None) -> Iterator[Trace]:
    """A trace that the console tells of, and that is written to a file if one is named.

    Raises ``UserError`` if the file cannot be written.
    """
    from golc.runtime.rcxsim.trace import Trace, to_file
    from golc.syntax.text import unwritable

    if file is None:
        yield Trace(_teller(console))
        return
    try:
        stream = file.open("w", encoding="utf-8")
    except OSError as error:
        raise unwritable(file, error) from None
    with stream:
        yield Trace(_teller(console), to_file(stream))


def _teller(console: Console) -> Callable[[Record], None]:
    """A reader of the trace that tells a person of trouble, and with ``-v`` of everything."""

    def tell(record: Record) -> None:
        text = _trouble(record)
        if text is not None and console.verbosity >= 0:
            console.err(f"{record['t']:9.3f} s  {text}")
        elif console.verbosity > 0:
            details = [f"{key} {value}" for key, value in record.items() if key not in ("t", "what") and value != {}]
            console.err(f"{record['t']:9.3f} s  {record['what']:<10} " + "  ".join(details))

    return tell


def _trouble(record: Record) -> str | None:
    """What is wrong by a record, if anything is."""
    problem = record.get("problem")
    if record["what"] in ONLY_WITH_PROBLEM and not problem:
        return None
    text = TROUBLE.get(record["what"]) or ("{action}: {problem}" if problem else None)
    return None if text is None else text.format(**record)
