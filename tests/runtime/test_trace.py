"""What a run says about itself."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from golc.diagnostics import DeviceError, Diagnostic
from golc.loading import load
from golc.runtime.loop.happenings import Remedy
from golc.runtime.loop.inbox import Closed, Refusal, Report
from golc.runtime.loop.policy import Policy
from golc.runtime.observers.trace import Style, Trace
from golc.situation.summary import summary
from golc.theory.theory import BasicActionTheory

Start = Callable[..., Any]


def traced(run: Any, verbosity: int = 0, style: Style | None = None) -> list[str]:
    """The lines of a run without the times at their beginnings, which are all the same."""
    lines: list[str] = []
    complaints: list[Diagnostic] = []
    trace = Trace(run.executive.dynamics, style or Style(False, True), verbosity, lines.append, complaints.extend)
    run.executive.observers.append(trace)
    with contextlib.suppress(DeviceError):
        run.run()
    lines += [f"complaint: {complaint.message}" for complaint in complaints]
    return [line.removeprefix("   0.00 s  ") for line in lines]


def arriving(run_of: list[Any]) -> Callable[[str, tuple[object, ...]], tuple[()]]:
    """A world in which the robot arrives and the button is pushed at once."""
    answers = {"start_to_next_station": "arrive_at_station", "signal_arrival": "push_go_button"}

    def perform(action: str, args: tuple[object, ...]) -> tuple[()]:
        if action in answers:
            run_of[0].inbox.batches.append([Report(answers[action], (), "rcx")])
        return ()

    return perform


def test_the_beginning_of_a_delivery(start: Start, delivery: BasicActionTheory) -> None:
    run_of: list[Any] = []
    run_of.append(start(delivery, perform=arriving(run_of)))

    lines = traced(run_of[0])

    assert lines[:10] == [
        "           location = 3, direction = 1, motion = stopped",
        "           holding_delivery_for holds for 4, 6",
        "           every delivery_requested = none",
        "→ start_to_next_station        world         delivery.gl:55 head: if direction = d",
        "  ✓ 0.00 s                                   motion stopped → moving",
        "  … wait until motion != moving              delivery.gl:71 control",
        "← arrive_at_station            rcx           location 3 → 4, motion moving → stopped",
        "→ signal_arrival               world         delivery.gl:73 control: on stop_requested(location)",
        "  … wait                                     delivery.gl:75 control",
        "← push_go_button               rcx           holding_delivery_for(4) true → false",
    ]
    assert lines[-5:] == [
        "end: idle: the program waits, at line 81",
        "           11 actions and 10 exogenous actions in 0.0 s",
        "           location = 1, direction = -1, motion = stopped",
        "           holding_delivery_for holds for nothing",
        "           every delivery_requested = none",
    ]


def test_statements_of_two_files_are_not_taken_for_each_other(start: Start, tmp_path: Path) -> None:
    main = 'domain main\nimport "part.gl"\nproc control:\n    step\n    other\n'
    part = "domain part\n# rest\naction step\nproc other:\n    step\n"
    assert main.rindex("step") == part.rindex("step")
    (tmp_path / "main.gl").write_text(main)
    (tmp_path / "part.gl").write_text(part)

    lines = traced(start(load(tmp_path / "main.gl")))

    assert [line.split()[-2:] for line in lines if "→" in line] == [["main.gl:4", "control"], ["part.gl:5", "other"]]


def test_it_fits_a_terminal_without_unicode(start: Start, delivery: BasicActionTheory) -> None:
    run_of: list[Any] = []
    run_of.append(start(delivery, perform=arriving(run_of)))

    assert "".join(traced(run_of[0], style=Style(False, False))).isascii()


def test_color_is_only_added(start: Start, delivery: BasicActionTheory) -> None:
    def run() -> Any:
        run_of: list[Any] = []
        run_of.append(start(delivery, perform=arriving(run_of)))
        return run_of[0]

    colored = traced(run(), style=Style(True, True))

    assert any("\x1b" in line for line in colored)
    plain = [re.sub(r"\x1b\[[0-9;]*m", "", line).removeprefix("   0.00 s  ").rstrip() for line in colored]
    assert plain == traced(run())


TRIAL = """
domain trial
type colour = {red, green}
fluent x: int = 0
fluent p: bool = false
fluent seen: colour = red
action a
action look:
    senses seen
exog become(n: int):
    poss n != x
    causes x := n
exog set_p:
    poss not p
    causes p := true
proc control:
"""


def program(body: str) -> str:
    return TRIAL + "".join(f"    {line}\n" for line in body.splitlines())


def test_messages_tests_and_sensing(start: Start) -> None:
    text = program('say "x is {x}"\ntest x = 0\nlook')
    run = start(text, perform=lambda action, args: ("green",))

    assert traced(run, verbosity=1)[2:7] == [
        "  - test x = 0                               trial.gl:18 control",
        "→ look                         world         trial.gl:19 control",
        "  ✓ 0.00 s                                   answered green; seen red → green",
        "",
        "end: the program is final",
    ]


def test_an_answer_is_told_though_it_changes_nothing(start: Start) -> None:
    lines = traced(start(program("look\na"), perform=lambda action, args: ("red",) if action == "look" else ()))

    assert lines[1:4] == [
        "→ look                         world         trial.gl:17 control",
        "  ✓ 0.00 s                                   answered red",
        "→ a                            world         trial.gl:18 control",
    ]


def test_a_statement_of_more_than_39_characters_is_cut(start: Start) -> None:
    body = "test x= 0 and x = 0 and x = 0 and x < 9\ntest x = 0 and x = 0 and x = 0 and x < 9"

    assert [line[4:43] for line in traced(start(program(body)), verbosity=1)[1:3]] == [
        "test x= 0 and x = 0 and x = 0 and x < 9",
        "test x = 0 and x = 0 and x = 0 and x <…",
    ]


def test_a_blocked_program_says_why_and_for_what_it_waits(start: Start) -> None:
    run = start(program("test p\na"), [[Report("set_p", (), "tcp")]])

    lines = traced(run)

    assert lines[1:4] == [
        "  blocked; waits for test",
        "               trial.gl:17:5: `p` is false (p = false)",
        "← set_p                        tcp           p false → true",
    ]


def test_trouble_is_told_and_what_is_done_about_it(start: Start, failing: Callable[[int], Any]) -> None:
    policy = Policy(on_failure=lambda label, error: Remedy.RETRY, retry_after=0)
    run = start(program("a"), perform=failing(1), policy=policy)

    assert traced(run)[1:6] == [
        "→ a                            world         trial.gl:17 control",
        "  ✗ a does not work",
        "               = help: repair it",
        "    tries again",
        "→ a                            world         trial.gl:17 control",
    ]


def test_impossible_dropped_and_refused_events(start: Start) -> None:
    from golc.diagnostics import NOWHERE, Code

    complaint = Diagnostic(Code.EVENT, "what is that?", NOWHERE)
    batch = [
        Report("become", (0,), "tcp"),
        Refusal("x", "stdin", (complaint,)),
        Report("nothing", (), "tcp"),
        Closed("stdin"),
    ]
    run = start(program("wait"), [batch])

    lines = traced(run, verbosity=1)

    assert "← become(0)                    tcp" in lines
    assert [line.strip() for line in lines if "thinks" in line] == [
        "the theory thinks that impossible here; the world is right"
    ]
    assert "  stdin has ended" in lines
    assert lines[-2:] == ["complaint: what is that?", "complaint: `nothing` is not an exogenous action of this domain"]


def test_quiet_says_only_messages_and_trouble(start: Start, failing: Callable[[int], Any]) -> None:
    assert traced(start(program('say "hello"\na')), verbosity=-1) == ["“hello”"]
    lines = traced(start(program("a"), perform=failing(1)), verbosity=-1)
    assert lines[0] == "  ✗ a does not work"
    assert "end: a does not work" in lines


def test_the_traceback_of_foreign_code_needs_v(start: Start) -> None:
    def perform(action: str, args: object) -> tuple[()]:
        try:
            raise ValueError("inner")
        except ValueError as error:
            raise DeviceError("outer") from error

    assert not any("Traceback" in line for line in traced(start(program("a"), perform=perform)))
    assert any("Traceback" in line for line in traced(start(program("a"), perform=perform), verbosity=1))


@pytest.mark.parametrize(
    ("declarations", "lines"),
    [
        ("type t = 1..3\nfluent f(a: t): t = 2", ["every f = 2"]),
        ("type t = 1..3\nfluent f(a: t): int = a // 3", ["f(1) = 0, f(2) = 0, f(3) = 1"]),
        ("type t = 1..4\nfluent f(a: t): int = a // 4", ["f(1) = 0, f(2) = 0, f(3) = 0, f(4) = 1"]),
        ("type t = 1..5\nfluent f(a: t): int = a // 5", ["f(5) = 1, all other f = 0"]),
        ("type t = 1..2\nfluent f(a: t, b: t) = a < b", ["f holds for (1, 2)"]),
        ("fluent x: int = 1\nfluent y: bool = true", ["x = 1, y = true"]),
    ],
)
def test_a_state_in_a_few_lines(start: Start, declarations: str, lines: list[str]) -> None:
    dynamics = start(f"domain d\n{declarations}\nproc control:\n    skip\n").executive.dynamics

    assert list(summary(dynamics, dynamics.initial())) == lines
