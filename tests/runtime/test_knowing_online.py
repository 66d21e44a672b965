"""Runs of an agent that does not know everything: what it learns, what it waits for, what surprises it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import pytest

from golc.diagnostics import ProgramError
from golc.runtime.loop.happenings import Blocked, Done
from golc.runtime.loop.policy import OnSurprise, Policy
from golc.theory.types import Unknown

if TYPE_CHECKING:
    from tests.runtime.conftest import Run

Start = Callable[..., "Run"]

DOORS = """\
domain doors
type room = 1..3
type door = {open, closed}
fluent at: room = 1
fluent gate(r: room): door = unknown
initially gate(1) = open
action look(r: room):
    senses gate(r)
action enter(r: room):
    poss gate(r) = open
    causes at := r
action slam(r: room):
    causes gate(r) := closed
exog somebody_passes(r: room):
    poss gate(r) = open
proc control:
    choose:
        enter(2)
    or:
        wait until known(gate(2))
        enter(2)
proc find:
    look(2)
    if gate(2) = open:
        enter(2)
    else:
        look(3)
        test gate(3) = open
        enter(3)
proc hasty:
    if gate(3) = open:
        enter(3)
    else:
        enter(2)
proc told:
    say "the second gate is {gate(2)}, the first {gate(1)}"
    enter(2)
proc watched:
    guard gate(2) = open:
        enter(2)
        enter(1)
"""


def answers(**results: Any) -> Callable[[str, tuple[Any, ...]], tuple[Any, ...]]:
    """A device whose ``look`` answers what is written for a room: ``answers(r2="open")``."""
    return lambda action, args: (results[f"r{args[0]}"],) if action == "look" else ()


def test_what_is_sensed_decides(start: Start) -> None:
    run = start(DOORS, perform=answers(r2="closed", r3="open"), procedure="find")
    run.run()
    assert run.story() == ["look(2)", "look(3)", "enter(3)"]
    assert run.value("gate", 2) == "closed"


def test_what_was_not_sensed_stays_unknown(start: Start) -> None:
    run = start(DOORS, perform=answers(r2="open"), procedure="find")
    run.run()
    assert run.story() == ["look(2)", "enter(2)"]
    assert run.value("gate", 3) == Unknown(("open", "closed"))


def test_an_action_waits_for_its_precondition_to_be_known(start: Start, event: Callable[..., Any]) -> None:
    run = start(DOORS, batches=[[event("somebody_passes", 3)], [event("somebody_passes", 2)]])
    run.run()
    assert run.story() == ["<somebody_passes(3)", "<somebody_passes(2)", "enter(2)"]


def test_an_event_tells_that_it_was_possible(start: Start, event: Callable[..., Any]) -> None:
    run = start(DOORS, batches=[[event("somebody_passes", 2)]])
    run.run()
    assert run.value("gate", 2) == "open"


def test_a_blocked_run_names_what_would_tell(start: Start) -> None:
    run = start(DOORS, procedure="told")
    with pytest.raises(ProgramError):
        run.run()
    (why,) = run.only(Blocked)[0].reasons
    assert why.text == "`enter(2)` is not possible: `gate(r) = open` is not known (`look` senses it)"
    assert dict(why.values) == {"gate(2)": Unknown(("open", "closed")), "r": 2}


def test_a_message_may_speak_of_what_is_unknown(start: Start) -> None:
    run = start(DOORS, procedure="told")
    with pytest.raises(ProgramError):
        run.run()
    assert run.story() == ['"the second gate is open or closed, the first open"']


def test_a_decision_on_what_is_unknown_is_an_error_with_help(start: Start) -> None:
    with pytest.raises(ProgramError) as caught:
        start(DOORS, procedure="hasty").run()
    diagnostic = caught.value.diagnostic
    assert diagnostic.code.code == "GL117"
    assert diagnostic.message == (
        "`gate(3) = open` is neither known to be true nor known to be false, so that the program cannot go on"
    )
    assert (diagnostic.span.text, diagnostic.notes) == ("gate(3) = open", ("gate(3) = open or closed",))
    assert diagnostic.help == "`look` senses it"


def test_a_guard_neither_steps_nor_ends_while_its_condition_is_unknown(start: Start, event: Callable[..., Any]) -> None:
    run = start(DOORS, batches=[[event("somebody_passes", 2)]], procedure="watched")
    run.run()
    assert run.story() == ["<somebody_passes(2)", "enter(2)", "enter(1)"]


SURE = """\
domain sure
type door = {open, closed, jammed}
fluent gate: door = one of [open, closed]
fluent other: bool = unknown
action look:
    senses gate
proc control:
    look
"""


def test_a_surprise_is_reported_and_believed(start: Start) -> None:
    run = start(SURE, perform=lambda action, args: ("jammed",))
    run.run()
    assert run.value("gate") == "jammed"
    assert run.value("other") == Unknown((False, True))
    (done,) = run.only(Done)
    assert [(one.sensed, one.expected) for one in done.surprises] == [("jammed", Unknown(("open", "closed")))]


def test_a_surprise_may_end_the_run(start: Start) -> None:
    policy = Policy(on_surprise=OnSurprise.STOP)
    with pytest.raises(ProgramError, match="`look` sensed jammed, where open or closed was expected") as caught:
        start(SURE, perform=lambda action, args: ("jammed",), policy=policy).run()
    assert caught.value.diagnostic.code.code == "GL115"
