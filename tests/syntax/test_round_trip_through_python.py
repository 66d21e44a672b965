"""What is printed as Python is read as the tree that was printed, whatever the tree; and so is its text in golc."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import fields
from itertools import count
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from golc.diagnostics import UserError
from golc.embed.modules import read_theory
from golc.embed.printing import python_text
from golc.syntax import tree as ast
from golc.syntax.unparse import unparse
from golc.syntax.walk import descendants

FUNCTIONS = ("abs", "len", "first", "rest", "poss", "before")

NUMBERS = count()
"""Each file has a name of its own."""

NAMES = ("a", "b", "of", "run", "class", "c", "theory")
"""A few, so that what is used is declared, twice perhaps, and hidden by variables; Python needs some for itself."""


@given(st.data())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_file_is_read_as_itself(
    trees: Any, parsed: Callable[[str], ast.File], tmp_path: Path, data: st.DataObject
) -> None:
    file = data.draw(trees.files)
    number = data.draw(st.integers(1, len(NAMES) + 1))
    file = file if number > len(NAMES) else _renamed(file, NAMES[:number])
    path = tmp_path / f"theory{next(NUMBERS)}.py"
    path.write_text(_printed(file), encoding="utf-8")
    with warnings.catch_warnings(action="ignore"):  # Python thinks little of `1[0]`
        written = read_theory(path)

    assert [finding.message for finding in written.findings.diagnostics] == []
    assert written.file == file
    # Of a real Python keeps the value, not the zeros at its end.
    assert python_text(parsed(unparse(written.file))) == python_text(written.file)


def _renamed(part: Any, names: tuple[str, ...]) -> Any:
    """A tree with these names alone."""
    match part:
        case tuple():
            return tuple(_renamed(each, names) for each in part)
        case ast.Ident(text=text):
            return ast.Ident(names[sum(map(ord, text)) % len(names)])
        case ast.Node():
            values = {field.name: _renamed(getattr(part, field.name), names) for field in fields(part)}
            return type(part)(**values)
    return part


def _printed(file: ast.File) -> str:
    """The Python of a tree that can be written so: functions with one argument, parameters with different names."""
    applied = (node for node in descendants(file) if isinstance(node, ast.Apply) and node.name.text in FUNCTIONS)
    assume(all(len(node.args) < 2 for node in applied))
    try:
        return python_text(file)
    except UserError as error:
        assume("duplicate argument" not in str(error))
        raise
