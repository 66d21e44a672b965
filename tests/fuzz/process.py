"""The process in which golc is tried out: it may die, hang or run out of memory."""

from __future__ import annotations

import json
import os
import re
import select
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

PROGRAM = Path(__file__).with_name("worker.py")

PATIENCE = 60.0
"""Seconds of processor time that a stage of an input may take before it is given up."""

INPUTS = 400
"""How many inputs a process is given, so that what it keeps in memory for good can be told apart."""


class Worker:
    """A process of ``worker.py``, started anew when it has died."""

    def __init__(self, seed: int, folder: Path, megabytes: int) -> None:
        self._arguments = [str(seed), str(folder), str(megabytes)]
        self._process: subprocess.Popen[bytes] | None = None
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115
        self._asked = 0

    def ask(self, number: int) -> dict[str, Any]:
        """What became of an input, with a ``fault`` if that is one."""
        process = self._started()
        assert process.stdin is not None and process.stdout is not None
        process.stdin.write(b"%d\n" % number)
        process.stdin.flush()
        stage = ""
        while True:
            before = _seconds(process.pid)
            while not select.select([process.stdout], [], [], 0.5)[0]:
                if _seconds(process.pid) - before > PATIENCE:
                    return self._hung(process, stage)
            line = process.stdout.readline()
            if not line:
                break
            answer: dict[str, Any] | str = json.loads(line)
            if not isinstance(answer, str):
                return answer
            stage = answer
        process.wait()
        said = self._said()
        self._process = None
        return {"fault": said, "kind": f"died: {process.returncode} | {_innermost(said)}"}

    def close(self) -> None:
        """End the process."""
        if self._process is not None and self._process.stdin is not None:
            self._process.stdin.close()
            self._process.wait()
            self._process = None

    def _started(self) -> subprocess.Popen[bytes]:
        self._asked += 1
        if self._asked % INPUTS == 0:
            self.close()
        if self._process is None:
            self._errors.seek(0)
            self._errors.truncate()
            self._process = subprocess.Popen(
                [sys.executable, str(PROGRAM), *self._arguments],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                bufsize=0,
                stderr=self._errors,
            )
        return self._process

    def _hung(self, process: subprocess.Popen[bytes], stage: str) -> dict[str, Any]:
        self._errors.seek(0, os.SEEK_END)
        start = self._errors.tell()
        process.send_signal(signal.SIGUSR1)
        time.sleep(1)
        self._errors.seek(start)
        said = self._errors.read().decode(errors="replace")
        process.kill()
        process.wait()
        self._process = None
        return {"fault": said, "kind": f"slow: {stage} more than {PATIENCE:.0f} s | {_innermost(said)}"}

    def _said(self) -> str:
        self._errors.seek(0)
        return self._errors.read().decode(errors="replace")


def _innermost(said: str) -> str:
    """The innermost place in golc of a stack that faulthandler has written, where the innermost comes first."""
    found = re.search(r"File .*/golc/(.*)", said)
    return found.group(1) if found else ""


def _seconds(process: int) -> float:
    fields = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
