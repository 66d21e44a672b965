"""Long runs and deep programs: constant memory, no recursion limit."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterator
from typing import Any

import pytest

Start = Callable[..., Any]


@pytest.fixture
def shallow_stack() -> Iterator[None]:
    """Let Python recurse no deeper than a few hundred calls from here."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack(0)) + 250)
    yield
    sys.setrecursionlimit(limit)


def steps(program: Any, most: int) -> int:
    """Take decisions until the program is final; how many."""
    machine, node, state = program.machine, program.node, program.state
    for count in range(most):
        if machine.final(node, state):
            return count
        label, node = machine.decide(node, state)
        state = machine.successor(state, label)
    return most


def test_a_million_steps_of_a_loop_leave_no_programs_behind(start: Start) -> None:
    program = start("""
        while x < 1000000:
            inc
    """)
    before = program.machine.program.live_nodes
    assert steps(program, 10**7) == 10**6
    assert program.machine.program.live_nodes == before


def test_the_rounds_of_a_loop_share_their_programs(start: Start) -> None:
    program = start("""
        while x < 100000:
            pick n: digit where n = x % 4:
                act(n)
                inc
    """)
    steps(program, 1000)
    few = program.machine.program.live_nodes
    assert steps(program, 10**6) == 2 * 10**5
    assert program.machine.program.live_nodes <= few + 2


@pytest.mark.parametrize(
    ("body", "procedure"),
    [
        ("nest(100000)", "proc nest(n: int):\n    if n > 0:\n        inc\n        nest(n - 1)\n        inc\n"),
        (
            "nest(300)",
            "proc nest(n: int):\n    if n > 0:\n        inc\n        together:\n            nest(n - 1)\n"
            "        and:\n            test x >= 300\n            inc\n",
        ),
        (
            "nest(300)",
            "proc nest(n: int):\n    if n > 0:\n        inc\n        prefer:\n            nest(n - 1)\n"
            "        over:\n            inc\n",
        ),
    ],
)
def test_procedures_may_nest_deeply(start: Start, shallow_stack: None, body: str, procedure: str) -> None:
    program = start(body, procedure)
    wanted = 2 * int(body[5:-1])
    actions = 0
    machine, node, state = program.machine, program.node, program.state
    while not machine.final(node, state):
        label, node = machine.decide(node, state)
        after = machine.successor(state, label)
        actions += after != state
        state = after
    assert actions == wanted


def test_a_long_sequence_is_no_deep_one(start: Start) -> None:
    program = start("\n".join(["test x = 0"] * 20000))
    assert steps(program, 10**6) == 20000
