"""Goals and invariants: formulas with names; an invariant holds in the initial state."""

from __future__ import annotations

from pathlib import Path

import pytest

import golc
from golc.diagnostics import Code, UserError
from golc.loading import examine, load

LIFT = """domain lift
type floor = 1..4
fluent at: floor = 2
fluent lit(n: floor) = n in {1, 4}
action move(n: floor):
    poss n != at
    causes at := n
"""


def found(tmp_path: Path, text: str) -> list[tuple[str, str, str]]:
    """Code, message and marked text of every finding."""
    path = tmp_path / "lift.gl"
    path.write_text(LIFT + text)
    return [
        (finding.code.code, finding.message, finding.span.text)
        for finding in examine(path).findings
        if finding.code is not Code.UNUSED
    ]


@pytest.mark.parametrize(
    "text",
    [
        "invariant low: at < 3\n",
        "invariant low: not lit(at)\n",
        "invariant low: poss(move(3)) and not poss(move(2))\n",
        "invariant low: forall n: floor where lit(n). n != at\n",
        "goal dark: not exists n: floor. lit(n)\ninvariant low: not dark\n",
        "define busy := exists n: floor. lit(n)\ninvariant low: busy\n",
    ],
)
def test_an_invariant_that_holds_at_first_is_fine(tmp_path: Path, text: str) -> None:
    assert found(tmp_path, text) == []


@pytest.mark.parametrize(
    ("text", "message", "marked"),
    [
        ("invariant low: at < 2\n", "invariant `low` is false in the initial state", "at < 2"),
        ("invariant low: lit(at)\n", "invariant `low` is false in the initial state", "lit(at)"),
        (
            "invariant low: 1 // (at - 2) = 0\n",
            "invariant `low` cannot be evaluated in the initial state: division by zero",
            "1 // (at - 2)",
        ),
        (
            "invariant low: lit(at + 3)\n",
            "invariant `low` cannot be evaluated in the initial state: argument 5 of `lit` is outside `floor` (1..4)",
            "at + 3",
        ),
    ],
)
def test_an_invariant_that_does_not_is_an_error(tmp_path: Path, text: str, message: str, marked: str) -> None:
    assert found(tmp_path, text) == [("GL052", message, marked)]


def test_an_invariant_that_is_too_much_to_evaluate_is_said_to_be_undecided(tmp_path: Path) -> None:
    ((code, message, _),) = found(tmp_path, "invariant all: forall x: 1..1000, y: 1..1000. x + y + at > 0\n")
    assert code == "GL052"
    assert message == "whether invariant `all` holds at first is not decided: it takes too many steps"


def test_goals_and_invariants_are_formulas_without_arguments(tmp_path: Path) -> None:
    assert found(tmp_path, "goal high: at + 1\n")[0][:2] == (
        "GL016",
        "`at + 1` is of type `int`, but goal `high` needs `bool`",
    )
    assert found(tmp_path, "goal high: at = 4\ndefine up := high(1)\n")[0][0] == Code.ARITY.code
    assert found(tmp_path, "goal high: at = 4\ninvariant high: at = 2\n")[0][0] == Code.DUPLICATE.code
    assert found(tmp_path, "goal a: b\ngoal b: a\n")[0][0] == Code.CIRCULAR.code


def test_their_names_are_in_the_theory(tmp_path: Path) -> None:
    path = tmp_path / "lift.gl"
    path.write_text(LIFT + "goal high: at = 4\ninvariant low: at < 5\n")
    theory = load(path)
    assert (theory.goals, theory.invariants) == (("high",), ("low",))


def test_a_formula_from_outside_has_its_own_places(tmp_path: Path) -> None:
    path = tmp_path / "lift.gl"
    path.write_text(LIFT)
    with pytest.raises(UserError) as caught:
        golc.load(path).planning(goal="at = 3 and bright")
    (finding,) = caught.value.diagnostics
    assert (str(finding.span), finding.span.text) == ("<goal>:1:12", "bright")
