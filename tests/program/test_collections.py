"""``for``, ``pick`` and ``on some`` over sets and lists: their transitions in order.

At first ``todo`` is ``[2, 0, 2]`` and ``seen`` is ``{1, 3}``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Start = Callable[..., Any]


def test_for_goes_through_a_list_in_its_order(start: Start) -> None:
    program = start("""
        for n in todo:
            act(n)
    """)
    assert program.labels() == ["act(2)"]
    assert program.run() == ["act(2)", "act(0)", "act(2)"]


def test_for_goes_through_a_set_in_the_order_of_the_type(start: Start) -> None:
    program = start("""
        for n in seen + {0}:
            act(n)
    """)
    assert program.run() == ["act(0)", "act(1)", "act(3)"]


def test_the_collection_of_a_for_is_evaluated_once_with_its_first_step(start: Start) -> None:
    program = start("""
        c
        for n in todo:
            push(n)
    """)
    assert program.run() == ["c", "push(2)", "push(0)", "push(2)"]
    assert program.event("set_todo", (1,)).run() == ["c", "push(1)"]
    assert program.take().event("set_todo", (1, 3)).run() == ["push(1)", "push(3)"]
    assert program.take().take().event("set_todo", ()).run() == ["push(0)", "push(2)"]


def test_the_condition_of_a_for_over_a_list_is_asked_when_its_turn_comes(start: Start) -> None:
    program = start("""
        for n in todo where n != x:
            act(n)
            inc
            inc
    """)
    assert program.run() == ["act(2)", "inc", "inc", "act(0)", "inc", "inc", "act(2)", "inc", "inc"]
    assert program.take().event("set_x", -1).run() == ["inc", "inc", "act(0)", "inc", "inc", "act(2)", "inc", "inc"]
    assert program.take().event("set_x", -2).run() == ["inc", "inc", "act(2)", "inc", "inc"]


def test_collections_and_types_may_be_mixed_and_depend_on_each_other(start: Start) -> None:
    program = start("""
        for n in [2, 1], b: bool, m in [n, 0] where b or m = 0:
            act(10 * n + m)
    """)
    assert program.run() == ["act(20)", "act(22)", "act(20)", "act(10)", "act(11)", "act(10)"]


def test_a_for_over_nothing_is_final(start: Start) -> None:
    program = start("""
        for n in todo - [0, 2]:
            act(n)
    """)
    assert program.final
    assert program.labels() == []


def test_a_turn_that_is_final_lets_the_next_element_step_first(start: Start) -> None:
    program = start("""
        for n in seen:
            star:
                act(n)
    """)
    assert program.labels() == ["act(3)", "act(1)"]
    assert program.final


def test_pick_looks_at_the_collection_as_it_is_now(start: Start) -> None:
    program = start("""
        pick n in todo where n > x:
            act(n)
    """)
    assert program.labels() == ["act(2)", "act(2)"]
    assert program.event("set_todo", (3, 1, 0)).labels() == ["act(3)", "act(1)"]


def test_pick_from_a_set_and_then_from_what_depends_on_the_choice(start: Start) -> None:
    program = start("""
        pick s in {todo, [1]}, n in s:
            act(n)
    """)
    assert program.labels() == ["act(1)", "act(2)", "act(0)", "act(2)"]


def test_an_interrupt_for_some_element(start: Start) -> None:
    program = start("""
        interrupts:
            on some n in seen where n > x:
                push(n)
    """)
    assert program.run() == ["push(1)", "push(3)"]
    assert program.event("set_x", 1).labels() == ["push(3)"]


def test_a_long_list_is_gone_through(start: Start) -> None:
    program = start("""
        for n in [x for x in 1..30000]:
            act(n)
    """)
    assert program.run()[-1] == "act(30000)"


def test_an_action_is_written_by_the_types_of_its_arguments(start: Start) -> None:
    program = start('paint({blue, red}, ["one", "two words"], 0.5)')
    assert program.run() == ['paint({red, blue}, ["one", "two words"], 0.5)']
