"""The loop of the paper, step by step, in a scripted world."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.diagnostics import Code, ProgramError
from golc.program.circles import CIRCLES
from golc.runtime.devices.base import Args
from golc.runtime.loop.happenings import (
    Blocked,
    Done,
    Dropped,
    End,
    Ended,
    Refused,
    Stepped,
    Waiting,
)
from golc.runtime.loop.inbox import Report
from golc.runtime.loop.policy import Policy
from golc.theory.types import show_call
from tests.runtime.trial import never, program

Start = Callable[..., Any]
Event = Callable[..., Report]


def test_a_final_program_ends_without_an_action(start: Start) -> None:
    run = start(program("skip"), perform=never)

    assert run.run().end is End.FINAL


def test_what_has_occurred_is_taken_in_before_final_is_asked(start: Start, event: Event) -> None:
    run = start(program("while not p:\n    a"))
    run.inbox.put(event("flip"))

    assert run.run().end is End.FINAL
    assert run.story() == ["<flip"]


def test_events_are_taken_in_one_by_one_in_order_of_arrival_duplicates_kept(start: Start, event: Event) -> None:
    run = start(program("skip"))
    for report in (event("flip"), event("become", 2), event("flip"), event("flip")):
        run.inbox.put(report)

    run.run()

    assert run.story() == ["<flip", "<become(2)", "<flip", "<flip"]
    assert run.value("p") is True


@pytest.mark.parametrize(
    ("during", "since"), [(["set_x(1)"], "become(3)"), (["set_x(1)", "a"], "flip, become(3)"), ([], "become(3)")]
)
def test_where_a_plan_is_lost_the_events_since_its_first_action_are_told(
    start: Start, event: Event, during: list[str], since: str
) -> None:
    def perform(action: str, args: Args) -> Args:
        if show_call(action, args) in during:
            run.inbox.put(event("flip"))
        if args == (2,):
            run.inbox.put(event("become", 3))
        return ()

    run = start(program("set_x(1)\nsearch:\n    a\n    set_x(2)\n    test x = 2\n    b"), perform=perform)

    with pytest.raises(ProgramError) as raised:
        run.run()

    assert raised.value.diagnostic.code is Code.BLOCKED
    assert raised.value.diagnostic.notes == (f"exogenous actions since the plan was made: {since}",)


def test_a_test_step_comes_before_an_action_that_stands_above_it(start: Start) -> None:
    run = start(program('together:\n    a\nand:\n    say "first"'))

    run.run()

    assert run.story() == ['"first"', "a"]


def test_a_silent_test_step_comes_before_an_action(start: Start) -> None:
    run = start(program("together:\n    a\nand:\n    test true"))

    run.run()

    assert [type(h) for h in run.happened if type(h) in (Stepped, Done)] == [Stepped, Done]


def test_the_first_possible_action_is_committed_to(start: Start) -> None:
    run = start(program("choose:\n    a\n    test false\nor:\n    b"))

    with pytest.raises(ProgramError):
        run.run()
    assert run.story() == ["a"]


def test_a_wait_is_taken_only_if_nothing_else_can_step(start: Start) -> None:
    run = start(program("together:\n    wait\nand:\n    a"))

    run.run()

    assert [type(h) for h in run.happened if type(h) in (Waiting, Done)] == [Done, Waiting]


def test_effects_are_applied_when_the_device_reports_success(start: Start) -> None:
    seen = []

    def perform(action: str, args: Args) -> Args:
        seen.append(run.value("x"))
        return ()

    run = start(program("set_x(2)"), perform=perform)
    run.run()

    assert seen == [0]
    assert run.value("x") == 2


def test_what_was_sensed_is_put_into_the_state_and_the_surprise_is_told(start: Start) -> None:
    run = start(program("look\nif seen = green:\n    a"), perform=lambda action, args: ("green",) * (action == "look"))

    run.run()

    assert run.story() == ["look", "a"]
    assert [(s.fluent, s.expected, s.sensed) for s in run.only(Done)[0].surprises] == [("seen", "red", "green")]


def test_events_reported_while_an_action_runs_are_applied_after_it_in_order(start: Start, event: Event) -> None:
    def perform(action: str, args: Args) -> Args:
        run.inbox.put(event("become", 3))
        run.inbox.put(event("flip"))
        return ()

    run = start(program("set_x(2)\nif x = 3:\n    skip"), perform=perform)
    run.run()

    assert run.story() == ["set_x(2)", "<become(3)", "<flip"]
    assert run.value("x") == 3


def test_a_wait_ends_with_an_event_that_came_after_it_began(start: Start, event: Event) -> None:
    run = start(program("wait\nwait\na"), [[event("flip")], [event("flip")]])
    run.inbox.put(event("flip"))

    run.run()

    assert run.story() == ["<flip", "<flip", "<flip", "a"]
    assert len(run.only(Waiting)) == 2


def test_two_events_at_once_end_one_wait(start: Start, event: Event) -> None:
    run = start(program("wait\nwait\na"), [[event("flip"), event("flip")]])

    assert run.run().end is End.IDLE
    assert run.story() == ["<flip", "<flip"]


def test_a_refused_line_and_a_dropped_event_do_not_end_a_wait(start: Start, event: Event) -> None:
    run = start(program("wait\na"), [[event("nothing")], [event("overflow"), event("become", 9)]])
    run.executive.state = run.executive.dynamics.progress(run.executive.state, "set_x", (3,))

    assert run.run().end is End.IDLE
    assert run.story() == []
    assert len(run.only(Refused)) == 2
    assert len(run.only(Dropped)) == 1


def test_a_blocked_program_waits_while_a_source_is_open_and_says_for_what(start: Start, event: Event) -> None:
    run = start(program("test p\na"), [[event("become", 1)], [event("flip")]])

    assert run.run().end is End.FINAL
    assert run.story() == ["<become(1)", "<flip", "a"]
    blocked = run.only(Blocked)
    assert [reason.text for reason in blocked[0].reasons] == ["`p` is false"]
    assert blocked[0].reasons[0].values == (("p", False),)
    assert blocked[0].sources == ("test",)
    assert len(blocked) == 2


def test_a_blocked_program_fails_when_no_source_is_open_and_names_each_branch(start: Start) -> None:
    run = start(program("choose:\n    test p\nor:\n    test x = 2"))
    run.executive._sources[0].ended = True

    with pytest.raises(ProgramError) as failure:
        run.run()

    finding = failure.value.diagnostic
    assert failure.value.exit_code == 5
    assert finding.code is Code.BLOCKED
    assert finding.marker == "`p` is false (p = false)"
    assert [label.text for label in finding.labels] == ["`x = 2` is false (x = 0)"]


def test_a_program_without_exogenous_actions_fails_at_once_when_it_is_blocked(start: Start) -> None:
    run = start("domain quiet\nfluent p: bool = false\naction a\nproc control:\n    test p\n    a\n")

    with pytest.raises(ProgramError, match="blocked, and no source is open"):
        run.run()


def test_a_source_that_ends_while_the_program_is_blocked_makes_it_fail(start: Start, event: Event) -> None:
    run = start(program("test p"), policy=Policy())
    source = run.executive._sources[0]

    def wait(timeout: float | None = None) -> bool:
        source.ended = True
        return False

    run.inbox.wait = wait
    with pytest.raises(ProgramError, match="blocked"):
        run.run()


def test_a_program_that_waits_when_nothing_can_come_fails(start: Start) -> None:
    run = start(program("wait"), policy=Policy())
    run.executive._sources[0].ended = True

    with pytest.raises(ProgramError) as failure:
        run.run()

    assert failure.value.diagnostic.code is Code.WAITS_FOR_EVER
    assert "--stop-when-idle" in (failure.value.diagnostic.help or "")


def test_a_blocked_program_is_no_success_when_it_is_idle(start: Start) -> None:
    run = start(program("test p"))

    with pytest.raises(ProgramError) as failure:
        run.run()

    assert failure.value.exit_code == 5


def test_steps_without_action_or_event_in_a_row_run_in_circles(start: Start) -> None:
    run = start(program("while true:\n    test true"))
    steps = [0]

    def count(happening: object) -> None:
        steps[0] += isinstance(happening, Stepped)

    run.executive.observers.append(count)

    with pytest.raises(ProgramError) as failure:
        run.executive.run()

    assert failure.value.diagnostic.code is Code.RUNS_IN_CIRCLES
    assert failure.value.diagnostic.span.text == "test true"
    assert steps[0] == CIRCLES


def test_an_abort_ends_the_run_as_failed_with_its_words(start: Start) -> None:
    run = start(program('set_x(1)\nabort "x is {x}"'))

    with pytest.raises(ProgramError) as failure:
        run.run()

    assert failure.value.diagnostic.message == "x is 1"
    assert run.only(Ended)[0].end is End.ABORTED
    assert run.device.told[-2:] == ["abort", "close"]


def test_without_observers_nothing_is_told_and_all_is_done(start: Start, event: Event) -> None:
    run = start(program("set_x(1)\nwait\ntest p"), [[event("flip")]])

    outcome = run.executive.run()

    assert (outcome.end, outcome.actions, outcome.exogenous) == (End.FINAL, 1, 1)
    assert run.happened == []
