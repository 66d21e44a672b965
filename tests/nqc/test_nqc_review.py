"""What ``golc check`` says of a brick and its NQC files, as a user sees it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from golc.cli import invoke
from golc.loading import load

DOMAIN = """\
domain robot

type bay = 1..3
fluent at: bay = 1
fluent moving = false
fluent rung = false

action drive:
    poss not moving
    causes moving := true

action ring(b: bay):
    causes rung := true

exog arrived:
    poss moving
    causes moving := false

exog bumped

proc control:
    drive
    wait until not moving
    ring(at)

device rcx "robot.nqc":
    0 drive by start goOn
    1 .. ring(b: bay) by call ringAt
    4 arrived
    5 bumped
"""

NQC = """\
task goOn() { OnFwd(OUT_A); Wait(100); golc_report(EXOG_arrived); }
void ringAt(int b) { PlayTone(440, b); }
task watch() { while (true) { Wait(1); if (SENSOR_1 == 1) golc_report(EXOG_bumped); } }
"""

Check = Callable[[str, str], list[str]]


@pytest.fixture
def check(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Check:
    """The findings of ``golc check robot.gl``: place, head and help of each."""
    monkeypatch.chdir(tmp_path)

    def run(domain: str, nqc: str) -> list[str]:
        (tmp_path / "robot.gl").write_text(domain)
        if nqc:
            (tmp_path / "robot.nqc").write_text(nqc)
        invoke(["check", "robot.gl"])
        out = capsys.readouterr().out.splitlines()
        kept = [line.strip() for line in out if "[GL" in line or line.strip().startswith(("-->", "= help"))]
        return [line.removeprefix("--> ").removeprefix("= help: ") for line in kept]

    return run


def test_a_brick_whose_files_fit_has_no_finding(check: Check) -> None:
    assert check(DOMAIN, NQC) == []


def test_a_file_that_is_not_there_yet_is_no_finding(check: Check) -> None:
    assert check(DOMAIN, "") == []


@pytest.mark.parametrize(
    ("old", "new", "found"),
    [
        pytest.param(
            "call ringAt",
            "call ringtA",
            [
                "warning[GL096]: `ringtA` is not in the NQC files of `rcx`",
                "robot.gl:28:31",
                "did you mean `ringAt`?",
            ],
            id="misspelt behaviour",
        ),
        pytest.param(
            "start goOn",
            "start proceed",
            [
                "warning[GL096]: `proceed` is not in the NQC files of `rcx`",
                "robot.gl:27:22",
                "write `task proceed()` there",
            ],
            id="missing behaviour",
        ),
        pytest.param(
            "robot.nqc",
            "robto.nqc",
            ["warning[GL096]: there is no NQC file `robto.nqc`", "robot.gl:26:8", "did you mean `robot.nqc`?"],
            id="misspelt file",
        ),
        pytest.param(
            "start goOn",
            "call goOn",
            ["error[GL096]: `goOn` is a task, which cannot be called", "robot.gl:27:21", "write `by start goOn`"],
            id="task that is called",
        ),
        pytest.param(
            "call ringAt",
            "call goOn",
            [
                "error[GL096]: `goOn` is called for one action and started for another",
                "robot.gl:28:31",
            ],
            id="behaviour used in two ways",
        ),
        pytest.param(
            "    poss moving\n    causes moving := false",
            "    causes at := 2",
            [
                "warning[GL087]: `drive` starts a task, but no exogenous action has to do with `moving`, "
                "so that nothing tells its end",
                "robot.gl:26:22",
                "let one of what the brick reports ask for it or change it, or use `by call` to wait for the end",
            ],
            id="task without an end",
        ),
        pytest.param(
            "1 .. ring(b: bay)",
            "14 .. ring(b: bay)",
            [
                "note[GL081]: the number 16 of `ring` takes several messages, as all from 16 on",
                "robot.gl:28:11",
                "number the actions from 0 to 15, and what the brick reports after them",
            ],
            id="number of several messages",
        ),
        pytest.param(
            "4 arrived",
            "2 arrived",
            [
                "error[GL082]: `arrived` takes number 2, which `ring` has already",
                "robot.gl:29:7",
                "4 is free",
            ],
            id="one number for two things",
        ),
        pytest.param(
            "    0 drive by start goOn\n",
            "",
            [
                "error[GL080]: no device does `drive`",
                "robot.gl:8:8",
                "bind it in a device's block; `device self:` with the line `drive` is for mere bookkeeping",
            ],
            id="action without a device",
        ),
        pytest.param(
            "exog bumped",
            "exog bumped\nexog called from rcx",
            [
                "error[GL086]: no device reports `called`, which may come only from rcx",
                "robot.gl:20:6",
                "write a line `called` in the brick's block",
            ],
            id="event that no device reports",
        ),
    ],
)
def test_a_mistake_in_the_domain_is_one_finding(check: Check, old: str, new: str, found: list[str]) -> None:
    assert old in DOMAIN
    assert check(DOMAIN.replace(old, new, 1), NQC) == found


@pytest.mark.parametrize(
    ("old", "new", "found"),
    [
        pytest.param(
            "void ringAt(int b)",
            "void ringAt()",
            [
                "error[GL096]: `ringAt` takes no arguments, but `ring` has 1",
                "robot.gl:28:31",
                "write `void ringAt(int a)`, one `int` for each argument",
            ],
            id="missing parameter",
        ),
        pytest.param(
            "Wait(1); ",
            "",
            [
                "warning[GL097]: a loop in task `watch` never rests, which makes the brick answer late",
                "robot.nqc:3:16",
                "put a `Wait(1);` into it: 10 ms, in which the other tasks get their turn",
            ],
            id="loop without rest",
        ),
        pytest.param(
            "golc_report(EXOG_bumped)",
            "PlaySound(1)",
            [
                "warning[GL086]: nothing in the NQC files reports `bumped`",
                "robot.gl:30:7",
                "write `golc_report(EXOG_bumped);` where it happens",
            ],
            id="event that no behaviour reports",
        ),
        pytest.param(
            "EXOG_bumped",
            "EXOG_bumpd",
            [
                "error[GL088]: `EXOG_bumpd` is no exogenous action of the device",
                "robot.nqc:3:71",
                "did you mean `EXOG_bumped`?",
            ],
            id="misspelt event",
        ),
        pytest.param(
            "task watch",
            "task main",
            [
                "error[GL088]: `main` is a name of the control program",
                "robot.nqc:3:6",
                "the task `main` is generated; `void initialize()` is called when it starts",
            ],
            id="name of the control program",
        ),
        pytest.param(
            "void ringAt",
            "".join(f"sub s{number}() {{ Wait(1); }}\n" for number in range(9)) + "void ringAt",
            [
                "error[GL095]: the program has 9 subs, but a brick has 8",
                "robot.nqc:10:5",
                "make some of them functions: `void` instead of `sub`",
            ],
            id="too many subs",
        ),
    ],
)
def test_a_mistake_in_the_nqc_file_is_one_finding(check: Check, old: str, new: str, found: list[str]) -> None:
    assert old in NQC
    assert check(DOMAIN, NQC.replace(old, new, 1)) == found


def test_loops_without_rest_are_found_one_by_one_and_the_innermost_alone(check: Check) -> None:
    loops = "while (SENSOR_2 == 0) { } while (SENSOR_2 == 1) { while (SENSOR_3 == 0) { } }"
    found = check(DOMAIN, NQC.replace("while (true)", f"{loops} while (true)"))
    assert [line for line in found if line.startswith("robot.nqc")] == ["robot.nqc:3:16", "robot.nqc:3:66"]


def test_stubs_that_somebody_has_filled_in_count(check: Check, tmp_path: Path) -> None:
    (tmp_path / "build").mkdir()
    (tmp_path / "build" / "robot-rcx-stubs.nqc").write_text("void ringAt(int b) { Wait(b); }\n")
    assert check(DOMAIN, NQC.replace("void ringAt", "void ringOnce")) == []


def test_what_plans_without_a_brick_does_not_look_into_nqc_files(tmp_path: Path) -> None:
    (tmp_path / "robot.gl").write_text(DOMAIN)
    (tmp_path / "robot.nqc").write_text("task main() { }\n")
    assert load(tmp_path / "robot.gl").name == "robot"


def test_a_note_is_counted_and_no_warning(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "robot.gl").write_text(DOMAIN.replace("1 .. ring", "14 .. ring"))
    (tmp_path / "robot.nqc").write_text(NQC)
    assert invoke(["check", "--strict", str(tmp_path / "robot.gl")]) == 0
    assert capsys.readouterr().err == "checked 1 file: 1 note\n"
