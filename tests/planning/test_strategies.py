"""Shortest and cheapest plans, compared with the list of all plans."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, permutations
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from golc.planning.limits import Limits
from golc.planning.planner import Executable, Planning, executable
from golc.planning.plans import Plan
from golc.program.labels import Act
from golc.theory.statements import Strategy
from golc.theory.types import Number
from tests.theories import theory_of

EXAMPLES = Path(__file__).parents[2] / "examples"

DECLARATIONS = """domain trial
fluent x: int = 0
fluent on(n: 0..2) = n = 1
action free:
    cost 0
action a
action toll:
    cost x % 3 + 0.5
action inc:
    causes x := x + 1
    cost 2
action flip(n: 0..2):
    causes on(n) := not on(n)
    cost n
action off(n: 0..2):
    poss on(n)
    causes on(n) := false
"""


def compiled(lines: list[str]) -> Executable:
    return executable(
        theory_of("\n".join([DECLARATIONS, "proc control:", *(f"    {line}" for line in lines), ""])), "control"
    )


def one(program: Executable, strategy: Strategy, limits: Limits) -> Plan | None:
    return next(iter(Planning(program, limits, strategy=strategy)), None)


def cost(program: Executable, plan: tuple[Act, ...]) -> Number:
    """The sum of the costs, by the interpreter of terms instead of the compiled functions."""
    dynamics, state = program.dynamics, program.dynamics.initial()
    total: Number = 0
    for act in plan:
        term = dynamics.theory.actions[act.action].cost
        value = 1 if term is None else dynamics.knowing.evaluate(term, state, act.args)
        assert isinstance(value, int | Fraction)
        total += value
        state = dynamics.progress(state, act.action, act.args)
    return total


CONDITIONS = ["x = 0", "x < 2", "on(1)", "not on(2)", "exists n: 0..2. on(n)", "x % 2 = 1"]
LEAVES = ["free", "a", "toll", "inc", "flip(0)", "flip(2)", "off(1)", "off(x % 3)", "skip"]


def blocks(depth: int) -> st.SearchStrategy[list[str]]:
    """A block, as lines."""
    statement = st.sampled_from(LEAVES).map(lambda line: [line])
    condition = st.sampled_from(CONDITIONS)
    statement |= condition.map(lambda c: [f"test {c}"])
    if depth > 0:
        inner = blocks(depth - 1).map(lambda block: ["    " + line for line in block])
        statement |= st.one_of(
            st.tuples(inner, inner).map(lambda t: ["choose:", *t[0], "or:", *t[1]]),
            st.tuples(inner, inner).map(lambda t: ["together:", *t[0], "and:", *t[1]]),
            st.tuples(condition, inner).map(lambda t: [f"while {t[0]}:", *t[1]]),
            inner.map(lambda block: ["star:", *block]),
            inner.map(lambda block: ["star at most 2:", *block]),
            inner.map(lambda block: ["pick n: 0..2:", "    off(n)", *block]),
        )
    return st.lists(statement, min_size=1, max_size=3).map(lambda found: [line for block in found for line in block])


@given(body=blocks(2), steps=st.integers(1, 3))
def test_the_best_plan_is_the_first_of_the_best_of_all(body: list[str], steps: int) -> None:
    program = compiled(body)
    planning = Planning(program, Limits(steps=steps, nodes=1000), all_plans=True)
    every = [plan.actions for plan in planning]
    assume(planning.outcome.expanded <= 1000)
    shortest = one(program, Strategy.SHORTEST, Limits(steps=steps))
    cheapest = one(program, Strategy.CHEAPEST, Limits(steps=steps))
    assert (shortest and shortest.actions) == min(every, key=len, default=None)
    best = min(every, key=lambda plan: cost(program, plan), default=None)
    assert (cheapest and cheapest.actions) == best
    assert cheapest is None or cheapest.cost == cost(program, cheapest.actions)
    if shortest is not None:
        assert one(program, Strategy.SHORTEST, Limits()) == shortest


def test_search_shortest_drives_the_elevator_as_little_as_possible() -> None:
    """Of all orders of the floors, one by one, the best."""
    text = (EXAMPLES / "elevator" / "elevator.gl").read_text() + "proc tour:\n    search shortest:\n        basic\n"
    program = executable(theory_of(text), "tour")
    node, state, actions = program.node, program.dynamics.initial(), []
    while (transition := program.machine.decide(node, state)) is not None:
        label, node = transition
        state = program.machine.successor(state, label)
        actions += [label.action] if isinstance(label, Act) else []
    moves = min(sum(abs(a - b) for a, b in pairwise((3, *order, 1))) for order in permutations((2, 5, 9)))
    assert program.machine.final(node, state)
    assert actions.count("up") + actions.count("down") == moves
    assert len(actions) == moves + 3 * 3 + 1


def test_a_bound_that_is_too_small_is_told() -> None:
    planning = Planning(compiled(["inc", "inc"]), Limits(steps=1), strategy=Strategy.CHEAPEST)
    assert list(planning) == []
    assert planning.outcome.gave_up == "no plan of more than 1 steps was considered"
    assert planning.outcome.stuck == ("inc",)
    assert planning.outcome.reasons == []


def test_where_no_plan_is_the_longest_way_is_told() -> None:
    planning = Planning(
        compiled(["inc", "choose:", "    a", "    off(2)", "or:", "    off(0)"]), Limits(), strategy=Strategy.SHORTEST
    )
    assert list(planning) == []
    assert planning.outcome.gave_up is None
    assert [str(action) for action in planning.outcome.stuck] == ["inc", "a"]
    assert [reason.span.text for reason in planning.outcome.reasons] == ["off(2)"]


ROUND = """domain round
fluent at: 1..2 = 1
fluent key: bool = {key}
action go(x: 1..2):
    poss x != at
    causes at := x
action enter:
    poss key
action look:
    poss false
    senses key
proc control:
    star:
        pick x: 1..2:
            go(x)
    enter
    look
"""


@pytest.mark.parametrize("key", ["false", "unknown"])
@pytest.mark.parametrize("strategy", Strategy)
def test_where_every_way_leads_back_the_longest_is_told(strategy: Strategy, key: str) -> None:
    planning = Planning(executable(theory_of(ROUND.format(key=key)), "control"), Limits(), strategy=strategy)
    assert list(planning) == []
    assert planning.outcome.gave_up is None
    assert planning.outcome.stuck[:1] == ("go(2)",)
    assert planning.outcome.reasons[0].span.text == "enter"


def test_a_plan_that_was_found_is_not_given_up_because_a_longer_way_was_cut() -> None:
    planning = Planning(compiled(["choose:", "    a", "    a", "or:", "    free"]), Limits(steps=1))
    assert [[str(action) for action in plan.actions] for plan in planning] == [["free"]]
    assert planning.outcome.gave_up is None
