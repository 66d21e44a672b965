"""What becomes of exogenous actions: refused, impossible, with effects that cannot be."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from golc.diagnostics import Code, ProgramError
from golc.runtime.devices.base import Args
from golc.runtime.loop.happenings import (
    Dropped,
    Refused,
    TakenIn,
)
from golc.runtime.loop.inbox import Report
from golc.runtime.loop.policy import OnImpossible, Policy
from tests.runtime.trial import never, program

Start = Callable[..., Any]
Event = Callable[..., Report]


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
