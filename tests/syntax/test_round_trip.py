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


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_written_file_parses_to_itself(path: Path, parsed: Parsed) -> None:
    file = parsed(read_source(path).text)
    printed = unparse(file)

    assert parsed(printed) == file
    assert unparse(parsed(printed)) == printed
