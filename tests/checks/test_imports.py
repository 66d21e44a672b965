"""Imports: declarations join, and what is wrong is said in the right file at the right place."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.loading import examine, load
from golc.planning.goals import GoalPlanning
from golc.planning.limits import Limits

MAIN = """domain main
import "parts/rooms.gl"
fluent at: room = hall
action go(r: room):
    poss door(at, r)
    causes at := r
goal cook: at = kitchen
"""
ROOMS = """domain rooms
type room = {hall, kitchen, garden}
const spare = 3
static door(a: room, b: room) = a != b and hall in {a, b}
"""


def write(folder: Path, **files: str) -> None:
    """Files by their names without ``.gl``; ``parts_x`` is ``parts/x.gl``."""
    (folder / "parts").mkdir(exist_ok=True)
    for name, text in files.items():
        (folder / f"{name.replace('_', '/')}.gl").write_text(text)


def found(folder: Path, name: str = "main.gl") -> list[str]:
    """``FILE:LINE:COLUMN CODE MESSAGE`` of each finding in a file, with paths from the folder."""
    findings = examine(folder / name).findings
    return [f"{f.span} {f.code.code} {f.message}".replace(f"{folder}/", "") for f in findings]


def test_declarations_join_and_need_not_all_be_used(tmp_path: Path) -> None:
    write(tmp_path, main=MAIN, parts_rooms=ROOMS)
    assert found(tmp_path) == []
    theory = load(tmp_path / "main.gl")
    assert theory.name == "main"
    assert [
        str(action)
        for plan in GoalPlanning(theory, theory.definitions["cook"].body, Limits())
        for action in plan.actions
    ] == ["go(kitchen)"]


def test_the_file_itself_is_told_what_it_does_not_use(tmp_path: Path) -> None:
    write(tmp_path, parts_rooms=ROOMS)
    assert "parts/rooms.gl:3:7 GL027 const `spare` is not used" in found(tmp_path, "parts/rooms.gl")


def test_an_import_may_stand_below_what_needs_it_and_bring_constants_for_the_command_line(tmp_path: Path) -> None:
    write(
        tmp_path,
        main='domain main\nfluent x: 0..top = top\nimport "parts/top.gl"\n',
        parts_top="domain t\nconst top = 2\n",
    )
    assert load(tmp_path / "main.gl", {"top": "7"}).constants["top"].value == 7


def test_a_file_that_is_imported_twice_is_joined_once(tmp_path: Path) -> None:
    write(
        tmp_path,
        main='domain main\nimport "parts/a.gl"\nimport "parts/b.gl"\nimport "parts/../parts/a.gl"\nfluent z: t = x\n',
        parts_a='domain a\nimport "c.gl"\n',
        parts_b='domain b\nimport "c.gl"\n',
        parts_c="domain c\nconst x = 1\ntype t = 0..x\n",
    )
    assert load(tmp_path / "main.gl").constants["x"].value == 1


@pytest.mark.parametrize(
    ("files", "findings"),
    [
        (
            {"main": MAIN},
            ["main.gl:2:1 GL001 cannot read `parts/rooms.gl`: there is no such file"],
        ),
        (
            {"main": MAIN, "parts_rooms": ROOMS.replace("hall, kitchen", "hall, at")},
            [
                "parts/rooms.gl:2:20 GL011 `at` is declared as a value, but it is a fluent already",
            ],
        ),
        (
            {"main": MAIN, "parts_rooms": ROOMS.replace("hall in", "hal in").replace("= 3", "= = 3")},
            [
                "parts/rooms.gl:3:14 GL004 an expression is missing after `=`",
                "parts/rooms.gl:4:44 GL012 unknown value `hal`",
            ],
        ),
        (
            {"main": MAIN, "parts_rooms": ROOMS.replace("domain rooms\n", "")},
            ["parts/rooms.gl:1:1 GL009 "],
        ),
        ({"main": 'domain main\nimport "main.gl"\n'}, ["main.gl:2:1 GL019 a file imports itself"]),
        (
            {"main": MAIN, "parts_rooms": ROOMS + 'import "../main.gl"\n'},
            ["parts/rooms.gl:5:1 GL019 `../main.gl` is imported by what it imports itself"],
        ),
        ({"main": 'domain main\nimport "parts"\n'}, ["main.gl:2:1 GL001 cannot read `parts`: it is a directory"]),
    ],
    ids=["missing", "declared twice", "errors inside", "no domain line", "itself", "circle", "directory"],
)
def test_what_is_wrong_is_said_in_its_place(tmp_path: Path, files: dict[str, str], findings: list[str]) -> None:
    write(tmp_path, **files)
    came = found(tmp_path)
    assert len(came) == len(findings), came
    for one, expected in zip(came, findings, strict=True):
        assert one.startswith(expected)


def test_the_first_of_two_declarations_is_shown_in_its_file(tmp_path: Path) -> None:
    write(tmp_path, main=MAIN + "const spare = 4\n", parts_rooms=ROOMS)
    (finding,) = [finding for finding in examine(tmp_path / "main.gl").findings if finding.code.code == "GL011"]
    assert str(finding.labels[0].span).endswith("parts/rooms.gl:3:7")


def test_bytes_that_are_no_text_are_shown_where_they_are(tmp_path: Path) -> None:
    write(tmp_path, main=MAIN)
    (tmp_path / "parts" / "rooms.gl").write_bytes(b"domain rooms\n# \xff\n")
    (finding,) = examine(tmp_path / "main.gl").findings
    assert (finding.span.line, finding.span.column) == (2, 3)
    assert [label.span.text for label in finding.labels] == ['import "parts/rooms.gl"']


def test_the_devices_of_an_imported_file_look_for_their_files_beside_it(tmp_path: Path) -> None:
    write(
        tmp_path,
        main='domain main\nimport "parts/robot.gl"\nproc control:\n    beep\n',
        parts_robot='domain robot\naction beep\ndevice rcx "beep.nqc":\n    0 beep by call beep\n',
    )
    (tmp_path / "parts" / "beep.nqc").write_text("void beep() { }\n")
    (device,) = load(tmp_path / "main.gl").devices
    assert device.folder == str(tmp_path / "parts")
