"""Ten mistakes in one file are shown in one run of ``golc check``, in their order and their places, in every format."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote

import pytest

from golc.cli import invoke

LINES = [
    "domain yard",
    'const greeting = "日本" + 1',  # a wide string
    "type bay = 1..4",
    "fluent at: bya = 1",
    "fluent free: bool == true",
    'fluent full = "場所" = hall',  # behind wide characters
    "action go(to: bay):",
    "    poss\tfull and\tfree2",  # behind tabs
    "    causes at2 := to",
    "action rest:",
    "    causes full := 3",
    "exog push:",
    "    causes full := not ful",
    'define sign := "e\u0301" = "→" and fulll',  # behind a combining character
    "proc control:",
    "    rest",
    "    restt",  # the last line
]
PLACES = [
    ("GL016", 2, 18, 22),
    ("GL014", 4, 12, 15),
    ("GL005", 5, 19, 21),
    ("GL012", 6, 22, 26),
    ("GL012", 8, 19, 24),
    ("GL012", 9, 12, 15),
    ("GL016", 11, 20, 21),
    ("GL012", 13, 24, 27),
    ("GL012", 14, 31, 36),
    ("GL013", 17, 5, 10),
]
"""Code, line, column and end of each mistake, counted in characters from 1."""

MARKED = ['"日本"', "bya", "==", "hall", "free2", "at2", "3", "ful", "fulll", "restt"]

Read = Callable[[str], list[tuple[str, int, int, int]]]


def from_json(out: str) -> list[tuple[str, int, int, int]]:
    spans = [(finding["code"], finding["span"]) for finding in json.loads(out)["findings"]]
    return [(code, span["line"], span["column"], span["end_column"]) for code, span in spans]


def from_sarif(out: str) -> list[tuple[str, int, int, int]]:
    (run,) = json.loads(out)["runs"]
    assert run["columnKind"] == "unicodeCodePoints"
    regions = [(found["ruleId"], found["locations"][0]["physicalLocation"]["region"]) for found in run["results"]]
    assert [region["snippet"]["text"] for _, region in regions] == MARKED
    return [(code, region["startLine"], region["startColumn"], region["endColumn"]) for code, region in regions]


def from_github(out: str) -> list[tuple[str, int, int, int]]:
    pattern = re.compile(r"::error file=yard\.gl,line=(\d+),endLine=\d+,col=(\d+),endColumn=(\d+),title=(GL\d{3})")
    found = [match.groups() for line in out.splitlines() if (match := pattern.match(unquote(line)))]
    return [(code, int(line), int(column), int(end)) for line, column, end, code in found]


def from_text(out: str) -> list[tuple[str, int, int, int]]:
    """The end is where the marks end, which are as wide as what is marked."""
    found: list[tuple[str, int, int, int]] = []
    for block in re.split(r"\n\n(?=error)", out.strip()):
        lines = block.split("\n")
        code, place = re.findall(r"\[(GL\d{3})\]", lines[0])[0], lines[1].rpartition("--> yard.gl:")[2]
        line, column = map(int, place.split(":"))
        source, marks = lines[3].split("| ", 1)[1], lines[4].split("| ", 1)[1]
        assert shown(source)[marks.index("^") : marks.rindex("^") + 1] == shown(MARKED[len(found)])
        found.append((code, line, column, column + len(MARKED[len(found)])))
    return found


def shown(text: str) -> str:
    """One character for each column of a terminal."""
    wide = "".join(character + character if character > "\u3000" else character for character in text)
    return wide.replace("\u0301", "")


@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["LF", "CRLF"])
@pytest.mark.parametrize("last", [True, False], ids=["ended", "open"])
@pytest.mark.parametrize(
    ("form", "read"),
    [("text", from_text), ("json", from_json), ("sarif", from_sarif), ("github", from_github)],
    ids=["text", "json", "sarif", "github"],
)
def test_ten_mistakes_are_shown_in_order_and_in_place(
    form: str,
    read: Read,
    last: bool,
    end: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("yard.gl").write_bytes((end.join(LINES) + (end if last else "")).encode())
    assert invoke(["check", "--format", form, "yard.gl"]) == 1
    out, err = capsys.readouterr()
    assert read(out) == PLACES
    assert err.startswith("checked 1 file: 10 errors")


CROWDED = """\
domain yard

type bay = 1..4
fluent at: bay == 1
fluent lit(b: bay) = fasle
fluent queue: list[bay] = [1, 2

action go(to: bay)
    poss at = to + and lit(to)
    causes at = tp
    causes lit(to, 1) := true

proc control:
    while not lit(4, 4):
        goo(4)
        if at == 4 then
            go(red)
        else
            go(1);
"""


def test_mistakes_in_one_declaration_do_not_hide_each_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("yard.gl").write_text(CROWDED)
    assert invoke(["check", "--format", "json", "yard.gl"]) == 1
    out, err = capsys.readouterr()
    found = [(f["span"]["line"], f["span"]["column"], f["message"]) for f in json.loads(out)["findings"]]
    assert found == [
        (4, 16, "equality is `=`, not `==`"),
        (5, 22, "unknown word `fasle`"),
        (6, 32, "the `]` that closes `[` is missing"),
        (8, 19, "the colon at the end of this `action` is missing"),
        (9, 20, "an expression is missing before `and`"),
        (10, 15, "`=` tests, `:=` changes: an effect is written with `:=`"),
        (10, 17, "unknown variable `tp`"),
        (11, 12, "`lit` takes 1 argument, not 2"),  # and in line 14
        (15, 9, "unknown action `goo`"),
        (16, 15, "equality is `=`, not `==`"),
        (16, 20, "`then` is written as a colon"),
        (17, 16, "unknown name `red`"),
        (18, 13, "the colon at the end of this `else` is missing"),
        (19, 18, "`;` does not join or end statements"),
    ]
    assert err == "checked 1 file: 14 errors; --fix would fix 7 of them\n"


def test_numbers_and_settings_of_a_brick_are_checked_although_there_are_errors(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    domain = "domain d\naction go\naction stay\nproc control:\n    gone\n"
    domain += "device rcx:\n    1 go\n    1 stay\n    set pol 1 s\n"
    Path("yard.gl").write_text(domain)
    assert invoke(["check", "--format", "json", "yard.gl"]) == 1
    found = [(f["span"]["line"], f["code"], f["message"]) for f in json.loads(capsys.readouterr().out)["findings"]]
    assert found == [
        (5, "GL013", "unknown action or procedure `gone`"),
        (8, "GL082", "`stay` takes number 1, which `go` has already"),
        (9, "GL089", "a device `rcx` has no setting `pol`"),
    ]
