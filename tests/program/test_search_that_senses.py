"""``search`` over sensing actions: the branch that the results select is followed, or its choices are tried again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from golc.planning.planner import LookAhead
from golc.program.labels import Act, Wait
from golc.program.lookahead import Request
from golc.program.step import Machine

Start = Callable[..., Any]

GATES = """
type side = 0..1
type state = {open, shut}
fluent gate(s: side): state = unknown
fluent inside: bool = false
fluent jammed: bool = false
initially gate(0) = open or gate(1) = open
action look(s: side):
    senses gate(s)
action enter(s: side):
    poss gate(s) = open
    causes inside := true
action jolt(s: side):
    poss gate(s) = shut and not jammed
    causes gate(s) := open
action pull(s: side):
    poss gate(s) = shut
    causes gate(s) := open
exog slam:
    causes gate(0) := shut
exog jam:
    causes jammed := true
exog forget:
    causes gate(0) := unknown
"""

TRY = """
    search:
        look(0)
        choose:
            enter(0)
        or:
            choose:
                jolt(0)
            or:
                pull(0)
            enter(0)
"""


class Run:
    """A run whose sensing actions answer what they are told to, and that counts its searches."""

    def __init__(self, program: Any) -> None:
        self.program = program
        self.dynamics = program.executable.dynamics
        self.searches: list[Request] = []
        look_ahead = LookAhead()

        def planner(machine: Any, node: Any, state: Any, request: Request) -> Any:
            self.searches.append(request)
            return look_ahead(machine, node, state, request)

        self.machine = Machine(self.dynamics, program.machine.program, program.executable.ahead, planner)
        self.node, self.state = program.node, program.state

    def step(self, *results: Any) -> str:
        """The next action or wait, tests left out; it senses these results."""
        while (decided := self.machine.decide(self.node, self.state)) is not None:
            label, self.node = decided
            if isinstance(label, Act):
                self.state = self.machine.successor(self.state, label)
                if results:
                    self.state, _ = self.dynamics.assimilate(self.state, label.action, label.args, results)
                return str(label)
            if isinstance(label, Wait):
                return "wait"
        return "final" if self.machine.final(self.node, self.state) else "blocked"

    def event(self, action: str) -> None:
        self.state = self.dynamics.progress(self.state, action, ())


def test_the_branch_of_the_result_is_followed(start: Start) -> None:
    run = Run(start(TRY, GATES))
    assert [run.step("open"), run.step(), run.step()] == ["look(0)", "enter(0)", "final"]
    run = Run(start(TRY, GATES))
    assert [run.step("shut"), run.step(), run.step(), run.step()] == ["look(0)", "jolt(0)", "enter(0)", "final"]


def test_nothing_is_searched_again_on_the_way(start: Start) -> None:
    run = Run(start(TRY, GATES))
    assert [run.step("shut"), run.step(), run.step()] == ["look(0)", "jolt(0)", "enter(0)"]
    assert len(run.searches) == 1


def test_branches_of_branches_are_followed(start: Start) -> None:
    body = """
        search:
            look(0)
            if gate(0) = shut:
                look(1)
                if gate(1) = open:
                    enter(1)
                else:
                    never
            else:
                look(1)
                choose:
                    jolt(1)
                    enter(1)
                or:
                    enter(0)
    """
    run = Run(start(body, GATES))
    assert [run.step("shut"), run.step("open"), run.step(), run.step()] == ["look(0)", "look(1)", "enter(1)", "final"]
    run = Run(start(body, GATES))
    assert [run.step("open"), run.step("shut"), run.step(), run.step()] == ["look(0)", "look(1)", "jolt(1)", "enter(1)"]
    run = Run(start(body, GATES))
    assert [run.step("open"), run.step("open"), run.step(), run.step()] == ["look(0)", "look(1)", "enter(0)", "final"]
    assert len(run.searches) == 1


def test_the_choices_are_kept_where_something_else_has_changed(start: Start) -> None:
    for result, steps in (("open", ["enter(0)", "final"]), ("shut", ["jolt(0)", "enter(0)"])):
        run = Run(start(TRY, GATES))
        run.step(result)
        run.event("set_p")
        assert [run.step(), run.step()] == steps
        assert len(run.searches) == 1


def test_before_the_sensing_too(start: Start) -> None:
    run = Run(start(TRY.replace("look(0)", "inc\n        look(0)"), GATES))
    assert run.step() == "inc"
    run.event("set_p")
    assert [run.step("shut"), run.step(), run.step(), run.step()] == ["look(0)", "jolt(0)", "enter(0)", "final"]
    assert len(run.searches) == 1


def test_the_rest_is_searched_anew_where_the_choices_lead_nowhere(start: Start) -> None:
    run = Run(start(TRY, GATES))
    run.step("shut")
    run.event("jam")
    assert [run.step(), run.step(), run.step()] == ["pull(0)", "enter(0)", "final"]
    assert len(run.searches) == 2


def test_a_branch_that_was_not_selected_may_fit_after_an_event(start: Start) -> None:
    run = Run(start(TRY, GATES))
    run.step("open")
    run.event("slam")
    assert [run.step(), run.step(), run.step()] == ["jolt(0)", "enter(0)", "final"]
    assert len(run.searches) == 1


def test_a_result_that_nobody_thought_of_is_a_reason_to_search(start: Start) -> None:
    """That gate 0 is shut is known when gate 1 is looked at, so that gate 1 should be open."""
    body = """
        search:
            look(0)
            look(1)
            choose:
                enter(1)
            or:
                enter(0)
            or:
                jolt(1)
                enter(1)
    """
    run = Run(start(body, GATES))
    assert [run.step("shut"), run.step("shut"), run.step(), run.step()] == ["look(0)", "look(1)", "jolt(1)", "enter(1)"]
    assert len(run.searches) == 2


def test_what_has_been_done_counts_in_every_branch(start: Start) -> None:
    run = Run(start(TRY.replace("search:", "search at most 3 steps:"), GATES))
    run.step("shut")
    run.event("jam")
    run.step()
    assert [request.steps for request in run.searches] == [3, 2]


def test_no_way_for_one_result_is_no_way(start: Start) -> None:
    program = start(
        """
        search:
            choose:
                look(0)
                enter(0)
            or:
                look(1)
                if gate(1) = shut:
                    never
                else:
                    enter(1)
    """,
        GATES,
    )
    run = Run(program)
    assert run.step() == "blocked"
    [reason] = run.machine.why_blocked(run.node, run.state)
    assert reason.text == (
        "`search` finds no way to the end of its block; the longest way was look(0) (gate(0) = shut); "
        "there `enter(0)` is not possible: `gate(s) = open` is false (gate(0) = shut, s = 0)"
    )


def test_what_is_forgotten_is_sensed_again(start: Start) -> None:
    body = """
        search:
            star at most 2:
                look(0)
            choose:
                enter(0)
            or:
                jolt(0)
                enter(0)
    """
    run = Run(start(body, GATES))
    assert run.step("open") == "look(0)"
    run.event("forget")
    assert [run.step("shut"), run.step(), run.step()] == ["look(0)", "jolt(0)", "enter(0)"]


def test_a_lost_plan_says_what_it_counted_on(start: Start) -> None:
    run = Run(start("search:\n    look(0)\n    test not p", GATES))
    run.step("shut")
    run.event("set_p")
    assert run.step() == "blocked"
    [reason] = run.machine.why_blocked(run.node, run.state)
    assert "the plan of `search` no longer leads to its end" in reason.text
    assert "it counted on p = false" in reason.text
    assert reason.actions == 1
