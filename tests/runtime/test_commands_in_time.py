"""Commands that come at the worst moment: nothing begins, or begins again, before they have been obeyed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.runtime.devices.base import Args, GivenUpError
from golc.runtime.loop.happenings import End
from golc.runtime.loop.inbox import Command, Item
from golc.runtime.loop.policy import Policy

Start = Callable[..., Any]

PROGRAM = "domain d\naction a\nproc control:\n    a\n    a\n"


def stop() -> Command:
    return Command("stop", "test", lambda result: None)


@pytest.mark.parametrize("engaged", ["action", "confirmation"])
def test_what_is_given_up_for_a_command_finds_it_in_the_queue(start: Start, engaged: str) -> None:
    queued: list[list[Item]] = []
    asked = stop()

    def busy(*_: object) -> Args:
        run.inbox.put(asked)
        raise GivenUpError("given up")

    policy = Policy(confirm=lambda label: run.inbox.put(asked), interrupt=lambda: queued.append(list(run.inbox.items)))
    run = start(PROGRAM, perform=busy, policy=policy if engaged == "confirmation" else None)
    run.device.interrupt = lambda: queued.append(list(run.inbox.items))

    assert run.run().end is End.STOPPED
    assert queued == [[asked]]


def test_an_action_does_not_begin_after_a_command_that_came_while_it_was_decided_upon(start: Start) -> None:
    run = start(PROGRAM)

    def handles(action: str, args: Args) -> bool:
        run.inbox.put(stop())
        return True

    run.device.handles = handles

    assert run.run().end is End.STOPPED
    assert run.story() == []


ENDLESS = """
domain d
fluent x: int = 0
action inc:
    causes x := x + 1
proc control:
    search:
        star:
            inc
        test x < 0
"""


def test_a_search_without_end_is_given_up_for_a_command(start: Start) -> None:
    run = start(ENDLESS)
    dynamics, looked = run.executive.dynamics, [0]
    progress = dynamics.progress
    replies: list[object] = []

    def counted(*args: Any) -> Any:
        looked[0] += 1
        if looked[0] == 1000:
            run.inbox.put(Command("state", "test", replies.append))
            assert replies == [{"x": 0}]
            run.inbox.put(stop())
        return progress(*args)

    dynamics.progress = counted

    assert run.run().end is End.STOPPED
    assert run.story() == []
