"""``wait e s`` and ``within e s``: what the clock has to do with transitions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

Start = Callable[..., Any]


def at(program: Any, moment: float) -> Any:
    """The program at a moment."""
    program.machine.now = lambda: moment
    return program


def decided(program: Any) -> Any:
    """After the transition that the online loop takes."""
    label, node = program.machine.decide(program.node, program.state)
    return replace(program, node=node, state=program.machine.successor(program.state, label))


def decision(program: Any) -> Any:
    transition = program.machine.decide(program.node, program.state)
    return transition and str(transition.label).partition("(")[0]


def test_a_wait_for_a_time_is_over_when_it_has_passed(start: Start) -> None:
    program = at(start("wait 5 s\na"), 10)
    assert program.labels() == ["clock"]
    waiting = program.take()
    assert waiting.labels() == ["wait"]
    assert waiting.take().node is waiting.node
    assert at(waiting, 14.9).labels() == ["wait"]
    assert at(waiting, 15).labels() == ["a"]


def test_the_time_is_evaluated_when_the_clock_starts(start: Start) -> None:
    program = start("wait 2 * x s").event("set_x", 3).take().event("set_x", 0)
    assert not at(program, 5).final
    assert at(program, 6).final


@pytest.mark.parametrize(
    ("time", "moment"), [("0.5", 0.5), ("len(todo) * 0.25", 0.75), ("x - 9.5", 0), ("1" + 400 * "0", 1e9)]
)
def test_times_have_decimals_and_bounds(start: Start, time: str, moment: float) -> None:
    program = start(f"wait {time} s").take()
    assert at(program, moment).final
    assert moment == 0 or not at(program, moment - 0.1).final


def test_a_clock_starts_when_nothing_else_can_step(start: Start) -> None:
    program = start("""
        choose:
            wait 5 s
        or:
            a
    """)
    assert program.labels() == ["clock", "a"]
    assert decision(program) == "a"


def test_clocks_run_beside_each_other(start: Start) -> None:
    program = at(
        start("""
        together:
            wait 5 s
            a
        and:
            wait 2 s
            b
    """),
        0,
    )
    both = decided(decided(program))
    assert decision(both) == "Wait"
    assert both.machine.alarm == 2
    assert decision(at(both, 2)) == "b"
    assert decision(at(both, 5)) == "a"


WITHIN = """
    within 10 s:
        a
        wait until p
        b
    else:
        c
    off(1)
"""


def test_the_clock_of_within_starts_with_the_first_transition(start: Start) -> None:
    program = at(start(WITHIN), 100)
    assert program.labels() == ["a"]
    begun = program.take()
    assert at(begun, 109.9).labels() == ["wait"]
    assert begun.event("set_p").labels() == ["b"]
    assert at(begun, 110).labels() == ["c"]
    assert at(begun, 110).take().labels() == ["off(1)"]
    assert at(begun, 110).event("set_p").labels() == ["c"]


def test_within_has_no_say_any_more_when_its_block_is_over(start: Start) -> None:
    program = start(WITHIN).take().event("set_p").take()
    assert at(program, 1000).labels() == ["off(1)"]


def test_without_an_else_part_the_program_goes_on_when_the_time_is_up(start: Start) -> None:
    program = start("""
        within 10 s:
            a
            never
        b
    """).take()
    assert decision(program) is None
    assert program.machine.alarm == 10
    assert at(program, 10).labels() == ["b"]


def test_a_wait_at_the_beginning_of_within_starts_its_clock(start: Start) -> None:
    program = at(
        start("""
        within 10 s:
            within 5 s:
                wait until p
            else:
                a
                wait
        else:
            b
    """),
        1,
    )
    assert decision(program) == "Clock"
    outer = decided(program)
    both = decided(outer)
    assert decision(both) == "Wait"
    assert both.machine.alarm == 6
    assert decision(at(both, 6)) == "a"
    assert decision(at(both, 11)) == "b"


def test_look_ahead_has_no_clock(start: Start) -> None:
    program = start("within 1 s:\n    wait 5 s\n    a\nelse:\n    b", ahead=True)
    assert program.labels() == ["clock"]
    assert program.take().labels() == ["a"]
    assert program.take().take().final


def test_a_wait_for_a_time_in_a_search_is_waited_for(start: Start) -> None:
    program = at(
        start("""
        search:
            choose:
                wait 3 s
                never
            or:
                a
                wait 5 s
                b
    """),
        0,
    )
    after = program.take()
    assert after.labels() == ["clock"]
    waiting = after.take()
    assert waiting.labels() == ["wait"]
    assert at(waiting, 5).labels() == ["b"]
    assert at(waiting, 5).take().final
