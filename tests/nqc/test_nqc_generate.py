from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from golc.diagnostics import Code, UserError
from golc.nqc.files import Outcome
from golc.nqc.program import queue_of

if TYPE_CHECKING:
    from tests.nqc.conftest import Workshop

ROBOT = """\
domain robot
type side = {left, right}
fluent light: 0..100 = 0
action turn(s: side)
action look:
    senses light
action drive(n: 1..3, s: side)
exog arrived
exog bumped(s: side)
device rcx "robot.nqc":
    0 .. turn(s: side) by call turn
    2 look by call look
    3 .. drive(n: 1..3, s: side) by start drive
    9 arrived
    10 .. bumped(s: side)
"""

BEHAVIOURS = """\
void turn(int s) { OnFwd(OUT_A + s); Wait(10); }
void look() { sensorVal = SENSOR_3; }
task drive() { OnFwd(OUT_A); Wait(golc_arg1); golc_report(EXOG_arrived); start helper; }
task helper() { Wait(1); }
task bumper() { golc_report(EXOG_bumped_left); golc_report(EXOG_bumped_right); Wait(1); }
"""


def program(workshop: Workshop) -> str:
    return (workshop.folder / "build" / "robot-rcx.nqc").read_text()


def function(text: str, name: str) -> list[str]:
    """The lines of a generated function, without indentation."""
    start = text.index(f"{name}(", text.index(f"void {name}("))
    return [line.strip() for line in text[start : text.index("\n}\n", start)].splitlines()[2:]]


def test_a_call_gets_its_arguments_and_a_task_finds_them_in_variables(workshop: Workshop) -> None:
    workshop.write("robot.nqc", BEHAVIOURS)
    assert workshop.generate(ROBOT) is not None
    text = program(workshop)
    assert "#define NUMBER_turn 0     // turn(s: side)\n#define LAST_turn 1\n" in text
    behaviour = function(text, "startBehaviour")
    assert behaviour[behaviour.index("default:") :] == [
        "default:",
        "if (number >= NUMBER_turn && number <= LAST_turn) {",
        "golc_arg1 = number - NUMBER_turn;",
        "turn(golc_arg1);",
        "}",
        "}",
    ]
    begin = function(text, "golc_begin")
    assert begin[begin.index("golc_arg1 = golc_number - NUMBER_drive;") :][:5] == [
        "golc_arg1 = golc_number - NUMBER_drive;",
        "golc_arg2 = golc_arg1 % 2;",
        "golc_arg1 /= 2;",
        "golc_arg1 += 1;     // n: 1..3",
        "start drive;",
    ]


def test_integers_reach_a_behaviour_as_they_are(workshop: Workshop) -> None:
    text = "domain robot\ntype heading = {-1, 1}\ntype odd = {1, 2, 7}\naction go(h: heading, o: odd)\n"
    assert workshop.generate(text + 'device rcx "robot.nqc":\n    0 .. go(h: heading, o: odd) by call go\n')
    begin = function(program(workshop), "startBehaviour")
    assert "golc_arg1 *= 2;" in begin
    assert "golc_arg1 += -1;     // h: heading" in begin
    assert "case 2: golc_arg2 = 7; break;" in begin


def test_constants_in_a_binding_reach_the_behaviour_too(workshop: Workshop) -> None:
    text = "domain robot\ntype side = {left, right}\naction go(s: side, n: 1..2)\nexog e\ndevice rcx:\n    9 e\n"
    text += "    0 go(right, 2) by call go\n    1 go(right, 1) by start run\n    2 .. go(left, n: 1..2) by call go\n"
    assert workshop.generate(text)
    made = program(workshop)
    assert "go(1, 2);" in function(made, "startBehaviour")
    assert "golc_arg1 = 0;" in function(made, "startBehaviour")
    begin = function(made, "golc_begin")
    assert begin[begin.index("golc_arg1 = 1;") :][:3] == ["golc_arg1 = 1;", "golc_arg2 = 1;", "start run;"]
    assert [line.split()[1] for line in made.splitlines() if line.startswith("#define NUMBER_go")] == [
        "NUMBER_go_right_2",
        "NUMBER_go_right_1",
        "NUMBER_go_left",
    ]


def test_numbers_whose_names_would_be_equal_get_different_ones(workshop: Workshop) -> None:
    text = "domain robot\ntype side = {left, right}\naction go(s: side)\naction go_left\ndevice rcx:\n"
    assert workshop.generate(text + "    0 go_left by call f\n    1 go(left) by call g\n    2 go(right) by call g\n")
    made = [line.split()[1:] for line in program(workshop).splitlines() if line.startswith("#define NUMBER_go")]
    assert made == [["NUMBER_go_left", "0"], ["NUMBER_go_left_1", "1"], ["NUMBER_go_right", "2"]]


def test_each_ground_event_has_a_counter(workshop: Workshop) -> None:
    workshop.write("robot.nqc", BEHAVIOURS)
    generated = workshop.generate(ROBOT)
    assert generated is not None
    assert [(counter.name, counter.code) for counter in generated.program.counters] == [
        ("EXOG_arrived", 1),
        ("EXOG_bumped_left", 2),
        ("EXOG_bumped_right", 3),
    ]
    assert not workshop.findings


def test_abort_stops_what_actions_have_started_but_no_monitor(workshop: Workshop) -> None:
    workshop.write("robot.nqc", BEHAVIOURS)
    assert workshop.generate(ROBOT)
    text = program(workshop)
    assert function(text, "stopAllBehaviours") == ["stop drive;", "stop helper;", "Off(OUT_A + OUT_B + OUT_C);"]
    assert function(text, "initialize") == ["start bumper;"]


def test_a_hook_of_the_user_is_not_generated(workshop: Workshop) -> None:
    workshop.write("robot.nqc", BEHAVIOURS + "void initialize() { start bumper; }\n")
    assert workshop.generate(ROBOT)
    assert "void initialize()" not in program(workshop)
    assert "void panicAction()" in program(workshop)


@pytest.mark.parametrize(
    ("numbers", "base", "depth"),
    [([3], 2, 14), ([3, 4, 5], 4, 7), ([0, 6], 8, 4), ([0, 7], 16, 3), ([0, 1000], 1024, 1), ([0, 16382], 16384, 1)],
)
def test_the_queue_is_as_deep_as_one_variable_allows(
    workshop: Workshop, numbers: list[int], base: int, depth: int
) -> None:
    exogs = "".join(f"exog e{number}\n" for number in numbers)
    lines = "".join(f"    {number} e{number}\n" for number in numbers)
    queue = queue_of(workshop.numbers(f"domain robot\n{exogs}device rcx:\n{lines}"))
    assert (queue.first, queue.base, queue.depth) == (numbers[0], base, depth)
    assert queue.full < 2**15
    assert queue.last - queue.first + 1 < queue.base


def test_events_whose_numbers_lie_too_far_apart_are_an_error(workshop: Workshop) -> None:
    assert workshop.generate("domain robot\nexog a\nexog b\ndevice rcx:\n    0 a\n    16383 b\n") is None
    assert [diagnostic.code for diagnostic in workshop.findings] == [Code.NUMBER_RANGE]


def test_the_map_says_what_each_number_means(workshop: Workshop) -> None:
    workshop.write("robot.nqc", BEHAVIOURS)
    generated = workshop.generate(ROBOT)
    assert generated is not None
    found = json.loads((workshop.folder / "build" / "robot-rcx.json").read_text())
    assert found["messages"]["action_numbers"] == {"first": 32, "last": 63}
    assert found["fingerprint"] == generated.actions.fingerprint
    rows = {row["number"]: row for row in found["actions"]}
    assert sorted(rows) == list(range(12))
    assert rows[8]["action"] == "drive"
    assert rows[8]["arguments"] == [3, "right"]
    assert rows[8]["behaviour"] == {"start": "drive"}
    assert rows[2]["results"] == "0..100"
    assert rows[11]["exogenous"] and rows[11]["arguments"] == ["right"]


def test_missing_behaviours_get_stubs_of_the_right_form(workshop: Workshop) -> None:
    workshop.write("robot.nqc", "void look() { Wait(1); }\n")
    generated = workshop.generate(ROBOT)
    assert generated is not None
    assert [stub.name for stub in generated.stubs] == ["turn", "drive"]
    stubs = (workshop.folder / "build" / "robot-rcx-stubs.nqc").read_text()
    assert "void turn(int argument1)" in stubs
    assert "task drive()" in stubs
    assert "look" not in stubs
    assert '#include "../robot.nqc"\n#include "robot-rcx-stubs.nqc"\n' in program(workshop)


def test_stubs_that_are_not_needed_any_more_are_removed(workshop: Workshop) -> None:
    assert workshop.generate(ROBOT)
    stubs = workshop.folder / "build" / "robot-rcx-stubs.nqc"
    assert stubs.exists()
    workshop.write("robot.nqc", BEHAVIOURS)
    generated = workshop.generate(ROBOT)
    assert generated is not None
    assert generated.removed == (stubs,)
    assert not stubs.exists()


def test_edited_stubs_are_kept_and_further_ones_go_into_another_file(workshop: Workshop) -> None:
    assert workshop.generate(ROBOT)
    stubs = workshop.folder / "build" / "robot-rcx-stubs.nqc"
    edited = stubs.read_text().replace("Wait(100)", "Wait(7)")
    stubs.write_text(edited)
    generated = workshop.generate(ROBOT + "    30 wave by call wave\n" + "action wave\n")
    assert generated is not None
    assert stubs.read_text() == edited
    assert [stub.name for stub in generated.stubs] == ["wave"]
    assert "void wave()" in (workshop.folder / "build" / "robot-rcx-stubs2.nqc").read_text()
    assert program(workshop).count("-stubs") == 2
    assert workshop.compile(ROBOT + "    30 wave by call wave\n" + "action wave\n").image.size > 0


@pytest.mark.parametrize("name", ["robot-rcx.nqc", "control.nqh", "robot-rcx.json"])
def test_an_edited_file_is_left_alone_and_the_new_text_goes_beside_it(workshop: Workshop, name: str) -> None:
    assert workshop.generate(ROBOT)
    path = workshop.folder / "build" / name
    fresh = path.read_text()
    path.write_text(fresh + "\n")
    generated = workshop.generate(ROBOT)
    assert generated is not None
    assert path.read_text() == fresh + "\n"
    assert Path(f"{path}.new").read_text() == fresh
    assert [written.kept for written in generated.written if written.outcome is Outcome.KEPT] == [path]
    assert Code.NQC_EDITED in [diagnostic.code for diagnostic in workshop.findings]


def test_a_file_that_golc_has_not_written_is_left_alone(workshop: Workshop) -> None:
    (workshop.folder / "build").mkdir()
    path = workshop.folder / "build" / "control.nqh"
    path.write_bytes(b"// somebody's own \xff\n")
    assert workshop.generate(ROBOT)
    assert path.read_bytes() == b"// somebody's own \xff\n"


def test_untouched_files_are_written_anew(workshop: Workshop) -> None:
    assert workshop.generate(ROBOT)
    generated = workshop.generate(ROBOT.replace("9 arrived", "20 arrived"))
    assert generated is not None
    assert all(written.outcome is Outcome.WRITTEN for written in generated.written)
    assert "#define NUMBER_arrived 20" in program(workshop)


def test_a_folder_that_cannot_be_made_is_a_user_error(workshop: Workshop) -> None:
    workshop.write("build", "a file")
    with pytest.raises(UserError, match="build"):
        workshop.generate(ROBOT)


def test_an_event_that_nothing_reports_is_a_warning(workshop: Workshop) -> None:
    workshop.write("robot.nqc", BEHAVIOURS.replace("golc_report(EXOG_arrived); ", ""))
    assert workshop.generate(ROBOT)
    assert [(found.code, found.severity.value) for found in workshop.findings] == [(Code.UNREPORTED, "warning")]


def test_a_report_of_something_unknown_is_found_at_its_place(workshop: Workshop) -> None:
    workshop.write("robot.nqc", BEHAVIOURS.replace("EXOG_arrived", "EXOG_arived"))
    assert workshop.generate(ROBOT) is None
    error = next(found for found in workshop.findings if found.severity.value == "error")
    assert (error.span.text, error.span.line, error.help) == ("EXOG_arived", 3, "did you mean `EXOG_arrived`?")


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("task main() { Wait(1); }\n", Code.NQC_NAME),
        ("int golc_state;\n", Code.NQC_NAME),
        ("int EXOG_arrived;\n", Code.NQC_NAME),
        ("#define NUMBER_look 3\n", Code.NQC_NAME),
    ],
)
def test_names_of_the_control_program_cannot_be_defined(workshop: Workshop, text: str, code: Code) -> None:
    workshop.write("robot.nqc", BEHAVIOURS + text)
    assert workshop.generate(ROBOT) is None
    assert [found.code for found in workshop.findings] == [code]


def test_the_timer_of_the_control_program_is_not_to_be_used(workshop: Workshop) -> None:
    workshop.write("robot.nqc", BEHAVIOURS + "void f() { ClearTimer(3); ClearTimer(0); }\n")
    assert workshop.generate(ROBOT)
    assert [(found.code, found.span.text) for found in workshop.findings] == [(Code.NQC_BEHAVIOUR, "ClearTimer(3")]


HOOKS = """\
domain hooks
fluent light: 0..100 = 0
action turn:
    senses light
action signal
action follow
exog arrived
exog lost
exog pushed
device rcx "hooks.nqc":
    0 turn by call spin
    1 signal by call unknown
    2 follow by start follow
    3 arrived
    4 lost
    5 pushed
"""


@pytest.fixture
def with_hooks(workshop: Workshop) -> Workshop:
    for name in ("hooks.nqc", "hooks.nqh"):
        workshop.write(name, (Path(__file__).parent / name).read_text())
    return workshop


def test_hooks_of_the_user_are_used_as_they_are(with_hooks: Workshop) -> None:
    generated = with_hooks.generate(HOOKS)
    assert generated is not None
    assert generated.program.own_hooks
    assert not generated.stubs
    text = (with_hooks.folder / "build" / "hooks-rcx.nqc").read_text()
    for hook in ("initialize", "startBehaviour", "stopAllBehaviours", "panicAction"):
        assert f"void {hook}(" not in text
    assert "int exogAction;" in text
    assert "golc_report" not in text


def test_sampled_events_are_a_warning(with_hooks: Workshop) -> None:
    assert with_hooks.generate(HOOKS)
    assert [found.code for found in with_hooks.findings] == [Code.NQC_SAMPLED]


def test_messages_of_an_application_of_legolog_must_be_those_of_the_device(with_hooks: Workshop) -> None:
    assert with_hooks.generate(HOOKS + "    set range 1\n") is None
    found = [(finding.code, finding.help) for finding in with_hooks.findings if finding.severity.value == "error"]
    assert found == [
        (Code.DEVICE_SETTING, "write `set action_base 32` in the device's block"),
        (Code.DEVICE_SETTING, "write `set value_base 64` in the device's block"),
    ]
