"""The loop of the paper, step by step, in a scripted world."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from golc.diagnostics import Code, DeviceError, ProgramError
from golc.program.circles import CIRCLES
from golc.runtime.devices.base import Args, GivenUpError
from golc.runtime.loop.happenings import (
    Blocked,
    Done,
    Dropped,
    End,
    Ended,
    Failed,
    Refused,
    Remedied,
    Remedy,
    Reset,
    Stepped,
    TakenIn,
    Waiting,
)
from golc.runtime.loop.inbox import Broken, Command, Report
from golc.runtime.loop.policy import OnImpossible, Policy
from golc.theory.types import show_call

HEAD = """
domain trial
type digit = 0..3
type colour = {red, green}
fluent x: digit = 0
fluent p: bool = false
fluent seen: colour = red
action a
action b
action set_x(n: digit):
    causes x := n
action look:
    senses seen
exog become(n: digit):
    poss n != x
    causes x := n
exog flip:
    causes p := not p
exog overflow:
    causes x := x + 1
proc control:
"""

Start = Callable[..., Any]
Event = Callable[..., Report]
Failing = Callable[[int], Callable[[str, Args], Args]]


def program(body: str) -> str:
    return HEAD + "\n".join("    " + line for line in body.strip().splitlines()) + "\n"


def never(action: str, args: Args) -> Args:
    raise AssertionError(f"{action} was performed")


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


@pytest.mark.parametrize(
    ("action", "args", "message"),
    [
        ("nothing", (), "`nothing` is not an exogenous action of this domain"),
        ("a", (), "`a` is not an exogenous action of this domain"),
        ("become", (), "`become` takes 1 argument, not 0"),
        ("become", (7,), "7 in `become(7)` is outside `digit` (0..3)"),
    ],
)
def test_what_is_no_exogenous_action_is_refused(
    start: Start, event: Event, action: str, args: Args, message: str
) -> None:
    run = start(program("skip"))
    run.inbox.put(event(action, *args))

    run.run()

    assert [refused.diagnostics[0].message for refused in run.only(Refused)] == [message]
    assert run.story() == []


def test_an_impossible_event_is_applied_and_told_as_such(start: Start, event: Event) -> None:
    run = start(program("skip"))
    run.inbox.put(event("become", 0))
    run.inbox.put(event("become", 1))

    run.run()

    assert [taken.impossible for taken in run.only(TakenIn)] == [True, False]


def test_an_impossible_event_is_dropped_where_the_policy_says_so(start: Start, event: Event) -> None:
    run = start(program("skip"), policy=Policy(on_impossible=OnImpossible.DROP))
    run.inbox.put(event("become", 0))

    run.run()

    assert [dropped.reason for dropped in run.only(Dropped)] == ["it is not possible in this state"]


def test_an_impossible_event_ends_the_run_where_the_policy_says_so(start: Start, event: Event) -> None:
    run = start(program("a"), policy=Policy(on_impossible=OnImpossible.STOP), perform=never)
    run.inbox.put(event("become", 0))

    with pytest.raises(ProgramError) as failure:
        run.run()

    assert failure.value.diagnostic.code is Code.IMPOSSIBLE_EVENT
    assert run.device.told == ["open", "abort", "close"]


@pytest.mark.parametrize("policy", OnImpossible)
def test_an_event_whose_effect_leaves_its_type_is_dropped_whatever_the_policy(
    start: Start, event: Event, policy: OnImpossible
) -> None:
    run = start(program("set_x(3)\nwait"), [[event("overflow")]], policy=Policy(policy, stop_when_idle=0))

    run.run()

    assert ["which is outside" in dropped.reason for dropped in run.only(Dropped)] == [True]
    assert run.value("x") == 3


def test_an_event_that_comes_before_the_device_is_free_is_taken_in_first(start: Start, event: Event) -> None:
    run = start(program("if p:\n    b\nelse:\n    a"))

    @contextmanager
    def free() -> Iterator[None]:
        if not run.device.told[1:]:
            run.device.told.append("an event")
            run.inbox.put(event("flip"))
        yield

    run.device.free = free
    run.run()

    assert run.device.told == ["open", "an event", "b", "abort", "close"]


def test_an_action_whose_effect_leaves_its_type_is_never_begun(start: Start) -> None:
    run = start(program("climb\nclimb").replace("action a\n", "action a\naction climb:\n    causes x := x + 2\n"))

    with pytest.raises(ProgramError, match="`x` would be 4, which is outside `digit`"):
        run.run()

    assert run.value("x") == 2
    assert run.device.told == ["open", "climb", "abort", "close"]


def test_a_failed_action_has_no_effects_and_ends_the_run(start: Start, failing: Failing) -> None:
    run = start(program("set_x(1)"), perform=failing(1))

    with pytest.raises(DeviceError, match=r"set_x\(1\) does not work"):
        run.run()

    assert run.value("x") == 0
    assert [type(h) for h in run.happened[-3:]] == [Failed, Remedied, Ended]
    assert run.device.told == ["open", "set_x(1)", "abort", "close"]


def test_a_failed_action_is_tried_again(start: Start, failing: Failing) -> None:
    policy = Policy(on_failure=lambda label, error: Remedy.RETRY, retry_after=0)
    run = start(program("set_x(1)"), perform=failing(3), policy=policy)

    assert run.run().end is End.FINAL
    assert run.device.told == ["open"] + ["set_x(1)"] * 4 + ["abort", "close"]


def test_what_happened_during_a_failed_action_counts_before_it_is_tried_again(start: Start, event: Event) -> None:
    def perform(action: str, args: Args) -> Args:
        if action == "a":
            run.inbox.put(event("flip"))
            raise DeviceError("no")
        return ()

    policy = Policy(on_failure=lambda label, error: Remedy.RETRY, retry_after=0)
    run = start(program("if p:\n    b\nelse:\n    a"), perform=perform, policy=policy)
    run.run()

    assert run.story() == ["a", "<flip", "b"]


def test_after_a_failure_the_next_transition_is_taken(start: Start, failing: Failing) -> None:
    policy = Policy(on_failure=lambda label, error: Remedy.NEXT)
    run = start(program("choose:\n    a\nor:\n    b"), perform=failing(1), policy=policy)

    assert run.run().end is End.FINAL
    assert run.story() == ["a", "b"]


def test_a_failure_without_another_way_is_the_end_if_nothing_can_come(start: Start, failing: Failing) -> None:
    run = start(program("a"), perform=failing(9), policy=Policy(on_failure=lambda label, error: Remedy.NEXT))
    run.executive._sources[0].ended = True

    with pytest.raises(DeviceError, match="a does not work"):
        run.run()


def test_a_failed_action_is_tried_anew_after_an_event(start: Start, failing: Failing, event: Event) -> None:
    policy = Policy(on_failure=lambda label, error: Remedy.NEXT)
    run = start(program("a"), [[event("flip")]], perform=failing(1), policy=policy)

    assert run.run().end is End.FINAL
    assert run.story() == ["a", "<flip", "a"]


@pytest.mark.parametrize("error", [KeyboardInterrupt(), ValueError("a bug"), DeviceError("broken"), BrokenPipeError()])
def test_whatever_ends_a_run_the_devices_are_told_to_stop_first(start: Start, error: BaseException) -> None:
    def perform(action: str, args: Args) -> Args:
        raise error

    run = start(program("a"), perform=perform)

    with pytest.raises(type(error)):
        run.run()

    ends = {KeyboardInterrupt: End.INTERRUPTED, BrokenPipeError: End.INTERRUPTED, DeviceError: End.DEVICE}
    assert run.device.told == ["open", "a", "abort", "close"]
    assert run.only(Ended)[0].end is ends.get(type(error), End.BUG)


def test_an_observer_that_fails_ends_the_run_with_the_devices_stopped(start: Start) -> None:
    def observer(happening: object) -> None:
        if isinstance(happening, Done):
            raise BrokenPipeError("nobody reads")

    run = start(program("a\nb"))
    run.executive.observers.append(observer)

    with pytest.raises(BrokenPipeError):
        run.run()

    assert run.device.told == ["open", "a", "abort", "close"]
    assert run.only(Ended)[0].message == "nobody reads the output any more"


def test_a_device_that_cannot_be_told_to_stop_is_named_at_the_end(start: Start) -> None:
    run = start(program("a"))

    def abort() -> None:
        raise DeviceError("no answer")

    run.device.abort = abort
    run.run()

    assert run.only(Ended)[0].unstopped == (("world", "no answer"),)


def test_a_device_that_cannot_be_opened_is_not_told_to_stop(start: Start) -> None:
    run = start(program("a"))

    def open_() -> None:
        raise DeviceError("no port")

    run.device.open = open_
    with pytest.raises(DeviceError, match="no port"):
        run.run()

    assert run.device.told == []
    assert run.only(Ended)[0].end is End.DEVICE


def test_a_source_that_breaks_ends_the_run(start: Start) -> None:
    run = start(program("wait"), [[Broken("rcx", DeviceError("the brick is silent"))]], policy=Policy())

    with pytest.raises(DeviceError, match="the brick is silent"):
        run.run()


def command(name: str, replies: list[object]) -> Command:
    return Command(name, "test", replies.append)  # type: ignore[arg-type]


def test_state_and_history_are_answered(start: Start, event: Event) -> None:
    replies: list[object] = []
    batch = [event("flip"), command("state", replies), command("history", replies)]
    run = start(program("set_x(2)\nwait"), [batch])

    run.run()

    assert replies == [{"x": 2, "p": True, "seen": "red"}, ["set_x(2)", "flip from test"]]


def test_a_stop_ends_the_run_with_success(start: Start) -> None:
    replies: list[object] = []
    run = start(program("wait\na"), [[command("stop", replies)]])

    outcome = run.run()

    assert (outcome.end, outcome.message) == (End.STOPPED, "stopped by the operator (test)")
    assert run.device.told == ["open", "abort", "close"]


def test_an_abort_command_stops_the_devices_and_the_run_goes_on(start: Start, event: Event) -> None:
    run = start(program("wait\na"), [[command("abort", [])], [event("flip")]])

    assert run.run().end is End.FINAL
    assert run.device.told == ["open", "abort", "a", "abort", "close"]
    assert len(run.only(Reset)) == 1


def test_a_stop_interrupts_the_action_under_way(start: Start) -> None:
    interrupted: list[bool] = []

    def perform(action: str, args: Args) -> Args:
        run.inbox.put(command("stop", []))
        assert interrupted
        raise DeviceError("given up")

    run = start(program("a\nb"), perform=perform)
    run.device.interrupt = lambda: interrupted.append(True)

    assert run.run().end is End.STOPPED
    assert run.story() == ["a"]


def test_an_action_given_up_for_an_abort_is_decided_upon_anew_whatever_the_policy(start: Start) -> None:
    tried: list[str] = []

    def perform(action: str, args: Args) -> Args:
        tried.append(action)
        if len(tried) == 1:
            run.inbox.put(command("abort", []))
            raise GivenUpError("given up")
        return ()

    run = start(program("a"), perform=perform)

    assert run.run().end is End.FINAL
    assert run.device.told == ["open", "a", "abort", "a", "abort", "close"]


def test_the_state_can_be_asked_for_while_an_action_runs(start: Start) -> None:
    replies: list[object] = []

    def perform(action: str, args: Args) -> Args:
        run.inbox.put(command("state", replies))
        assert replies == [{"x": 0, "p": False, "seen": "red"}]
        return ()

    run = start(program("set_x(1)"), perform=perform)
    run.run()

    assert len(replies) == 1


def test_an_action_begins_only_when_it_is_confirmed(start: Start) -> None:
    asked: list[str] = []
    run = start(program("a\nb"), policy=Policy(confirm=lambda label: asked.append(str(label))))

    run.run()

    assert asked == ["a", "b"]


def test_what_happens_before_the_confirmation_is_decided_upon(start: Start, event: Event) -> None:
    def confirm(label: object) -> None:
        if str(label) == "a":
            run.inbox.put(event("flip"))

    run = start(program("if p:\n    b\nelse:\n    a"), policy=Policy(confirm=confirm))
    run.run()

    assert run.story() == ["<flip", "b"]


def test_without_observers_nothing_is_told_and_all_is_done(start: Start, event: Event) -> None:
    run = start(program("set_x(1)\nwait\ntest p"), [[event("flip")]])

    outcome = run.executive.run()

    assert (outcome.end, outcome.actions, outcome.exogenous) == (End.FINAL, 1, 1)
    assert run.happened == []


def test_the_history_in_memory_has_a_bound(start: Start) -> None:
    run = start(program("while true:\n    a\n    if x = 3:\n        wait\n    else:\n        b"), perform=None)
    count = [0]

    def perform(action: str, args: Args) -> Args:
        count[0] += 1
        if count[0] == 3_000:
            run.inbox.put(command("stop", []))
        return ()

    run.device._perform = perform
    run.executive.run()

    assert run.executive.actions == 3_000
    assert run.executive.told()[0] == "… 2000 before"
    assert len(run.executive.history) == 1_000
