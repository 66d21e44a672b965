"""Scenarios of theories that leave something open: which of the possible worlds is the real one."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.loading import load
from golc.scenarios.play import Played, play

SAFE = """domain safe
type key = {red, green, blue}
fluent fits: key = unknown
fluent open = false
fluent marked = false
fluent turns: int = 0
initially fits != red
initially marked implies fits = blue
action try(k: key):
    poss not open
    causes open := true when fits = k
    causes turns := turns + 1
    senses open
exog heard_click(k: key):
    poss fits = k
proc control:
    while not open:
        pick k: key where possible(fits = k):
            try(k)
proc blind:
    wait
    test possible(fits = green)
    try(green)
scenario s:
"""


def played(tmp_path: Path, lines: str) -> Played:
    path = tmp_path / "safe.gl"
    path.write_text(SAFE + "".join(f"    {line}\n" for line in lines.splitlines()))
    theory = load(path)
    return play(theory, theory.scenarios["s"])


@pytest.mark.parametrize(
    ("lines", "trace"),
    [
        # The first possible world, in the order of the type.
        ("run control", ["    1 try(green): true"]),
        ("given fits = blue", ["    1 try(green): false", "    2 try(blue): true"]),
        ("given fits != green", ["    1 try(green): false", "    2 try(blue): true"]),
        ("given fits > green and not open", ["    1 try(green): false", "    2 try(blue): true"]),
        # The agent knows of the world what the declarations say, with the values that replace others.
        ("given marked = true", ["    1 try(blue): true"]),
        ("given turns = 5\nexpect turns = 6", ["    1 try(green): true"]),
    ],
)
def test_which_world_is_real(tmp_path: Path, lines: str, trace: list[str]) -> None:
    result = played(tmp_path, lines)
    assert result.failure is None
    assert result.trace == trace


@pytest.mark.parametrize(
    ("lines", "message", "marked"),
    [
        ("given fits = red", "this is not so in the initial state", "fits = red"),
        ("given fits = blue\ngiven fits < blue", "this is not so in the initial state", "fits < blue"),
        ("given knows(fits = blue)", "this is not so in the initial state", "knows(fits = blue)"),
        ("expect fits = blue", "at the end this is not so", "expect fits = blue"),
        ("expect turns = 2", "at the end this is not so", "expect turns = 2"),
    ],
)
def test_what_no_world_or_not_the_real_one_has(tmp_path: Path, lines: str, message: str, marked: str) -> None:
    failure = played(tmp_path, lines).failure
    assert failure is not None
    assert (failure.message, failure.span.text) == (message, marked)


def test_values_given_that_contradict_the_constraints(tmp_path: Path) -> None:
    path = tmp_path / "safe.gl"
    path.write_text(
        SAFE.replace("initially marked", "initially not marked\ninitially marked") + "    given marked = true\n"
    )
    theory = load(path)
    failure = play(theory, theory.scenarios["s"]).failure
    assert failure is not None
    assert (failure.code.code, failure.span.text) == ("GL053", "not marked")


def test_formulas_of_a_scenario_see_the_world_and_what_is_known(tmp_path: Path) -> None:
    lines = "given fits = blue\nuntil knows(fits = blue)\nexpect fits = blue and not open and known(fits)"
    assert played(tmp_path, lines).failure is None
    lines = "given fits = blue\nexpect not known(fits)"
    failure = played(tmp_path, lines).failure
    assert failure is not None and failure.span.text == "expect not known(fits)"


def test_an_event_tells_what_was_so(tmp_path: Path) -> None:
    lines = "given fits = blue\nrun blind\non heard_click(blue) when waiting\nexpect turns = 0"
    failure = played(tmp_path, lines).failure
    assert failure is not None
    assert "blocked" in failure.message
    assert played(tmp_path, "run blind\non heard_click(green) when waiting\nexpect open").failure is None


def test_an_event_happens_only_where_it_can(tmp_path: Path) -> None:
    failure = played(tmp_path, "given fits = blue\non heard_click(green) after 0").failure
    assert failure is not None
    assert failure.message == "`heard_click(green)` cannot happen here"
