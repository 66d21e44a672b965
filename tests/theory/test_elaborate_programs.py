"""Blocks to typed programs."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest

from golc.theory import statements as typed
from golc.theory.calls import circular
from golc.theory.terms import Binder, FluentTerm, Literal, Variable
from golc.theory.types import BOOL, INT, Interval

Build = Callable[..., Any]

STATION = Interval(1, 6)
HEAD = """type station = 1..6
fluent lit(f: station) = false
fluent busy = false
action go(n: station)
action stop
exog arrive
"""
BUSY = FluentTerm("busy", (), type=BOOL)
STOP = typed.Perform("stop", ())


def go(value: Variable | int) -> typed.Perform:
    return typed.Perform("go", (value if isinstance(value, Variable) else Literal(value, type=INT),))


@pytest.fixture
def program(theory: Build) -> Build:
    """The program of a block, its lines written without indentation."""

    def build(block: str) -> Any:
        lines = "".join(f"    {line}\n" for line in block.splitlines())
        return theory(f"{HEAD}proc control:\n{lines}").procedures["control"].body

    return build


def test_a_block_of_one_statement_is_that_statement(program: Build) -> None:
    assert program("stop") == STOP


def test_a_block_is_a_sequence(program: Build) -> None:
    assert program("go(1)\nstop\nskip") == typed.Sequence((go(1), STOP, typed.Skip()))


def test_elif_is_an_if_in_the_else_part(program: Build) -> None:
    found = program("if busy:\n    stop\nelif lit(1):\n    go(1)")
    assert found == typed.If(
        BUSY, STOP, typed.If(FluentTerm("lit", (Literal(1, type=INT),), type=BOOL), go(1), typed.Skip())
    )
    assert found.otherwise.span.text == "lit(1):\n        go(1)"


def test_loops_and_choices(program: Build) -> None:
    assert program("while busy:\n    stop") == typed.While(BUSY, STOP)
    assert program("star:\n    stop") == typed.Star(None, STOP)
    assert program("choose:\n    stop\nor:\n    skip") == typed.Choose((STOP, typed.Skip()))
    assert program("together:\n    stop\nand:\n    skip") == typed.Together((STOP, typed.Skip()))
    assert program("prefer:\n    stop\nover:\n    skip") == typed.Prefer((STOP, typed.Skip()))
    assert program("guard busy:\n    stop") == typed.Guard(BUSY, STOP)
    assert program("together star:\n    stop") == typed.TogetherStar(STOP)
    assert program("star at most 3:\n    stop") == typed.Star(Literal(3, type=INT), STOP)


def test_search_has_a_strategy_and_limits(program: Build) -> None:
    first = typed.Search(typed.Strategy.FIRST, None, None, STOP)
    assert program("search:\n    stop") == program("search first:\n    stop") == first
    three = Literal(3, type=INT)
    assert program("search shortest within 2.5 s at most 3 steps:\n    stop") == typed.Search(
        typed.Strategy.SHORTEST, three, Fraction(5, 2), STOP
    )
    assert program("search cheapest within 3 s:\n    stop") == typed.Search(typed.Strategy.CHEAPEST, None, three, STOP)


def test_for_binds_the_next_levels(program: Build) -> None:
    n = Variable(0, "n", type=STATION)
    found = program("for n: station where lit(n):\n    go(n)")
    assert found == typed.For((Binder(n),), FluentTerm("lit", (n,), type=BOOL), go(n))


def test_pick_binds_the_next_levels(program: Build) -> None:
    n, m = Variable(0, "n", type=STATION), Variable(1, "m", type=STATION)
    found = program("pick n: station:\n    pick m: station where lit(m):\n        go(n)\n        go(m)")
    inner = typed.Pick((Binder(m),), FluentTerm("lit", (m,), type=BOOL), typed.Sequence((go(n), go(m))))
    assert found == typed.Pick((Binder(n),), None, inner)


def test_let_binds_a_value(program: Build) -> None:
    found = program("let x = 3:\n    go(x)")
    x = Variable(0, "x", type=INT)
    assert found == typed.Let(x, Literal(3, type=INT), go(x))


def test_interrupts_bind_their_variables_alone(program: Build) -> None:
    n = Variable(0, "n", type=STATION)
    found = program("interrupts:\n    on some n: station where lit(n):\n        go(n)\n    on busy:\n        wait")
    assert found == typed.Interrupts(
        (
            typed.Interrupt((Binder(n),), FluentTerm("lit", (n,), type=BOOL), go(n)),
            typed.Interrupt((), BUSY, typed.Wait()),
        )
    )


def test_tests_waits_and_messages(program: Build) -> None:
    assert program("test busy") == typed.Test(BUSY)
    assert program("wait until busy") == typed.WaitUntil(BUSY)
    assert program('say "it is {busy}!"') == typed.Say(typed.Message(("it is ", BUSY, "!")))
    assert program('abort ""') == typed.Abort(typed.Message(()))


def test_a_procedure_takes_integers(theory: Build) -> None:
    built = theory(HEAD + "proc down(n: int):\n    if n > 0:\n        down(n - 1)\nproc control:\n    down(3)\n")
    assert built.procedures["down"].parameters[0].type == INT
    assert built.procedures["control"].body == typed.Invoke("down", (Literal(3, type=INT),))


def test_recursion_is_told_from_mere_calls(theory: Build) -> None:
    built = theory(HEAD + "proc a:\n    b\nproc b:\n    choose:\n        a\n    or:\n        c\nproc c:\n    stop\n")
    assert {name: procedure.recursive for name, procedure in built.procedures.items()} == {
        "a": True,
        "b": True,
        "c": False,
    }


def test_circles_of_a_graph() -> None:
    graph = {"a": frozenset("b"), "b": frozenset("ac"), "c": frozenset(), "d": frozenset("d"), "e": frozenset("ax")}
    assert [sorted(part) for part in circular(graph)] == [["a", "b"], ["d"]]


def test_a_long_row_of_procedures_is_no_recursion(theory: Build) -> None:
    lines = [f"proc p{n}:\n    p{n + 1}\n" for n in range(3000)]
    built = theory(HEAD + "".join(lines) + "proc p3000:\n    stop\n")
    assert not built.procedures["p0"].recursive


def test_times_are_terms_or_have_decimals(program: Build) -> None:
    five = Literal(5, type=INT)
    assert program("wait 5 s") == typed.WaitTime(five)
    assert program("within 0.5 s:\n    stop") == typed.Within(Fraction(1, 2), STOP, typed.Skip())
    assert program("within 5 s:\n    stop\nelse:\n    go(1)") == typed.Within(five, STOP, go(1))
