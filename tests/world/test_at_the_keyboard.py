"""Somebody at a terminal presses the robot's buttons, lifts it and puts it somewhere."""

from __future__ import annotations

import os
import pty
import select
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from golc.runtime.rcxsim.attended import AttendedPort

DELIVERY = Path(__file__).parents[2] / "examples/delivery"
DOMAIN = DELIVERY / "delivery.gl"
PATIENCE = 60.0


class Terminal:
    """A command on a terminal of its own, in its foreground."""

    def __init__(self, *arguments: object) -> None:
        command = [sys.executable, "-m", "golc", *map(str, arguments)]
        self.pid, self._master = pty.fork()
        if self.pid == 0:  # pragma: no cover (the child)
            os.environ["NO_COLOR"] = "1"
            os.execv(command[0], command)
        self.shown = ""

    def type(self, line: str) -> None:
        os.write(self._master, f"{line}\n".encode())

    def until(self, text: str) -> str:
        """What is shown up to a text, from where the last one ended."""
        deadline = time.monotonic() + PATIENCE
        while text not in self.shown:
            assert select.select([self._master], [], [], max(0.0, deadline - time.monotonic()))[0], self.shown
            try:
                self.shown += os.read(self._master, 4096).decode()
            except OSError:
                raise AssertionError(f"the end came before {text!r}: {self.shown}") from None
        before, _, self.shown = self.shown.partition(text)
        return before

    def end(self) -> int:
        """The exit code."""
        return os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])

    def close(self) -> None:
        os.close(self._master)


Open = Callable[..., Terminal]


@pytest.fixture
def terminal() -> Iterator[Open]:
    opened: list[Terminal] = []

    def start(*arguments: object) -> Terminal:
        opened.append(Terminal(*arguments))
        return opened[-1]

    yield start
    for each in opened:
        each.close()


@pytest.fixture
def alone(tmp_path: Path) -> Path:
    """The delivery world with nobody in it."""
    floor, people, _ = (DELIVERY / "delivery.toml").read_text().partition("[people]\n")
    assert people
    (tmp_path / "alone.toml").write_text(floor)
    return tmp_path / "alone.toml"


def test_the_operator_of_a_run_presses_the_button_and_carries_the_robot(terminal: Open, alone: Path) -> None:
    there = terminal("run", DOMAIN, "--world", alone, "--speed", 20)
    there.until("!press, !lift, !put")
    there.until("delivery.gl:75 control")  # it has signalled, and waits for the button
    there.type("!press go for 0.5 s")
    there.until("you: press go")
    there.until("← push_go_button")
    there.type("!lift")
    there.until("you: lift the robot")
    there.type("!put at station 6 facing backward")
    there.until("you: put at station 6, facing")
    there.type("!stop")
    there.until("end: stopped by the operator")
    assert there.end() == 0


def test_what_nobody_can_do_is_refused_with_what_can_be_done(terminal: Open, alone: Path) -> None:
    there = terminal("run", DOMAIN, "--world", alone, "--speed", 20)
    there.type("!press gp")
    there.until("error[GL111]: there is no button `gp`")
    there.until("did you mean `go`?")
    there.type("!put")
    there.until("`put` is nothing that people can do here")
    there.type("!stop")
    there.until("end: stopped")
    assert there.end() == 0


def test_without_a_world_there_is_nobody_at_the_robot(terminal: Open) -> None:
    there = terminal("run", DOMAIN, "--world", "none", "--speed", 20)
    there.type("!press go")
    there.until("unknown command `!press go`")
    there.until("there are !state, !history, !abort, !stop\r")
    there.type("!stop")
    there.until("end: stopped")
    assert there.end() == 0


def test_somebody_at_a_simulated_brick(terminal: Open, alone: Path) -> None:
    there = terminal("sim", DOMAIN, "--world", alone)
    there.until("type what you do at the robot")
    there.type("press og")
    there.until("there is no button `og`")
    there.type("press go")
    there.until("you: press go")
    there.type("put at station 5")
    there.until("you: put at station 5, facing")
    os.kill(there.pid, signal.SIGTERM)
    there.until("the robot is at station 5")
    assert there.end() == 0


def test_lines_may_come_from_a_pipe_which_ends(alone: Path) -> None:
    command = [sys.executable, "-m", "golc", "sim", str(DOMAIN), "--world", str(alone)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe, text=True) as brick:
        assert brick.stdin is not None
        assert brick.stderr is not None
        brick.stdin.write("lift\n\nput at station 2")
        brick.stdin.close()
        assert brick.stderr.readline() == "you: lift the robot\n"
        assert brick.stderr.readline().startswith("you: put at station 2")
        assert brick.poll() is None
        brick.terminate()
        assert brick.wait(PATIENCE) == 0


class Silence:
    """A port at which nobody says anything."""

    description = "pty nowhere"

    def watched(self) -> list[int]:
        return []

    def read(self, descriptor: int) -> bytes:
        return b""

    def write(self, data: bytes) -> None: ...
    def close(self) -> None: ...


def test_a_terminal_is_left_alone_in_the_background(monkeypatch: pytest.MonkeyPatch) -> None:
    master, slave = os.openpty()
    port = AttendedPort(Silence(), slave, lambda text: None)
    assert port.watched() == [slave]
    monkeypatch.setattr(os, "tcgetpgrp", lambda descriptor: os.getpgrp() + 1)
    assert port.watched() == []
    os.close(master)
    os.close(slave)
