"""A function of Python means what a static with the same values means."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Code, ProgramError
from golc.loading import load
from golc.situation.dynamics import Dynamics
from golc.theory.theory import BasicActionTheory

HEAD = """domain trial
type small = 0..3
type colour = {red, green, blue}
{functions}
fluent x: small = 0
fluent paint: colour? = none
fluent on(n: small) = false
"""
STATICS = """static next(n: small): small = {{{next}}}
static odd(n: small, c: colour) = {{{odd}}}
static dye(c: colour?): colour? = {{{dye}}}
"""
EXTERNS = """extern next(n: small): small from "h.py"
extern odd(n: small, c: colour) from "h.py"
extern dye(c: colour?): colour? from "h.py"
"""
COLOURS = ["red", "green", "blue"]
TERMS = [
    "next(x)", "next(next(x) * 1)", "odd(next(x), red)", "dye(paint)", "dye(dye(paint))", "next(x + 1)",
    "exists n: small. odd(n, green) and on(n)", "forall n: small, c: colour. odd(n, c) implies next(n) = x",
    "sum n: small where on(n). next(n)", "{next(n) for n: small where on(n)}", "[dye(c) for c: colour]",
    "dye(paint) = paint or odd(x, paint)", "max n: small where odd(n, blue). next(n)", "next(3) if on(next(0)) else 7",
]  # fmt: skip
"""Some of them have no value in some states."""


@st.composite
def tables(draw: st.DrawFn) -> dict[str, dict[Any, Any]]:
    small = range(4)
    keys = [*itertools.product(small, COLOURS)]
    return {
        "next": {(n,): draw(st.sampled_from(small)) for n in small},
        "odd": {key: draw(st.booleans()) for key in keys},
        "dye": {(colour,): draw(st.sampled_from([None, *COLOURS])) for colour in (None, *COLOURS)},
    }


def golc(value: Any) -> str:
    return {"None": "none", "True": "true", "False": "false"}.get(str(value), str(value))


def entry(key: tuple[Any, ...], value: Any) -> str:
    texts = ", ".join(map(golc, key))
    return f"{texts if len(key) == 1 else f'({texts})'}: {golc(value)}"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("functions")


def theories(folder: Path, values: dict[str, dict[Any, Any]]) -> Iterator[BasicActionTheory]:
    """The theory with tables, and the one with functions."""
    texts = {name: ", ".join(entry(*pair) for pair in table.items()) for name, table in values.items()}
    (folder / "h.py").write_text(
        "".join(f"def {name}(*args): return {table!r}[args]\n" for name, table in values.items())
    )
    uses = "\n".join(f"define d{number} := {term}" for number, term in enumerate(TERMS))
    for functions in (STATICS.format(**texts), EXTERNS):
        path = folder / "trial.gl"
        path.write_text(HEAD.replace("{functions}", functions) + uses)
        yield load(path)


def answers(theory: BasicActionTheory, state: tuple[Any, ...]) -> Iterator[tuple[Any, Any]]:
    """What each term is in a state, interpreted and compiled: a value, or the code and the place of an error."""
    dynamics = Dynamics(theory)
    for definition in theory.definitions.values():
        compiled = dynamics.compiler.term(definition.body, 0)
        interpreted = partial(dynamics.interpreter.evaluate, definition.body)
        yield answer(interpreted, state), answer(compiled, state)


def answer(evaluate: Callable[..., Any], state: tuple[Any, ...]) -> Any:
    try:
        return evaluate(state, ())
    except ProgramError as error:
        return error.diagnostic.code, error.diagnostic.span.text


STATES = st.tuples(st.integers(0, 3), st.sampled_from([None, *COLOURS]), *[st.booleans()] * 4)


@given(tables(), STATES)
def test_a_function_of_python_is_like_a_table(folder: Path, values: dict[str, dict[Any, Any]], state: Any) -> None:
    as_tables, as_functions = [list(answers(theory, state)) for theory in theories(folder, values)]

    assert as_functions == as_tables
    assert [one for one, _ in as_functions] == [other for _, other in as_functions]


def test_what_fails_fails_in_both_ways(tmp_path: Path) -> None:
    (tmp_path / "h.py").write_text("def f(n): return [0, 1, 9][n]\n")
    path = tmp_path / "trial.gl"
    path.write_text('domain trial\ntype t = 0..3\nextern f(n: t): t from "h.py"\nfluent x: t = 0\ndefine d0 := f(x)\n')
    theory = load(path)

    found = [next(answers(theory, (n,))) for n in range(4)]

    error = (Code.EXTERN, "f(x)")
    assert found == [(0, 0), (1, 1), (error, error), (error, error)]
