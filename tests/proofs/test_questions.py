"""Answers to questions about all situations, against trying many situations one by one."""

from __future__ import annotations

import itertools
import sys
import tracemalloc
from os import environ

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from golc.proofs.prover import Prover
from golc.proofs.questions import Asked, Question, Undecided, Witness
from golc.proofs.solver import solve
from golc.situation.dynamics import Dynamics
from golc.theory.theory import BasicActionTheory
from golc.theory.types import show_call
from tests.proofs.outcomes import outcome
from tests.theories import theory_of

HEAD = """\
domain trial
type small = 0..3
type colour = {red, green, blue}
fluent x: small = 0
fluent on(n: small): bool = false
fluent paint: colour? = none
fluent y: int = 0
fluent far: 0..1000000 = 0
static next(n: small): small = {0: 1, 1: 2, 2: 3, 3: 0}
"""
ATOMS = [
    "x = 2", "on(x)", "on(next(x))", "on(x + 1)", "paint = red", "paint = none", "paint < blue", "x < 3",
    "exists n: small. on(n) and n > x", "forall n: small where n != x. not on(n)", "(count n: small. on(n)) >= 2",
    "y < 3", "y + 2 >= x", "y = 7", "2 * y - 1 > 4", "-y <= 1", "y in 2..4", "abs(y) < 3", "max(y, 2) = 2", "y != far",
    "far > 10", "far = 0", "far - 5 < 3", "y - y = 0", "3 // x = 1", "y % 2 = 0", "far in small",
]  # fmt: skip
ON = [(False, False, False, False), (True, False, False, True), (False, True, True, False), (True, True, True, True)]
FAR = (0, 4, 7, 8, 11, 1_000_000)
STATES = [
    (x, *on, paint, y, far)
    for x, on, paint, y, far in itertools.product(range(4), ON, (None, "red", "blue"), range(-3, 9), FAR)
]


formulas = st.recursive(
    st.sampled_from(ATOMS),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["and", "or", "implies", "iff"]), inner).map(
            lambda parts: f"({parts[0]}) {parts[1]} ({parts[2]})"
        ),
        inner.map(lambda part: f"not ({part})"),
    ),
    max_leaves=3,
)


@settings(max_examples=int(environ.get("GOLC_EXAMPLES", 80)))
@given(formulas)
def test_a_question_is_answered_as_by_trying_many_situations(formula: str) -> None:
    theory = theory_of(f"{HEAD}define asked := {formula}\n")
    body = theory.definitions["asked"].body
    evaluate = Dynamics(theory).compiler.term(body, 0)
    for fails in (False, True):
        found = Prover(theory).answer(Question((), (Asked(body),), fails))
        assert not isinstance(found, Undecided)
        if found is None:
            assert not any(outcome(evaluate, state) is (None if fails else True) for state in STATES)
        else:
            state = situation(theory, found)
            assert outcome(evaluate, state) is (None if fails else True), str(found)


@settings(max_examples=int(environ.get("GOLC_EXAMPLES", 80)))
@given(formulas)
def test_a_solver_answers_as_trying_many_situations_does(formula: str) -> None:
    theory = theory_of(f"{HEAD}define asked := {formula}\n")
    body = theory.definitions["asked"].body
    evaluate = Dynamics(theory).compiler.term(body, 0)
    for fails in (False, True):
        found = solve(theory, Question((), (Asked(body),), fails))
        if found is None:
            assert not any(outcome(evaluate, state) is (None if fails else True) for state in STATES)
        else:
            values = {show_call(*name): value for name, value in found[0].items()}
            state = situation(theory, Witness(values, ()))
            assert outcome(evaluate, state) is (None if fails else True), values


def situation(theory: BasicActionTheory, witness: Witness) -> tuple[object, ...]:
    """Any situation like the witness: what it does not mention is of no account."""
    given: dict[str, object] = {"x": 3, "on(0)": True, "on(1)": False, "on(2)": True, "on(3)": False}
    given |= {"paint": "green", "y": 1, "far": 4, **witness.fluents}
    return tuple(given.values())


def answer(text: str, formula: str = "asked", fails: bool = False) -> Witness | Undecided | None:
    theory = theory_of(text)
    return Prover(theory).answer(Question((), (Asked(theory.definitions[formula].body),), fails))


def test_a_witness_names_only_what_matters() -> None:
    found = answer(f"{HEAD}define asked := (on(1) and x = 1 and y = 5) or (on(2) and y = 3)\n")
    assert isinstance(found, Witness)
    assert dict(found.fluents) == {"on(2)": True, "y": 3}


def test_invariants_are_assumed() -> None:
    text = f"{HEAD}invariant apart: not (on(1) and on(2))\ndefine asked := on(1) and on(2)\n"
    assert answer(text) is None


def test_an_error_is_told_with_the_values_that_lead_to_it() -> None:
    found = answer(f"{HEAD}define asked := on(y)\n", fails=True)
    assert isinstance(found, Witness)
    assert found.error is not None
    assert found.fluents == {"y": -1}
    assert found.error.diagnostic.message == "argument -1 of `on` is outside `small` (0..3)"


def test_what_takes_two_unbounded_integers_together_is_for_the_solver() -> None:
    text = f"{HEAD}fluent z: int = 0\ninvariant low: y < 4 and z < 4\n"
    text += "define asked := y + z = 6\ndefine never := y + z = 7\n"
    found = answer(text)
    assert isinstance(found, Witness)
    assert found.fluents == {"y": 3, "z": 3}
    assert answer(text, "never") is None


def test_without_a_solver_it_is_not_decided_and_says_what_would(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "golc.proofs.solver", None)
    found = answer(f"{HEAD}fluent z: int = 0\ndefine asked := y + z = 3\n")
    assert found == Undecided("two unbounded integers are added", "install `golc[smt]`, which brings a solver")


def test_many_fluents_cost_nothing_unless_they_are_read() -> None:
    text = "domain d\ntype n = 1..1000\nfluent f(x: n): n = 1\nfluent at: n = 1\ndefine asked := f(at) = 7 and at = 3\n"
    found = answer(text)
    assert isinstance(found, Witness)
    assert found.fluents == {"f(3)": 7, "at": 3}


def test_definitions_that_use_another_one_twice_are_given_up_instead_of_doubling_the_time() -> None:
    chain = [f"define d{n} := d{n - 1} or (d{n - 1} and y > {n})" for n in range(1, 13)]
    found = answer(
        "\n".join([f"{HEAD}define d0 := exists n: small. on(n) and on(n + x) and not on(n)", *chain, ""]), "d12"
    )
    assert found == Undecided("it takes too long to evaluate; the formula is too long for a solver")


def test_a_witness_among_thousands_of_fluents_takes_bounded_memory() -> None:
    tracemalloc.start()
    try:
        found = answer("domain d\ntype n = 1..1500\nfluent lit(x: n) = false\ndefine asked := exists x: n. lit(x)\n")
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert isinstance(found, Witness)
    assert any(found.fluents.values())
    assert peak < 200 * 2**20
