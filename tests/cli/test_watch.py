"""``golc check --watch`` as a process: at a terminal, and in a pipe."""

from __future__ import annotations

import contextlib
import os
import select
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from golc.cli import invoke
from golc.cli import watching as loop
from golc.cli.reads import status

LIMIT = 120.0
"""Seconds after which something that does not come is given up."""

GOOD = "domain d\nfluent f = true\naction go:\n    causes f := not f\n"
BAD = GOOD.replace("not f", "not g")
CLEAR = "\x1b[H\x1b[2J"
READY = "Ctrl-C ends it"

Start = Callable[..., "Watcher"]


class Watcher:
    """A process that watches, and what it writes: to a terminal, or to a pipe."""

    def __init__(self, folder: Path, arguments: tuple[str, ...], terminal: bool) -> None:
        self.read, write = os.openpty() if terminal else os.pipe()
        command = [sys.executable, "-m", "golc", "check", "--watch", *arguments]
        self.process = subprocess.Popen(
            command, cwd=folder, stdin=subprocess.DEVNULL, stdout=write, stderr=write, start_new_session=True
        )
        os.close(write)
        self.said = ""
        self.place = 0

    def run(self) -> str:
        """What the next run says, until all is quiet again."""
        start = self.place
        while (end := self.said.find(READY, start)) < 0:
            assert self.more(), f"it has ended after {self.said[start:]!r}"
        self.place = end + len(READY)
        return self.said[start : self.place]

    def more(self) -> bool:
        """Read something more; whether anything came."""
        ready, _, _ = select.select([self.read], [], [], LIMIT)
        assert ready, f"nothing comes any more after {self.said!r}"
        data = b""
        with contextlib.suppress(OSError):  # what a terminal says whose other end is closed
            data = os.read(self.read, 65536)
        self.said += data.decode().replace("\r\n", "\n")
        return bool(data)

    def end(self, number: int = signal.SIGINT) -> int:
        """Send a signal as the terminal does it, to all processes; the exit code."""
        os.killpg(self.process.pid, number)
        while self.more():
            pass
        return self.process.wait(LIMIT)


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Start]:
    started: list[Watcher] = []

    def begin(*arguments: str, terminal: bool = True) -> Watcher:
        started.append(Watcher(tmp_path, arguments, terminal))
        return started[-1]

    yield begin
    for watcher in started:
        if watcher.process.poll() is None:
            os.killpg(watcher.process.pid, signal.SIGKILL)
            watcher.process.wait()
        os.close(watcher.read)


def replace(path: Path, text: str) -> None:
    """Write a file as many editors do: another one takes its place, and half of it is never seen."""
    path.with_suffix(".new").write_text(text)
    path.with_suffix(".new").replace(path)


def test_each_change_is_a_new_run(tmp_path: Path, start: Start) -> None:
    path = tmp_path / "a.gl"
    path.write_text(GOOD)
    watcher = start("a.gl")
    first = watcher.run()
    assert first.startswith(CLEAR)
    assert "golc check\n" in first
    assert "checked 1 file: nothing found\nwatching 1 file; " in first

    with path.open("r+") as file:
        file.write(BAD)
    found = watcher.run()
    assert CLEAR in found
    assert "unknown name `g`" in found

    replace(path, GOOD)
    assert "nothing found" in watcher.run()

    path.unlink()
    assert "there is no such file" in watcher.run()

    replace(path, GOOD)
    assert "nothing found" in watcher.run()
    assert watcher.end() == 130
    assert "interrupted" in watcher.said[watcher.place :]
    assert "Traceback" not in watcher.said


def test_what_a_file_names_is_watched(tmp_path: Path, start: Start) -> None:
    (tmp_path / "parts").mkdir()
    device = 'device rcx "a.nqc":\n    0 go by call walk\n'
    (tmp_path / "a.gl").write_text('domain a\nimport "parts/b.gl"\n' + device)
    watcher = start("a.gl", terminal=False)
    assert "cannot read" in watcher.run()

    replace(tmp_path / "parts" / "b.gl", GOOD)
    assert "nothing found" in watcher.run()

    replace(tmp_path / "parts" / "b.gl", BAD)
    assert "parts/b.gl:4:21" in watcher.run()

    replace(tmp_path / "parts" / "b.gl", GOOD)
    assert "nothing found" in watcher.run()

    replace(tmp_path / "a.nqc", "void walk(int far) {}\n")
    assert "GL096" in watcher.run()

    replace(tmp_path / "a.nqc", "void walk() {}\n")
    assert "nothing found" in watcher.run()
    assert watcher.end(signal.SIGTERM) == 130
    assert "\x1b" not in watcher.said


def test_python_beside_a_theory_is_read_anew(tmp_path: Path, start: Start) -> None:
    (tmp_path / "sizes.py").write_text("top = 3\n")
    (tmp_path / "lift.py").write_text(
        "from golc.embed import Theory, interval\nfrom sizes import top\n\n"
        'theory = Theory("lift")\nat = theory.fluent("at", interval(1, 3), top)\n'
        'theory.goal("home", at == 1)\n'
    )
    watcher = start("lift.py")
    assert "nothing found" in watcher.run()

    replace(tmp_path / "sizes.py", "top = 44\n")
    assert "error[GL" in watcher.run()

    replace(tmp_path / "sizes.py", "top = 2\n")
    assert "nothing found" in watcher.run()


def test_what_it_has_fixed_is_no_change(tmp_path: Path, start: Start) -> None:
    path = tmp_path / "a.gl"
    path.write_text(GOOD.replace(":=", "="))
    watcher = start("a.gl", "--fix", terminal=False)
    assert "1 finding fixed, nothing left" in watcher.run()
    assert path.read_text() == GOOD

    replace(path, BAD)
    assert "1 error" in watcher.run()
    assert watcher.end() == 130
    assert watcher.said.count("golc check\n") == 2


def test_a_format_that_is_one_whole_cannot_go_on(capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["check", "--watch", "--format", "sarif", "a.gl"]) == 2
    assert "--format sarif is one whole" in capsys.readouterr().err


def test_a_file_that_is_gone_for_a_moment_is_waited_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.gl"
    path.write_text(GOOD)
    known = {str(path): status(path)}
    steps = iter(["look", "remove", "look", "write", "look"])

    def sleep(seconds: float) -> None:
        match next(steps):
            case "remove":
                path.unlink()
            case "write":
                path.write_text(BAD)

    monkeypatch.setattr(time, "sleep", sleep)
    loop._wait(known)
    assert path.read_text() == BAD
    assert next(steps, None) is None


def test_a_file_that_stays_away_is_a_change(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.gl"
    path.write_text(GOOD)
    known = {str(path): status(path)}
    path.unlink()
    looks: list[float] = []
    monkeypatch.setattr(time, "sleep", looks.append)
    loop._wait(known)
    assert len(looks) == loop.AWAY
