"""Questions about sets, lists, strings and real numbers, which cannot be gone through, against trying situations."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from fractions import Fraction
from os import environ

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from golc.diagnostics import ProgramError
from golc.proofs.prover import Prover
from golc.proofs.questions import Asked, Question, Undecided, Witness
from golc.situation.dynamics import Dynamics
from tests.theories import theory_of

HEAD = """\
domain trial
type small = 0..2
static near(n: small): set[small] = {m for m: small where abs(m - n) = 1}
fluent x: small = 0
fluent route: list[small] = []
fluent seen: set[small] = {}
fluent back: list[small]? = none
fluent note: string = ""
fluent fuel: real = 0
fluent on(n: small): bool = false
define waiting := len(route) > 0
"""
ATOMS = [
    "x = 2", "x in route", "x in seen + {1}", "route = []", "route != []", "len(route) > 0", "0 < len(route)",
    "len(route) = 0", "len(route) >= 2", "waiting", "first(route) = x", "rest(route) = [x]", "route[0] = 1",
    "route[1] = 1", "on(first(route))", "on(first(route) + 1)", "exists n in route. on(n)", "back != none",
    "back = none", "first(back) = 1", "x in back", "len(back) > 1", 'note = ""', 'note != "{route}"', "fuel > 0.5",
    "fuel * 2 = 1", "3 // x = 1", "seen - {x} = {}", "(count n in seen. n > x) = 1", "(max n in route. n) = 2",
    "on(1)", "first(route) in seen and x in near(first(route))", "first(rest(route)) = x", "len(near(x)) = 2",
    "(first(back) if back != none else x) = 1",
]  # fmt: skip
LISTS: tuple[tuple[int, ...], ...] = ((), (0,), (1,), (2,), (0, 1), (2, 2), (1, 2, 0))
VALUES: Mapping[str, tuple[object, ...]] = {
    "x": (0, 1, 2),
    "route": LISTS,
    "seen": (frozenset(), frozenset({1}), frozenset({0, 2})),
    "back": (None, (), (1,), (2, 0)),
    "note": ("", "[]"),
    "fuel": (0, Fraction(1, 2), 7),
    "on(0)": (False, True),
    "on(1)": (True,),
    "on(2)": (False,),
}
STATES = [*itertools.product(*VALUES.values())]

formulas = st.recursive(
    st.sampled_from(ATOMS),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["and", "or", "implies"]), inner).map(
            lambda parts: f"({parts[0]}) {parts[1]} ({parts[2]})"
        ),
        inner.map(lambda part: f"not ({part})"),
    ),
    max_leaves=4,
)


def ask(formula: str, fails: bool) -> Witness | Undecided | None:
    theory = theory_of(f"{HEAD}define asked := {formula}\n")
    return Prover(theory).answer(Question((), (Asked(theory.definitions["asked"].body),), fails))


@settings(max_examples=int(environ.get("GOLC_EXAMPLES", 60)), deadline=None)
@given(formulas, st.booleans())
def test_no_answer_is_contradicted_by_a_situation(formula: str, fails: bool) -> None:
    theory = theory_of(f"{HEAD}define asked := {formula}\n")
    body = theory.definitions["asked"].body
    evaluate = Dynamics(theory).compiler.term(body, 0)

    def is_one(state: tuple[object, ...]) -> bool:
        try:
            return bool(evaluate(state, ())) and not fails
        except ProgramError:
            return fails

    found = Prover(theory).answer(Question((), (Asked(body),), fails))
    if found is None:
        assert not any(map(is_one, STATES))
    elif isinstance(found, Witness):
        usual = {name: values[0] for name, values in VALUES.items()}
        assert is_one(tuple((usual | dict(found.fluents)).values()))


@pytest.mark.parametrize(
    "formula",
    [
        "len(route) > 0 and first(route) = x",
        "waiting and on(first(route))",
        "not (len(route) = 0 or rest(route) = [])",
        "route = [] or route[0] = x",
        "x in route and first(route) = x",
        "back != none and x in back",
        "back = none or len(back) > 1",
        "(first(route) if route != [] else x) = 1",
        "len(route) > 0 implies first(route) in near(first(route))",
        "exists n in route, m in near(n). on(m) and first(route) = n",
    ],
)
def test_what_was_asked_before_is_taken_into_account(formula: str) -> None:
    assert ask(formula, fails=True) is None


@pytest.mark.parametrize(
    ("formula", "fluents"),
    [
        ("first(route) = x", {"route": ()}),
        ("len(route) >= 0 and first(route) = x", {"route": ()}),
        ("x in back", {"back": None}),
        ("len(route) > 0 and route[1] = 2", {"route": (0,)}),
        ("on(first(route) + 1) and route != []", {"route": ()}),
    ],
)
def test_an_error_is_found_among_a_few_values(formula: str, fluents: dict[str, object]) -> None:
    found = ask(formula, fails=True)
    assert isinstance(found, Witness)
    assert dict(found.fluents) == fluents


def test_what_cannot_be_gone_through_is_left_out_of_a_proof() -> None:
    assert ask("len(route) > 1 and x = 1 and x = 2", fails=False) is None
    assert isinstance(ask("len(route) > 1 and len(route) < 1", fails=False), Undecided)
    assert isinstance(ask('note = "{x}" and x = 1 and route = [1]', fails=False), Undecided)
