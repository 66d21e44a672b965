"""Successor state axioms mean what the equivalent ``causes`` clauses mean."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.situation.dynamics import Dynamics
from golc.theory.theory import BasicActionTheory
from tests.theories import theory_of

Found = Callable[..., list[str]]
Theory = Callable[..., BasicActionTheory]

LAMPS = """type floor = 1..3
type side = {left, right}
const top = 3
fluent lit(f: floor) = f = 2
fluent at: floor = 1
action call(n: floor)
action turn_off(f: floor)
action go(n: int)
action reset(s: side, n: floor)
exog all_on
"""


def after(theory: BasicActionTheory, *calls: tuple[str, tuple[Any, ...]]) -> list[Any]:
    """The values of ``lit`` and of ``at`` after some actions."""
    dynamics = Dynamics(theory)
    state = dynamics.initial()
    for name, args in calls:
        state = dynamics.progress(state, name, args)
    return list(state)


@pytest.mark.parametrize(
    ("cases", "calls", "state"),
    [
        ("after call(f) := true", [("call", (3,))], [False, True, True, 1]),
        ("after all_on := true", [("all_on", ())], [True, True, True, 1]),
        ("after turn_off(f) := false when f = 2", [("turn_off", (2,))], [False, False, False, 1]),
        ("after turn_off(f) := false when f = 1", [("turn_off", (2,))], [False, True, False, 1]),
        ("after call(n) := f < n", [("call", (2,))], [True, False, False, 1]),
        ("after reset(left, f) := not lit(f)", [("reset", ("left", 2))], [False, False, False, 1]),
        ("after reset(left, f) := not lit(f)", [("reset", ("right", 2))], [False, True, False, 1]),
        ("after reset(s, top) := s = left", [("reset", ("left", 3))], [True, True, True, 1]),
        ("after reset(s, top) := s = left", [("reset", ("left", 2))], [False, True, False, 1]),
        # An argument outside the type of the head's parameter fits no instance.
        ("after go(f) := true", [("go", (9,))], [False, True, False, 1]),
        ("after go(f) := true", [("go", (3,))], [False, True, True, 1]),
        # The first line that fits decides.
        ("after call(1) := false\nafter call(f) := true", [("call", (1,)), ("call", (3,))], [False, False, True, 1]),
        ("after call(f) := true\nafter call(n) := false", [("call", (1,))], [True, False, False, 1]),
        ("after call(n) := false when n = 1\nafter call(f) := true", [("call", (3,))], [False, True, True, 1]),
        ("after call(n) := false when n = 1\nafter call(f) := true", [("call", (1,))], [False, False, False, 1]),
        ("after call(n) := true\nafter call(f) := false", [("call", (3,))], [True, True, True, 1]),
    ],
)
def test_what_a_fluent_is_after_an_action(
    theory: Theory, cases: str, calls: list[tuple[str, tuple[Any, ...]]], state: list[Any]
) -> None:
    lines = "".join(f"    {case}\n" for case in cases.splitlines())
    built = theory(f"{LAMPS}axiom lit(f):\n{lines}    otherwise unchanged\n")
    assert after(built, *calls) == state


def test_a_fluent_without_parameters_and_one_that_never_changes(theory: Theory) -> None:
    text = "axiom at:\n    after go(n) := n when n in floor\n    otherwise unchanged\n"
    built = theory(f"{LAMPS}{text}axiom lit(f):\n    otherwise unchanged\n")
    assert after(built, ("go", (2,)), ("go", (7,)), ("all_on", ())) == [False, True, False, 2]


@pytest.mark.parametrize(
    ("text", "finding"),
    [
        ("axiom lt(f):\n    otherwise unchanged\n", "1:7 GL012 unknown fluent `lt`"),
        ("axiom top:\n    otherwise unchanged\n", "1:7 GL018 `top` is a const, and an axiom describes a fluent"),
        ("axiom lit:\n    otherwise unchanged\n", "1:7 GL015 `lit` takes 1 argument, not none"),
        ("axiom lit(f):\n    after cal(f) := true\n    otherwise unchanged\n", "2:11 GL013 unknown action `cal`"),
        (
            "axiom lit(f):\n    after call := true\n    otherwise unchanged\n",
            "2:11 GL015 `call` takes 1 argument, not none",
        ),
        (
            "axiom lit(f):\n    after call(7) := true\n    otherwise unchanged\n",
            "2:16 GL017 `7` is outside `floor` (1..3)",
        ),
        (
            "axiom lit(f):\n    after reset(f, 1) := true\n    otherwise unchanged\n",
            "2:17 GL016 `f` is of type `floor` (1..3), and here of type `side` (left, right)",
        ),
        (
            "axiom lit(f):\n    after call(f) := 3\n    otherwise unchanged\n",
            "2:22 GL016 `3` is of type `int`, but fluent `lit` needs `bool`",
        ),
        (
            "axiom lit(f):\n    otherwise unchanged\naxiom lit(n):\n    otherwise unchanged\n",
            "3:7 GL011 fluent `lit` has two axioms",
        ),
        (
            "axiom lit(f):\n    otherwise unchanged\naction hit:\n    causes lit(1) := true\n",
            "1:7 GL025 fluent `lit` is described by an axiom and by `causes`",
        ),
    ],
)
def test_what_makes_no_axiom(found: Found, text: str, finding: str) -> None:
    lines = LAMPS.count("\n")
    line, _, rest = finding.partition(":")
    assert found(LAMPS + text) == [f"{int(line) + lines}:{rest}"]


def test_one_mistake_is_one_finding_though_later_lines_look_at_earlier_ones(found: Found) -> None:
    lines = "    after call(f) := true when litt(f)\n    after call(n) := false\n    after call(2) := false\n"
    assert len(found(f"{LAMPS}axiom lit(f):\n{lines}    otherwise unchanged\n")) == 1


BASE = """domain trial
type t = 0..2
fluent big(f: t): t = f
fluent other(f: t): t = 2 - f
"""
PARAMETERS = {"a": ("p", "q"), "b": ("p",)}


@dataclass(frozen=True)
class Line:
    """``after action(pattern) := value when condition``; names in value and condition are in braces."""

    action: str
    pattern: tuple[str, ...]
    value: str
    condition: str

    def axiom(self) -> str:
        names = {name: name for name in ("f", "x", "y")}
        pattern = f"({', '.join(self.pattern)})"
        return (
            f"    after {self.action}{pattern} := {self.value.format(**names)} when {self.condition.format(**names)}\n"
        )

    def names(self) -> dict[str, str]:
        """What each name is in a clause: the first of the action's parameters that it stands for."""
        pairs = zip(self.pattern, PARAMETERS[self.action], strict=True)
        return {"f": "f"} | {name: parameter for name, parameter in reversed([*pairs]) if name in ("x", "y")}

    def fits(self) -> str:
        """When the line fits, over the action's parameters and ``f``."""
        names = self.names()
        demands = [
            f"{names.get(name, name)} = {parameter}"
            for name, parameter in zip(self.pattern, PARAMETERS[self.action], strict=True)
        ]
        return " and ".join([*demands, f"({self.condition.format(**names)})"])

    def clause(self, earlier: Sequence[Line]) -> str:
        others = "".join(f" and not ({line.fits()})" for line in earlier if line.action == self.action)
        value = self.value.format(**self.names())
        return f"    causes forall f: t where {self.fits()}{others}. big(f) := {value}\n"


@st.composite
def lines(draw: st.DrawFn) -> Line:
    action = draw(st.sampled_from(["a", "b"]))
    pattern = tuple(draw(st.sampled_from(["0", "1", "2", "f", "x", "y"])) for _ in PARAMETERS[action])
    bound = [f"{{{name}}}" for name in ("f", "x", "y") if name == "f" or name in pattern]
    # What stands for a parameter of `b` may be outside the type.
    safe = bound if action == "a" else ["{f}"]
    one, two = draw(st.sampled_from([*bound, "1"])), draw(st.sampled_from([*bound, "2"]))
    place = draw(st.sampled_from([*safe, "0"]))
    value = draw(st.sampled_from([place, "2", f"big({place})", f"2 - other({place})"]))
    condition = draw(st.sampled_from([f"{one} < {two}", f"{one} != {two}", f"big({place}) = 1", "true"]))
    if draw(st.booleans()):
        condition = f"{condition} or exists n: t. other(n) > big({place}) and n = {{f}}"
    return Line(action, pattern, value, condition)


@given(st.lists(lines(), min_size=1, max_size=5), st.tuples(*[st.integers(0, 2)] * 6))
def test_an_axiom_means_what_the_equivalent_clauses_mean(cases: list[Line], state: tuple[int, ...]) -> None:
    lines = "".join(case.axiom() for case in cases)
    head = "action a(p: t, q: t)\naction b(p: int)\naxiom big(f):\n"
    axiom = Dynamics(theory_of(f"{BASE}{head}{lines}    otherwise unchanged\n"))
    clauses = {
        action: "".join(case.clause(cases[:index]) for index, case in enumerate(cases) if case.action == action)
        for action in PARAMETERS
    }
    heads = {"a": "action a(p: t, q: t)", "b": "action b(p: int)"}
    actions = [f"{heads[name]}:\n{clauses[name]}" if clauses[name] else f"{heads[name]}\n" for name in heads]
    causes = Dynamics(theory_of(BASE + "".join(actions)))
    calls = [("a", args) for args in product(range(3), repeat=2)] + [("b", (number,)) for number in range(-1, 4)]
    for name, args in calls:
        after_axiom = axiom.progress(state, name, args)
        assert after_axiom == causes.progress(state, name, args)
        interpreted = axiom.interpreter.progress(axiom.theory.actions[name], state, args)
        assert after_axiom == interpreted


@pytest.mark.parametrize(
    ("lines", "clauses"),
    [
        ("after a(f, q) := unknown", "causes big(p) := unknown"),
        ("after a(p, f) := one of {p, f} when p != f", "causes big(q) := one of {p, q} when p != q"),
        (
            "after a(0, q) := unknown when q = f\nafter a(p, q) := one of {other(p), 2}",
            "causes big(q) := unknown when p = 0\n    "
            "causes forall f: t where not (p = 0 and q = f). big(f) := one of {other(p), 2}",
        ),
    ],
)
def test_an_axiom_leaves_open_what_the_equivalent_clauses_leave_open(lines: str, clauses: str) -> None:
    cases = "".join(f"    {line}\n" for line in lines.splitlines())
    axiom = Dynamics(theory_of(f"{BASE}action a(p: t, q: t)\naxiom big(f):\n{cases}    otherwise unchanged\n"))
    causes = Dynamics(theory_of(f"{BASE}action a(p: t, q: t):\n    {clauses}\n"))
    for args in product(range(3), repeat=2):
        assert axiom.progress(axiom.initial(), "a", args) == causes.progress(causes.initial(), "a", args)
