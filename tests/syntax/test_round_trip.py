"""What is printed parses to the tree that was printed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Findings, Source
from golc.syntax import tree as ast
from golc.syntax.parse import parse_expression
from golc.syntax.text import read_source
from golc.syntax.unparse import unparse, unparse_expression, unparse_statement

ROOT = Path(__file__).parents[2]
FILES = [ROOT / "tests/programs/everything.gl", *sorted((ROOT / "examples").glob("*/*.gl"))]

Parsed = Callable[[str], ast.File]


@given(st.data())
def test_a_file_parses_to_itself(trees: Any, parsed: Parsed, data: st.DataObject) -> None:
    file = data.draw(trees.files)

    assert parsed(unparse(file)) == file


@given(st.data())
def test_an_expression_parses_to_itself(trees: Any, data: st.DataObject) -> None:
    expression = data.draw(trees.expressions)
    findings = Findings()

    assert parse_expression(Source("test", unparse_expression(expression)), findings) == expression
    assert findings.diagnostics == []


@given(st.data())
def test_a_statement_parses_to_itself(trees: Any, parsed: Parsed, data: st.DataObject) -> None:
    statement = data.draw(trees.statements)
    lines = unparse_statement(statement).split("\n")
    (proc,) = parsed("domain d\nproc p:\n" + "".join(f"    {line}\n" for line in lines)).declarations

    assert isinstance(proc, ast.Proc)
    assert proc.body.statements == (statement,)


def test_a_message_inside_a_message_has_no_text() -> None:
    with pytest.raises(ValueError, match="a message inside a message"):
        unparse_expression(ast.Message((ast.Message(("a",)),)))


@pytest.mark.parametrize(
    "text",
    [
        "a or b and not c = d + e * -f",
        "((a or b) and c) = d",
        "not (a and b)",
        "a - (b - c)",
        "a - b - c",
        "(a implies b) implies c",
        "a implies b implies c",
        "(a iff b) iff c",
        "(exists x: t. p(x)) and q",
        "q and exists x: t. p(x) and q",
        "(q or exists x: t. p(x)) and q",
        "(not exists x: t. p(x)) = q",
        "(a if b else count x: t. p(x)) + 1",
        "(count x: t. p(x)) + 1 + count x: t. p(x)",
        "a if exists x: t. p(x) else b if c else d",
        "(a if b else c) if d else e",
        "(-a)[0] + l[0][1] + [a][0] + f(b)[1]",
        "x in 1..6 and y not in -3..(n + 1)",
        "a in {b} + {}",
    ],
)
def test_no_parentheses_too_many(text: str) -> None:
    expression = parse_expression(Source("t", text), Findings())

    assert expression is not None
    assert unparse_expression(expression) == text


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_written_file_parses_to_itself(path: Path, parsed: Parsed) -> None:
    file = parsed(read_source(path).text)
    printed = unparse(file)

    assert parsed(printed) == file
    assert unparse(parsed(printed)) == printed
