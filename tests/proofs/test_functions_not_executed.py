"""Answers where a function of Python is not executed, against trying every function of its declared types."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator, Mapping
from os import environ
from pathlib import Path
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from golc.diagnostics import Findings, Source
from golc.proofs.prover import Prover
from golc.proofs.questions import Asked, Question, Undecided, Witness
from golc.syntax.parse import parse_file
from golc.theory.elaborate import elaborate

HEAD = """\
domain trial
type small = 0..2
type colour = {red, green}
fluent x: small = 0
fluent y: small = 0
fluent on = false
extern f(a: small): small from "helpers.py"
extern near(a: small, on: bool) from "helpers.py"
extern maybe(a: bool): small? from "helpers.py"
extern paint(a: small): colour from "helpers.py"
extern group(on: bool): set[small] from "helpers.py"
extern whole(n: int): small from "helpers.py"
static twice(a: small): small = f(f(a))
static least(a: small): small = f(a) if f(a) < a else a
"""
SUBSETS = [frozenset(chosen) for size in range(4) for chosen in itertools.combinations(range(3), size)]
BOTH = (False, True)
FUNCTIONS: dict[str, list[Mapping[Any, Any]]] = {
    "f": [dict(enumerate(values)) for values in itertools.product(range(3), repeat=3)],
    "near": [
        dict(zip(itertools.product(range(3), BOTH), values, strict=True))
        for values in itertools.product(BOTH, repeat=6)
    ],
    "maybe": [dict(zip(BOTH, values, strict=True)) for values in itertools.product((None, 0, 1, 2), repeat=2)],
    "paint": [dict(enumerate(values)) for values in itertools.product(("red", "green"), repeat=3)],
    "group": [dict(zip(BOTH, values, strict=True)) for values in itertools.product(SUBSETS, repeat=2)],
    "whole": [dict(enumerate(values)) for values in itertools.product(range(3), repeat=4)],
}
MOST = 3_000
"""How many choices of functions one formula is tried with."""

ATOMS = {
    "f(x) = f(x)": "f[x] == f[x]",
    "f(x) = f(y)": "f[x] == f[y]",
    "x = y": "x == y",
    "on": "on",
    "f(x) < 3": "f[x] < 3",
    "f(x) > x": "f[x] > x",
    "f(x) + f(y) <= 2": "f[x] + f[y] <= 2",
    "twice(x) = f(1)": "f[f[x]] == f[1]",
    "least(x) <= x": "min(f[x], x) <= x",
    "least(y) = x": "min(f[y], y) == x",
    "forall a: small. f(a) != x": "all(f[a] != x for a in range(3))",
    "exists a: small, b: small where a != b. f(a) = f(b)": "len({*f.values()}) < 3",
    "near(x, on)": "near[x, on]",
    "near(x, not on)": "near[x, not on]",
    "near(y, true)": "near[y, True]",
    "maybe(on) = none": "maybe[on] is None",
    "maybe(on) != none and maybe(on) < 3": "maybe[on] is not None and maybe[on] < 3",
    "maybe(true) = maybe(false)": "maybe[True] == maybe[False]",
    "maybe(on) < x": "less(maybe[on], x)",
    "paint(x) = red": "paint[x] == 'red'",
    "paint(x) = paint(y)": "paint[x] == paint[y]",
    "paint(x) in {red, green}": "True",
    "x in group(on)": "x in group[on]",
    "group(on) = group(true)": "group[on] == group[True]",
    "len(group(true)) > 1": "len(group[True]) > 1",
    "forall a in group(on). a < 3": "all(a < 3 for a in group[on])",
    "whole(x) = whole(y)": "whole[x] == whole[y]",
    "whole(x + 1) > 2": "whole[x + 1] > 2",
    "whole(x + 1) = x": "whole[x + 1] == x",
    "2 // f(x) = 1": "2 // f[x] == 1",
}
"""Formulas of golc, and what they mean in Python."""

formulas = st.recursive(
    st.sampled_from([*ATOMS.items()]),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["and", "or"]), inner).map(
            lambda parts: (f"({parts[0][0]}) {parts[1]} ({parts[2][0]})", f"({parts[0][1]}) {parts[1]} ({parts[2][1]})")
        ),
        inner.map(lambda part: (f"not ({part[0]})", f"not ({part[1]})")),
    ),
    max_leaves=3,
)


def less(left: int | None, right: int) -> bool:
    """As in golc, `none` is less than nothing: an error."""
    if left is None:
        raise ZeroDivisionError
    return left < right


def called(python: str) -> list[str]:
    """The functions in a formula."""
    return [name for name in FUNCTIONS if re.search(rf"\b{name}\b", python)]


def outcomes(python: str) -> Iterator[dict[tuple[int, int, bool], bool | None]]:
    """For each choice of the functions what a formula is in each situation; none if it has no value."""
    code = compile(python, "formula", "eval")
    names = called(python)
    for chosen in itertools.product(*[FUNCTIONS[name] for name in names]):
        functions = dict(zip(names, chosen, strict=True))
        found: dict[tuple[int, int, bool], bool | None] = {}
        for x, y, on in itertools.product(range(3), range(3), BOTH):
            try:
                found[x, y, on] = bool(eval(code, {**functions, "less": less, "x": x, "y": y, "on": on}))
            except ZeroDivisionError:
                found[x, y, on] = None
        yield found


def answers(tmp_path: Path, formula: str, fails: bool) -> Witness | Undecided | None:
    """What the prover says, which must not execute anything."""
    findings, source = Findings(), Source(str(tmp_path / "trial.gl"), f"{HEAD}define asked := {formula}\n")
    (tmp_path / "helpers.py").write_text(
        "".join(f"def {name}(a{', b' if name == 'near' else ''}): raise AssertionError\n" for name in FUNCTIONS)
    )
    file = parse_file(source, findings)
    assert file is not None
    theory = elaborate(file, source, findings)
    assert theory is not None, findings.diagnostics
    return Prover(theory).answer(Question((), (Asked(theory.definitions["asked"].body),), fails))


def compare(tmp_path: Path, formula: str, python: str, fails: bool) -> None:
    wanted = None if fails else True
    every = [*outcomes(python)]
    found = answers(tmp_path, formula, fails)
    anywhere = any(value is wanted for values in every for value in values.values())
    uniform = [place for place in every[0] if all(values[place] is wanted for values in every)]
    match found:
        case None:
            assert not anywhere
        case Witness():
            fits = [place for place in uniform if fluents_of(place).items() >= found.fluents.items()]
            assert fits, f"{found} is no witness for every function"
            # What is not mentioned is of no account.
            assert len(fits) == 3 * 3 * 2 // product_of_sizes(found.fluents)
        case Undecided(function=function):
            assert anywhere
            assert function in FUNCTIONS
            assert fails or not uniform or "whole" in formula  # which has arguments without end


def fluents_of(place: tuple[int, int, bool]) -> dict[str, object]:
    return dict(zip(("x", "y", "on"), place, strict=True))


def product_of_sizes(names: Mapping[str, object]) -> int:
    sizes = {"x": 3, "y": 3, "on": 2}
    product = 1
    for name in names:
        product *= sizes[name]
    return product


@pytest.mark.parametrize(("formula", "python"), ATOMS.items(), ids=ATOMS)
def test_each_formula_by_itself(tmp_path: Path, formula: str, python: str) -> None:
    for fails in BOTH:
        compare(tmp_path, formula, python, fails)
        compare(tmp_path, f"not ({formula})", f"not ({python})", fails)


@settings(max_examples=int(environ.get("GOLC_EXAMPLES", 60)), deadline=None)
@given(formulas)
def test_a_question_is_answered_as_by_trying_every_function(
    tmp_path_factory: pytest.TempPathFactory, formula: tuple[str, str]
) -> None:
    assume(math.prod(len(FUNCTIONS[name]) for name in called(formula[1])) <= MOST)
    for fails in BOTH:
        compare(tmp_path_factory.mktemp("trial"), *formula, fails)
