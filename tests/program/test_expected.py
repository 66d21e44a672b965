"""Exogenous actions that look-ahead counts on: where they happen, and how a way that counts on them is followed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.planning.limits import Limits
from golc.planning.planner import Planning
from golc.program.labels import Act, Wait

Start = Callable[..., Any]

EXPECTED = """
exog arrive expected:
    poss x > 0 and not p
    causes p := true
exog ring(n: digit) expected:
    poss on(n)
    causes on(n) := false
exog leave expected:
    poss p
    causes p := false
"""


def plans(program: Any) -> list[list[str]]:
    return [[str(step) for step in plan.steps] for plan in Planning(program.executable, Limits(), all_plans=True)]


def reasons(program: Any) -> list[str]:
    planning = Planning(program.executable, Limits())
    assert list(planning) == []
    return [reason.text for reason in planning.outcome.reasons]


@pytest.mark.parametrize(
    ("body", "steps"),
    [
        ("wait", ["… ring(1)"]),
        ("inc\nwait\na", ["inc", "… arrive", "a"]),
        ("wait\nwait\nwait until not on(2)", ["… ring(1)", "… ring(2)"]),
        ("wait until not on(2)\na", ["… ring(1)", "… ring(2)", "a"]),
        ("wait until not p\na", ["a"]),
        ("inc\nwait until p\nwait until not p\nb", ["inc", "… arrive", "… ring(1)", "… ring(2)", "… leave", "b"]),
        ("wait 5 s\na", ["a"]),
    ],
)
def test_the_first_expected_exogenous_action_ends_a_wait(start: Start, body: str, steps: list[str]) -> None:
    assert plans(start(body, EXPECTED)) == [steps]


def test_what_can_be_done_is_done_before_anything_happens(start: Start) -> None:
    program = start("together:\n    wait until p\n    a\nand:\n    inc\n    b", EXPECTED)
    assert plans(program) == [["inc", "b", "… arrive", "a"]]
    assert plans(start("choose:\n    wait\nor:\n    a", EXPECTED)) == [["a"]]


def test_each_wait_that_may_end_is_a_choice(start: Start) -> None:
    program = start("choose:\n    wait\n    a\nor:\n    wait\n    b", EXPECTED)
    assert plans(program) == [["… ring(1)", "a"], ["… ring(1)", "b"]]


def test_a_part_that_waits_for_what_is_expected_holds_those_below_it(start: Start) -> None:
    body = "prefer:\n    wait until {0}\n    a\nover:\n    off(2)\n    b"
    assert plans(start(body.format("not on(1)"), EXPECTED)) == [["… ring(1)", "a", "off(2)", "b"]]
    nothing_expected = "exog arrive expected:\n    poss false\n    causes p := true\n"
    assert plans(start(body.format("not on(2)"), nothing_expected)) == [["off(2)", "a", "b"]]


def test_interrupts_are_not_over_while_something_is_expected(start: Start) -> None:
    body = "interrupts:\n    on p:\n        never\n    on exists n: digit. on(n):\n        wait"
    assert plans(start(body, EXPECTED)) == [["… ring(1)", "… ring(2)"]]


def test_nothing_happens_where_nothing_is_declared_to_be_expected(start: Start) -> None:
    assert reasons(start("wait")) == ["look-ahead cannot wait: nothing happens while it thinks"]
    assert reasons(start("wait until p")) == ["`p` is false"]


def test_a_wait_without_end_names_what_is_expected_and_not_possible(start: Start) -> None:
    text = "nothing is expected: `arrive` is not possible: `x > 0` is false (x = 0); no `ring` is possible; "
    text += "`leave` is not possible: `p` is false (p = false)"
    program = start("off(1)\noff(2)\nwait", EXPECTED)
    assert reasons(program) == [f"look-ahead cannot wait: nothing happens while it thinks, and {text}"]
    program = start("off(1)\noff(2)\nwait until x = 1", EXPECTED)
    assert reasons(program) == [f"`x = 1` is false, and {text}"]


def test_events_cost_nothing_and_are_no_steps(start: Start) -> None:
    program = start("inc\nwait until p\na", EXPECTED)
    planning = Planning(program.executable, Limits(steps=2))
    [plan] = planning
    assert [str(step) for step in plan.steps] == ["inc", "… arrive", "a"]
    assert [str(action) for action in plan.actions] == ["inc", "a"]


SEARCH = """
    search:
        inc
        wait until p
        choose:
            test x = 1
            a
        or:
            b
"""


def follow(program: Any, *events: tuple[Any, ...]) -> list[str]:
    """What a run does whose waits end with these exogenous actions, in order."""
    pending, done = [*events], []
    while (decided := program.machine.decide(program.node, program.state)) is not None:
        label, node = decided
        program.node = node
        if isinstance(label, Act):
            done.append(str(label))
            program.state = program.machine.successor(program.state, label)
        elif isinstance(label, Wait):
            done.append("wait")
            if not pending:
                return done
            program = program.event(*pending.pop(0))
    return done if program.final else [*done, "blocked"]


def test_a_search_block_waits_for_what_it_expects(start: Start) -> None:
    assert follow(start(SEARCH, EXPECTED)) == ["inc", "wait"]
    assert follow(start(SEARCH, EXPECTED), ("arrive",)) == ["inc", "wait", "a"]


def test_another_event_makes_it_look_again(start: Start) -> None:
    events: list[tuple[Any, ...]] = [("ring", 1), ("set_x", 3), ("arrive",)]
    assert follow(start(SEARCH, EXPECTED), *events) == ["inc", "wait", "wait", "wait", "b"]


def test_an_event_that_comes_before_it_is_waited_for_is_not_waited_for_again(start: Start) -> None:
    program = start(SEARCH, EXPECTED)
    label, program.node = program.machine.decide(program.node, program.state)
    program.state = program.machine.successor(program.state, label)
    assert str(label) == "inc"
    assert follow(program.event("arrive")) == ["a"]


def test_a_plan_is_lost_if_what_it_counted_on_does_not_come(start: Start) -> None:
    once = "exog arrive expected:\n    poss x = 1 and not p\n    causes p := true\n"
    program = start("search:\n    inc\n    wait\n    test p\n    a", once)
    assert follow(program, ("set_x", 1)) == ["inc", "wait", "blocked"]
