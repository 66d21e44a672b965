"""What terms over collections, texts and real numbers are, by hand: in generated code and off the tree."""

from __future__ import annotations

from fractions import Fraction

import pytest

from golc.situation.dynamics import Dynamics
from golc.theory.recursion import deep_recursion
from golc.theory.types import Value
from tests.theories import theory_of

DOMAIN = """domain d
type colour = {red, green, blue}
type digit = 0..9
fluent x: digit = 2
fluent half: real = 0.5
fluent paint: set[colour] = {blue, red}
fluent queue: list[digit] = [3, 0, 3]
fluent pairs: set[list[colour]] = {[blue], [red, blue], []}
fluent maybe: set[set[colour]?] = {none, {blue}, {red}}
fluent names: list[string] = ["b", "a b"]
fluent on(d: digit) = d in {0, 3}
static fact(n: int): real = 1 if n = 0 else n * fact(n - 1) * 0.5
define shades(cs: set[colour]) := [c for c in cs where c != green]
action a
"""
DEEP = 240

TERMS: list[tuple[str, Value]] = [
    ("[c for c in paint + {green}]", ("red", "green", "blue")),
    ("[l for l in pairs]", ((), ("red", "blue"), ("blue",))),
    ("[s for s in maybe]", (None, frozenset({"red"}), frozenset({"blue"}))),
    ("[c for c in shades(paint)] + [c for c in {blue, green}]", ("red", "blue", "green", "blue")),
    ("{n * 2 for n in queue where on(n)}", frozenset({0, 6})),
    ("[n + m for n in queue, m in [n, x] where m > 0]", (6, 5, 2, 6, 5)),
    ("[m for n in [1, 2], m: digit where m < n]", (0, 0, 1)),
    ("exists c in paint. c = red", True),
    ("forall n in queue. on(n)", True),
    ("exists n in queue. 3 // n = 1", True),
    ("exists n in {x, 0}. false", False),
    ("count n in queue. n = 3", 2),
    ("sum n in queue. n", 6),
    ("min n in {x, 7}. n", 2),
    ("max n in queue. n * half", Fraction(3, 2)),
    ("sum n in [1, 1]. half", 1),
    ("half + half", 1),
    ("half * x", 1),
    ("(half + 3) % 2", Fraction(3, 2)),
    ("(half - 4) // 1", -4),
    ("-half", Fraction(-1, 2)),
    ("fact(3)", Fraction(3, 4)),
    ("x in {1, x} and 5 not in queue and [red] not in pairs", True),
    ("none in maybe", True),
    ("paint - {red} = {blue} and paint != {blue}", True),
    ("queue - [3, x]", (0,)),
    ("queue + [x]", (3, 0, 3, 2)),
    ("first(queue) + len(rest(queue)) + queue[x]", 8),
    ('"{paint} {queue} {half} {maybe}"', "{red, blue} [3, 0, 3] 0.5 {none, {red}, {blue}}"),
    ('"{names} {names[1]}"', '["b", "a b"] a b'),
    ("{n for n: digit where n in [x, 9] or n = 4}", frozenset({2, 4, 9})),
    ("len(digit) + len(colour)", 13),
    ("colour[x]", "blue"),
    ("[" * DEEP + "x" + "]" * DEEP + "[0]" * DEEP, 2),
    ("len({" * DEEP + "x" + "})" * DEEP, 1),
]


def evaluated(text: str) -> list[Value]:
    """The value of an expression by generated code, and off the tree."""
    theory = theory_of(f"{DOMAIN}define it := {text}\n")
    dynamics, term = Dynamics(theory), theory.definitions["it"].body
    state = dynamics.initial()
    with deep_recursion():
        return [dynamics.compiler.term(term, 0)(state, ()), dynamics.knowing.evaluate(term, state, ())]


@pytest.mark.parametrize(("text", "value"), TERMS, ids=[text[:60] for text, _ in TERMS])
def test_values(text: str, value: Value) -> None:
    for found in evaluated(text):
        assert found == value
        assert type(found) is type(value)
