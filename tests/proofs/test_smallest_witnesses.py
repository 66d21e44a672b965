"""What a witness shows: the fewest fluents, and the smallest values."""

from __future__ import annotations

import pytest

from golc.proofs.prover import Prover
from golc.proofs.questions import Asked, Question, Witness
from tests.theories import theory_of

HEAD = """\
domain trial
type small = 0..3
type colour = {red, green, blue}
fluent x: small = 0
fluent y: int = 0
fluent z: int = 0
fluent far: -1000000..1000000 = 0
fluent on(n: small): bool = false
fluent paint: colour? = none
fluent seen: set[colour] = {}
fluent many: set[small] = {}
fluent route: list[small] = []
fluent fuel: real = 0
"""


def answer(formula: str, fails: bool = False, more: str = "") -> object:
    theory = theory_of(f"{HEAD}{more}define asked := {formula}\n")
    return Prover(theory).answer(Question((), (Asked(theory.definitions["asked"].body),), fails))


def shown(formula: str, fails: bool = False, more: str = "") -> dict[str, object]:
    found = answer(formula, fails, more)
    assert isinstance(found, Witness), found
    return dict(found.fluents)


@pytest.mark.parametrize(
    "formula",
    ["2 * y = 7", "3 * y + 1 = 9", "y - 2 * y = y + 1 and y > 0", "far > 1000000", "far < -1000000", "4 * far = 2"],
)
def test_what_no_integer_makes_true_has_no_witness(formula: str) -> None:
    assert answer(formula) is None


@pytest.mark.parametrize(
    ("formula", "fluents"),
    [
        ("x > 1", {"x": 2}),
        ("y > 4 or y < -2", {"y": -3}),
        ("y != 0", {"y": 1}),
        ("far < -700 or far > 800", {"far": -701}),
        ("far > 999999", {"far": 1000000}),
        ("2 * y = 8", {"y": 4}),
        ("far = -1000000", {"far": -1000000}),
        ("(x = 1 and on(1)) or y = 9", {"y": 9}),
        ("on(x)", {"x": 0, "on(0)": True}),
        ("x = 2 and on(x)", {"x": 2, "on(2)": True}),
        ("exists n: small. on(n)", {"on(0)": True}),
        ("(count n: small. on(n)) >= 2", {"on(0)": True, "on(1)": True}),
        ("(count n: small. on(n)) < 2", {"on(0)": False, "on(1)": False, "on(2)": False}),
        ("forall n: small. on(n) implies n > 2", {"on(0)": False, "on(1)": False, "on(2)": False}),
        ("(on(1) or x = 0) and (on(1) or y = 2)", {"on(1)": True}),
        ("on(2) if on(0) iff on(1) else on(2)", {"on(2)": True}),
        ("x = 1 or not (x = 1)", {}),
        ("paint != none", {"paint": "red"}),
        ("paint > red and paint != green", {"paint": "blue"}),
        ("green in seen", {"seen": frozenset({"green"})}),
        ("len(seen) > 1 and red not in seen", {"seen": frozenset({"green", "blue"})}),
        ("len(route) > 0 and first(route) > 1", {"route": (2,)}),
        ("fuel > 0.5", {"fuel": 1}),
        ("len(route) = 2 and y >= 0 and route[y] = 1 and first(route) = 0", {"route": (0, 1), "y": 1}),
    ],
)
def test_a_formula_is_made_true_by_the_fewest_fluents_and_the_smallest_values(
    formula: str, fluents: dict[str, object]
) -> None:
    paint = "paint != none and " if "paint >" in formula else ""
    assert shown(paint + formula) == fluents


@pytest.mark.parametrize(
    ("formula", "fluents"),
    [
        ("y + z > 10", 11),
        ("y + z = 5 and y > z + 1", 5),
        ("y * 2 - z * 3 = 7 and y > 0", 3),
        ("y + z < -20 and far > y", 21),
        ("x = 0 and on(1) and y + z > 8 or y + z > 10 and on(1)", 10),
    ],
)
def test_what_a_solver_finds_is_near_0(formula: str, fluents: int) -> None:
    found = shown(formula)
    assert sum(abs(value) for value in found.values() if isinstance(value, int)) == fluents


@pytest.mark.parametrize(
    ("formula", "fluents"),
    [
        ("on(x + 1)", {"x": 3}),
        ("y >= 0 and on(y)", {"y": 4}),
        ("6 // (x - 2) > 1", {"x": 2}),
        ("on(1) and x = 9 // y", {"on(1)": True, "y": 0}),
        ("first(route) = 1", {"route": ()}),
        ("len(many) < 3 and (max n in many. n) > 1", {"many": frozenset()}),
    ],
)
def test_an_error_is_shown_by_the_fewest_fluents_and_the_smallest_values(
    formula: str, fluents: dict[str, object]
) -> None:
    assert shown(formula, fails=True) == fluents


def test_an_invariant_is_no_part_of_what_is_shown() -> None:
    assert shown("x > 0 and y > 0", more="invariant tied: on(0) or y > 7 * x\n") == {"x": 1, "y": 1}
    assert shown("x > 0 and y > 0", more="invariant tied: y > 7 * x\n") == {"x": 1, "y": 8}
