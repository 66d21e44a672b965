"""Prunes: formulas about bad situations, and what an action has led to."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from golc.theory.terms import Before, FluentTerm, Literal, Operation, Operator, Variable
from golc.theory.theory import Prune
from golc.theory.types import BOOL, INT, Interval

Build = Callable[..., Any]

FLOOR = Interval(1, 3)
HEAD = """type floor = 1..3
const top = 3
fluent at: floor = 1
fluent fuel: int = 5
action go(n: floor, fast: bool)
action swap(a: floor, b: int)
exog call(n: floor)
"""
AT = FluentTerm("at", (), type=FLOOR)


def equal(left: Any, right: Any) -> Operation:
    return Operation(Operator.EQUAL, (left, right), type=BOOL)


def test_a_formula_about_any_situation(theory: Build) -> None:
    fuel = FluentTerm("fuel", (), type=INT)
    condition = Operation(Operator.LESS, (fuel, Literal(0, type=INT)), type=BOOL)
    assert theory(HEAD + "prune hopeless: fuel < 0\n").prunes == {"hopeless": Prune("hopeless", None, condition)}


def test_names_of_the_pattern_are_the_parameters_of_the_action(theory: Build) -> None:
    prunes = theory(HEAD + "prune back: after go(n, quick) when before(at) = n and quick\n").prunes
    n, fast = Variable(0, "n", type=FLOOR), Variable(1, "fast", type=BOOL)
    both = Operation(Operator.AND, (equal(Before(AT, type=FLOOR), n), fast), type=BOOL)
    assert prunes["back"] == Prune("back", "go", both)


def test_constants_of_the_pattern_are_demanded_before_the_condition(theory: Build) -> None:
    prunes = theory(HEAD + "prune high: after go(top, true) when at = 1\n").prunes
    n, fast = Variable(0, "n", type=FLOOR), Variable(1, "fast", type=BOOL)
    demands = (equal(n, Literal(3, type=INT)), equal(fast, Literal(True, type=BOOL)), equal(AT, Literal(1, type=INT)))
    assert prunes["high"].condition == Operation(Operator.AND, demands, type=BOOL)


def test_a_name_that_stands_twice_has_to_match(theory: Build) -> None:
    prunes = theory(HEAD + "prune same: after swap(x, x)\n").prunes
    assert prunes["same"].condition == equal(Variable(1, "b", type=INT), Variable(0, "a", type=FLOOR))


def test_without_a_condition_an_action_is_never_taken(theory: Build) -> None:
    assert theory(HEAD + "prune calls: after call(n)\n").prunes["calls"] == Prune(
        "calls", "call", Literal(True, type=BOOL)
    )


def test_prunes_have_names_of_their_own(theory: Build) -> None:
    prunes = theory(HEAD + "prune at: at = 2\nprune go: fuel < 1\nprune floor: after call(1)\n").prunes
    assert list(prunes) == ["at", "go", "floor"]


def test_variables_of_the_condition_come_after_the_parameters(theory: Build) -> None:
    prunes = theory(HEAD + "prune near: after call(n) when exists m: floor. m = n + before(at)\n").prunes
    assert prunes["near"].condition.binders[0].variable == Variable(1, "m", type=FLOOR)
