"""What the Golog and IndiGolog interpreters did with their elevators, golc does too."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from golc.loading import load
from golc.planning.goals import GoalPlanning
from golc.planning.limits import Limits
from golc.planning.planner import Planning, executable
from golc.program.labels import Act, Wait

TESTS = Path(__file__).parents[1]
EXAMPLES = TESTS.parent / "examples"


def case(name: str) -> Any:
    return json.loads((TESTS / "cases" / f"{name}.json").read_text())


def plans(path: Path, procedure: str, all_plans: bool = False) -> list[list[str]]:
    planning = Planning(executable(load(path), procedure), Limits(), all_plans)
    return [[str(action).replace(" ", "") for action in plan.actions] for plan in planning]


def run(path: Path, procedure: str) -> tuple[str, list[str]]:
    """What the online loop does if no exogenous action ever happens: how it ends, and the actions."""
    ready = executable(load(path), procedure)
    node, state = ready.node, ready.dynamics.initial()
    actions: list[str] = []
    while not ready.machine.final(node, state):
        transition = ready.machine.decide(node, state)
        if transition is None:
            return "failed", actions
        label, node = transition
        if isinstance(label, Wait):
            return "idle", actions
        if isinstance(label, Act):
            actions.append(str(label))
        state = ready.machine.successor(state, label)
    return "final", actions


@pytest.mark.parametrize("name", ["basic", "smart"])
def test_the_elevator_plans_as_recorded(name: str) -> None:
    assert plans(EXAMPLES / "elevator" / "elevator.gl", name) == [case(f"elevator-{name}")["actions"]]


@pytest.mark.parametrize("name", ["basic", "smart", "dumb"])
def test_the_elevator_runs_as_recorded(name: str) -> None:
    recorded = case(f"elevator-{name}")
    assert run(EXAMPLES / "elevator" / "elevator.gl", name) == (recorded["outcome"], recorded["actions"])


def test_the_reactive_elevator_runs_as_recorded() -> None:
    recorded = case("elevator-reactive-quiet")
    assert run(EXAMPLES / "elevator" / "reactive.gl", "control") == (recorded["outcome"], recorded["actions"])


def test_the_lift_has_the_recorded_executions_each_once() -> None:
    assert plans(TESTS / "programs" / "lift.gl", "control", all_plans=True) == case("lift-two-calls")["executions"]


def test_the_ten_blocks_have_the_one_recorded_plan_of_the_least_length() -> None:
    theory = load(EXAMPLES / "blocks" / "blocks.gl")
    recorded = case("blocks-ten")["actions"]
    (goal,) = GoalPlanning(theory, theory.definitions["done"].body, Limits())
    assert [_as_recorded(str(action)) for action in goal.actions] == recorded
    (plan,) = Planning(executable(theory, "control"), Limits(steps=11), all_plans=True)
    assert [_as_recorded(str(action)) for action in plan.actions] == recorded
    assert not list(Planning(executable(theory, "control"), Limits(steps=10)))


def _as_recorded(action: str) -> str:
    return action.replace(", ", ",")
