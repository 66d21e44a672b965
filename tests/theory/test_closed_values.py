"""Values of terms before there is any situation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

Build = Callable[..., Any]

HEAD = """type digit = 0..9
type colour = {red, green, blue}
static square(n: int): int = n * n
static after(c: colour): colour? = {red: green, green: blue, blue: none}
static small(n: digit): digit = n + 5
define twice(n: int) := n * 2
define maybe := none if 1 > 2 else 3
"""


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("square(3) + twice(4)", 17),
        ("after(red)", "green"),
        ("after(blue) = none", True),
        ("square(2) = 4 and not (square(2) != 4)", True),
        ("square(2) > 4 or square(2) >= 4 or 1 // (square(0)) = 1", True),
        ("square(2) < 4 and 1 // square(0) = 1", False),
        ("square(2) <= 3 implies 1 // square(0) = 1", True),
        ("square(2) = 4 implies square(3) = 8", False),
        ("(square(1) = 1) iff (square(2) = 2)", False),
        ("1 if square(2) = 4 else 1 // square(0)", 1),
        ("square(7) // square(-2) * 10 + square(7) % 4", 121),
        ("abs(-square(2)) - min(square(2), 3) + max(square(2), 3)", 5),
        ("exists n: digit. square(n) = 49", True),
        ("forall n: digit where n > 0. square(n) >= n", True),
        ("forall n: digit. square(n) > n", False),
        ("count n: digit, m: digit. square(n) = m", 4),
        ("sum n: digit where n % 2 = 1. square(n)", 165),
        ("(max n: digit. 9 - square(n)) - (min n: digit. square(n))", 9),
        ("square(2) in digit and square(4) not in digit", True),
        ("after(green) in {blue, none}", True),
        ("after(red) < blue", True),
        ("blue <= green", False),
    ],
)
def test_closed_expressions_have_values(theory: Build, text: str, value: object) -> None:
    assert theory(f"{HEAD}const c = {text}\n").constants["c"].value == value


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("1 // square(0)", "division by zero"),
        ("1 % square(0)", "division by zero"),
        ("maybe + (1 if maybe = none else after(blue))", None),
        ("small(square(3))", "`small(9)` would be 14, which is outside `digit` (0..9)"),
        ("small(square(4))", "argument 16 of `small` is outside `digit` (0..9)"),
        ("min n: digit where square(n) > 99. n", "`min` over nothing has no value"),
        ("after(blue) < red", "an operand is `none`, where a value is needed"),
    ],
)
def test_what_has_no_value_says_why(found: Build, text: str, reason: str | None) -> None:
    (finding,) = found(f"{HEAD}const c = {text}\n")
    assert (reason is None and "GL016" in finding) or finding.endswith(f"this has no value: {reason}")


def test_a_definition_that_reads_no_fluent_is_closed(theory: Build) -> None:
    built = theory("define limit := 2 * 3\nfluent at: int = limit\nfluent far(n: 1..9) = n > limit\n")
    assert built.fluents["at"].initial.definition == "limit"


def test_a_definition_that_reads_a_fluent_through_another_is_not(found: Build) -> None:
    text = "fluent at: int = 1\ndefine here := at\ndefine there := here + 1\nfluent far: int = there\n"
    assert found(text) == ["4:19 GL020 an initial value cannot depend on `there`, which reads fluents"]


def test_whether_an_action_is_possible_is_not_closed(found: Build) -> None:
    text = "action go\nfluent can = poss(go)\n"
    assert found(text) == ["2:14 GL020 an initial value cannot depend on whether `go` is possible"]
