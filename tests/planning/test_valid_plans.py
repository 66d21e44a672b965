"""Every plan that golc prints is an execution of its program in every possible world; others do not pass for one."""

from __future__ import annotations

import copy
import random
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeAlias

import pytest

from golc.loading import load

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
PROGRAMS = ROOT / "tests" / "programs"

Plan: TypeAlias = list[dict[str, Any]]
Printed: TypeAlias = Callable[..., list[Plan]]

CASES = [
    (EXAMPLES / "delivery" / "delivery.gl", "control"),
    (EXAMPLES / "elevator" / "elevator.gl", "basic"),
    (EXAMPLES / "gates" / "gates.gl", "control"),
    (EXAMPLES / "gates" / "gates.gl", "think_first"),
    (EXAMPLES / "sorter" / "sorter.gl", "sort_one"),
    (PROGRAMS / "lift.gl", "control"),
    *[(EXAMPLES / name / f"{name}.gl", "control") for name in ("blocks", "handover", "husbands", "towers")],
    (EXAMPLES / "elevator" / "reactive.gl", "control"),
]


@pytest.mark.parametrize(
    ("path", "procedure", "strategy"),
    [(*case, strategy) for case in CASES for strategy in ("--first", "--shortest", "--cheapest")]
    + [(EXAMPLES / "elevator" / "elevator.gl", "smart", "--first")],
    ids=lambda value: getattr(value, "stem", value),
)
def test_the_plans_of_the_examples_are_valid(
    printed: Printed, validity: Any, path: Path, procedure: str, strategy: str
) -> None:
    [plan] = printed(str(path), procedure, strategy)
    valid = validity(load(path))
    assert valid.of_program(plan, procedure)
    assert not valid.of_program(plan[1:], procedure)


def test_every_plan_of_the_lift_is_valid(printed: Printed, validity: Any) -> None:
    path = PROGRAMS / "lift.gl"
    valid = validity(load(path))
    assert all(valid.of_program(plan) for plan in printed(str(path), "--all"))


@pytest.mark.parametrize("options", [[], ["--conformant"]])
def test_plans_for_goals_are_valid(tmp_path: Path, printed: Printed, validity: Any, options: list[str]) -> None:
    for path, goal in (
        (EXAMPLES / "gates" / "gates.gl", "inside"),
        (EXAMPLES / "gates" / "gates.gl", "at = right"),
        (EXAMPLES / "elevator" / "elevator.gl", "at = 5 and not lit(5)"),
        (EXAMPLES / "handover" / "handover.gl", "delivered"),
    ):
        plans = printed(str(path), "--goal", goal, *options)
        stated = tmp_path / "stated.gl"
        stated.write_text(f"{path.read_text()}\ngoal stated: {goal}\n")
        valid = validity(load(stated), bool(options))
        assert len(plans) == (0 if options and goal == "inside" else 1)
        assert all(valid.of_goal(plan, "stated") and not valid.of_goal(plan[:-1], "stated") for plan in plans)


# A walk through rooms with doors that may be shut, and bells that ring: what is sensed decides what comes next, and
# nothing may be left out, done twice or done otherwise.
HOUSE = """domain house
type room = {hall, kitchen, cellar}
type state = {open, shut}
fluent door(r: room): state = unknown
fluent key: 1..3 = one of {1, 2}
fluent at: room = hall
fluent bell: 0..2 = 0
fluent steps: int = 0
initially door(hall) = open or door(kitchen) = open
action look(r: room):
    poss at != cellar or r = cellar
    senses door(r)
    causes steps := steps + 1
action weigh:
    poss steps >= 1
    senses key
    causes bell := 1
action unlock(k: 1..3, r: room):
    poss door(r) = shut and key = k
    causes door(r) := open
    causes steps := steps + 1
action enter(r: room):
    poss door(r) = open and r != at
    causes at := r
    causes steps := steps + 1
exog ring expected:
    poss bell = 1
    causes bell := 2
exog chime(r: room) expected:
    poss bell = 2 and r != at
    causes bell := 0
proc control:
    look(kitchen)
    weigh
    wait until bell = 2
    if door(kitchen) = shut:
        if key = 1:
            unlock(1, kitchen)
        else:
            unlock(2, kitchen)
    enter(kitchen)
    wait
    look(cellar)
    if door(cellar) = open:
        enter(cellar)
        test steps in {4, 5}
    else:
        weigh
        look(hall)
        test steps in {4, 5}
proc choosy:
    choose:
        enter(kitchen)
    or:
        pick r: room where r != hall:
            look(r)
            test door(r) = open
            enter(r)
    or:
        look(kitchen)
        weigh
        pick k: 1..3:
            if door(kitchen) = shut:
                unlock(k, kitchen)
        enter(kitchen)
"""


@pytest.fixture(scope="module")
def house(tmp_path_factory: pytest.TempPathFactory) -> str:
    file = tmp_path_factory.mktemp("house") / "house.gl"
    file.write_text(HOUSE)
    return str(file)


def test_conditional_plans_with_events_are_valid(house: str, printed: Printed, validity: Any) -> None:
    valid = validity(load(house))
    for procedure in ("control", "choosy"):
        for strategy in ("--first", "--shortest", "--cheapest"):
            [plan] = printed(house, procedure, strategy)
            assert valid.of_program(plan, procedure)
            assert valid.of_program(plan, "choosy" if procedure == "control" else "control") is False


def parts(plan: Plan) -> Iterator[Plan]:
    """A plan and those of its branches, the branches' of those, …"""
    yield plan
    for branch in plan[-1].get("branches", []) if plan else []:
        yield from parts(branch["plan"])


def changed(plan: Plan, chance: random.Random) -> Plan:
    """A plan with one thing changed."""
    other = copy.deepcopy(plan)
    part = chance.choice([part for part in parts(other) if part])
    place = chance.randrange(len(part))
    step = part[place]
    branches = step.get("branches")
    match chance.choice(["drop", "double", "swap", "rename", "argument", "cut", "kind", "branch"]):
        case "drop" if branches is None:
            del part[place]
        case "double" if branches is None:
            part.insert(place, copy.deepcopy(step))
        case "swap" if place + 1 < len(part) and "branches" not in part[place + 1]:
            part[place], part[place + 1] = part[place + 1], part[place]
        case "rename":
            kind = "action" if "action" in step else "expected"
            step[kind] = chance.choice(["look", "weigh", "enter", "ring", "chime", "unlock", "fly"])
        case "argument" if step["args"]:
            step["args"][-1] = chance.choice(["hall", "kitchen", "cellar", 3])
        case "cut":
            del part[place:]
        case "kind":
            kind, new = ("action", "expected") if "action" in step else ("expected", "action")
            step[new] = step.pop(kind)
        case "branch" if branches is not None:
            match chance.choice(["drop", "swap", "results", "more", "none"]):
                case "drop":
                    del branches[chance.randrange(len(branches))]
                case "swap":
                    branches[0]["plan"], branches[1]["plan"] = branches[1]["plan"], branches[0]["plan"]
                case "results":
                    branches[0]["results"] = branches[1]["results"]
                case "more":
                    branches.append({"results": [3], "plan": []})
                case "none":
                    del step["branches"]
                    part += branches[0]["plan"]
    return other


def test_a_hundred_changed_plans_are_refused(house: str, printed: Printed, validity: Any) -> None:
    valid = validity(load(house))
    chance = random.Random(7)
    [plan] = printed(house)
    refused: list[Plan] = []
    while len(refused) < 150:
        other = changed(plan, chance)
        if other != plan and other not in refused:
            assert not valid.of_program(other), other
            refused.append(other)
