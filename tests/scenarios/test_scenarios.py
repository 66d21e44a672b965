"""Scenarios: what a program does in a world that is written down, and the first difference from what is expected."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.loading import examine, load
from golc.scenarios.play import Played, play

DOOR = """domain door
type place = 1..3
fluent at: place = 1
fluent open: bool = false
fluent rung(p: place): int = 0
invariant near: at < 3 or open
action go(p: place):
    poss open
    causes at := p
action ring:
    causes rung(at) := rung(at) + 1
exog opens:
    poss not open
    causes open := true
exog closes:
    causes open := false
proc control:
    ring
    wait until open
    go(2)
    say "at {at}"
    go(3)
proc twice(p: place):
    go(p)
    ring
proc stuck:
    go(2)
scenario s:
"""


def played(tmp_path: Path, lines: str) -> Played:
    path = tmp_path / "door.gl"
    path.write_text(DOOR + "".join(f"    {line}\n" for line in lines.splitlines()))
    theory = load(path)
    return play(theory, theory.scenarios["s"])


@pytest.mark.parametrize(
    ("lines", "trace"),
    [
        ("on opens when waiting", ["    1 ring", "      <- opens", "    2 go(2)", '      "at 2"', "    3 go(3)"]),
        ("on opens after 0", ["      <- opens", "    1 ring", "    2 go(2)", '      "at 2"', "    3 go(3)"]),
        ("on opens after 1", ["    1 ring", "      <- opens", "    2 go(2)", '      "at 2"', "    3 go(3)"]),
        ("on opens when rung(1) = 1\nuntil at = 2", ["    1 ring", "      <- opens", "    2 go(2)"]),
        # One line at each wait, the first one first; the batch happens as one.
        (
            "on opens, closes when waiting\non opens when not open\nuntil at = 3",
            [
                "    1 ring",
                "      <- opens",
                "      <- closes",
                "      <- opens",
                "    2 go(2)",
                '      "at 2"',
                "    3 go(3)",
            ],
        ),
        ("run control", ["    1 ring"]),
        ("given open = true and at = 2\nrun twice(3)", ["    1 go(3)", "    2 ring"]),
        ("until at = 1", []),
        # A blocked program waits for an event, too.
        ("run stuck\non opens when waiting", ["      <- opens", "    1 go(2)"]),
    ],
)
def test_what_happens_in_which_order(tmp_path: Path, lines: str, trace: list[str]) -> None:
    result = played(tmp_path, lines)
    assert (result.failure, result.trace) == (None, trace)


@pytest.mark.parametrize(
    "expectation",
    [
        "expect ring exactly 1",
        "expect go at least 2",
        "expect go(3) at most 1",
        "expect go(1) exactly 0",
        "expect opens at least 1",
        "expect actions [ring, go(2), go(3)]",
        "expect at = 3 and open and rung(1) = 1",
    ],
)
def test_what_is_as_expected(tmp_path: Path, expectation: str) -> None:
    assert played(tmp_path, f"on opens when waiting\n{expectation}").failure is None


@pytest.mark.parametrize(
    ("expectation", "message", "place", "length"),
    [
        ("expect ring exactly 2", "`ring` happens 1 time, and exactly 2 times is expected", "expect ring exactly 2", 5),
        ("expect go at most 1", "`go` happens more than 1 time", "expect go at most 1", 5),
        ("expect go(2) exactly 0", "`go(2)` happens more than 0 times", "expect go(2) exactly 0", 3),
        ("expect opens at least 2", "`opens` happens 1 time, and at least 2 times is expected", None, 5),
        ("expect actions [ring, go(3), go(2)]", "action 2 is `go(2)`, and `go(3)` is expected", "go(3)", 3),
        ("expect actions [ring]", "action 2 is `go(2)`, where the run is expected to have ended", None, 3),
        (
            "expect actions [ring, go(2), go(3), ring]",
            "the run ends after 3 actions, and `ring` is expected next",
            "ring",
            5,
        ),
        ("expect open and at = 2", "at the end this is not so", "expect open and at = 2", 5),
    ],
)
def test_the_first_difference_is_told_with_the_run_up_to_it(
    tmp_path: Path, expectation: str, message: str, place: str | None, length: int
) -> None:
    result = played(tmp_path, f"on opens when waiting\n{expectation}")
    assert result.failure is not None
    assert (result.failure.message, result.failure.span.text.strip()) == (message, place or expectation)
    assert len(result.trace) == length


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ("given rung(2) > 0", "this is not so in the initial state"),
        ("run stuck", "the program is blocked in scenario `s`, and nothing more happens"),
        (
            "on closes when waiting\nuntil at = 2",
            "`until` never holds: the program waits, at line 19, and nothing more",
        ),
        ("on opens after 1\nuntil rung(2) = 1", "`until` never holds: the program is final"),
        ("on opens after 0\non opens after 1", "`opens` cannot happen here"),
        ("on closes when not open", "scenario `s` does not end: 100000 actions and events"),
        ("on opens after 0\non closes after 3", "invariant `near` is false after `closes`"),
        ("given at = 3", "invariant `near` is false in the initial state"),
    ],
)
def test_what_else_goes_wrong(tmp_path: Path, lines: str, message: str) -> None:
    failure = played(tmp_path, lines).failure
    assert failure is not None
    assert failure.message.startswith(message)


@pytest.mark.parametrize(
    ("lines", "code", "marked"),
    [
        ("on go(2) after 1", "GL018", "go"),
        ("on opns after 1", "GL013", "opns"),
        ("on opens(1) after 1", "GL015", "opens"),
        ("on opens after -1", "GL017", "-1"),
        ("on opens after at", "GL020", "at"),
        ("given at = 4", "GL017", "4"),
        ("given at = 2 and at = 1", "GL011", "at = 1"),
        ("given rung(at) = open", "GL016", "rung(at) = open"),
        ("until at", "GL016", "at"),
        ("run control\nrun stuck", "GL025", "run stuck"),
        ("run twice(4)", "GL017", "4"),
        ("run ring", "GL018", "ring"),
        ("expect actions [opens]", "GL018", "opens"),
        ("expect stuck at least 1", "GL018", "stuck"),
    ],
)
def test_what_makes_no_scenario(tmp_path: Path, lines: str, code: str, marked: str) -> None:
    path = tmp_path / "door.gl"
    path.write_text(DOOR + "".join(f"    {line}\n" for line in lines.splitlines()))
    examined = examine(path)
    theory, found = examined.theory, examined.findings
    assert theory is None
    assert (code, marked) in [(finding.code.code, finding.span.text.strip()) for finding in found]


def test_two_scenarios_of_a_name_and_one_without_a_program(tmp_path: Path) -> None:
    path = tmp_path / "d.gl"
    path.write_text("domain d\nfluent x: int = 0\nscenario a:\n    expect x = 0\nscenario a:\n    expect x = 0\n")
    found = [finding.message for finding in examine(path).findings]
    assert "scenario `a` is declared twice" in found
    assert "scenario `a` does not say what it runs, and there is no procedure `control`" in found


EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*/*.gl"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_scenarios_of_the_examples_go_as_they_expect(path: Path) -> None:
    theory = load(path)
    assert theory.scenarios or not theory.procedures  # a file that others import has none
    assert [played.failure for played in (play(theory, each) for each in theory.scenarios.values())] == [None] * len(
        theory.scenarios
    )


def test_time_passes_when_nothing_else_can_happen(tmp_path: Path) -> None:
    path = tmp_path / "clock.gl"
    path.write_text(
        "domain clock\nfluent calm: bool = false\naction ring\naction sleep\nexog quiet:\n    causes calm := true\n"
        "proc control:\n    ring\n    wait 5 s\n    within 10 s:\n        wait until calm\n    else:\n        sleep\n"
        "scenario late:\n    run control\nscenario early:\n    on quiet after 1\n"
        "scenario between:\n    on quiet when waiting\n"
    )
    theory = load(path)
    assert play(theory, theory.scenarios["late"]).trace == ["    1 ring", "      5 s", "      15 s", "    2 sleep"]
    assert play(theory, theory.scenarios["early"]).trace == ["    1 ring", "      <- quiet", "      5 s"]
    assert play(theory, theory.scenarios["between"]).trace == ["    1 ring", "      <- quiet", "      5 s"]
