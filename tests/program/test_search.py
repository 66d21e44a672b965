"""``search`` online: look ahead before the first step, follow the way, look again when the world has changed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.diagnostics import Code, ProgramError

Start = Callable[..., Any]

BLOCK = """
    search:
        choose:
            a
            test x = 7
        or:
            b
            inc
            c
            test x = 1
        or:
            b
            act(3)
"""


def test_search_takes_no_step_that_leads_nowhere(start: Start) -> None:
    assert start(BLOCK).run() == ["b", "inc", "c"]


def test_without_search_the_first_step_is_committed(start: Start) -> None:
    body = BLOCK.replace("search:", "if true:")
    assert start(body).run() == ["a", "blocked"]


def test_a_way_goes_on_by_the_same_choices_only_if_the_same_program_remains(start: Start) -> None:
    after_a = start("""
        search:
            a
            if p:
                b
                a
            else:
                b
                c
    """).take()
    assert after_a.run() == ["b", "c"]
    assert after_a.event("set_p").run() == ["b", "a"]


def test_search_that_finds_no_way_is_blocked_and_has_done_nothing(start: Start) -> None:
    program = start("""
        search:
            a
            never
    """)
    assert program.run() == ["blocked"]
    assert [blocked.text for blocked in program.machine.why_blocked(program.node, program.state)] == [
        "`search` finds no way to the end of its block; the longest way was a; "
        "there `never` is not possible: `false` is false"
    ]


def test_the_way_is_kept_if_its_choices_still_lead_to_the_end(start: Start) -> None:
    program = start("""
        search:
            star:
                inc
            test x >= 2
            a
    """)
    assert program.run() == ["inc", "inc", "a"]
    assert program.take().event("set_x", 5).run() == ["inc", "a"]


def test_a_choice_is_kept_though_another_leads_to_the_same_program(start: Start) -> None:
    program = start("""
        search:
            inc
            choose:
                off(1)
            or:
                off(2)
            test not on(2)
    """)
    assert program.run() == ["inc", "off(2)"]
    assert program.take().event("set_x", 4).run() == ["off(2)"]


def test_the_rest_is_searched_anew_if_the_choices_lead_nowhere(start: Start) -> None:
    program = start("""
        search:
            inc
            choose:
                test x = 1
                a
            or:
                b
    """)
    assert program.run() == ["inc", "a"]
    assert program.take().event("set_x", 4).run() == ["b"]


def test_an_alternative_already_passed_is_lost(start: Start) -> None:
    program = start("""
        search:
            choose:
                a
                test x = 0
            or:
                b
    """)
    after = program.take().event("set_x", 4)
    assert after.run() == ["blocked"]
    [reason] = after.machine.why_blocked(after.node, after.state)
    assert reason.text == (
        "the plan of `search` no longer leads to its end, and alternatives that it has passed are lost; "
        "it counted on x = 0; stuck at once: `x = 0` is false (x = 4)"
    )
    assert reason.values == (("x", 4),)
    assert reason.actions == 1


def test_search_may_end_without_a_step(start: Start) -> None:
    program = start("""
        search:
            star:
                a
        b
    """)
    assert program.labels()[0] == "b"


def test_a_branch_beside_the_search_may_change_the_state(start: Start) -> None:
    program = start("""
        together:
            search:
                choose:
                    a
                    test x = 0
                or:
                    c
                    test x = 0
                    c
        and:
            test p
            inc
    """)
    assert program.run() == ["a", "blocked"]
    assert program.event("set_p").take(1).take(1).run() == ["blocked"]


def test_all_transitions_of_a_higher_part_are_looked_at(start: Start) -> None:
    program = start("""
        search:
            prefer:
                choose:
                    a
                    test p
                or:
                    b
            over:
                c
    """)
    assert program.run() == ["b", "c"]


def test_every_witness_is_tried(start: Start) -> None:
    program = start("""
        search:
            pick n: digit:
                test on(n)
                off(n)
                test not on(2)
    """)
    assert program.run() == ["off(2)"]


def test_a_waiting_condition_is_a_test_of_look_ahead(start: Start) -> None:
    program = start("""
        search:
            inc
            wait until x = 1
            a
    """)
    assert program.run() == ["inc", "a"]


def test_a_hundred_steps_are_planned_once(start: Start) -> None:
    program = start("""
        search:
            while x < 100:
                inc
    """)
    machine, node, state, programs = program.machine, program.node, program.state, set()
    for _ in range(100):
        label, node = machine.decide(node, state)
        state = machine.successor(state, label)
        programs.add(node.operands[0])
    assert machine.final(node, state)
    assert len(programs) == 1


DETOUR = """
    choose:
        a
        b
        c
    or:
        b
        test {0}
        b
    or:
        c
        c
"""


def test_search_shortest_takes_the_first_of_the_shortest_ways(start: Start) -> None:
    block = "search shortest:" + DETOUR.replace("\n", "\n    ")
    assert start(block.format("true")).run() == ["b", "b"]
    assert start(block.format("x = 1")).run() == ["c", "c"]


def test_search_shortest_counts_actions_only(start: Start) -> None:
    program = start("""
        search shortest:
            choose:
                a
                b
            or:
                test x = 0
                say "three steps, but one action"
                test not p
                c
    """)
    assert program.run()[-1] == "c"


COSTS = """
action walk:
    cost 3
action ride:
    cost x
action fly:
    cost 3 - x
"""


def test_search_cheapest_adds_costs_up_as_they_are_before_each_action(start: Start) -> None:
    block = """
        search cheapest:
            choose:
                walk
                walk
            or:
                inc
                inc
                ride
            or:
                a
                a
                a
                a
                a
    """
    assert start(block, COSTS).run() == ["inc", "inc", "ride"]
    assert start(block, COSTS).event("set_x", 1).run() == ["inc", "inc", "ride"]
    assert start(block, COSTS).event("set_x", 5).run() == ["a", "a", "a", "a", "a"]


def test_the_first_of_equally_cheap_ways_is_taken(start: Start) -> None:
    program = start(
        """
        search cheapest:
            choose:
                a
                walk
            or:
                walk
                a
            or:
                a
                a
                a
                a
        """,
        COSTS,
    )
    assert program.run() == ["a", "walk"]


def test_ways_of_one_cost_are_in_program_order_though_they_were_found_in_another(start: Start) -> None:
    program = start(
        """
        search cheapest:
            choose:
                walk
                walk
            or:
                a
                a
                a
                walk
            or:
                a
                a
                walk
                a
        """,
        COSTS,
    )
    assert program.run() == ["walk", "walk"]


def test_a_negative_cost_is_an_error_with_its_place(start: Start) -> None:
    program = start("search cheapest:\n    fly", COSTS).event("set_x", 5)
    with pytest.raises(ProgramError) as caught:
        program.run()
    diagnostic = caught.value.diagnostic
    assert diagnostic.code is Code.VALUE_OUTSIDE_TYPE
    assert diagnostic.message == "the cost of `fly` would be -2, but a cost is at least 0"
    assert diagnostic.span.text == "3 - x"
    assert start("search cheapest:\n    fly", COSTS).event("set_x", 3).run() == ["fly"]


def test_a_bound_on_steps_that_is_reached_is_the_reason(start: Start) -> None:
    program = start("""
        search at most x + 2 steps:
            while x < 3:
                inc
    """)
    assert program.run() == ["blocked"]
    [reason] = program.machine.why_blocked(program.node, program.state)
    assert reason.text == "`search` finds no way to the end of its block; no way of more than 2 steps was considered"
    assert program.event("set_x", 1).run() == ["inc", "inc"]


def test_no_way_at_all_is_told_from_giving_up(start: Start) -> None:
    program = start("""
        search at most 9 steps:
            inc
            never
    """)
    [reason] = program.machine.why_blocked(program.node, program.state)
    assert reason.text.startswith("`search` finds no way to the end of its block; the longest way was ")


def test_time_that_is_up_is_the_reason(start: Start) -> None:
    program = start("""
        search within 0 s:
            while x < 1000:
                inc
    """)
    assert program.run() == ["blocked"]
    [reason] = program.machine.why_blocked(program.node, program.state)
    assert reason.text.startswith("`search` finds no way to the end of its block; gave up after 0 s (")


def test_the_rest_is_searched_by_the_same_strategy(start: Start) -> None:
    program = start("""
        search shortest:
            inc
            choose:
                test x = 1
                a
            or:
                b
                b
            or:
                c
    """)
    assert program.run() == ["inc", "a"]
    assert program.take().event("set_x", 4).run() == ["c"]


def test_steps_that_have_been_done_count_for_the_bound_of_the_rest(start: Start) -> None:
    program = start("""
        search at most 3 steps:
            inc
            while x < 2:
                inc
    """)
    assert program.run() == ["inc", "inc"]
    assert program.take().event("set_x", 0).run() == ["inc", "inc"]
    after = program.take().event("set_x", -1)
    assert after.run() == ["blocked"]
    [reason] = after.machine.why_blocked(after.node, after.state)
    assert reason.text.endswith("; it counted on x = 1; no way of more than 2 steps was considered")


def test_a_request_is_answered_once(start: Start) -> None:
    """The same block in the same state, first and shortest, are different questions."""
    program = start(
        """
        choose:
            search first:
                q
            test p
        or:
            search shortest:
                q
    """.replace(
            "q", "choose:\n                    a\n                    a\n                or:\n                    b"
        )
    )
    assert program.labels() == ["a", "b"]


def test_a_search_that_has_come_to_its_end_is_not_blamed(start: Start) -> None:
    after = start("""
        search:
            a
            test x = 0
        never
    """).take()
    blocked = after.take()
    reasons = blocked.machine.why_blocked(blocked.node, blocked.state)
    assert [reason.text for reason in reasons] == ["`never` is not possible: `false` is false"]
