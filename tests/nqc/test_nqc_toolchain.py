from __future__ import annotations

import re
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from golc.diagnostics import Code, DeviceError, Diagnostic, UserError
from golc.nqc.limits import LOOP_VARIABLES
from golc.nqc.program import control
from golc.nqc.toolchain import Target, Usage, check_usage, compile_program
from golc.nqc.words import API, KEYWORDS

if TYPE_CHECKING:
    from tests.nqc.conftest import Workshop

ROBOT = """\
domain robot
action go
exog arrived
device rcx "robot.nqc":
    0 go by call go
    1 arrived
"""

GO = "void go() { OnFwd(OUT_A); Wait(10); golc_report(EXOG_arrived); }\n"
BOTH = pytest.mark.parametrize("target", list(Target))
EXAMPLES = Path(__file__).parents[2] / "examples"


def refused(workshop: Workshop, nqc: str, target: Target = Target.RCX2, text: str = ROBOT) -> list[Diagnostic]:
    """What is wrong with a program whose behaviours are in a file of the user."""
    workshop.write("robot.nqc", nqc)
    with pytest.raises(UserError) as raised:
        workshop.compile(text, target)
    return list(raised.value.diagnostics)


@BOTH
def test_a_program_compiles_and_its_size_is_told(workshop: Workshop, target: Target) -> None:
    workshop.write("robot.nqc", GO)
    compiled = workshop.compile(ROBOT, target)
    assert compiled.path == workshop.folder / "build" / "robot-rcx.rcx"
    table = {(line.what, line.of): line.used for line in compiled.usage}
    assert 800 < table["bytes", 6000] < 1100
    assert table["tasks", 10] == 2
    assert table["subs", 8] == 0
    assert 14 <= table["variables", 32] <= 18
    assert (("variables", 16) in table) == (target is Target.RCX2)


@BOTH
def test_the_delivery_program_is_smaller_than_the_original(workshop: Workshop, target: Target) -> None:
    """The original takes 1,491 bytes and 23 variables for the same robot."""
    folder = EXAMPLES / "delivery"
    workshop.write("delivery.nqc", (folder / "delivery.nqc").read_text())
    compiled = workshop.compile((folder / "delivery.gl").read_text(), target)
    table = {(line.what, line.of): line.used for line in compiled.usage}
    assert table["bytes", 6000] <= 1300
    assert table["variables", 32] <= 22


@BOTH
def test_hooks_of_legolog_compile_unchanged(workshop: Workshop, target: Target) -> None:
    for name in ("hooks.nqc", "hooks.nqh"):
        workshop.write(name, (Path(__file__).parent / name).read_text())
    text = ROBOT.replace("robot.nqc", "hooks.nqc")
    assert workshop.compile(text, target).image.size < 1300


@BOTH
def test_stubs_compile(workshop: Workshop, target: Target) -> None:
    text = ROBOT + "    2 .. look(a: 1..3, b: bool) by call look {0: red, 7: blue}\n    8 run by start run\n"
    text += (
        "type colour = {red, blue}\nfluent c: colour = red\naction run\naction look(a: 1..3, b: bool):\n    senses c\n"
    )
    compiled = workshop.compile(text, target)
    assert "sensorVal = 0;" in (workshop.folder / "build" / "robot-rcx-stubs.nqc").read_text()
    assert compiled.image.size > 0


def test_the_tones_compile(workshop: Workshop) -> None:
    workshop.write("robot.nqc", GO)
    quiet = workshop.compile(ROBOT).image.size
    assert workshop.generate(ROBOT, tones=True)
    path = workshop.folder / "build" / "robot-rcx.nqc"
    where = workshop.theory(ROBOT).devices[0].span
    loud = compile_program(path, [workshop.folder / "build", workshop.folder], Target.RCX, where)
    assert loud.image.size == quiet + 8


def test_an_error_is_shown_at_its_place_in_the_users_file(workshop: Workshop) -> None:
    (error,) = refused(workshop, GO + "void f()\n{\n\tspeed = 3 + unknown;\n}\n")[:1]
    assert error.code is Code.NQC_REFUSED
    assert error.message == "nqc: undefined variable 'speed'"
    assert (Path(error.span.source.name).name, error.span.line, error.span.text) == ("robot.nqc", 4, "speed")
    assert [label.span.text for label in error.labels] == ["rcx"]


def test_an_error_in_an_included_file_is_shown_there(workshop: Workshop) -> None:
    workshop.write("more.nqh", "// one\nint a = b;\n")
    (error,) = refused(workshop, '#include "more.nqh"\n' + GO)[:1]
    assert (Path(error.span.source.name).name, error.span.line) == ("more.nqh", 2)


def test_all_errors_come_in_one_go(workshop: Workshop) -> None:
    errors = refused(workshop, GO + "void f() { Wait(a); }\nvoid g() { Wait(b); }\n")
    assert [(error.span.line, error.span.text) for error in errors] == [(2, "a"), (3, "b")]


def test_an_error_without_a_place_is_shown_at_the_device(workshop: Workshop) -> None:
    workshop.write("robot.nqc", GO + "task helper() { Wait(1); }\n")
    assert workshop.generate(ROBOT)
    path = workshop.folder / "build" / "robot-rcx.nqc"
    path.write_text(path.read_text() + "".join(f"task t{number}() {{}}\n" for number in range(10)))
    with pytest.raises(UserError) as raised:
        workshop.compile(ROBOT)
    (error,) = raised.value.diagnostics
    assert error.message == "nqc: maximum of 10 tasks exceeded"
    assert error.span.text == "rcx"


def test_a_missing_compiler_is_a_device_error(workshop: Workshop, monkeypatch: pytest.MonkeyPatch) -> None:
    workshop.write("robot.nqc", GO)
    monkeypatch.setenv("PATH", str(workshop.folder))
    with pytest.raises(DeviceError) as raised:
        workshop.compile(ROBOT)
    assert raised.value.exit_code == 4
    assert raised.value.help is not None and "apt-get install nqc" in raised.value.help


def test_a_compiler_that_fails_is_a_device_error(workshop: Workshop, monkeypatch: pytest.MonkeyPatch) -> None:
    workshop.write("robot.nqc", GO)
    tools = workshop.folder / "bin"
    tools.mkdir()
    (tools / "nqc").write_text("#!/bin/sh\nexit 7\n")
    (tools / "nqc").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tools}:/bin:/usr/bin")
    with pytest.raises(DeviceError, match="exit code 7"):
        workshop.compile(ROBOT)


def test_too_many_tasks_are_found_before_compiling(workshop: Workshop) -> None:
    tasks = "".join(f"task t{number}() {{ Wait(1); }}\n" for number in range(9))
    (error,) = refused(workshop, GO + tasks)
    assert (error.code, error.message) == (Code.NQC_LIMIT, "the program has 11 tasks, but a brick has 10")
    workshop.write("robot.nqc", GO + tasks.replace("task t8", "void t8"))
    assert workshop.compile(ROBOT).image.size > 0


def test_too_many_subs_are_found_at_the_first_that_does_not_fit(workshop: Workshop) -> None:
    (error,) = refused(workshop, GO + "".join(f"sub s{number}() {{ Wait(1); }}\n" for number in range(9)))
    assert (error.code, error.span.text) == (Code.NQC_LIMIT, "s8")
    workshop.write("robot.nqc", GO + "".join(f"sub s{number}() {{ Wait(1); }}\n" for number in range(8)))
    assert workshop.compile(ROBOT).image.size > 0


@pytest.mark.parametrize(("target", "most"), [(Target.RCX, 16), (Target.RCX2, 17)])
def test_too_many_variables_are_found_before_compiling(workshop: Workshop, target: Target, most: int) -> None:
    (error,) = refused(workshop, GO + "".join(f"int v{number};\n" for number in range(most + 1)), target)
    assert (error.code, error.message) == (Code.NQC_LIMIT, "the program has 33 variables, but a brick has 32")
    workshop.write("robot.nqc", GO + "".join(f"int v{number};\n" for number in range(most)))
    assert workshop.compile(ROBOT, target).image.size > 0


def test_too_many_events_are_found_with_what_to_do(workshop: Workshop) -> None:
    text = "domain robot\naction go\nexog request(a: 1..6, b: 1..6)\ndevice rcx\n"
    with pytest.raises(UserError) as raised:
        workshop.compile(text)
    (error,) = raised.value.diagnostics
    assert error.help is not None and "one for each combination of its arguments" in error.help


def test_a_sub_with_variables_in_two_tasks_is_found_for_firmware_1(workshop: Workshop) -> None:
    nqc = "sub s() { int a; a = Timer(0); SetPower(OUT_A, a); }\nvoid go() { s(); golc_report(EXOG_arrived); }\n"
    nqc += "task watcher() { s(); Wait(1); }\n"
    (error,) = refused(workshop, nqc, Target.RCX)
    assert error.code is Code.NQC_LIMIT
    assert error.message == "sub `s` has variables of its own and runs in the tasks watcher and golc_worker"
    assert workshop.compile(ROBOT, Target.RCX2).image.size > 0


def test_a_program_that_is_too_large_is_found_after_compiling(workshop: Workshop) -> None:
    lines = "    OnFwd(OUT_A); Wait(10);\n" * 700
    (error,) = refused(workshop, GO + f"task long()\n{{\n{lines}}}\n")
    assert error.code is Code.NQC_LIMIT
    assert "bytes, but a brick with firmware 2.0 has 6000" in error.message


def test_a_program_on_which_nqc_crashes_is_too_large(workshop: Workshop) -> None:
    lines = "    OnFwd(OUT_A); Wait(10);\n" * 7000
    (error,) = refused(workshop, GO + f"task long()\n{{\n{lines}}}\n")
    assert error.code is Code.NQC_LIMIT


def test_what_is_exactly_full_is_allowed(workshop: Workshop) -> None:
    where = workshop.theory(ROBOT).devices[0].span
    check_usage([Usage("tasks", 10, 10)], Target.RCX, where)
    with pytest.raises(UserError):
        check_usage([Usage("tasks", 11, 10)], Target.RCX, where)


def test_the_variables_of_the_event_loop_are_counted_right() -> None:
    assert sum(line.startswith("int golc_") for line in control().splitlines()) == LOOP_VARIABLES


def refuses(folder: Path, word: str) -> bool:
    """Whether the real nqc takes the word neither for a task nor for a function, for one of the firmwares."""
    for target in Target:
        for text in (f"task {word}() {{ Wait(1); }}\ntask main() {{ start {word}; }}\n", f"void {word}() {{}}\n{MAIN}"):
            (folder / "word.nqc").write_text(text)
            command = ["nqc", f"-T{target.nqc}", "-Oword.rcx", "word.nqc"]
            if subprocess.run(command, cwd=folder, capture_output=True, check=False).returncode:
                return True
    return False


MAIN = "task main() { Wait(1); }\n"


def test_nqc_refuses_every_word_of_the_list(tmp_path: Path) -> None:
    assert [word for word in sorted(KEYWORDS | API) if not refuses(tmp_path, word)] == []


def test_the_list_has_every_word_of_the_header_that_nqc_refuses(tmp_path: Path) -> None:
    header = subprocess.run(["nqc", "-api"], capture_output=True, check=True, text=True).stdout
    words = set(re.findall(r"(?:#\s*define|void|sub|int)\s+([A-Za-z]\w*)", header)) - KEYWORDS - API
    functions = "".join(f"void {word}() {{}}\n" for word in sorted(words))
    (tmp_path / "words.nqc").write_text(functions + MAIN)
    done = subprocess.run(["nqc", "-TRCX2", "-Ow.rcx", "words.nqc"], cwd=tmp_path, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    assert len(words) > 100
