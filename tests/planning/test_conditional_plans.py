"""Random domains in which something is unknown and sensed: golc plans exactly what brute force can plan."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeAlias

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from golc.planning.goals import GoalPlanning
from golc.planning.limits import Limits
from golc.planning.planner import Planning, executable
from golc.planning.plans import Plan
from golc.program.labels import Act
from golc.theory.statements import Strategy
from golc.theory.types import Value, writable
from tests.reference.definitions import Definitions
from tests.reference.knowledge import Knowledge, Worlds
from tests.theories import theory_of

MOST_PAIRS = 300

FORMULAS = ["p", "not q", "p or q", "p or not r", "p iff r", "knows(q)", "possible(r)"]
EFFECTS = [
    "p := not p",
    "p := true when q",
    "q := true when r",
    "r := p",
    "q := not r",
    "p := unknown",
    "r := one of {p, q}",
]
SENSES = ["p", "q", "p iff q", "p or r", "r"]
PRUNES = ["", "", "", "prune bad: p and r", "prune back: after a when before(q) and not q", "prune settled: knows(p)"]


ANYTHING = ["star:", "    choose:", "        a", "    or:", "        b", "    or:", "        c", "test reached"]


@st.composite
def domains(draw: st.DrawFn) -> str:
    lines = ["domain d"]
    for name in "pqr":
        lines.append(f"fluent {name}: bool = {draw(st.sampled_from(['true', 'unknown', 'unknown', 'unknown']))}")
    if draw(st.booleans()):
        lines.append("initially p or not p and (q iff r)")
    for name in "abc":
        lines.append(f"action {name}:")
        lines.append(f"    poss {draw(st.sampled_from(['true'] * 9 + FORMULAS))}")
        effect = draw(st.sampled_from(["", *EFFECTS]))
        lines += [f"    causes {effect}"] if effect else []
        lines += [f"    senses {term}" for term in draw(st.sets(st.sampled_from(SENSES), max_size=2))]
    lines += ["exog ring expected:", f"    poss {draw(st.sampled_from(FORMULAS))}", "    causes p := true"]
    lines.append(draw(st.sampled_from(PRUNES)))
    lines.append(f"goal reached: {draw(st.sampled_from(FORMULAS[:5]))}")
    return "\n".join(lines)


def blocks(depth: int) -> st.SearchStrategy[list[str]]:
    """A block, as lines."""
    formula = st.sampled_from(FORMULAS)
    leaves = [["a"], ["b"], ["c"], ANYTHING]
    statement = st.sampled_from(
        [*leaves, *leaves, *leaves, ["wait"], ["test p"], ["test not q"], ["wait until p or q"]]
    )
    if depth > 0:
        inner = blocks(depth - 1).map(lambda block: ["    " + line for line in block])
        statement |= st.one_of(
            st.tuples(inner, inner).map(lambda t: ["choose:", *t[0], "or:", *t[1]]),
            st.tuples(inner, inner).map(lambda t: ["together:", *t[0], "and:", *t[1]]),
            st.tuples(formula, inner, inner).map(lambda t: [f"if {t[0]}:", *t[1], "else:", *t[2]]),
            st.tuples(formula, inner).map(lambda t: [f"while {t[0]}:", *t[1]]),
            inner.map(lambda block: ["star:", *block]),
            st.tuples(inner, inner).map(lambda t: ["prefer:", *t[0], "over:", *t[1]]),
        )
    return st.lists(statement, min_size=1, max_size=3).map(lambda found: [line for block in found for line in block])


PROGRAMS = st.one_of(blocks(2), st.just(ANYTHING), blocks(1).map(lambda block: [*block, *ANYTHING]))


class Blind(Knowledge):
    """Knowledge of an agent that makes no use of what is sensed."""

    def outcomes(self, action: str, s: Worlds, args: tuple[Value, ...]) -> dict[tuple[Value, ...], Worlds]:
        return {(): s}


Pair: TypeAlias = Any
Options: TypeAlias = dict[Pair, list[tuple[int, list[Pair]]]]
"""For each pair that is no end its options: what they weigh, and the pairs of their outcomes."""


def least(options: Callable[[Pair], list[tuple[int, list[Pair]]] | None], start: Pair) -> float:
    """The least number of actions in the worst branch of a plan: explores everything, then iterates the definition.

    ``options`` of an end are none.
    """
    graph: Options = {}
    ends = set()
    pending = [start]
    while pending:
        pair = pending.pop()
        if pair not in graph and pair not in ends:
            assume(len(graph) < MOST_PAIRS)
            found = options(pair)
            if found is None:
                ends.add(pair)
            else:
                graph[pair] = found
                pending += [after for _, outcomes in found for after in outcomes]
    worth: dict[Pair, float] = {**dict.fromkeys(graph, math.inf), **dict.fromkeys(ends, 0.0)}
    while True:
        before = dict(worth)
        for pair, found in graph.items():
            worth[pair] = min([w + max(worth[after] for after in outcomes) for w, outcomes in found], default=math.inf)
        if worth == before:
            return worth[start]


def of_program(d: Definitions) -> float:
    """The same for a program, by the definitions."""

    def options(pair: Pair) -> list[tuple[int, list[Pair]]] | None:
        config, worlds = pair
        if d.final(config, worlds):
            return None
        found = []
        transitions = d.trans(config, worlds)
        waits = all(label == "wait" for label, _, _ in transitions)
        for label, left, after in transitions:
            if label == "test":
                found.append((0, [(left, after)]))
            elif label != "wait":
                name, args = label
                outcomes = d.k.outcomes(name, after, args).values()
                if not any(d.k.pruned(name, args, worlds, known) for known in outcomes):
                    found.append((1, [(left, known) for known in outcomes]))
            elif waits:
                event = d.expected(worlds)
                assert event is not None
                known = d.k.progress(event[0], worlds, event[1])
                if not d.k.pruned(*event, worlds, known):
                    found.append((0, [(left, known)]))
        return found

    assume(d.k.initial())
    return least(options, (d.start("control"), d.k.initial()))


def of_goal(d: Definitions) -> float:
    """The same for the goal."""

    def options(worlds: Pair) -> list[tuple[int, list[Pair]]] | None:
        if d.k.holds(d.theory.definitions["reached"].body, worlds, ()):
            return None
        found = []
        for name in "abc":
            if d.k.possible(name, worlds, ()):
                outcomes = d.k.outcomes(name, d.k.progress(name, worlds, ()), ()).values()
                if not any(d.k.pruned(name, (), worlds, known) for known in outcomes):
                    found.append((1, [*outcomes]))
        if (event := d.expected(worlds)) is not None:
            after = d.k.progress(event[0], worlds, event[1])
            if not d.k.pruned(*event, worlds, after):
                found.append((0, [after]))
        return found

    assume(d.k.initial())
    return least(options, d.k.initial())


def weight(plan: Plan) -> int:
    return len(plan.actions) + max([weight(way) for way in plan.ways], default=0)


def as_printed(plan: Plan) -> list[dict[str, Any]]:
    steps: list[dict[str, Any]] = [
        {"action" if isinstance(step, Act) else "expected": step.action, "args": []} for step in plan.steps
    ]
    if plan.cases:
        steps[-1]["branches"] = [{"results": writable(c.results), "plan": as_printed(c.plan)} for c in plan.cases]
    return steps


@given(domain=domains(), body=PROGRAMS)
def test_a_plan_is_found_exactly_if_there_is_one(validity: Any, domain: str, body: list[str]) -> None:
    theory = theory_of("\n".join([domain, "proc control:", *(f"    {line}" for line in body), ""]))
    wanted = of_program(Definitions(theory, True))
    ready = executable(theory, "control")
    for strategy in Strategy:
        plan = next(iter(Planning(ready, Limits(), strategy=strategy)), None)
        assert (plan is not None) == (wanted < math.inf)
        if plan is not None:
            assert validity(theory).of_program(as_printed(plan))
            assert strategy is Strategy.FIRST or weight(plan) == wanted
    for steps in {0, 1, 2} if wanted == math.inf else {int(wanted), max(0, int(wanted) - 1)}:
        for strategy in Strategy:
            plan = next(iter(Planning(ready, Limits(steps=steps), strategy=strategy)), None)
            assert (plan is not None) == (wanted <= steps)
            assert plan is None or weight(plan) <= steps


@given(domain=domains(), conformant=st.booleans(), bound=st.sampled_from([None, 1, 2]))
def test_a_goal_is_reached_exactly_if_it_can_be(
    validity: Any, domain: str, conformant: bool, bound: int | None
) -> None:
    theory = theory_of(f"{domain}\n")
    defined = Definitions(theory, True)
    if conformant:
        defined.k = Blind(theory)
    wanted = of_goal(defined)
    plan = next(iter(GoalPlanning(theory, theory.definitions["reached"].body, Limits(steps=bound), conformant)), None)
    assert (plan is not None) == (wanted < math.inf if bound is None else wanted <= bound)
    if plan is not None:
        assert weight(plan) == wanted
        assert validity(theory, conformant).of_goal(as_printed(plan), "reached")


@given(domain=domains(), body=PROGRAMS)
def test_a_conformant_plan_works_without_any_result(validity: Any, domain: str, body: list[str]) -> None:
    theory = theory_of("\n".join([domain, "proc control:", *(f"    {line}" for line in body), ""]))
    blind = Definitions(theory, True)
    blind.k = Blind(theory)
    wanted = of_program(blind)
    for strategy in Strategy:
        ready = executable(theory, "control", conformant=True)
        plan = next(iter(Planning(ready, Limits(), strategy=strategy)), None)
        assert (plan is not None) == (wanted < math.inf)
        if plan is not None:
            assert not plan.cases
            assert validity(theory, conformant=True).of_program(as_printed(plan))
            assert strategy is Strategy.FIRST or weight(plan) == wanted


def test_plans_that_branch_are_not_listed() -> None:
    theory = theory_of("domain d\nfluent p: bool = unknown\naction a:\n    senses p\nproc control:\n    a\n")
    with pytest.raises(ValueError, match="plans that branch by what is sensed are not listed"):
        Planning(executable(theory, "control"), Limits(), all_plans=True)
    blind = Planning(executable(theory, "control", conformant=True), Limits(), all_plans=True)
    assert [[str(act) for act in plan.actions] for plan in blind] == [["a"]]
