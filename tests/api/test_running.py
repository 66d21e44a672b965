"""Runs from Python: callbacks, what comes of them, and a simulated brick that needs no file."""

from __future__ import annotations

import doctest
import importlib
import re
from pathlib import Path
from typing import Any

import pytest

import golc
from golc.api.theory import Theory
from golc.diagnostics import Findings, Source
from golc.loading import examine_file
from golc.runtime.settings import Settings
from golc.syntax.parse import parse_file

ROOT = Path(__file__).parents[2]

COUNTER = """domain counter
fluent total: int = 0
fluent colour: {dark, light} = unknown
fluent stopped = false
action add(n: 1..9):
    causes total := total + n
action look:
    senses colour
action fail
exog stop:
    causes stopped := true
proc control:
    add(2)
    look
    say "seen {colour}"
    wait until stopped
    add(3)
proc broken:
    add(1)
    fail
proc blocked:
    add(1)
    test total > 5
proc quits:
    abort "enough"
device host "hands.py":
    add(n: 1..9)
    look
    fail
"""

HANDS = """def add(n): pass
def look(): return "light"
def fail(): raise OSError("no hands")
"""


@pytest.fixture
def counter(tmp_path: Path) -> golc.Theory:
    (tmp_path / "counter.gl").write_text(COUNTER)
    (tmp_path / "hands.py").write_text(HANDS)
    return golc.load(tmp_path / "counter.gl")


STOP = ["on look after 0 s: stop"]


def test_the_example_of_the_docstring_is_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    results = doctest.testmod(importlib.import_module("golc.runtime.running"))
    assert (results.attempted, results.failed) == (4, 0)


def test_a_run_has_its_history_and_its_last_state(counter: golc.Theory) -> None:
    run = golc.run(counter, events=STOP, speed=100)
    assert run.end is golc.End.FINAL
    assert [str(entry) for entry in run.history] == ["add(2)", "look: light", "stop", "add(3)"]
    assert [(entry.exogenous, entry.source) for entry in run.history[1:3]] == [(False, None), (True, "schedule")]
    assert [entry.state["total"] for entry in run.history] == [2, 2, 2, 5]
    assert run.actions == (golc.Call("add", (2,)), golc.Call("look"), golc.Call("add", (3,)))
    assert run.messages == ("seen light",)
    assert run.error is None
    assert (run.state, dict(run.state)) == (
        run.history[-1].state,
        {"total": 5, "colour": "light", "stopped": True},
    )
    assert counter.holds(run.state, "total = 5")
    assert repr(run).startswith(
        "<Run of counter: control: the program is final, after 3 actions and 1 exogenous action in "
    )


def test_callbacks_are_told_in_order(counter: golc.Theory) -> None:
    told: list[str] = []
    seen: list[object] = []
    golc.run(
        counter,
        events=STOP,
        speed=100,
        on_action=lambda entry: told.append(f"did {entry}"),
        on_sensing=lambda entry: told.append(f"sensed {entry.sensed}"),
        on_exogenous=lambda entry: told.append(f"heard {entry}"),
        on_message=lambda text: told.append(f"said {text}"),
        observers=[seen.append],
    )
    assert told == ["did add(2)", "did look: light", "sensed ('light',)", "said seen light", "heard stop", "did add(3)"]
    assert [type(happening).__name__ for happening in seen][:3] == ["Started", "Begun", "Done"]
    assert type(seen[-1]).__name__ == "Ended"


def test_what_a_callback_raises_ends_the_run(counter: golc.Theory) -> None:
    def stop(entry: golc.Occurrence) -> None:
        raise LookupError(f"not {entry}")

    seen: list[object] = []
    with pytest.raises(LookupError, match=r"not add\(2\)"):
        golc.run(counter, on_action=stop, observers=[seen.append])
    assert [type(happening).__name__ for happening in seen] == ["Started", "Begun", "Done", "Ended"]


@pytest.mark.parametrize(
    ("program", "kind", "end", "count"),
    [
        ("broken", golc.DeviceError, golc.End.DEVICE, 1),
        ("blocked", golc.ProgramError, golc.End.FAILED, 1),
        ("quits", golc.ProgramError, golc.End.ABORTED, 0),
    ],
)
def test_a_failure_is_raised_or_kept(
    counter: golc.Theory, program: str, kind: type[golc.GolcError], end: golc.End, count: int
) -> None:
    with pytest.raises(kind):
        golc.run(counter, program)
    run = golc.run(counter, program, check=False)
    assert (type(run.error), run.end, run.state["total"]) == (kind, end, count)


@pytest.mark.parametrize(
    ("program", "events", "message"),
    [
        ("contrl", None, "unknown procedure `contrl`"),
        ("control", ["at 1 s: stopp"], "unknown exogenous action `stopp`"),
        ("control", "missing.events", "cannot read `missing.events`: there is no such file"),
    ],
)
def test_what_cannot_be_run_is_a_user_error_whatever_is_checked(
    counter: golc.Theory, program: str, events: str | list[str] | None, message: str, tmp_path: Path
) -> None:
    with pytest.raises(golc.UserError) as caught:
        golc.run(counter, program, events=events, check=False)
    assert caught.value.diagnostics[0].message == message


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        ({"speed": 0}, "the speed is 0, and has to be from 0.01 to 1000"),
        ({"speed": 0.0099}, "the speed is 0.0099, and has to be from 0.01 to 1000"),
        ({"speed": 1001}, "the speed is 1001, and has to be from 0.01 to 1000"),
        ({"stop_when_idle": -1}, "stop_when_idle is -1, and has to be a number of seconds from 0"),
        ({"stop_when_idle": float("nan")}, "stop_when_idle is nan, and has to be a number of seconds from 0"),
        ({"listen": ("127.0.0.1", 65536)}, "the port to listen at is 65536, and has to be from 0 to 65535"),
        ({"on_failure": "wait"}, "on_failure is 'wait', and has to be one of ask, retry, next, stop"),
        (
            {"port": "/dev/null", "world": "room.toml"},
            "a world and a picture are for a simulated brick, not for one at a port",
        ),
    ],
)
def test_options_that_make_no_sense_are_refused(counter: golc.Theory, options: Any, problem: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(problem)}$"):
        golc.run(counter, **options)


def test_a_run_remembers_as_much_as_it_is_told(counter: golc.Theory) -> None:
    run = golc.run(counter, events=STOP, speed=100, remember=2)
    assert [str(entry) for entry in run.history] == ["stop", "add(3)"]
    assert (run.done, run.happened, run.messages) == (3, 1, ("seen light",))
    assert "after 3 actions and 1 exogenous action" in run.summary()


def test_an_action_without_a_device_ends_a_run_with_one_line(tmp_path: Path) -> None:
    (tmp_path / "handless.gl").write_text("domain handless\naction grab\nproc control:\n    grab\n")
    run = golc.run(golc.load(tmp_path / "handless.gl"), check=False)
    assert (run.end, run.message) == (golc.End.FAILED, "no device performs `grab`")
    assert isinstance(run.error, golc.UserError)


ASKED = """domain asked
fluent name: string = "nobody"
action ask:
    senses name
action wave
proc control:
    ask
    wave
device operator:
    ask by prompt "Who is there?"
    wave by prompt "Please wave to {name}."
"""


def test_a_function_answers_for_the_operator_and_the_trace_is_written(tmp_path: Path) -> None:
    (tmp_path / "asked.gl").write_text(ASKED)
    questions: list[str] = []
    lines: list[str] = []
    answers = iter(["what?", '"Ada"', ""])

    def answer(question: str) -> str:
        questions.append(question)
        return next(answers)

    run = golc.run(golc.load(tmp_path / "asked.gl"), voice=golc.Voice(lines.append, ask=answer))
    assert run.state["name"] == "Ada"
    assert [questions[0], questions[-1]] == ["Who is there? [string]", "Please wave to Ada."]
    assert len(questions) == 3
    assert lines[0].strip() == "asked: control"
    assert any("→ ask" in line for line in lines)


def test_nobody_is_there_to_answer_and_standard_input_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "asked.gl").write_text(ASKED)
    with pytest.raises(golc.DeviceError, match="nobody is there to answer"):
        golc.run(golc.load(tmp_path / "asked.gl"))


BRICK = """domain brick
fluent at: 0..3 = 0
action drive
exog arrives:
    poss at < 3
    causes at := at + 1
proc control:
    while at < 2:
        drive
        wait
device rcx:
    drive
    arrives
"""


def test_a_theory_that_is_in_no_file_runs_on_a_simulated_brick() -> None:
    source, findings = Source("not a file", BRICK), Findings()
    file = parse_file(source, findings)
    assert file is not None
    theory = Theory(examine_file(file, (source,), findings))
    run = golc.run(theory, events=["on drive after 1 s: arrives"], speed=50)
    assert [str(entry) for entry in run.history] == ["drive", "arrives", "drive", "arrives"]
    assert run.history[1].source == "rcx"
    assert run.state["at"] == 2
    assert run.seconds > 2


def test_settings_at_their_limits() -> None:
    assert [Settings(speed=speed).speed for speed in (0.01, 1000)] == [0.01, 1000]
    assert Settings(stop_when_idle=0, listen=("127.0.0.1", 65535)).stop_when_idle == 0
