"""What ``golc check`` finds and proves of functions of Python that it does not execute: what is so for all of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest

from golc.diagnostics import Code
from golc.loading import Examined, examine

Check: TypeAlias = Callable[[str], Examined]

HEAD = """domain robot
type station = 1..4
type colour = {red, green}
fluent at: station = 1
fluent other: station = 1
fluent left: 0..100 = 100
fluent paint: colour = red
fluent seen: set[station] = {}
fluent next: station? = none
fluent total: int = 0
fluent lit(s: station) = false
extern near(a: station, b: station) from "map.py"
extern after(a: station): station from "map.py"
extern perhaps(a: station): station? from "map.py"
extern colour_of(a: station): colour from "map.py"
extern around(a: station): set[station] from "map.py"
extern metres(a: station, b: station): 0..40 from "map.py"
extern far(a: station): 101..200 from "map.py"
extern steps(a: int): int from "map.py"
extern most(a: station): int? from "map.py"
"""
PYTHON = "".join(
    f"def {name}({parameters}): raise AssertionError('executed')\n"
    for name, parameters in [
        ("near", "a, b"), ("after", "a"), ("perhaps", "a"), ("colour_of", "a"), ("around", "a"), ("metres", "a, b"),
        ("far", "a"), ("steps", "a"), ("most", "a"),
    ]
)  # fmt: skip


@pytest.fixture
def examined(tmp_path: Path) -> Check:
    """Examines a domain with functions that must not be executed."""

    def examined(text: str) -> Examined:
        (tmp_path / "map.py").write_text(PYTHON)
        (tmp_path / "robot.gl").write_text(HEAD + text)
        return examine(tmp_path / "robot.gl", proofs=True)

    return examined


def proved(found: Examined) -> list[tuple[str, str]]:
    """What is found, but for what is not used."""
    return [(each.code.code, each.message) for each in found.findings if each.code is not Code.UNUSED]


PROVED = {
    "a value of the type": "action a:\n    causes at := after(at)\n",
    "an optional value": "action a:\n    poss at = 1\n    causes at := perhaps(2) when perhaps(2) != none\n",
    "an optional value of an optional fluent": "action a:\n    causes next := perhaps(at)\n",
    "an optional number without bounds": "action a:\n    causes total := most(at) if most(at) != none else total\n",
    "a symbol": "action a:\n    causes paint := colour_of(at)\n",
    "a set": "action a:\n    causes seen := around(at) + seen\n",
    "elements of a set": "action a:\n    causes forall n in around(at). lit(n) := n in seen\n",
    "a number without bounds": "action a:\n    causes total := total + steps(total)\n",
    "calls of calls": "action a:\n    causes at := after(after(at))\n",
    "a precondition that takes care": "action a(n: station):\n    poss metres(at, n) <= left\n"
    "    causes left := left - metres(at, n)\n",
    "an invariant": "invariant back: at = 1 or metres(at, 1) <= left\n"
    "action a(n: station):\n    poss metres(at, n) + metres(n, 1) <= left\n"
    "    causes at := n\n    causes left := left - metres(at, n)\n",
    "an invariant that the function keeps": "invariant same: next = none or next = after(at)\n"
    "action a:\n    causes next := after(at)\naction b:\n    causes next := none\n",
    "the same arguments, the same value": "action a:\n    poss at = other\n"
    "    causes left := metres(at, 1)\n    causes left := metres(other, 1)\n",
    "the same unbounded arguments, the same value": "action a:\n    poss total = left + 1\n"
    "    causes total := steps(left + 1)\n    causes total := steps(total)\n",
    "a static between": "static way(a: station): 0..80 = metres(a, 1) + metres(1, a)\n"
    "action a:\n    causes left := way(at)\n",
    "a recursive static": "static end(a: station, n: 0..2): station = after(end(a, n - 1)) if n > 0 else a\n"
    "action a:\n    causes at := end(at, 2)\n",
    "a definition between": "define way(a: station) := metres(at, a) + metres(a, at)\n"
    "action a:\n    causes left := way(3)\n",
    "what a quantifier runs over": "action a:\n    causes left := (max n: station. metres(at, n))\n",
    "what is known": "action look:\n    senses at\naction a:\n    poss knows(at = 2)\n    causes at := after(2)\n",
}


@pytest.mark.parametrize("text", PROVED.values(), ids=PROVED)
def test_what_holds_for_every_function_is_proved(examined: Check, text: str) -> None:
    pytest.importorskip("z3")
    found = examined(text)

    assert proved(found) == []
    assert found.undecided == 0
    assert found.asked > 0


LEFT_OPEN = {
    "a value outside its type": "action a:\n    causes left := 3 * metres(at, 1)\n",
    "no value": "action a:\n    causes at := perhaps(at)\n",
    "another argument": "action a:\n    causes left := metres(at, 1)\n    causes left := metres(other, 1)\n",
    "the arguments in another order": "action a:\n    causes left := metres(at, 1)\n    causes left := metres(1, at)\n",
    "an action that may be impossible": "action a:\n    poss near(at, 2)\n    causes at := 1\n",
    "an unbounded argument": "action a:\n    poss steps(total) > 3\n    causes at := 1\n",
    "an invariant that may be broken": "invariant close: at = 1 or near(at, 1)\n"
    "action a(n: station):\n    causes at := n\n",
    "an invariant of which more is known": "invariant close: near(at, 1)\naction a(n: station):\n"
    "    poss near(n, 2)\n    causes at := n\n",
    "a static that leaves its type": "static way(a: station): 0..50 = metres(a, 1) + metres(1, a)\n"
    "action a:\n    causes left := way(at)\n",
    "a condition of a program": "action a\nproc control:\n    if near(at, 2):\n        a\n",
}


@pytest.mark.parametrize("text", LEFT_OPEN.values(), ids=LEFT_OPEN)
def test_what_does_not_hold_for_every_function_is_left_open(examined: Check, text: str) -> None:
    pytest.importorskip("z3")
    found = examined(text)

    notes = [each for each in found.findings if each.code is Code.NOT_DECIDED]
    assert len(notes) == 1
    assert notes[0].message.endswith("is decided: its file is not executed")
    assert notes[0].help == "`--trust` would decide it: it executes the file"
    assert {code for code, _ in proved(found)} <= {"GL049", "GL034"}
    assert found.undecided > 0


FOUND = {
    "an action that is never possible": (
        "action a:\n    poss metres(at, 2) > 40\n    causes at := 1\n",
        [("GL043", "`a` can never be possible")],
    ),
    "an effect that fails whatever the function is": (
        "action a:\n    poss near(at, 2) or at < 3\n    causes other := at + 3\n",
        [("GL041", "`a` can go wrong: `other` would be 5, which is outside `station` (1..4)")],
    ),
    "effects that differ whatever the function is": (
        "action a:\n    causes left := metres(at, 1)\n    causes left := 50 when at = 2\n",
        [("GL040", "`a` may give `left` two values at once")],
    ),
    "an invariant that is broken whatever the function is": (
        "invariant early: at < 3 or left > 40\naction a:\n    causes left := metres(at, at)\n    causes at := 3\n",
        [("GL042", "`a` may break invariant `early`")],
    ),
    "a condition that is always true": (
        "action a\nproc control:\n    if metres(at, 1) <= 40:\n        a\n",
        [("GL073", "this condition is always true here")],
    ),
}


@pytest.mark.parametrize(("text", "expected"), FOUND.values(), ids=FOUND)
def test_what_is_wrong_for_every_function_is_found(examined: Check, text: str, expected: list[tuple[str, str]]) -> None:
    pytest.importorskip("z3")

    assert [found for found in proved(examined(text)) if found[0] != "GL049"] == expected


def test_a_counterexample_speaks_of_no_value_of_a_function(examined: Check) -> None:
    found = examined("action a:\n    poss near(at, 2) or at < 3\n    causes other := at + 3\n")

    (error,) = [each for each in found.findings if each.code is Code.EFFECT_FAILS]
    assert error.notes == ("for example when at = 2 and `a` is done",)


THEORY = """from __future__ import annotations
from golc.embed import Theory, causes, enum, interval, poss

theory = Theory("tour")
room = theory.type("room", enum("hall", "library", "attic"))
hall, library, attic = room
at = theory.fluent("at", room, hall)
left = theory.fluent("left", interval(0, 90), 90)


@theory.extern(file="map.py")
def metres(a: room, b: room) -> interval(0, {longest}): ...


@theory.invariant
def back():
    return at == hall or metres(at, hall) <= left


@theory.action
def go(to: room):
    poss(to != at and metres(at, to) <= left)
    poss(to == hall or metres(at, to) + metres(to, hall) <= left)
    causes(at, to)
    causes(left, left - metres(at, to))
"""


@pytest.mark.parametrize(("longest", "undecided"), [(45, 0), (91, 1)])
def test_a_theory_in_python_is_proved_alike(tmp_path: Path, longest: int, undecided: int) -> None:
    pytest.importorskip("z3")
    (tmp_path / "map.py").write_text(PYTHON)
    (tmp_path / "tour.py").write_text(THEORY.format(longest=longest))

    found = examine(tmp_path / "tour.py", proofs=True)

    assert found.undecided == undecided
    assert [code for code, _ in proved(found) if code != "GL034"] == ["GL049"] * undecided


def test_what_holds_for_every_function_holds_in_the_states_that_can_be_reached(tmp_path: Path) -> None:
    (tmp_path / "map.py").write_text(PYTHON)
    (tmp_path / "robot.gl").write_text(f"{HEAD}action a:\n    poss near(at, 1)\n    causes at := after(at)\n")

    found = examine(tmp_path / "robot.gl", proofs=True, reachable=True)

    assert found.scope is not None and not found.scope.whole
    assert found.undecided == 1, "whether it is ever possible"
