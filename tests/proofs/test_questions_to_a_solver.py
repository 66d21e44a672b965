"""What a solver answers about sets, lists and texts, against trying situations one by one."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from os import environ

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from golc.proofs.questions import Asked, Question
from golc.proofs.solver import solve
from golc.proofs.symbols import NotDecidedError
from golc.situation.dynamics import Dynamics
from golc.theory.types import show_call
from tests.proofs.outcomes import outcome
from tests.theories import theory_of

HEAD = """\
domain trial
type small = 0..2
static near(n: small): set[small] = {0: {1}, 1: {0, 2}, 2: {1}}
fluent x: small = 0
fluent seen: set[small] = {}
fluent both(n: small): set[small] = {}
fluent maybe: set[small]? = none
fluent route: list[small] = []
fluent note: string = ""
"""
SETS = [
    "x in seen", "seen = {}", "seen = {x, 1}", "len(seen) > 1", "seen + {x} = seen", "(seen - {x}) = {2}",
    "len(seen + {1}) = 2", "len({x, 1, 2}) = 3", "near(x) = seen", "seen = {n for n: small where n != x}",
    "seen = {n + 1 for n in seen where n < 2} + {0}", "exists n in seen. n > x", "forall n in seen. n in near(x)",
    "(count n in seen. n >= x) = 2", "(sum n in seen. n) = 3", "(max n in seen. n) = x", "(min n in seen - {0}. n) = 2",
    "both(x) = seen", "both(0) = both(1)", "both(x) - both(0) = {x}", "x in both(x)", "maybe = none", "maybe = seen",
    "x in maybe", "len(maybe) = 1", "(maybe if maybe != none else {x}) = {1, 2}", "(seen if x = 1 else both(2)) = {0}",
    "near(x) = near(1)", "(exists n in seen, m in both(n). m = x)", "x in {1, 2}", "seen != both(0)",
    "3 // len(seen) = 3",
]  # fmt: skip
OTHERS = [
    "route = [x, 1]", "first(route) = x", "rest(route) = [x]", "route[1] = 2", "route[x] = x", "len(route) = 3",
    "x in route", "route + [x] = [1, 2, 2]", "route - [x] = [1]", "[n for n in route where n > 0] = [2]",
    "exists n in route. n in seen", "(count n in route. n = x) = 2", "(sum n in route. n) = 3", 'note = "x"',
    'note != ""', "[n + 1 for n: small] = [1, 2, 3]", "{n for n in route} = seen",
]  # fmt: skip
SUBSETS = [frozenset(chosen) for size in range(4) for chosen in itertools.combinations(range(3), size)]
FEW = [frozenset[int](), frozenset({0}), frozenset({0, 1, 2})]
LISTS = [(), (1,), (2,), (0, 1), (1, 2), (2, 2), (0, 1, 2), (0, 2, 1)]


def formulas(atoms: list[str]) -> st.SearchStrategy[str]:
    pairs = st.tuples(st.sampled_from(atoms), st.sampled_from(["and", "or", "implies"]), st.sampled_from(atoms))
    joined = pairs.map(lambda parts: f"({parts[0]}) {parts[1]} ({parts[2]})")
    return st.one_of(st.sampled_from(atoms), joined, joined.map(lambda formula: f"not ({formula})"))


def agrees(formula: str, states: Sequence[tuple[object, ...]]) -> bool:
    """Whether the solver's answers fit what the formula is in states; it may not know that there is none."""
    theory = theory_of(f"{HEAD}define asked := {formula}\n")
    body = theory.definitions["asked"].body
    evaluate = Dynamics(theory).compiler.term(body, 0)
    for fails in (False, True):
        wanted = None if fails else True
        try:
            found = solve(theory, Question((), (Asked(body),), fails))
        except NotDecidedError:
            assert "route" in formula
            continue
        if found is None:
            if any(outcome(evaluate, state) is wanted for state in states):
                return False
        else:
            values = {"x": 0, "seen": frozenset(), **{f"both({n})": frozenset() for n in range(3)}}
            values |= {"maybe": None, "route": (), "note": ""}
            values |= {show_call(*name): value for name, value in found[0].items()}
            if outcome(evaluate, tuple(values.values())) is not wanted:
                return False
    return True


@settings(max_examples=int(environ.get("GOLC_EXAMPLES", 60)), deadline=None)
@given(formulas(SETS))
def test_a_solver_answers_about_sets_as_trying_all_situations_does(formula: str) -> None:
    boths = list(itertools.product(FEW, FEW, FEW))
    states = [
        (x, seen, *both, maybe, (), "")
        for x, seen, maybe in itertools.product(
            range(3), SUBSETS, [None, frozenset(), frozenset({1}), frozenset({1, 2})]
        )
        for both in (boths if "both" in formula else boths[:1])
    ]
    assert agrees(formula, states)


@settings(max_examples=int(environ.get("GOLC_EXAMPLES", 60)), deadline=None)
@given(formulas([*OTHERS, *SETS[:6]]))
def test_no_answer_of_a_solver_about_lists_is_contradicted_by_a_situation(formula: str) -> None:
    lists = itertools.product(range(3), SUBSETS, LISTS, ["", "x"])
    empty = (frozenset[int](), frozenset[int](), frozenset[int](), None)
    assert agrees(formula, [(x, seen, *empty, route, note) for x, seen, route, note in lists])


@pytest.mark.parametrize("formula", [*SETS, *OTHERS])
def test_each_formula_by_itself(formula: str) -> None:
    empty = (frozenset[int](), frozenset[int](), frozenset({0, 1, 2}))
    maybes = [None, frozenset[int](), frozenset({1}), frozenset({1, 2})]
    states = itertools.product(range(3), SUBSETS, maybes, LISTS, ["", "x"])
    assert agrees(formula, [(x, seen, *empty, maybe, route, note) for x, seen, maybe, route, note in states])


@pytest.mark.parametrize(
    ("left", "right", "quotient", "rest"),
    [(7, 2, 3, 1), (-7, 2, -4, 1), (7, -2, -4, -1), (-7, -2, 3, -1), (6, -2, -3, 0), (0, -5, 0, 0)],
)
def test_a_solver_divides_as_the_language_does(left: int, right: int, quotient: int, rest: int) -> None:
    """The quotient is rounded down; what remains has the sign of the divisor."""
    for wrong in (0, 1):
        theory = theory_of(
            f"domain trial\nfluent a: int = 0\nfluent b: int = 0\ndefine asked := a = {left} and b = {right}"
            f" and (a // b != {quotient + wrong} or a % b != {rest})\n"
        )
        found = solve(theory, Question((), (Asked(theory.definitions["asked"].body),)))
        assert (found is None) == (wrong == 0)
