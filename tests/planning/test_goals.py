"""Planning for a goal: the shortest plan, first in the order of declarations, types and arguments."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.api.loading import load
from golc.diagnostics import ProgramError, UserError
from golc.planning.plans import Outcome

LIFT = """domain lift
type floor = 1..4
fluent at: floor = 2
fluent lit(n: floor) = n in {1, 4}
action up:
    poss at < 4
    causes at := at + 1
action down:
    poss at > 1
    causes at := at - 1
action off(n: floor):
    poss at = n and lit(n)
    causes lit(n) := false
exog call(n: floor):
    causes lit(n) := true
goal dark: not exists n: floor. lit(n)
"""

PEGS = """domain pegs
type spot = {a, b, c}
fluent on(s: spot): 0..2 = 1 if s = a else 0
action put(from_: spot, to: spot):
    poss from_ != to and on(from_) > 0
    causes on(from_) := on(from_) - 1
    causes on(to) := on(to) + 1
action drop(s: spot):
    causes on(s) := 0
"""


def plan(
    tmp_path: Path, text: str, goal: str, steps: int | None = None, nodes: int | None = None
) -> tuple[list[str] | None, Outcome]:
    path = tmp_path / "domain.gl"
    path.write_text(text)
    planning = load(path).planning(goal=goal, steps=steps, nodes=nodes)
    plans = [[str(action) for action in found.actions] for found in planning]
    return (plans[0] if plans else None), planning.outcome


@pytest.mark.parametrize(
    ("text", "goal", "actions"),
    [
        # The lower light first: 1 + 3 moves; the upper one first would take 2 + 3.
        (LIFT, "dark", ["down", "off(1)", "up", "up", "up", "off(4)"]),
        (LIFT, "lit(4) and at = 3", ["up"]),
        (LIFT, "at = 2", []),
        (PEGS, "on(a) = 0", ["put(a, b)"]),
        (PEGS, "on(c) = 1", ["put(a, c)"]),
        (PEGS, "forall s: spot. on(s) = 0", ["drop(a)"]),
    ],
)
def test_the_first_of_the_shortest_plans_is_found(tmp_path: Path, text: str, goal: str, actions: list[str]) -> None:
    found, outcome = plan(tmp_path, text, goal)
    assert (found, outcome.plans, outcome.gave_up) == (actions, 1, None)


def test_what_cannot_be_reached_is_proven_with_what_is_false_at_the_deepest_point(tmp_path: Path) -> None:
    found, outcome = plan(tmp_path, LIFT, "lit(2) and at = 3")
    assert (found, outcome.gave_up) == (None, None)
    # 4 floors with each light on or off: all 16 states are looked at.
    assert outcome.expanded == 16
    assert outcome.reasons[0].text == "`lit(2)` is false"
    assert outcome.reasons[0].values == (("lit(2)", False),)


def test_where_nothing_is_possible_the_preconditions_are_named(tmp_path: Path) -> None:
    text = "domain d\nfluent x: int = 0\naction go:\n    poss x > 2\n    causes x := 5\n"
    found, outcome = plan(tmp_path, text, "x = 5")
    assert found is None
    assert [reason.text for reason in outcome.reasons] == [
        "`x = 5` is false",
        "`go` is not possible: `x > 2` is false",
    ]


@pytest.mark.parametrize(
    ("limits", "gave_up"),
    [
        ({"steps": 5}, "no plan of more than 5 steps was considered"),
        ({"nodes": 3}, "gave up after 3 expanded pairs of program and state"),
    ],
)
def test_a_limit_is_no_proof(tmp_path: Path, limits: dict[str, int], gave_up: str) -> None:
    found, outcome = plan(tmp_path, LIFT, "dark", **limits)
    assert (found, outcome.gave_up) == (None, gave_up)


def test_a_plan_of_just_so_many_steps_is_found(tmp_path: Path) -> None:
    found, _ = plan(tmp_path, LIFT, "dark", steps=6)
    assert found is not None


def test_an_action_with_an_endless_type_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UserError, match="`go` cannot be used to plan for a goal: `n` has no list of values"):
        plan(tmp_path, "domain d\nfluent x: int = 0\naction go(n: int):\n    causes x := n\n", "x = 5")


def test_an_action_that_leaves_a_type_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ProgramError, match="`at` would be 3, which is outside"):
        plan(tmp_path, "domain d\nfluent at: 1..2 = 1\naction up:\n    causes at := at + 1\n", "at = 1 and at = 2")


def test_what_has_no_value_behind_what_is_false_is_no_error(tmp_path: Path) -> None:
    text = (
        "domain d\nfluent x: 0..3? = none\nfluent lit(n: 0..3) = false\naction a:\n    poss lit(0)\n    causes x := 1\n"
    )
    found, outcome = plan(tmp_path, text, "x != none and x < 3 and lit(x)")
    assert found is None
    assert [str(reason).split(": ", 1)[1] for reason in outcome.reasons] == [
        "`x != none` is false (x = none)",
        "`a` is not possible: `lit(0)` is false (lit(0) = false)",
    ]
    assert plan(tmp_path, text, "forall n: 0..3. x != none and lit(x)")[1].reasons[0].values == ()
