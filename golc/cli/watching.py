"""Doing something again whenever one of the files changes that it has read.

Each run is a process of its own: it sees every file anew, Python modules among them, and tells which files it has read
and how they were then. These are looked at a few times a second, until one is not as it was read.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from collections.abc import Callable, Iterable, Mapping
from typing import TypeAlias

from golc.cli.console import Console
from golc.cli.reads import Status, reads, status
from golc.diagnostics import counted
from golc.runtime.signals import ENDING, ending_on_signals

PAUSE = 0.2
"""Seconds between two looks at the files."""

AWAY = 5
"""Looks for which a file may be gone: some editors remove it before they write it anew."""

CLEAR = "\x1b[H\x1b[2J"

Statuses: TypeAlias = Mapping[str, Status]


def watch(run: Callable[[], int], files: Iterable[str], console: Console) -> int:
    """Run, and run again after each change of what was read, until a signal ends it; ``files`` are what is watched if a
    run ends before it can tell.

    Returns in the processes of the runs only: what they end with.
    """
    known = _now(files)
    with ending_on_signals():
        while True:
            _begin(console)
            read, write = os.pipe()
            child = os.fork()
            if child == 0:
                os.close(read)
                return _run(run, write)
            os.close(write)
            known = _told(child, read) or _now(known)
            console.note(f"watching {counted(len(known), 'file')}; Ctrl-C ends it")
            _wait(known)


def _begin(console: Console) -> None:
    """On a terminal the screen is cleared; the time tells one run from another."""
    if sys.stdout.isatty():
        print(CLEAR, end="", flush=True)
    console.note(f"{time.strftime('%H:%M:%S')} golc check")


def _run(run: Callable[[], int], write: int) -> int:
    """What the process of a run does: at its end it tells what it has read."""
    for name in ENDING:
        signal.signal(getattr(signal, name), signal.SIG_DFL)
    with os.fdopen(write, "w", encoding="utf-8") as stream, reads() as found:
        try:
            return run()
        finally:
            json.dump(found(), stream)


def _told(child: int, read: int) -> Statuses:
    """What the process of a run says that it has read; nothing if it has ended before it could say so."""
    try:
        with os.fdopen(read, encoding="utf-8") as stream:
            text = stream.read()
    except BaseException:
        os.kill(child, signal.SIGTERM)
        raise
    finally:
        os.waitpid(child, 0)
    try:
        told: dict[str, list[int] | None] = json.loads(text)
    except ValueError:  # it was killed
        return {}
    return {path: None if found is None else tuple(found) for path, found in told.items()}


def _wait(known: Statuses) -> None:
    """Wait until a file is not as it was, and then until nothing changes any more."""
    while (before := _now(known)) == known:
        time.sleep(PAUSE)
    away = 0
    while True:
        time.sleep(PAUSE)
        after = _now(known)
        gone = any(after[path] is None and known[path] is not None for path in known)
        away = away + 1 if gone else 0
        if after == before and (not gone or away >= AWAY):
            return
        before = after


def _now(paths: Iterable[str]) -> Statuses:
    return {path: status(path) for path in paths}
