"""Random programs: the machine's *Trans* and *Final* are those of the definitions, written out naively here.

The clock stands still: a wait for a time does not end, and no time is up.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from golc.situation.worlds import Worlds
from golc.theory.types import show_call
from tests.reference.definitions import Definitions

CONDITIONS = ["x = 0", "x < 2", "not p", "on(1)", "exists n: digit. on(n)", "x % 2 = 1", "x in todo", "true", "false"]
LEAVES = ["a", "b", "inc", "act(x)", "off(1)", "off(x % 4)", "push(x % 4)", "never", "skip", "wait", "wait 5 s", "q(1)"]
LEAVES += ["q(x)", "push(len(seen))"]
PROCEDURES = """
proc q(n: int):
    choose:
        act(n)
    or:
        test n < 2
        q(n + 1)
    or:
        if n < 1:
            q(n + 2)
        else:
            skip
"""


UNCERTAIN = ["u", "not u", "v(1)", "v(0) or v(1)", "knows(u)", "possible(v(2)) and x < 2", "known(v(1))", "on(1)"]
STIRRING = ["peek", "stir(0)", "stir(x % 4)", "act(1 if u else 2)", "act(x)", "inc", "a", "wait", "skip", "q(x)"]


def lines(depth: int, conditions: list[str] = CONDITIONS) -> st.SearchStrategy[list[str]]:
    """A block, as lines."""
    statement = st.sampled_from(LEAVES if conditions is CONDITIONS else STIRRING).map(lambda line: [line])
    condition = st.sampled_from(conditions)
    statement |= condition.map(lambda c: [f"test {c}"]) | condition.map(lambda c: [f"wait until {c}"])
    if depth > 0:
        inner = lines(depth - 1, conditions).map(lambda block: ["    " + line for line in block])
        two = st.lists(inner, min_size=2, max_size=3)

        def joined(first: str, other: str) -> Callable[[list[list[str]]], list[str]]:
            return lambda blocks: [
                line for k, block in enumerate(blocks) for line in [f"{other if k else first}:", *block]
            ]

        handlers = st.lists(st.tuples(condition, inner), min_size=1, max_size=3)
        statement |= st.one_of(
            st.tuples(condition, inner, inner).map(lambda t: [f"if {t[0]}:", *t[1], "else:", *t[2]]),
            st.tuples(condition, inner).map(lambda t: [f"while {t[0]}:", *t[1]]),
            inner.map(lambda block: ["star:", *block]),
            st.tuples(st.sampled_from(["0", "2", "x - 1"]), inner).map(lambda t: [f"star at most {t[0]}:", *t[1]]),
            inner.map(lambda block: ["together star:", *block]),
            st.tuples(condition, inner).map(lambda t: [f"guard {t[0]}:", *t[1]]),
            inner.map(lambda block: ["within x + 1 s:", *block, "else:", "    a"]),
            inner.map(lambda block: ["for n: digit where on(n):", *block]),
            inner.map(lambda block: ["for k in 1..2, p2: bool:", "    if p2 = p:", "        act(k)", *block]),
            inner.map(lambda block: ["for n in todo where n in seen or on(n):", *block]),
            inner.map(lambda block: ["for n in seen, m in [n, x], b: bool:", "    if b:", "        act(m)", *block]),
            inner.map(lambda block: ["pick n: digit where on(n):", *block]),
            inner.map(lambda block: ["pick n in todo where on(n):", *block]),
            inner.map(lambda block: ["pick p2: bool, s in {todo, [x]}, n in s:", "    act(n)", *block]),
            inner.map(lambda block: ["pick m: digit:", "    off(m)", *block]),
            inner.map(lambda block: ["let y = x + 1:", "    act(y)", *block]),
            two.map(joined("choose", "or")),
            two.map(joined("together", "and")),
            two.map(joined("prefer", "over")),
            handlers.map(
                lambda hs: [
                    "interrupts:",
                    *(f"    {line}" for c, block in hs for line in [f"on {c}:", *block]),
                    "    on some n: digit where on(n) and n > x:",
                    "        off(n)",
                    "    on some n in seen, m in todo where n = m:",
                    "        push(n)",
                ]
            ),
        )
    return st.lists(statement, min_size=1, max_size=3).map(lambda blocks: [line for block in blocks for line in block])


@given(body=lines(2), ahead=st.booleans())
def test_transitions_and_finality_are_those_of_the_definitions(start: Any, body: list[str], ahead: bool) -> None:
    compare(start("\n".join(body), PROCEDURES, ahead), ahead)


UNKNOWN = """
fluent u: bool = unknown
fluent v(n: digit): bool = unknown
initially u or v(1)
action peek:
    senses u
action stir(n: digit):
    causes v(n) := unknown
    causes u := not u when v(n)
exog ping(n: digit) expected:
    poss v(n)
    causes v(n) := false
"""


@given(body=lines(2, UNCERTAIN), more=st.sampled_from(["", UNKNOWN.replace("expected", "")]))
def test_look_ahead_knows_what_follows_from_the_possible_worlds(start: Any, body: list[str], more: str) -> None:
    compare(start("\n".join(body), PROCEDURES + (more or UNKNOWN), True), True)


def compare(program: Any, ahead: bool) -> None:
    """Follow all transitions of a program for some steps, in the machine and by the definitions."""
    theory = program.executable.dynamics.theory
    defined = Definitions(theory, ahead)
    pending = [(program, defined.start("control"))]
    for _ in range(40):
        if not pending:
            break
        running, config = pending.pop(0)
        state = running.state
        worlds = frozenset(state) if isinstance(state, Worlds) else frozenset([state])
        assert running.final == defined.final(config, worlds)
        wanted = defined.trans(config, worlds)
        if ahead and any(label != "wait" for label, _, _ in wanted):
            wanted = [transition for transition in wanted if transition[0] != "wait"]
        assert running.labels() == [label if isinstance(label, str) else show_call(*label) for label, _, _ in wanted]
        for index, (_, left, after) in enumerate(wanted):
            taken = running.take(index)
            assert (frozenset(taken.state) if isinstance(taken.state, Worlds) else frozenset([taken.state])) == after
            pending.append((taken, left))
