from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from golc.loading import examine

if TYPE_CHECKING:
    from tests.nqc.conftest import Workshop


def codes(workshop: Workshop, text: str) -> list[str]:
    return [diagnostic.code.code for diagnostic in workshop.found(text)]


def test_a_theory_without_devices_needs_none(workshop: Workshop) -> None:
    assert codes(workshop, "domain d\naction a\nexog e from rcx\n") == []


def test_an_action_without_a_device_is_found(workshop: Workshop) -> None:
    found = workshop.found('domain d\naction a\naction b\ndevice operator:\n    a by prompt "a?"\n')
    assert [(diagnostic.code.code, diagnostic.span.text) for diagnostic in found] == [("GL080", "b")]


def test_instances_without_a_device_are_found(workshop: Workshop) -> None:
    text = "domain d\naction a(n: 1..4)\ndevice rcx:\n    0 .. a(n: 1..2)\ndevice self:\n    a(3)\n"
    found = workshop.found(text)
    assert [diagnostic.message for diagnostic in found] == ["devices do only 3 of the 4 instances of `a`"]
    assert codes(workshop, text + "    a(4)\n") == []


def test_a_brick_without_bindings_does_what_no_other_device_does(workshop: Workshop) -> None:
    assert codes(workshop, "domain d\naction a\naction b\ndevice rcx\ndevice self:\n    b\n") == []


def test_two_bricks_without_bindings_are_found(workshop: Workshop) -> None:
    text = 'domain d\naction a\ndevice rcx left "l.nqc":\n    set range 0\ndevice rcx right "r.nqc":\n    set range 1\n'
    assert codes(workshop, text) == ["GL080"]


@pytest.mark.parametrize(
    ("source", "device", "expected"),
    [
        ("", "device rcx:\n    0 a\n", []),
        (" from operator", "device rcx:\n    0 a\n", []),
        (" from rcx", "device rcx:\n    0 a\n", ["GL086"]),
        (" from rcx", "device rcx:\n    0 a\n    1 e\n", []),
        (" from rcx", "device rcx\n", []),
        (" from rcx", "device self:\n    a\n", ["GL086"]),
        (" from host", "device self:\n    a\n", ["GL086"]),
        (" from host", 'device host "a.py":\n    a\n', ["GL086"]),
        (" from left", "device rcx left:\n    0 a\n", ["GL086"]),
        (" from left", "device rcx left:\n    0 a\n    1 e\n", []),
        (" from alice", "device operator alice:\n    a\n", []),
    ],
)
def test_an_exogenous_action_is_reported_by_someone(
    workshop: Workshop, source: str, device: str, expected: list[str]
) -> None:
    assert codes(workshop, f"domain d\naction a\nexog e{source}\n{device}") == expected


@pytest.mark.parametrize("bindings", [":\n    look\n", "\n"])
def test_bookkeeping_senses_nothing(workshop: Workshop, bindings: str) -> None:
    found = workshop.found(f"domain d\nfluent x: bool = false\naction look:\n    senses x\ndevice self{bindings}")
    assert [diagnostic.message for diagnostic in found] == ["`look` senses, but the device `self` cannot answer"]


def test_a_brick_reports_only_what_may_come_from_it(workshop: Workshop) -> None:
    text = "domain d\naction a\nexog e from operator\ndevice rcx:\n    0 a\n    1 e\n"
    found = examine(workshop.write("robot.gl", text)).findings
    assert [(diagnostic.message, diagnostic.span.line) for diagnostic in found] == [
        ("`e` may come only from operator, not from `rcx`", 6)
    ]


def test_a_started_task_needs_an_end(workshop: Workshop) -> None:
    text = "domain d\naction a\nexog e\ndevice rcx:\n    0 a by start go\n"
    found = workshop.found(text)
    assert [(diagnostic.code.code, diagnostic.severity.value) for diagnostic in found] == [("GL087", "warning")]
    assert codes(workshop, text + "    1 e\n") == []


@pytest.mark.parametrize("name", ["main", "task", "OnFwd", "SENSOR_1", "initialize", "golc_go", "EXOG_a", "sensorVal"])
def test_names_that_nqc_does_not_take_are_found(workshop: Workshop, name: str) -> None:
    found = workshop.found(f"domain d\naction a\ndevice rcx:\n    0 a by call {name}\n")
    assert [(diagnostic.code.code, diagnostic.span.text) for diagnostic in found] == [("GL088", name)]


def test_an_action_whose_own_name_nqc_does_not_take_is_found(workshop: Workshop) -> None:
    assert codes(workshop, "domain d\naction stop\ndevice rcx:\n    0 stop\n") == ["GL088"]
    assert codes(workshop, "domain d\naction stop\ndevice rcx:\n    0 stop by call halt\n") == []


def test_a_name_that_is_too_long_is_found(workshop: Workshop) -> None:
    assert codes(workshop, f"domain d\naction a\ndevice rcx:\n    0 a by call {'x' * 201}\n") == ["GL088"]
    assert codes(workshop, f"domain d\naction a\ndevice rcx:\n    0 a by call {'x' * 200}\n") == []


def test_one_behaviour_is_used_in_one_way(workshop: Workshop) -> None:
    base = "domain d\naction a\naction b\naction c(n: 1..2)\nexog e\ndevice rcx:\n    9 e\n"
    assert codes(workshop, base + "    0 a by call f\n    1 b by call f\n    2 .. c(n: 1..2) by call g\n") == []
    assert codes(workshop, base + "    0 a by call f\n    1 b by start f\n    2 .. c(n: 1..2) by call g\n") == ["GL096"]
    assert codes(workshop, base + "    0 a by call f\n    1 b by call g\n    2 .. c(n: 1..2) by call f\n") == ["GL096"]


@pytest.mark.parametrize(
    "line",
    [
        *("set pol 1 s", "set poll -1 s", "set range 3", "set range -1", "set range 0.5", "set action_digits 1"),
        *("set action_digits 128", "set value_base 255", "set control_base 0", "set control_base 251"),
    ],
)
def test_settings_that_make_no_sense_are_found(workshop: Workshop, line: str) -> None:
    assert codes(workshop, f"domain d\naction a\ndevice rcx:\n    0 a\n    {line}\n") == ["GL089"]


def test_a_setting_that_is_nearly_known_is_proposed(workshop: Workshop) -> None:
    (found,) = workshop.found("domain d\naction a\ndevice rcx:\n    0 a\n    set pol 1 s\n")
    assert found.help == "did you mean `poll`?"


def test_only_bricks_have_settings(workshop: Workshop) -> None:
    assert codes(workshop, "domain d\naction a\ndevice self:\n    a\n    set poll 1 s\n") == ["GL089"]


@pytest.mark.parametrize(
    "lines",
    [
        ["set poll 0.25 s", "set range 1", "set silence 0 s"],
        ["set poll 0 s", "set range 2"],
        ["set range 0", "set value_digits 2", "set action_digits 2"],
        ["set action_digits 127", "set action_base 1", "set value_base 254"],
    ],
)
def test_settings_that_make_sense_are_taken(workshop: Workshop, lines: list[str]) -> None:
    text = "".join(f"    {line}\n" for line in lines)
    assert "GL089" not in codes(workshop, f"domain d\naction a\ndevice rcx:\n    0 a\n{text}")


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        ("    set action_base 100\n", []),
        ("    set action_base 50\n", ["GL092"]),
        ("    set control_base 250\n", []),
        ("    set action_base 224\n", []),
        ("    set action_base 225\n", ["GL092"]),
        ("    set control_base 70\n", ["GL092"]),
        ("    set action_base 200\n    set action_digits 40\n", ["GL092"]),
    ],
)
def test_messages_lie_apart_and_below_256(workshop: Workshop, lines: str, expected: list[str]) -> None:
    assert codes(workshop, "domain d\naction a\ndevice rcx:\n    0 a\n" + lines) == expected


def test_two_bricks_need_messages_of_their_own(workshop: Workshop) -> None:
    text = "domain d\naction a\naction b\ndevice rcx one:\n    0 a\ndevice rcx two:\n    0 b\n"
    (found,) = workshop.found(text)
    assert found.code.code == "GL092"
    assert found.help is not None and "`set range 1` for `two`" in found.help
    assert codes(workshop, text + "    set range 1\n") == []


NQC = """\
void f() { Wait(1); }
void g(int a, int b) { Wait(a); }
sub s() { Wait(1); }
task t() { Wait(1); }
"""


@pytest.mark.parametrize(
    ("binding", "expected"),
    [
        ("a by call f", []),
        ("a by call s", []),
        ("a by start t", []),
        ("a by call t", ["GL096"]),
        ("a by start f", ["GL096"]),
        ("a by call g", ["GL096"]),
        ("a by call elsewhere", ["GL096"]),
        ("a by start elsewhere", ["GL096"]),
    ],
)
def test_behaviours_in_the_nqc_file_fit_the_bindings(workshop: Workshop, binding: str, expected: list[str]) -> None:
    workshop.write("robot.nqc", NQC + "task watch() { golc_report(EXOG_e); }\n")
    text = f'domain d\naction a\nexog e\ndevice rcx "robot.nqc":\n    0 {binding}\n    9 e\n'
    assert codes(workshop, text) == expected


@pytest.mark.parametrize(("name", "expected"), [("f", ["GL096"]), ("g", []), ("s", ["GL096"])])
def test_functions_take_one_argument_for_each_of_the_action(workshop: Workshop, name: str, expected: list[str]) -> None:
    workshop.write("robot.nqc", NQC)
    text = (
        f'domain d\naction a(x: 1..2, y: 1..2)\ndevice rcx "robot.nqc":\n    0 .. a(x: 1..2, y: 1..2) by call {name}\n'
    )
    assert codes(workshop, text) == expected


def test_an_nqc_file_that_cannot_be_read_is_one_finding(workshop: Workshop) -> None:
    (workshop.folder / "robot.nqc").mkdir()
    path = workshop.write("robot.gl", 'domain d\naction a\nproc control:\n    a\ndevice rcx "robot.nqc":\n    0 a\n')
    found = examine(path, proofs=True).findings
    assert [(diagnostic.code.code, diagnostic.span.line) for diagnostic in found] == [("GL001", 5)]


@pytest.mark.parametrize(
    ("first", "count", "help_"),
    [
        (0, 16, None),
        (10, 16, "number the actions from 0 to 15, and what the brick reports after them"),
        (0, 17, "`set action_base 86` and `set action_digits 17` make it one message"),
        (0, 85, "`set action_base 86` and `set action_digits 85` make it one message"),
        (0, 86, None),
    ],
)
def test_how_a_number_needs_one_message_only(workshop: Workshop, first: int, count: int, help_: str | None) -> None:
    found = workshop.found(f"domain d\naction a(n: 1..{count})\ndevice rcx:\n    {first} .. a(n: 1..{count})\n")
    assert [(each.code.code, each.help) for each in found] == ([("GL081", help_)] if first + count > 16 else [])


@pytest.mark.parametrize(
    ("event", "expected"),
    [
        ("    causes moving := false\n", []),
        ("    poss moving\n", []),
        ("    causes at := 2 when moving\n", []),
        ("    causes at := 2\n", ["GL087"]),
    ],
)
def test_what_tells_the_end_of_a_task_changes_or_asks_for_what_the_task_changes(
    workshop: Workshop, event: str, expected: list[str]
) -> None:
    text = "domain d\nfluent moving = false\nfluent at: 1..3 = 1\naction drive:\n    causes moving := true\n"
    text += f"exog arrived:\n{event}device rcx:\n    0 drive by start go\n    1 arrived\n"
    assert codes(workshop, text) == expected
