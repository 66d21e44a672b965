"""``for``, bounded and concurrent iteration, guards: their transitions in order, and when they are final."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

Start = Callable[..., Any]


def test_for_does_its_block_once_for_each_value_in_order(start: Start) -> None:
    program = start("""
        for n: digit:
            act(n)
    """)
    assert program.labels() == ["act(0)"]
    assert program.run() == ["act(0)", "act(1)", "act(2)", "act(3)"]


def test_the_last_variable_of_a_for_changes_fastest(start: Start) -> None:
    program = start("""
        for n in 1..2, m in 1..3 where n != m:
            act(10 * n + m)
    """)
    assert program.run() == ["act(12)", "act(13)", "act(21)", "act(23)"]


def test_the_condition_of_a_for_is_asked_when_its_turn_comes(start: Start) -> None:
    program = start("""
        for n: digit where n != x:
            act(n)
            inc
    """)
    assert program.run() == ["act(1)", "inc", "act(2)", "inc", "act(3)", "inc"]
    assert program.take().event("set_x", 2).run() == ["inc", "act(2)", "inc", "act(3)", "inc"]


def test_a_turn_is_the_condition_and_the_first_step_in_one(start: Start) -> None:
    program = start("""
        for n: digit where on(n):
            off(n)
    """)
    assert program.labels() == ["off(1)"]
    assert program.take().labels() == ["off(2)"]
    assert program.take().take().final


def test_a_turn_that_is_final_lets_the_next_step_first(start: Start) -> None:
    program = start("""
        for n in 1..2:
            star:
                act(n)
    """)
    assert program.labels() == ["act(2)", "act(1)"]
    assert program.final


def test_a_for_whose_condition_never_holds_is_final(start: Start) -> None:
    program = start("""
        for n: digit where n > 3:
            act(n)
    """)
    assert program.final
    assert program.labels() == []


def test_a_for_that_is_not_over_keeps_what_follows(start: Start) -> None:
    program = start("""
        for n in 1..2:
            act(n)
        c
    """)
    assert program.run() == ["act(1)", "act(2)", "c"]


def test_a_for_of_a_million_turns_is_not_written_out(start: Start) -> None:
    program = start("""
        for n in 1..1000000:
            act(n)
    """)
    assert program.take().take().labels() == ["act(3)"]
    assert program.machine.program.live_nodes < 20


def test_a_bounded_star_stops_or_goes_on_until_its_bound(start: Start) -> None:
    program = start("""
        star at most 2:
            a
        b
    """)
    assert program.labels() == ["b", "a"]
    assert program.take(1).labels() == ["b", "a"]
    assert program.take(1).take(1).labels() == ["b"]


def test_the_bound_is_evaluated_with_the_first_round(start: Start) -> None:
    program = start("""
        star at most x + 1:
            inc
    """)
    assert program.take().labels() == []
    assert program.event("set_x", 1).take().labels() == ["inc"]
    assert program.event("set_x", 1).take().take().labels() == []


@pytest.mark.parametrize("bound", ["0", "x - 1"])
def test_a_star_of_no_rounds_is_over(start: Start, bound: str) -> None:
    program = start(f"star at most {bound}:\n    a")
    assert program.final
    assert program.labels() == []


def test_every_round_of_a_bounded_star_is_finished_before_the_next(start: Start) -> None:
    program = start("""
        star at most 2:
            a
            b
    """)
    assert not program.take().final
    assert program.take().labels() == ["b"]
    assert program.take().take().labels() == ["a"]


def test_copies_are_begun_one_after_the_other_and_run_beside_each_other(start: Start) -> None:
    program = start("""
        together star:
            a
            b
    """)
    assert program.final
    assert program.labels() == ["a"]
    two = program.take().take(1)
    assert program.take().labels() == ["b", "a"]
    assert two.labels() == ["b", "b", "a"]
    assert not two.take().final
    assert two.take().take().final


def test_a_copy_that_is_over_is_forgotten(start: Start) -> None:
    program = start("""
        together star:
            a
            b
    """)
    assert program.take().take().node is program.node
    assert program.take().take(1).take(1).node is program.take().node


def test_concurrent_iteration_that_may_end_ends(start: Start) -> None:
    program = start("""
        together star:
            a
        b
    """)
    assert program.labels() == ["b", "a"]


def test_a_guard_lets_its_block_step_while_the_condition_holds(start: Start) -> None:
    program = start("""
        guard not p:
            a
            b
    """)
    assert program.labels() == ["a"]
    assert not program.final
    assert program.run() == ["a", "b"]


def test_a_guard_whose_condition_fails_is_over(start: Start) -> None:
    program = start("""
        guard not p:
            a
            b
        c
    """)
    assert program.take().event("set_p").labels() == ["c"]
    assert program.take().event("set_p").run() == ["c"]
    assert program.event("set_p").run() == ["c"]


def test_the_condition_of_a_guard_is_asked_before_every_step(start: Start) -> None:
    program = start("""
        guard x < 2:
            while true:
                inc
        c
    """)
    assert program.run() == ["inc", "inc", "c"]


def test_a_guard_opens_again_where_nothing_has_followed(start: Start) -> None:
    after = start("""
        prefer:
            guard not p:
                a
                b
        over:
            c
            wait
    """).take()
    closed = after.event("set_p")
    assert closed.labels() == ["c"]
    assert closed.event("clear_p").labels() == ["b"]


def test_a_guard_is_over_with_its_block(start: Start) -> None:
    program = start("""
        guard true:
            a
    """)
    assert program.take().node is program.machine.program.nil


def test_guards_inside_each_other_all_have_to_hold(start: Start) -> None:
    program = start("""
        guard x = 0:
            guard not p:
                a
                b
            c
    """)
    assert program.take().labels() == ["b"]
    assert program.take().event("set_p").labels() == ["c"]
    assert program.take().event("set_p").event("set_x", 1).final


def test_a_closed_guard_is_named_where_the_program_is_blocked(start: Start) -> None:
    program = start("""
        together:
            guard p:
                a
        and:
            never
    """)
    reasons = program.machine.why_blocked(program.node, program.state)
    assert [reason.text for reason in reasons] == ["`p` is false", "`never` is not possible: `false` is false"]
