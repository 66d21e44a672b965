"""A terminal in a copy of the examples, in which the manual's sessions are repeated."""

from __future__ import annotations

import contextlib
import io
import os
import queue
import re
import shlex
import shutil
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from golc.cli import invoke

ROOT = Path(__file__).parents[2]
PATIENCE = 60.0
"""Real seconds after which a command that says nothing is given up."""
QUICK = ("check", "plan", "test", "gen-nqc")
"""Commands without threads and signals: they are called in this process, which takes a tenth of the time."""

TIMING = re.compile(r"(?:\b\d+\.\d+|\b\d+) s\b")
RECORDED = re.compile(r'"(time|duration)": ?\d+(\.\d+)?')


class MismatchError(AssertionError):
    """A command did not write what the manual says."""


class Terminal:
    """Runs commands one after the other in one folder, and compares what they write with what the manual shows.

    In what is expected, timings match every timing; ``…`` matches any part of a line, and alone on a line any number of
    lines. ``> text`` is typed when all lines before it have come; ``> ^C`` interrupts.
    """

    def __init__(self, folder: Path, chdir: Callable[[Path], None]) -> None:
        self.folder = folder
        self._environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "COLUMNS": "80"}
        self._background: list[_Process] = []
        self._code = 0
        shutil.copytree(ROOT / "examples", folder / "examples", ignore=shutil.ignore_patterns("build"))
        (folder / "bin").mkdir()
        for name, arguments in (("golc", "-m golc"), ("python", "")):
            command = folder / "bin" / name
            command.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} {arguments} "$@"\n')
            command.chmod(0o755)
        chdir(folder)

    def perform(self, command: str, expected: list[str]) -> None:
        """Run a command; raises ``MismatchError`` if it does not write what is expected."""
        words = _words(command)
        if words is not None and words[0] == "golc" and (len(words) == 1 or words[1] in (*QUICK, "--help")):
            self._in_here(words[1:], expected)
        elif command.endswith("&"):
            process = self._start(["bash", "-c", f"exec {command.rstrip('& ')}"])
            self._background.append(process)
            _compare(expected, process, whole=False)
        else:
            simple = words is not None and words[0] == "golc"
            arguments = [sys.executable, "-m", "golc", *(words or [])[1:]]
            process = self._start(arguments if simple else ["bash", "-c", f"(exit {self._code}); {command}"])
            try:
                _compare(expected, process, whole=True)
            finally:
                self._code = process.end()

    def close(self) -> None:
        """End what runs in the background."""
        for process in self._background:
            process.type("^C")
            process.end()

    def _in_here(self, arguments: list[str], expected: list[str]) -> None:
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            self._code = invoke(arguments)
        _compare(expected, _Written(output.getvalue()), whole=True)

    def _start(self, arguments: list[str]) -> _Process:
        return _Process(arguments, self.folder, self._environment)


def _words(command: str) -> list[str] | None:
    """The words of a simple command; None if it needs a shell."""
    lexer = shlex.shlex(command, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    words = list(lexer)
    return None if "$" in command or any(word and set(word) <= set("();<>|&") for word in words) else words


class _Written:
    """Output that is complete already."""

    def __init__(self, text: str) -> None:
        self._lines = iter(text.splitlines())

    def line(self) -> str | None:
        return next(self._lines, None)

    def type(self, text: str) -> None:
        raise MismatchError(f"nobody reads {text!r}")


class _Process:
    """A command with a terminal as its standard input, so that it takes somebody to be there."""

    def __init__(self, arguments: list[str], folder: Path, environment: dict[str, str]) -> None:
        self._keyboard, terminal = os.openpty()
        self._popen = subprocess.Popen(
            arguments,
            cwd=folder,
            env=environment,
            stdin=terminal,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        os.close(terminal)
        self._lines: queue.Queue[str | None] = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        assert self._popen.stdout is not None
        for line in self._popen.stdout:
            self._lines.put(line.rstrip("\n"))
        self._lines.put(None)

    def line(self) -> str | None:
        """The next line of its output, or None at the end."""
        try:
            return self._lines.get(timeout=PATIENCE)
        except queue.Empty:
            raise MismatchError(f"the command has said nothing for {PATIENCE:g} s") from None

    def type(self, text: str) -> None:
        """Type a line, or press Ctrl-C."""
        if text == "^C":
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self._popen.pid, signal.SIGINT)
        else:
            os.write(self._keyboard, text.encode() + b"\n")

    def end(self) -> int:
        """Its exit code; a command that does not end by itself is killed."""
        try:
            return self._popen.wait(10)
        except subprocess.TimeoutExpired:
            os.killpg(self._popen.pid, signal.SIGKILL)
            return self._popen.wait()
        finally:
            os.close(self._keyboard)


def _compare(expected: list[str], output: _Written | _Process, whole: bool) -> None:
    """Match lines as they come; ``whole``: nothing may follow the last one."""
    seen: list[str] = []
    skipping = False
    for wanted in expected:
        if wanted == "…":
            skipping = True
        elif wanted == ">" or wanted.startswith("> "):
            output.type(wanted[2:])
        else:
            while not _fits(wanted, line := output.line()):
                _shown(seen, line)
                if line is None or not skipping:
                    raise MismatchError(_difference(wanted, line, seen))
            _shown(seen, line)
            skipping = False
    while whole and (line := output.line()) is not None:
        _shown(seen, line)
        if not skipping:
            raise MismatchError(_difference("the end", line, seen))


def _shown(seen: list[str], line: str | None) -> None:
    if line is not None:
        seen.append(line)


def _difference(wanted: str, line: str | None, seen: list[str]) -> str:
    came = "the end of the output" if line is None else repr(line)
    return "\n".join([f"expected: {wanted!r}", f"but came: {came}", "after:", *seen])


def _fits(wanted: str, line: str | None) -> bool:
    if line is None:
        return False
    pattern = ".*".join(map(re.escape, _plain(wanted).split("…")))
    return re.fullmatch(pattern, _plain(line)) is not None


def _plain(line: str) -> str:
    """A line without its timings, and in lines with timings without the spaces that depend on them."""
    plain = RECORDED.sub(r'"\1":T', TIMING.sub("T s", line.rstrip()))
    return plain if plain == line.rstrip() else re.sub(" +", " ", plain)


@pytest.fixture
def terminal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Terminal]:
    """A terminal in an empty folder with a copy of ``examples``."""
    monkeypatch.setenv("COLUMNS", "80")
    opened = Terminal(tmp_path, monkeypatch.chdir)
    yield opened
    opened.close()
