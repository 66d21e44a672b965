"""What checking a file costs grows with its length, not faster, whatever there is much of."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from golc.loading import Examined, examine

LINES = 65


def checked(folder: Path, text: str, reachable: bool = False) -> Examined:
    path = folder / "large.gl"
    path.write_text(text, encoding="utf-8")
    return examine(path, proofs=True, reachable=reachable)


def calls(folder: Path, text: str) -> int:
    """How many calls of functions it takes: the same on every machine."""
    count = 0

    def called(frame: object, event: str, argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(called)
    try:
        checked(folder, text)
    finally:
        sys.setprofile(None)
    return count


def test_twice_the_lines_are_twice_the_work(tmp_path: Path, shapes: Mapping[str, Callable[[int], str]]) -> None:
    checked(tmp_path, shapes["building"](LINES))  # fills caches
    for shape, make in shapes.items():
        few, more, most = [calls(tmp_path, make(LINES * factor)) for factor in (1, 2, 4)]
        assert most - more < 3 * abs(more - few) or most < 1.1 * more, shape


def test_effects_that_a_parameter_tells_apart_are_not_compared(tmp_path: Path) -> None:
    clauses = "".join([f"    causes f := {n} when x = {n} and g\n" for n in range(100)])
    text = f"domain d\nfluent f: 0..99 = 0\nfluent g = true\naction a(x: 0..99):\n{clauses}"
    assert checked(tmp_path, text).asked == 200  # whether each effect happens, and keeps to the type


def test_effects_on_different_elements_are_not_compared(tmp_path: Path) -> None:
    clauses = "".join([f"    causes f({n}) := {n}\n" for n in range(50)])
    assert checked(tmp_path, f"domain d\nfluent f(x: 0..99): 0..99 = 0\naction a:\n{clauses}").asked == 50


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("f := 1 when x = 1", "f := 2 when y = 2"),
        ("f := 1 when x = 1", "f := 2 when x = 1 and y = 2"),
        ("f := 1 when g(x) = 1", "f := 2 when g(y) = 2"),
        ("h(x) := 1", "h(1) := 2"),
        ("h(2) := 1 when y = 1", "h(x) := 2 when y = 1"),
    ],
)
def test_effects_that_may_meet_are_found(tmp_path: Path, first: str, second: str) -> None:
    fluents = "fluent f: 0..9 = 0\nfluent g(x: 0..9): 0..9 = 0\nfluent h(x: 0..9): 0..9 = 0\n"
    others = "".join([f"    causes f := 3 when x = {n} and y = {n}\n" for n in range(5, 9)])
    text = f"domain d\n{fluents}action a(x: 0..9, y: 0..9):\n    causes {first}\n    causes {second}\n{others}"
    assert "GL040" in [finding.code.code for finding in checked(tmp_path, text).findings]


def test_thousands_of_pairs_of_effects_are_not_decided(tmp_path: Path) -> None:
    clauses = "".join([f"    causes f := 1 when x > {n}\n" for n in range(110)])
    found = checked(tmp_path, f"domain d\nfluent f: 0..9 = 0\naction a(x: 0..200):\n{clauses}")
    (note,) = [finding for finding in found.findings if finding.code.code == "GL049"]
    assert note.message == (
        "whether all effects of `a` agree is not decided: more than 5,000 pairs of them would have to be compared"
    )
    assert note.span.text == "a" and found.undecided == 1


def test_what_is_known_of_other_things_does_not_hide_what_cannot_be(tmp_path: Path) -> None:
    others = "".join([f"fluent g{n}: 0..9 = 0\n" for n in range(30)])
    tests = "".join([f"    test g{n} = 1\n" for n in range(30)])
    action = "action a:\n    poss f = 2\n    causes f := 1\n"
    text = f"domain d\nfluent f: 0..9 = 0\n{others}{action}proc p:\n    test f = 1\n{tests}    a\n"
    (stuck,) = [finding for finding in checked(tmp_path, text).findings if finding.code.code == "GL072"]
    assert [label.span.text for label in stuck.labels] == ["f = 1", "f = 2"]


def test_what_an_invariant_connects_is_known(tmp_path: Path) -> None:
    fluents = "fluent f: 0..9 = 0\nfluent g: 0..9 = 0\ninvariant same: f = g\n"
    action = "action a:\n    poss g = 2\n    causes g := 2\n"
    text = f"domain d\n{fluents}{action}proc p:\n    test f = 1\n    a\n"
    assert "GL072" in [finding.code.code for finding in checked(tmp_path, text).findings]


def test_what_goes_together_in_all_states_that_can_be_reached_is_known(tmp_path: Path) -> None:
    action = "action a:\n    poss g = 2\n    causes f := 2\n    causes g := 2\n"
    text = (
        f"domain d\nfluent f: 0..2 = 2\nfluent g: 0..2 = 2\n{action}action b:\n    causes f := 1\n    causes g := 1\n"
    )
    text += "proc p:\n    test f = 1\n    a\n"
    assert "GL072" not in [finding.code.code for finding in checked(tmp_path, text).findings]
    assert "GL072" in [finding.code.code for finding in checked(tmp_path, text, reachable=True).findings]
