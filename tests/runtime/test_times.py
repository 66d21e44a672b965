"""``wait e s`` and ``within e s`` online, with a clock that a test moves."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import pytest

from golc.diagnostics import Code, ProgramError
from golc.planning.planner import executable
from golc.runtime.clock import Clock
from golc.runtime.devices.base import Router
from golc.runtime.loop.executive import Executive
from golc.runtime.loop.happenings import Begun, End, Happening
from golc.runtime.loop.inbox import Inbox, Report
from golc.runtime.loop.policy import Policy
from golc.theory.types import show_call

DECLARATIONS = """domain trial
fluent p: bool = false
action a
action b
action c
exog happen:
    causes p := true
exog rain
proc control:
"""


class Hand(Inbox):
    """An inbox with events at fixed moments, and the clock: time passes only while somebody waits."""

    def __init__(self, events: Mapping[float, str]) -> None:
        super().__init__()
        self.moment = 0.0
        self.events = dict(sorted(events.items()))

    def wait(self, timeout: float | None = None) -> bool:
        soonest = next(iter(self.events), None)
        if soonest is not None and (timeout is None or soonest <= self.moment + timeout):
            self.moment = soonest
            self.items.append(Report(self.events.pop(soonest), (), "test"))
            return True
        self.moment += timeout or 0.0
        return False


Go = Callable[..., list[str]]


@pytest.fixture
def go(start: Any, unchecked: Any) -> Go:
    """Run a program without any open source: each action with the simulated second in which it begins."""

    def run(body: str, events: Mapping[float, str] | None = None, speed: float = 1.0) -> list[str]:
        text = DECLARATIONS + "".join(f"    {line}\n" for line in body.strip().splitlines())
        theory, inbox = unchecked(text), Hand(events or {})
        router, clock = Router([start(text).device], theory), Clock(lambda: inbox.moment, 0.0, speed)
        executive = Executive(executable(theory, "control"), router, inbox, (), Policy(), clock)
        done: list[str] = []

        def note(happening: Happening) -> None:
            if isinstance(happening, Begun):
                done.append(f"{happening.time:g} {show_call(happening.action, happening.args)}")

        executive.observers.append(note)
        outcome = executive.run()
        assert outcome.end is End.FINAL
        return [*done, f"{clock.now():g} end"]

    return run


def test_a_wait_takes_its_time(go: Go) -> None:
    assert go("a\nwait 5 s\nb\nwait 0.5 s") == ["0 a", "5 b", "5.5 end"]


def test_a_wait_takes_its_time_whatever_happens(go: Go) -> None:
    assert go("wait 5 s\nb", {1: "rain", 3: "happen"}) == ["5 b", "5 end"]


def test_times_are_simulated(go: Go) -> None:
    assert go("wait 5 s\nb", speed=10) == ["5 b", "5 end"]


def test_a_wait_that_is_longer_than_a_timer_may_run_takes_its_time(go: Go) -> None:
    assert go("wait 10000 s\nb") == ["10000 b", "10000 end"]


WITHIN = """
within 10 s:
    a
    wait until p
    b
else:
    c
"""


def test_what_happens_in_time_is_in_time(go: Go) -> None:
    assert go(WITHIN, {3: "rain", 9: "happen"}) == ["0 a", "9 b", "9 end"]


def test_the_else_part_takes_over_when_the_time_is_up(go: Go) -> None:
    assert go(WITHIN, {3: "rain", 11: "happen"}) == ["0 a", "10 c", "10 end"]


def test_a_wait_that_the_block_begins_with_is_timed(go: Go) -> None:
    assert go("within 10 s:\n    wait until p\n    a\nelse:\n    c") == ["10 c", "10 end"]


def test_a_block_that_cannot_go_on_is_left_when_the_time_is_up(go: Go) -> None:
    assert go("within 10 s:\n    a\n    test p\nelse:\n    c") == ["0 a", "10 c", "10 end"]


def test_an_event_that_helps_a_blocked_block_comes_in_time(go: Go) -> None:
    assert go("within 10 s:\n    a\n    test p\n    b\nelse:\n    c", {4: "happen"}) == ["0 a", "4 b", "4 end"]


def test_an_interrupt_may_cut_into_a_timed_wait(go: Go) -> None:
    body = "prefer:\n    test p\n    b\nover:\n    a\n    wait 5 s\n    c"
    assert go(body, {2: "happen"}) == ["0 a", "2 b", "5 c", "5 end"]


def test_two_clocks_ring_in_their_order(go: Go) -> None:
    assert go("together:\n    wait 5 s\n    a\nand:\n    wait 2 s\n    b") == ["2 b", "5 a", "5 end"]


def test_a_wait_beside_a_clock_ends_with_an_event(go: Go) -> None:
    body = "together:\n    wait 5 s\n    a\nand:\n    wait\n    b"
    assert go(body, {2: "rain"}) == ["2 b", "5 a", "5 end"]


def test_a_plan_with_a_wait_takes_its_time(go: Go) -> None:
    assert go("search:\n    a\n    wait 5 s\n    b") == ["0 a", "5 b", "5 end"]


def test_rounds_that_wait_for_no_time_go_in_circles(go: Go) -> None:
    with pytest.raises(ProgramError) as caught:
        go("while true:\n    wait 0 s")
    assert caught.value.diagnostic.code is Code.RUNS_IN_CIRCLES
