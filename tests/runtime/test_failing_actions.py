"""Actions, devices and sources that fail, and what is then done."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.diagnostics import DeviceError
from golc.runtime.devices.base import Args
from golc.runtime.loop.happenings import (
    Done,
    End,
    Ended,
    Failed,
    Remedied,
    Remedy,
)
from golc.runtime.loop.inbox import Broken, Report
from golc.runtime.loop.policy import Policy
from tests.runtime.trial import program

Start = Callable[..., Any]
Event = Callable[..., Report]
Failing = Callable[[int], Callable[[str, Args], Args]]


def test_a_failed_action_has_no_effects_and_ends_the_run(start: Start, failing: Failing) -> None:
    run = start(program("set_x(1)"), perform=failing(1))

    with pytest.raises(DeviceError, match=r"set_x\(1\) does not work"):
        run.run()

    assert run.value("x") == 0
    assert [type(h) for h in run.happened[-3:]] == [Failed, Remedied, Ended]
    assert run.device.told == ["open", "set_x(1)", "abort", "close"]


def test_after_another_action_one_that_has_failed_may_be_tried_again(start: Start, failing: Failing) -> None:
    body = "choose:\n    a\nor:\n    b\na"
    policy = Policy(on_failure=lambda label, error: Remedy.NEXT, stop_when_idle=0)
    run = start(program(body), perform=failing(1), policy=policy)

    assert run.run().end is End.FINAL
    assert run.story() == ["a", "b", "a"]


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
