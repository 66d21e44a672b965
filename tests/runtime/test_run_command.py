"""``golc run``: a real process, a real brick's frames on a real pty."""

from __future__ import annotations

import fcntl
import json
import os
import re
import signal
import socket
import subprocess
import sys
import termios
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from golc.cli import invoke

ROOT = Path(__file__).parent.parent.parent
DELIVERY = ROOT / "examples/delivery/delivery.gl"
ABORT, START, SIGNAL = 81, 34, 33
PATIENCE = 60.0
"""Seconds after which a test gives up; nothing takes nearly as long."""


class Golc:
    """A ``golc run`` under way."""

    def __init__(self, *arguments: object, **options: Any) -> None:
        command = [sys.executable, "-m", "golc", "run", *map(str, arguments)]
        pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
        self.process = subprocess.Popen(command, text=True, **{**pipes, **options})
        self._patience = threading.Timer(PATIENCE, self.process.kill)
        self._patience.start()

    def type(self, line: str) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def until(self, text: str) -> str:
        """What it prints up to the line that contains a text."""
        assert self.process.stdout is not None
        printed = ""
        for line in self.process.stdout:
            printed += str(line)
            if text in line:
                return printed
        raise AssertionError(f"{text!r} was never printed, but {printed} and {self.process.communicate()}")

    def end(self) -> tuple[int, str, str]:
        """Exit code and what it printed, when it has ended by itself."""
        out, err = self.process.communicate(timeout=PATIENCE)
        return int(self.process.returncode), str(out), str(err)

    def close(self) -> None:
        self._patience.cancel()
        self.process.kill()
        self.process.communicate()


@pytest.fixture
def golc() -> Iterator[Callable[..., Golc]]:
    made: list[Golc] = []

    def make(*arguments: object, **options: Any) -> Golc:
        made.append(Golc(*arguments, **options))
        return made[-1]

    yield make
    for each in made:
        each.close()


Robots = Callable[[str], Any]
Golcs = Callable[..., Golc]


def fast(robot: Any, file: Path = DELIVERY) -> list[object]:
    """The arguments for a run on a robot of a test; patience enough for a machine with other things to do."""
    return [file, "--port", robot.port, "--speed", "10"]


def journal_of(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_a_legolog_robot_delivers_and_drives_home(
    robot: Robots, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    brick = robot("willing")
    arguments = ["run", *fast(brick), "--stop-when-idle", 20, "--journal", tmp_path / "j"]

    code = invoke(list(map(str, arguments)))

    out, err = capfd.readouterr()
    assert (code, err) == (0, "")
    actions = [number for number in brick.everything() if number in (32, 33, 34)]
    assert actions == [34, 33, 34, 34, 33, 32, 34, 34, 34, 34, 34]
    assert brick.heard[0] == ABORT
    assert set(brick.heard[len(brick.heard) - brick.heard[::-1].index(START) :]) == {83, ABORT}
    assert "end: idle: the program waits, at line 81" in out
    assert "location = 1, direction = -1, motion = stopped" in out
    records = journal_of(tmp_path / "j")
    assert [record["event"] for record in (records[0], records[-1])] == ["start", "end"]
    assert [record["action"] for record in records if record["event"] == "done"][:2] == [
        "start_to_next_station",
        "signal_arrival",
    ]


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_signal_aborts_the_brick_while_an_action_runs(robot: Robots, golc: Golcs, tmp_path: Path, name: str) -> None:
    brick = robot("slow")
    run = golc(*fast(brick), "--journal", tmp_path / "j")
    brick.wait_for(START)

    run.process.send_signal(getattr(signal, name))
    code, out, err = run.end()

    assert code == 130
    assert f"end: interrupted by {name}" in out
    assert "Traceback" not in err
    heard = brick.everything()
    assert ABORT in heard[heard.index(START) :]
    assert journal_of(tmp_path / "j")[-1]["reason"] == "interrupted"


def test_ctrl_c_aborts_the_brick_while_the_program_waits(robot: Robots, golc: Golcs) -> None:
    brick = robot("lost")
    run = golc(*fast(brick))
    run.until("wait until motion != moving")

    run.process.send_signal(signal.SIGINT)
    code, out, _ = run.end()

    assert code == 130
    assert "location = 3, direction = 1, motion = moving" in out
    assert ABORT in brick.everything()[1:]


def test_a_closed_terminal_aborts_the_brick(robot: Robots, golc: Golcs, tmp_path: Path) -> None:
    brick = robot("slow")
    ours, theirs = os.openpty()

    def take_terminal() -> None:
        os.setsid()
        fcntl.ioctl(theirs, termios.TIOCSCTTY, 0)

    run = golc(
        *fast(brick),
        "--journal",
        tmp_path / "j",
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        preexec_fn=take_terminal,
    )
    os.close(theirs)
    brick.wait_for(START)

    os.close(ours)

    assert run.process.wait(PATIENCE) == 130
    heard = brick.everything()
    assert ABORT in heard[heard.index(START) :]
    assert journal_of(tmp_path / "j")[-1]["reason"] == "interrupted"


def test_when_nobody_reads_the_output_the_brick_is_aborted(robot: Robots, golc: Golcs, tmp_path: Path) -> None:
    brick = robot("willing")
    run = golc(*fast(brick), "--journal", tmp_path / "j")
    run.until("→ start_to_next_station")
    assert run.process.stdout is not None
    run.process.stdout.close()

    assert run.process.wait(PATIENCE) == 141

    assert ABORT in brick.everything()[1:]
    assert journal_of(tmp_path / "j")[-1]["message"] == "nobody reads the output any more"
    assert run.process.stderr is not None
    assert run.process.stderr.read() == ""


HOST = """
device host "helpers.py":
    turnaround by call turn
"""


def test_a_crash_of_a_python_behaviour_aborts_the_brick(robot: Robots, golc: Golcs, tmp_path: Path) -> None:
    text = DELIVERY.read_text().replace("    0 turnaround by call turnAround\n", "") + HOST
    domain = tmp_path / "delivery.gl"
    domain.write_text(text)
    (tmp_path / "helpers.py").write_text("def turn():\n    raise ValueError('no way to turn')\n")
    brick = robot("willing")

    code, out, err = golc(*fast(brick, domain), stdin=subprocess.DEVNULL).end()

    assert code == 4
    assert "`turn` failed at" in err
    assert "no way to turn" in err
    assert "Traceback" not in out + err
    heard = brick.everything()
    assert ABORT in heard[len(heard) - heard[::-1].index(SIGNAL) :]


@pytest.mark.parametrize(
    ("mood", "message"),
    [
        ("silent", "no brick answers on"),
        ("panicking", "panic"),
        ("confused", "100"),
        ("strange", "reported 9, which is the number of no action"),
        ("leaving", "has gone away"),
    ],
)
def test_a_brick_that_does_not_play_along_is_told_in_one_message(
    robot: Robots, golc: Golcs, tmp_path: Path, mood: str, message: str
) -> None:
    brick = robot(mood)

    arguments = [*fast(brick)[:-1], 30, "--journal", tmp_path / "j"]

    code, out, err = golc(*arguments, stdin=subprocess.DEVNULL).end()

    assert code == 4
    assert message in err
    assert err.count("error: ") == 1
    assert "Traceback" not in out + err
    assert journal_of(tmp_path / "j")[-1]["reason"] == "device"


def test_lines_on_standard_input_are_taken_in_or_refused(robot: Robots, golc: Golcs) -> None:
    brick = robot("willing")
    run = golc(*fast(brick))
    run.until("… wait")
    for line in ("request_delivery(2, 9)", "!stat", "request_delivery(2, 5)", "\xff"):
        run.type(line)
    run.until("request_delivery(2, 5)")
    run.type("!state")
    run.until("delivery_requested(2) = 5, all other delivery_requested = none")
    run.type("!stop")

    code, out, err = run.end()

    assert code == 0, err
    assert "end: stopped by the operator (stdin)" in out
    assert "`to` of `request_delivery` is of type station (1..6), not `9`" in err
    assert "<stdin line 1>:1:21" in err
    assert "did you mean `!state`?" in err


def test_the_operator_helps_a_robot_that_has_left_the_line(robot: Robots, golc: Golcs) -> None:
    brick = robot("clumsy")
    run = golc(*fast(brick))
    printed = run.until("? Please put me back on the line, near station 3, then press Enter")
    run.type("request_delivery(2, 5)")
    run.type("there you are")
    run.until("? press Enter, with nothing before it, when it is done")
    run.type("!state")
    run.until("motion = suspended")
    run.type("")
    printed += run.until("← arrive_at_station")
    run.type("!stop")

    code, _, err = run.end()

    assert (code, err) == (0, "")
    story = [line.split()[3] for line in printed.splitlines() if "→ " in line[:15] or "← " in line[:15]]
    assert story == [
        "start_to_next_station",
        "stop_abnormally",
        "reposition_robot",
        "request_delivery(2,",
        "start_to_next_station",
        "arrive_at_station",
    ]


def test_exogenous_actions_over_tcp(robot: Robots, golc: Golcs) -> None:
    brick = robot("willing")
    run = golc(*fast(brick), "--listen", "127.0.0.1:0")
    match = re.search(r"listening on 127\.0\.0\.1:(\d+)", run.until("listening on"))
    assert match is not None
    with socket.create_connection(("127.0.0.1", int(match[1])), PATIENCE) as client, client.makefile("rw") as stream:

        def say(line: str) -> str:
            stream.write(line + "\n")
            stream.flush()
            return stream.readline().strip()

        assert say("request_delivery(1, 2)") == "ok"
        run.until("← request_delivery(1, 2)")
        assert say("request_delivery(1, 7)").startswith("error: `to` of `request_delivery`")
        word, _, state = say("!state").partition(" ")
        assert (word, json.loads(state)["delivery_requested(1)"]) == ("ok", 2)
        assert say("!stop") == "ok"
    code, _, err = run.end()

    assert code == 0, err


def test_a_schedule_stands_for_the_operator_and_for_the_world(robot: Robots, golc: Golcs, tmp_path: Path) -> None:
    events = tmp_path / "demo.events"
    events.write_text("on start_to_next_station after 0 s: request_delivery(2, 5)\nat 9000 s: push_go_button\n")
    run = golc(*fast(robot("willing")), "--events", events)
    printed = run.until("→ turnaround")
    run.type("!stop")

    code, out, _ = run.end()

    assert code == 0
    assert re.search(r"← request_delivery\(2, 5\) +schedule", printed)
    assert "the schedule still had 1 event to come" in out


def test_the_operator_is_asked_about_a_failure_at_the_terminal(robot: Robots, golc: Golcs) -> None:
    brick = robot("confused")
    run = golc(*fast(brick), "--on-failure", "ask")
    run.until("start_to_next_station has failed: retry, next (take another way) or stop?")
    run.type("state")
    run.until("location = 3")
    run.type("stop")

    code, _, err = run.end()

    assert code == 4
    assert err.startswith("error: ")


def test_each_action_is_confirmed_with_step(robot: Robots, golc: Golcs) -> None:
    brick = robot("willing")
    run = golc(*fast(brick), "--step", "--stop-when-idle", "20")
    run.until("next is start_to_next_station")
    assert START not in brick.heard
    run.type("")
    run.until("next is signal_arrival")
    run.type("all")
    printed = run.until("← push_go_button") + run.until("← arrive_at_station")
    run.type("!stop")

    assert run.end()[0] == 0
    assert "next is" not in printed


def test_a_stop_does_not_wait_for_the_action_under_way(robot: Robots, golc: Golcs) -> None:
    brick = robot("slow")
    run = golc(*fast(brick))
    brick.wait_for(START)
    run.type("!stop")

    code, out, err = run.end()

    assert code == 0, err
    assert "end: stopped by the operator (stdin)" in out
    assert "location = 3, direction = 1, motion = stopped" in out


def test_an_abort_does_not_wait_for_the_action_under_way(robot: Robots, golc: Golcs) -> None:
    brick = robot("slow")
    run = golc(*fast(brick))
    brick.wait_for(START)
    run.type("!abort")
    run.until("the devices were told to stop (stdin: !abort)")
    run.until("→ start_to_next_station")
    run.type("!stop")

    assert run.end()[0] == 0


def test_an_abort_resets_the_brick_and_the_run_goes_on(robot: Robots, golc: Golcs) -> None:
    brick = robot("lost")
    run = golc(*fast(brick))
    run.until("wait until motion != moving")
    run.type("!abort")
    run.until("the devices were told to stop (stdin: !abort)")
    run.type("arrive_at_station")
    run.until("signal_arrival")
    run.process.send_signal(signal.SIGINT)

    assert run.end()[0] == 130
    assert brick.everything().count(ABORT) >= 3


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ([Path("/nowhere.gl")], 1, "/nowhere.gl"),
        ([DELIVERY, "contol"], 1, "did you mean `control`?"),
        ([DELIVERY, "head_for"], 1, "`head_for` takes 1 argument (n: station), not 0"),
        ([DELIVERY, "--events", "/nowhere.events"], 1, "/nowhere.events"),
        ([DELIVERY, "--speed", "0"], 2, "--speed"),
        ([DELIVERY, "--fast"], 2, "No such option"),
        ([DELIVERY, "--listen", "5000"], 2, "HOST:PORT"),
        ([DELIVERY, "--journal", DELIVERY], 2, "exists already; name another file, or remove that one first"),
        ([DELIVERY, "--port", "/nowhere/tty"], 4, "the port /nowhere/tty does not exist"),
        ([DELIVERY, "--port", str(DELIVERY)], 4, "is a regular file"),
        ([DELIVERY, "--port", "/dev/null"], 4, "/dev/null is not a serial port"),
    ],
)
def test_what_cannot_be_run_is_told_in_one_message(
    capfd: pytest.CaptureFixture[str], arguments: list[object], code: int, message: str
) -> None:
    assert invoke(["run", *map(str, arguments)]) == code

    out, err = capfd.readouterr()
    assert message in " ".join(err.split())
    assert "Traceback" not in out + err


def test_a_port_that_another_program_holds_is_told(robot: Robots, golc: Golcs) -> None:
    brick = robot("willing")
    first = golc(*fast(brick))
    first.until("→")

    code, _, err = golc(*fast(brick), stdin=subprocess.DEVNULL).end()

    assert code == 4
    assert "is in use" in err


SHUTTLE = """
domain shuttle
type station = 1..2
fluent location: station = 1
fluent moving: bool = false
fluent called: bool = false
action go:
    causes moving := true
exog arrive:
    causes moving := false
    causes location := 2
exog call from operator:
    causes called := true
proc control:
    wait until called
    go
    wait until not moving
device rcx "shuttle.nqc":
    3 go by start drive
    4 arrive
"""


def test_without_a_port_a_brick_is_simulated_and_that_is_said(golc: Golcs, tmp_path: Path) -> None:
    domain, events = tmp_path / "shuttle.gl", tmp_path / "demo.events"
    domain.write_text(SHUTTLE)
    events.write_text("at 1 s: call\non go after 2.5 s: arrive\n")
    arguments = [domain, "--events", events, "--speed", 5]

    code, out, err = golc(*arguments, stdin=subprocess.DEVNULL).end()

    assert (code, err) == (0, "")
    assert "on a simulated brick, 5 times as fast as a real one (no --port was given)" in out
    told = [" ".join(line.split()[2:5]) for line in out.splitlines() if "→ go" in line or "← " in line]
    assert told == ["← call schedule", "→ go rcx", "← arrive rcx"]
    assert "end: the program is final" in out
    assert "location = 2" in out


def test_quiet_says_nothing_when_all_is_well(golc: Golcs, tmp_path: Path) -> None:
    domain = tmp_path / "d.gl"
    domain.write_text("domain d\naction a\nproc control:\n    a\ndevice self:\n    a\n")

    assert golc(domain, "-q", stdin=subprocess.DEVNULL).end() == (0, "", "")


def test_a_blocked_program_without_sources_ends_with_5(golc: Golcs, tmp_path: Path) -> None:
    domain = tmp_path / "d.gl"
    domain.write_text(
        "domain d\nfluent p: bool = false\naction a:\n    causes p := true\nexog e\n"
        "proc control:\n    test p\n    a\ndevice self:\n    a\n"
    )
    code, out, err = golc(domain, stdin=subprocess.DEVNULL).end()

    assert code == 5
    assert "error[GL108]: the program is blocked" in err
    assert "`p` is false (p = false)" in err
    assert "end: the program is blocked" in out


def test_a_long_run_does_not_grow(tmp_path: Path, golc: Golcs) -> None:
    (tmp_path / "count.gl").write_text(
        """domain counting
fluent round: int = 0
fluent kept: int = 0
action go:
    causes round := round + 1
action look:
    senses kept
proc control:
    while round < 2000:
        go
    look
    say "{kept} are kept"
device self:
    go
device host "memory.py":
    look
"""
    )
    (tmp_path / "memory.py").write_text(
        """import gc
def look():
    return sum(type(thing).__name__ in ("Done", "Occurrence") for thing in gc.get_objects())
"""
    )
    code, out, _ = golc(tmp_path / "count.gl", "-q", stdin=subprocess.DEVNULL).end()
    assert code == 0 and re.search(r"\b0 are kept", out)


def test_what_is_reported_cannot_command_the_terminal(tmp_path: Path, golc: Golcs) -> None:
    (tmp_path / "greeting.gl").write_text(
        """domain greeting
fluent name: string = "nobody"
exog named(s: string):
    causes name := s
proc control:
    wait until name != "nobody"
    say "hello {name}"
"""
    )
    (tmp_path / "input").write_text('named("\x1b[2J\x9b2J\U0001f469\u200d\U0001f680")\n')
    with (tmp_path / "input").open() as lines:
        code, out, _ = golc(tmp_path / "greeting.gl", "--color", "always", stdin=lines).end()
    assert (code, "\x1b[2J" in out, "\x9b" in out) == (0, False, False)
    assert "hello \u241b[2J\ufffd2J\U0001f469\u200d\U0001f680" in out
    assert "\x1b[1m" in out
