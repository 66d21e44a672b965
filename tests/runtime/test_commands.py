"""Commands to a run: its state and history, stop, abort, and whether an action may begin."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.diagnostics import DeviceError
from golc.runtime.devices.base import Args, GivenUpError
from golc.runtime.loop.happenings import (
    End,
    Reset,
)
from golc.runtime.loop.inbox import Command, Report
from golc.runtime.loop.policy import Policy
from tests.runtime.trial import program

Start = Callable[..., Any]
Event = Callable[..., Report]


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


@pytest.mark.parametrize(("actions", "first"), [(1_000, "a"), (1_001, "… 1 before"), (3_000, "… 2000 before")])
def test_the_history_in_memory_has_a_bound(start: Start, actions: int, first: str) -> None:
    run = start(program("while true:\n    a\n    if x = 3:\n        wait\n    else:\n        b"), perform=None)
    count = [0]

    def perform(action: str, args: Args) -> Args:
        count[0] += 1
        if count[0] == actions:
            run.inbox.put(command("stop", []))
        return ()

    run.device._perform = perform
    run.executive.run()

    assert run.executive.actions == actions
    assert run.executive.told()[0] == first
    assert len(run.executive.history) == 1_000
