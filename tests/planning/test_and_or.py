"""The search of AND-OR graphs, on graphs written down by hand and at random."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TypeAlias

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import NOWHERE, LimitError, ProgramError
from golc.planning import and_or, worst_case
from golc.planning.and_or import Option, Solved, Stuck
from golc.planning.limits import Budget, Limits
from golc.program.labels import Act, Foreseen, Silent

Graph: TypeAlias = Mapping[str, list[tuple[str, str]]]
"""For each pair its options: the action (none: a silent step) and the pairs of its outcomes, as letters."""


class Drawn:
    """A graph as a problem; ``!`` is the end."""

    def __init__(self, graph: Graph) -> None:
        self.graph = graph

    def is_end(self, pair: str) -> bool:
        return pair == "!"

    def options(self, pair: str) -> Iterator[Option[str]]:
        for action, outcomes in self.graph[pair]:
            label: Foreseen = Act(action, (), NOWHERE) if action else Silent(NOWHERE)
            yield Option(label, tuple([((number,), after) for number, after in enumerate(outcomes)]))


def spell(found: Solved[str] | None) -> str:
    """A plan as ``x(y!, z!)``: after x, which has two outcomes, y or z, then the end."""
    if found is None:
        return "stuck"
    if found.option is None:
        return "!"
    ways = [spell(way) for way in found.ways]
    name = found.option.label.action if isinstance(found.option.label, Act) else "."
    return f"{name}{ways[0]}" if len(ways) == 1 else f"{name}({', '.join(ways)})"


def first(graph: Graph, start: str = "s", steps: int | None = None) -> str:
    return spell(and_or.first(Drawn(graph), start, Budget(Limits(steps=steps))))


def one(pair: object, act: Act) -> int:
    return 1


def lightest(graph: Graph, start: str = "s", steps: int | None = None) -> str:
    budget = Budget(Limits(steps=steps))
    return spell(worst_case.find(Drawn(graph), start, budget, one, lambda weight: budget.allows(int(weight))))


def test_every_outcome_needs_a_way() -> None:
    assert first({"s": [("x", "pq")], "p": [("y", "!")], "q": [("z", "!")]}) == "x(y!, z!)"
    assert first({"s": [("x", "pq")], "p": [("y", "!")], "q": []}) == "stuck"
    assert first({"s": [("x", "pq"), ("z", "!")], "p": [("y", "!")], "q": []}) == "z!"


def test_a_plan_has_a_step() -> None:
    assert first({"!": [("x", "!")]}, "!") == "x!"
    assert first({"!": [("x", "p")], "p": [("y", "!")]}, "!") == "xy!"
    assert first({"!": []}, "!") == lightest({"!": []}, "!") == "stuck"
    assert lightest({"!": [("x", "p")], "p": [("y", "!")]}, "!") == "xy!"


def test_a_plan_has_no_circles() -> None:
    assert first({"s": [("x", "s!"), ("y", "!")]}) == "y!"
    assert first({"s": [("x", "pp")], "p": [("y", "s"), ("z", "!")]}) == "x(z!, z!)"


def test_what_failed_because_of_an_open_pair_is_tried_again() -> None:
    """p fails on the way from q, which is open; q is solved by z, and then p by w and q."""
    graph = {"s": [("x", "qp")], "q": [("y", "p"), ("z", "!")], "p": [("w", "q")]}
    assert first(graph) == lightest(graph) == "x(z!, wz!)"


def test_what_failed_below_a_pair_that_fails_is_not_tried_again() -> None:
    graph = {"s": [("a", "p"), ("b", "q"), ("c", "!")], "p": [("d", "q")], "q": [("e", "p")]}
    budget = Budget()
    assert spell(and_or.first(Drawn(graph), "s", budget)) == "c!"
    assert budget.expanded == 3


def test_a_failure_that_is_used_again_depends_on_what_it_depended_on() -> None:
    """r is tried below q, then below p; both fail because of the open t, which is solved by z."""
    graph = {
        "s": [("x", "tp")],
        "t": [("a", "q"), ("b", "p"), ("z", "!")],
        "q": [("c", "r")],
        "p": [("d", "r")],
        "r": [("e", "t")],
    }
    assert first(graph) == "x(z!, dez!)"


def test_equal_ends_of_branches_are_one_plan() -> None:
    graph = {"s": [("x", "pq")], "p": [("y", "r")], "q": [("z", "r")], "r": [("w", "!")]}
    found = and_or.first(Drawn(graph), "s", Budget())
    assert isinstance(found, Solved)
    assert found.ways[0].ways[0] is found.ways[1].ways[0]


def test_silent_steps_weigh_nothing() -> None:
    graph = {"s": [("a", "p"), ("", "q")], "p": [("b", "!")], "q": [("", "r")], "r": [("c", "!")]}
    assert first(graph) == "ab!"
    assert lightest(graph) == "..c!"


def test_the_worst_branch_counts_and_every_branch_is_best() -> None:
    graph = {
        "s": [("x", "pq"), ("y", "p")],
        "p": [("a", "r"), ("b", "r"), ("", "t")],
        "t": [("c", "!"), ("d", "!")],
        "q": [("e", "!")],
        "r": [("", "!")],
    }
    assert lightest(graph) == "x(a.!, e!)"
    assert lightest({**graph, "q": [("e", "r"), ("f", "s")]}) == "x(a.!, e.!)"
    assert lightest({**graph, "q": [("e", "p")]}) == "ya.!"


def test_a_bound_on_steps_counts_the_actions_of_each_branch() -> None:
    graph = {"s": [("x", "pq")], "p": [("a", "r"), ("b", "!")], "r": [("c", "!")], "q": [("d", "r")]}
    assert first(graph, steps=3) == "x(ac!, dc!)"
    assert first(graph, steps=2) == lightest(graph, steps=2) == "stuck"
    assert first({**graph, "q": [("d", "!")]}, steps=2) == "x(b!, d!)"
    assert lightest({**graph, "q": [("d", "!")]}, steps=2) == "x(b!, d!)"


def test_a_pair_that_is_near_in_one_branch_may_be_far_in_another() -> None:
    graph = {"s": [("x", "pr")], "p": [("y", "r")], "r": [("z", "!")]}
    assert first(graph, steps=3) == lightest(graph, steps=3) == "x(yz!, z!)"
    assert first(graph, steps=2) == lightest(graph, steps=2) == "stuck"


def test_why_there_is_no_plan() -> None:
    graph = {"s": [("x", "pq")], "p": [("y", "t"), ("z", "!")], "t": [("w", "u")], "u": [], "q": [("v", "r")], "r": []}
    told: list[Stuck[str]] = []
    assert and_or.first(Drawn(graph), "s", Budget(), told.append) is None
    assert worst_case.find(Drawn(graph), "s", Budget(), one, lambda weight: True, told.append) is None
    assert len(told) == 2
    for stuck in told:
        assert stuck.actions == 2
        assert (stuck.label, stuck.results) == (Act("x", (), NOWHERE), (1,))
        assert stuck.then is not None
        assert (stuck.then.label, stuck.then.results) == (Act("v", (), NOWHERE), ())
        assert stuck.then.then is not None
        assert (stuck.then.then.pair, stuck.then.then.then) == ("r", None)


def test_how_far_it_came_at_a_limit() -> None:
    graph = {"s": [("x", "p")], "p": [("y", "q"), ("z", "r")], "q": [], "r": [("z", "t")], "t": []}
    for nodes, actions in ((3, [2]), (4, [2]), (2, [])):
        told: list[Stuck[str]] = []
        with pytest.raises(LimitError):
            and_or.first(Drawn(graph), "s", Budget(Limits(nodes=nodes)), told.append)
        assert [stuck.actions for stuck in told] == actions


class Endless:
    """Ever new pairs, by silent steps."""

    def is_end(self, pair: int) -> bool:
        return False

    def options(self, pair: int) -> Iterator[Option[int]]:
        yield Option(Silent(NOWHERE), (((), pair + 1),))


def test_limits_and_circles_end_a_search() -> None:
    for nodes, error in ((100, LimitError), (None, ProgramError)):
        with pytest.raises(error):
            and_or.first(Endless(), 0, Budget(Limits(nodes=nodes)))
        with pytest.raises(error):
            worst_case.find(Endless(), 0, Budget(Limits(nodes=nodes)), one, lambda weight: True)


class Ladder:
    """A way of many steps, each of which tells whether it was the last."""

    def is_end(self, pair: int) -> bool:
        return pair == 0

    def options(self, pair: int) -> Iterator[Option[int]]:
        yield Option(Act("climb", (), NOWHERE), (((False,), pair - 1), ((True,), 0)))


def test_long_plans_need_no_recursion() -> None:
    for found in (
        and_or.first(Ladder(), 20_000, Budget()),
        worst_case.find(Ladder(), 20_000, Budget(), one, lambda weight: True),
    ):
        assert isinstance(found, Solved)
        assert found.actions == 20_000


NAMES = "spqrt"
OUTCOMES = st.text(st.sampled_from(NAMES + "!"), min_size=1, max_size=2)
ACTIONS = st.sampled_from(["a", "b", "c", ""])
GRAPHS = st.fixed_dictionaries({name: st.lists(st.tuples(ACTIONS, OUTCOMES), max_size=4) for name in NAMES})


def values(graph: Graph) -> dict[str, float]:
    """The least weight of the worst branch from each pair, by iterating its definition to the fixed point."""
    worth = {**dict.fromkeys(graph, math.inf), "!": 0.0}
    for _ in range(10 * len(graph)):
        for pair, options in graph.items():
            worth[pair] = min(
                [(action != "") + max(worth[after] for after in outcomes) for action, outcomes in options],
                default=math.inf,
            )
    return worth


def weight(found: Solved[str]) -> int:
    own = found.option is not None and isinstance(found.option.label, Act)
    return own + max([weight(way) for way in found.ways], default=0)


def check(found: Solved[str], graph: Graph, above: tuple[str, ...] = ()) -> None:
    """It is a plan: options of the graph, a way for each outcome, no circles."""
    assert found.pair not in above
    if found.option is None:
        assert found.pair == "!"
        return
    assert found.option in [*Drawn(graph).options(found.pair)]
    assert [way.pair for way in found.ways] == [after for _, after in found.option.outcomes]
    for way in found.ways:
        check(way, graph, (*above, found.pair))


@given(graph=GRAPHS)
def test_a_plan_is_found_exactly_if_there_is_one(graph: Graph) -> None:
    worth = values(graph)
    for found in (
        and_or.first(Drawn(graph), "s", Budget()),
        worst_case.find(Drawn(graph), "s", Budget(), one, lambda weight: True),
    ):
        assert isinstance(found, Solved) == (worth["s"] < math.inf)
        if isinstance(found, Solved):
            check(found, graph)


@given(graph=GRAPHS)
def test_the_lightest_plan_is_lightest_in_every_branch(graph: Graph) -> None:
    worth = values(graph)
    found = worst_case.find(Drawn(graph), "s", Budget(), one, lambda weight: True)
    pending = [found]
    while pending:
        part = pending.pop()
        if isinstance(part, Solved):
            assert weight(part) == worth[part.pair]
            pending += part.ways


@given(graph=GRAPHS, steps=st.integers(0, 6))
def test_a_bound_is_kept_and_hides_no_plan(graph: Graph, steps: int) -> None:
    least = values(graph)["s"]
    budget = Budget(Limits(steps=steps))
    for found in (
        and_or.first(Drawn(graph), "s", budget),
        worst_case.find(Drawn(graph), "s", budget, one, lambda weight: budget.allows(int(weight))),
    ):
        assert isinstance(found, Solved) == (least <= steps)
        assert not isinstance(found, Solved) or weight(found) <= steps
    assert budget.cut or least <= steps or least == math.inf


def exhaustive(graph: Graph, pair: str, above: tuple[str, ...] = ()) -> str | None:
    """The first plan by trying everything, without any memory."""
    for action, outcomes in graph[pair]:
        ways: list[str] = []
        for after in outcomes:
            way = "!" if after == "!" else None
            if way is None and after not in (*above, pair):
                way = exhaustive(graph, after, (*above, pair))
            if way is None:
                break
            ways.append(way)
        if len(ways) == len(outcomes):
            return f"{action or '.'}{ways[0]}" if len(ways) == 1 else f"{action or '.'}({', '.join(ways)})"
    return None


@given(graph=GRAPHS)
def test_without_circles_the_first_plan_is_the_first_of_all(graph: Graph) -> None:
    rank = {name: number for number, name in enumerate(NAMES + "!")}
    forward = {
        pair: [
            (action, "".join(after for after in outcomes if rank[after] > rank[pair]) or "!")
            for action, outcomes in options
        ]
        for pair, options in graph.items()
    }
    assert first(forward) == (exhaustive(forward, "s") or "stuck")
