"""Each construct: its transitions in order, and whether it is final, by the definitions of the reference."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

Start = Callable[..., Any]


def test_an_action_is_one_transition_and_then_final(start: Start) -> None:
    program = start("a")
    assert program.labels() == ["a"]
    assert not program.final
    assert program.take().final
    assert program.take().labels() == []


def test_an_impossible_action_has_no_transition(start: Start) -> None:
    assert start("never").labels() == []


def test_arguments_are_evaluated_when_the_action_starts(start: Start) -> None:
    program = start("""
        inc
        act(x * 10)
    """)
    assert program.take().labels() == ["act(10)"]


def test_a_test_is_a_step_that_needs_its_formula(start: Start) -> None:
    assert start("test x = 0").labels() == ["test"]
    assert not start("test x = 0").final
    assert start("test x = 1").labels() == []


def test_skip_is_final_and_has_no_transition(start: Start) -> None:
    assert start("skip").final
    assert start("skip").labels() == []


def test_a_sequence_steps_its_first_part(start: Start) -> None:
    assert start("""
        a
        b
    """).labels() == ["a"]


def test_interrupts_are_final_only_when_nothing_can_step_though_their_body_might_end(start: Start) -> None:
    program = start("""
        interrupts:
            on x = 0:
                inc
                star:
                    a
    """).take()
    assert program.labels() == ["a"]
    assert not program.final


def test_a_final_first_part_lets_the_second_step_first(start: Start) -> None:
    program = start("""
        star:
            a
        b
    """)
    assert program.labels() == ["b", "a"]
    assert program.take(1).labels() == ["b", "a"]


def test_an_if_and_its_first_step_are_one_transition(start: Start) -> None:
    text = """
        if x = {}:
            a
        elif x = 0:
            b
        else:
            c
    """
    assert start(text.format(0)).labels() == ["a"]
    assert start(text.format(1)).labels() == ["b"]
    assert start("""
        if x = 1:
            a
    """).final


def test_a_while_and_its_first_step_are_one_transition(start: Start) -> None:
    program = start("""
        while x < 2:
            inc
    """)
    assert program.labels() == ["inc"]
    assert not program.final
    assert program.run() == ["inc", "inc"]


def test_a_while_is_final_where_its_condition_fails_or_its_body_is_final(start: Start) -> None:
    assert start("""
        while x = 1:
            a
    """).final
    assert start("""
        while x = 0:
            skip
    """).final


def test_choose_offers_its_branches_as_written(start: Start) -> None:
    program = start("""
        choose:
            b
        or:
            never
        or:
            a
    """)
    assert program.labels() == ["b", "a"]


def test_pick_offers_every_value_whose_where_holds_in_the_order_of_the_type(start: Start) -> None:
    program = start("""
        pick n: digit where on(n):
            off(n)
    """)
    assert program.labels() == ["off(1)", "off(2)"]


def test_pick_passes_over_values_whose_body_cannot_step(start: Start) -> None:
    program = start("""
        pick n: digit, m: digit where n > m:
            off(n)
    """)
    assert program.labels() == ["off(1)", "off(2)", "off(2)"]


def test_pick_is_final_if_its_body_is_for_some_value(start: Start) -> None:
    assert start("""
        pick n: digit where on(n):
            skip
    """).final
    assert not start("""
        pick n: digit where n > 3:
            skip
    """).final


def test_star_stops_first_and_goes_round(start: Start) -> None:
    program = start("""
        star:
            a
            b
    """)
    assert program.final
    assert program.labels() == ["a"]
    assert not program.take().final
    assert program.take().take().final
    assert program.take().take().node is program.node


def test_together_interleaves_its_branches(start: Start) -> None:
    program = start("""
        together:
            a
            b
        and:
            c
    """)
    assert program.labels() == ["a", "c"]
    assert program.take(0).labels() == ["b", "c"]
    assert program.take(1).labels() == ["a"]
    assert not program.take(1).final


def test_a_blocked_test_blocks_only_its_own_branch(start: Start) -> None:
    assert start("""
        together:
            test p
            a
        and:
            b
    """).run() == ["b", "blocked"]


def test_prefer_steps_the_lower_part_only_if_the_higher_cannot(start: Start) -> None:
    program = start("""
        prefer:
            test p
            a
        over:
            b
            b
        over:
            c
    """)
    assert program.labels() == ["b"]
    assert program.event("set_p").labels() == ["test"]
    assert program.take().take().labels() == ["c"]


def test_prefer_offers_every_transition_of_the_higher_part(start: Start) -> None:
    assert start("""
        prefer:
            choose:
                a
            or:
                b
        over:
            c
    """).labels() == ["a", "b"]


def test_prefer_is_final_when_all_parts_are(start: Start) -> None:
    program = start("""
        prefer:
            star:
                a
        over:
            b
    """)
    assert not program.final
    assert program.labels() == ["a"]


def test_the_highest_interrupt_that_can_step_does(start: Start) -> None:
    program = start("""
        interrupts:
            on p:
                a
            on x = 0:
                never
            on x < 2:
                inc
                b
    """)
    assert program.labels() == ["inc"]
    assert program.take().event("set_p").labels() == ["a"]
    assert program.take().labels() == ["b"]


def test_an_interrupt_takes_the_first_binding_whose_body_can_step(start: Start) -> None:
    program = start("""
        interrupts:
            on some n: digit where n < 3:
                off(n)
    """)
    assert program.labels() == ["off(1)"]
    assert program.run() == ["off(1)", "off(2)"]


def test_the_guard_of_an_interrupt_is_not_asked_again_inside_its_body(start: Start) -> None:
    program = start("""
        interrupts:
            on x = 0:
                inc
                a
    """)
    assert program.run() == ["inc", "a"]


def test_a_pre_empted_interrupt_goes_on_where_it_was(start: Start) -> None:
    program = start("""
        interrupts:
            on p and x < 5:
                act(9)
                inc
                inc
                inc
                inc
                inc
            on x = 0:
                a
                b
                inc
    """)
    after = program.take().event("set_p")
    assert after.run() == ["act(9)", "inc", "inc", "inc", "inc", "inc", "b", "inc"]


def test_a_final_body_has_ended_when_something_else_of_the_block_steps(start: Start) -> None:
    text = """
        interrupts:
            {}
            on not p:
                a
                wait until p
            {}
    """
    first = "on x = 7:\n                inc"
    for program in (start(text.format("", first)), start(text.format(first, ""))):
        answered = program.take().event("set_p").event("set_x", 7)
        assert answered.labels() == ["inc"]
        assert answered.take().event("clear_p").labels() == ["a"]


def test_interrupts_are_final_when_none_is_active_and_none_can_step(start: Start) -> None:
    program = start("""
        interrupts:
            on p:
                a
                test x = 1
    """)
    assert program.final
    assert not program.event("set_p").final
    assert not program.event("set_p").take().final


def test_interrupts_that_have_ended_let_the_sequence_go_on_and_fire_again(start: Start) -> None:
    program = start("""
        interrupts:
            on p:
                a
        b
    """)
    assert program.labels() == ["b"]
    ended = start("""
        together:
            interrupts:
                on x = 1:
                    inc
        and:
            wait
    """)
    assert ended.event("set_x", 1).labels() == ["inc", "wait"]


def test_a_second_block_of_interrupts_runs(start: Start) -> None:
    program = start("""
        interrupts:
            on x = 0:
                inc
        interrupts:
            on x = 1:
                inc
    """)
    assert program.run() == ["inc", "inc"]


def test_a_procedure_evaluates_its_arguments_with_its_first_transition(start: Start) -> None:
    program = start(
        """
        p_(x + 1)
    """,
        """
        proc p_(n: int):
            act(n)
    """,
    )
    assert program.labels() == ["act(1)"]
    assert program.event("set_x", 4).labels() == ["act(5)"]


def test_a_procedure_is_by_value(start: Start) -> None:
    program = start(
        "twice(x)",
        """
        proc twice(n: int):
            inc
            act(n)
    """,
    )
    assert program.run() == ["inc", "act(0)"]


def test_a_recursive_procedure_reached_again_without_a_step_is_a_step(start: Start) -> None:
    program = start(
        "down(2)",
        """
        proc down(n: int):
            if n > 0:
                down(n - 1)
            else:
                a
    """,
    )
    assert program.labels() == ["test"]
    assert not program.final
    assert program.run() == ["a"]


def test_let_names_a_value_without_a_step(start: Start) -> None:
    program = start("""
        let y = x + 1:
            inc
            act(y)
    """)
    assert program.labels() == ["inc"]
    assert program.run() == ["inc", "act(1)"]


def test_wait_is_a_step_online(start: Start) -> None:
    assert start("wait").labels() == ["wait"]
    assert not start("wait").final


def test_wait_until_waits_while_its_condition_fails(start: Start) -> None:
    program = start("""
        wait until p
        a
    """)
    assert program.labels() == ["wait"]
    assert program.event("set_p").labels() == ["a"]
    assert program.take().node is program.node


def test_a_wait_is_taken_only_if_nothing_else_can_step(start: Start) -> None:
    assert start("""
        choose:
            wait
        or:
            a
    """).run() == ["a"]


def test_a_waiting_higher_part_holds_the_lower_ones(start: Start) -> None:
    program = start("""
        prefer:
            wait until p
        over:
            a
    """)
    assert program.labels() == ["wait"]
    assert program.event("set_p").labels() == ["a"]


def test_test_steps_come_before_actions(start: Start) -> None:
    program = start("""
        together:
            a
        and:
            say "x is {x}"
            b
    """)
    assert program.run() == ["say x is 0", "a", "b"]


def test_abort_ends_the_run_and_is_a_dead_end_of_look_ahead(start: Start) -> None:
    assert start('abort "at {x}"').labels() == ["abort at 0"]
    assert start('abort "at {x}"', ahead=True).labels() == []


def test_look_ahead_cannot_wait_but_can_test(start: Start) -> None:
    assert start("wait", ahead=True).labels() == []
    assert start("wait until p", ahead=True).labels() == []
    assert start("wait until p", ahead=True).event("set_p").labels() == ["test"]
    assert not start("wait until p", ahead=True).event("set_p").final


@pytest.mark.parametrize("body", ["while x = 0:\n    test x = 0", "star:\n    test x = 0"])
def test_a_loop_comes_back_to_the_same_program(start: Start, body: str) -> None:
    program = start(body)
    assert program.take().node is program.node


def test_a_star_that_may_stop_does_not_run_for_ever(start: Start) -> None:
    assert (
        start("""
        star:
            a
    """).run()
        == []
    )


def test_names_are_bound_where_they_are_written(start: Start) -> None:
    program = start(
        """
        let n = 7:
            outer(n)
            act(n)
    """,
        """
        proc outer(m: int):
            let n = m + 1:
                act(n)
    """,
    )
    assert program.run() == ["act(8)", "act(7)"]
