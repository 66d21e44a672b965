"""Prunes: no engine enters a situation in which one is known to hold."""

from __future__ import annotations

from typing import cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.planning.goals import GoalPlanning
from golc.planning.limits import Limits
from golc.planning.planner import Planning, executable
from golc.planning.plans import Plan
from golc.situation.dynamics import Dynamics
from golc.situation.happened import Happened
from golc.situation.interpret import Interpreter
from golc.situation.layout import World
from golc.theory.statements import Strategy
from golc.theory.theory import BasicActionTheory
from tests.theories import theory_of

DOMAIN = """domain walk
type spot = 0..4
fluent at: spot = 1
fluent fuel: int = 4
fluent open_: bool = false
action go(n: spot):
    poss n != at and abs(n - at) <= 2 and fuel >= abs(n - at)
    causes at := n
    causes fuel := fuel - abs(n - at)
action rest
action unlock:
    causes open_ := true
exog tow(n: spot) expected:
    poss fuel <= 0
    causes at := n
    causes fuel := 4
goal there: at = 4
proc control:
    star:
        choose:
            rest
        or:
            pick n: spot:
                go(n)
    test at = 4
proc towed:
    go(2)
    wait
    go(2)
"""


def planned(theory: BasicActionTheory, procedure: str = "control", strategy: str = "first") -> list[str] | None:
    planning = Planning(executable(theory, procedure), Limits(), strategy=Strategy(strategy))
    return next(([str(step) for step in plan.steps] for plan in planning), None)


@pytest.mark.parametrize(
    ("prune", "steps"),
    [
        ("", ["go(2)", "go(4)"]),
        ("prune detour: at = 2", ["go(3)", "go(4)"]),
        ("prune detour: at in {2, 3}", None),
        ("prune empty: fuel < 2", None),
        ("prune long: after go(n) when abs(n - before(at)) > 1", ["go(2)", "go(3)", "go(4)"]),
        ("prune to_four: after go(4) when before(at) = 2", ["go(3)", "go(4)"]),
        ("prune other: after rest", ["go(2)", "go(4)"]),
        ("prune never_two: after go(n) when n = 2 and before(fuel) = 4", ["go(3)", "go(4)"]),
        ("prune poor: after go(n) when exists m: spot. m = before(at) and m > n", ["go(2)", "go(4)"]),
    ],
)
@pytest.mark.parametrize("strategy", ["shortest", "cheapest"])
def test_the_best_plan_enters_no_bad_situation(prune: str, steps: list[str] | None, strategy: str) -> None:
    theory = theory_of(f"{DOMAIN}{prune}\n")
    assert planned(theory, strategy=strategy) == steps
    goal = GoalPlanning(theory, theory.definitions["there"].body, Limits())
    assert next(([str(step) for step in plan.steps] for plan in goal), None) == steps


def test_the_initial_situation_is_not_pruned() -> None:
    theory = theory_of(f"{DOMAIN}prune start: at = 1\n")
    assert planned(theory, strategy="shortest") == ["go(2)", "go(4)"]


def test_an_action_that_changes_nothing_enters_a_situation_too() -> None:
    assert planned(theory_of(f"{DOMAIN}prune start: at = 1\nproc still:\n    rest\n"), "still") is None


def test_an_expected_event_is_pruned_like_an_action() -> None:
    text = DOMAIN.replace("fuel: int = 4", "fuel: int = 1")
    assert planned(theory_of(text), "towed") == ["go(2)", "… tow(0)", "go(2)"]
    theory = theory_of(f"{text}prune back: after tow(n) when n < before(at)\n")
    planning = Planning(executable(theory, "towed"), Limits())
    assert list(planning) == []
    assert planning.outcome.stuck == ("go(2)",)
    assert [reason.text for reason in planning.outcome.reasons] == ["`tow(0)` is pruned by `back`"]


def test_a_dead_end_names_the_prune() -> None:
    theory = theory_of(f"{DOMAIN}prune low: fuel < 4\nproc pair:\n    rest\n    go(2)\n")
    planning = Planning(executable(theory, "pair"), Limits())
    assert list(planning) == []
    assert planning.outcome.stuck == ("rest",)
    assert [reason.text for reason in planning.outcome.reasons] == ["`go(2)` is pruned by `low`"]
    theory = theory_of(f"{DOMAIN}prune any: true\n")
    goal = GoalPlanning(theory, theory.definitions["there"].body, Limits())
    assert list(goal) == []
    assert [reason.text for reason in goal.outcome.reasons][:3] == [
        "`at = 4` is false",
        "`go(0)` is pruned by `any`",
        "`go(1)` is not possible: `n != at` is false",
    ]


def test_a_way_that_is_followed_from_another_state_enters_no_bad_situation() -> None:
    body = (
        "proc block:\n    search:\n        go(2)\n        choose:\n            go(3)\n        or:\n            rest\n"
    )
    ready = executable(theory_of(f"{DOMAIN}prune low: after go(n) when fuel < 1\n{body}"), "block")
    machine, state = ready.machine, ready.dynamics.initial()
    first = machine.decide(ready.node, state)
    assert first is not None and str(first.label) == "go(2)"
    state = machine.successor(state, first.label)
    second = machine.decide(first.residual, state)
    assert second is not None and str(second.label) == "go(3)"
    empty = (*cast(tuple[object, ...], state)[:1], 1, False)
    second = machine.decide(first.residual, empty)
    assert second is not None and str(second.label) == "rest"


UNKNOWN = """domain dark
fluent lit(n: 1..2): bool = unknown
action flip(n: 1..2):
    causes lit(n) := not lit(n)
action put_out(n: 1..2):
    causes lit(n) := false
proc control:
    choose:
        flip(1)
    or:
        put_out(1)
"""


@pytest.mark.parametrize(
    ("prune", "steps"),
    [
        ("prune out: not lit(1)", ["flip(1)"]),
        ("prune open: not knows(lit(1)) and not knows(not lit(1))", ["put_out(1)"]),
        # What `lit(1)` was is not known, so that a prune that depends on it does not hold.
        ("prune undo: after flip(n) when lit(n) != before(lit(n))", ["flip(1)"]),
        ("prune open: after flip(n) when not before(knows(lit(n)))", ["put_out(1)"]),
    ],
)
def test_a_prune_has_to_be_known(prune: str, steps: list[str]) -> None:
    assert planned(theory_of(f"{UNKNOWN}{prune}\n")) == steps


PRUNES = [
    "prune p1: at = 3",
    "prune p2: fuel < 2",
    "prune p3: open_ and at > 2",
    "prune p4: after go(n) when before(at) < n",
    "prune p5: after go(2) when before(fuel) > fuel + 1",
    "prune p6: after rest when before(at) = 1",
    "prune p7: after unlock when before(open_)",
    "prune p8: after go(n) when forall m: spot where m < n. m != before(at) or open_",
]
RANDOM = """proc random:
    star:
        choose:
            pick n: spot:
                go(n)
        or:
            unlock
        or:
            rest
"""


@given(chosen=st.sets(st.sampled_from(PRUNES), min_size=1, max_size=3))
def test_the_plans_are_those_that_enter_no_bad_situation(chosen: set[str]) -> None:
    free = theory_of(DOMAIN + RANDOM)
    theory = theory_of("\n".join([DOMAIN + RANDOM, *sorted(chosen), ""]))
    every = Planning(executable(free, "random"), Limits(steps=2), all_plans=True)
    left = Planning(executable(theory, "random"), Limits(steps=2), all_plans=True)
    allowed = [plan.actions for plan in every if not enters_a_bad_situation(theory, plan)]
    assert sorted(map(str, allowed)) == sorted(str(plan.actions) for plan in left)


def enters_a_bad_situation(theory: BasicActionTheory, plan: Plan) -> bool:
    """By the interpreter of terms instead of the compiled functions."""
    interpreter, dynamics = Interpreter(theory), Dynamics(theory)
    state = dynamics.initial()
    for act in plan.actions:
        after = dynamics.progress(state, act.action, act.args)
        for prune in theory.prunes.values():
            situation = cast(World, Happened(cast(World, after), state))
            if prune.action in (None, act.action) and interpreter.holds(prune.condition, situation, act.args):
                return True
        state = after
    return False
