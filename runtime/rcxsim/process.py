"""Starts a simulated brick as a child process and makes sure that it never outlives its parent."""

from __future__ import annotations

import contextlib
import os
import select
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import TracebackType
from typing import IO

import golc
from golc.diagnostics import DeviceError

READY_WITHIN = 30.0
"""Seconds for the child to load its file and say where it is: half a second, if the machine has nothing else to do."""
GONE_WITHIN = 3.0
"""Seconds from asking a child to end until it is killed."""


@dataclass(frozen=True)
class BrickOptions:
    """What ``golc sim`` is told; see its options."""

    speed: float = 1.0
    air_time: float = 1.0
    loss: float = 0.0
    garble: float = 0.0
    seed: int = 0
    events: Path | None = None
    trace: Path | None = None
    echo: bool = True
    constants: Mapping[str, str] = field(default_factory=dict)

    def arguments(self) -> list[str]:
        """The options on the command line."""
        found = [f"--speed={self.speed}", f"--air-time={self.air_time}", f"--seed={self.seed}"]
        found += [f"--loss={self.loss}", f"--garble={self.garble}", "--echo" if self.echo else "--no-echo"]
        found += [] if self.events is None else [f"--events={self.events}"]
        found += [] if self.trace is None else [f"--trace={self.trace}"]
        return found + [f"-D{name}={text}" for name, text in self.constants.items()]


class BrickProcess:
    """A simulated brick that runs; ``port`` is the path of its pseudo terminal.

    The child holds the read end of a pipe and ends when nobody holds the other: however this process ends, it does too.
    It is in a session of its own, so that Ctrl-C and a closed terminal reach it only after the host has aborted it.
    """

    def __init__(self, child: subprocess.Popen[bytes], port: str) -> None:
        self._child = child
        self.port = port

    @property
    def pid(self) -> int:
        return self._child.pid

    def close(self) -> None:
        """End the child and wait until it is gone."""
        _end(self._child)

    def __enter__(self) -> BrickProcess:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def spawn(path: str | Path, options: BrickOptions | None = None, within: float = READY_WITHIN) -> BrickProcess:
    """Start a simulated brick for a domain file; raises DeviceError if it is not ready within so many seconds."""
    arguments = ["sim", *(options or BrickOptions()).arguments(), "--until-stdin-closes", "--quiet", "--", str(path)]
    with tempfile.TemporaryFile() as complaints:
        child = _start(arguments, complaints)
        try:
            line = _ready_line(child, within)
        except BaseException:
            _end(child)
            raise
        kind, _, port = line.partition(" ")
        if kind == "pty" and port:
            return BrickProcess(child, port)
        _end(child)
        complaints.seek(0)
        said = complaints.read().decode(errors="replace").strip()
    raise DeviceError("the simulated brick did not start" + (f":\n{said}" if said else ""))


def _start(arguments: Sequence[str], complaints: IO[bytes]) -> subprocess.Popen[bytes]:
    """The child, which finds the same golc as this process, and no module of the current directory."""
    home = str(Path(golc.__file__).parent.parent)
    rest = os.environ.get("PYTHONPATH")
    return subprocess.Popen(
        [sys.executable, "-P", "-m", "golc", *arguments],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=complaints,
        env={**os.environ, "PYTHONIOENCODING": "utf-8", "PYTHONPATH": f"{home}{os.pathsep}{rest}" if rest else home},
        start_new_session=True,
    )


def _ready_line(child: subprocess.Popen[bytes], within: float) -> str:
    """The first line that a child prints; what there is of it at the deadline or at the child's end."""
    assert child.stdout is not None
    deadline = time.monotonic() + within
    text = b""
    while b"\n" not in text and (left := deadline - time.monotonic()) > 0:
        if not select.select([child.stdout], [], [], left)[0]:
            break
        if not (data := os.read(child.stdout.fileno(), 4096)):
            break
        text += data
    return text.decode(errors="replace").partition("\n")[0] if b"\n" in text else ""


def _end(child: subprocess.Popen[bytes]) -> None:
    assert child.stdin is not None and child.stdout is not None
    with contextlib.suppress(OSError):
        child.stdin.close()
    for insist in (child.terminate, child.kill):
        try:
            child.wait(GONE_WITHIN)
            break
        except subprocess.TimeoutExpired:
            insist()
    child.wait()
    child.stdout.close()
