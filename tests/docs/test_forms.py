"""The page with both forms side by side: up to date, complete, and each side says what the other does."""

from __future__ import annotations

import importlib.util
import sys
import typing
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from golc.diagnostics import Findings, Source
from golc.embed.modules import read_theory
from golc.syntax import tree
from golc.syntax.parse import parse_file
from golc.syntax.walk import descendants

DOCS = Path(__file__).parents[2] / "docs"


def _forms() -> ModuleType:
    spec = importlib.util.spec_from_file_location("forms", DOCS / "forms.py")
    assert spec is not None and spec.loader is not None
    module = sys.modules["forms"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


FORMS = _forms()
ROWS = [
    pytest.param(section, row, id=row.golc.replace("\n", " ")[:50])
    for section in FORMS.SECTIONS
    for row in section.rows
]


def _parsed(text: str) -> tree.File:
    findings = Findings()
    file = parse_file(Source("forms.gl", text), findings)
    assert file is not None and findings.diagnostics == []
    return file


@pytest.mark.parametrize(("section", "row"), ROWS)
def test_both_sides_give_one_tree(section: Any, row: Any, tmp_path: Path) -> None:
    file = _parsed(FORMS.golc_file(section, row))
    for number, python in enumerate((FORMS.python_of(section, row), *row.also)):
        path = tmp_path / f"theory{number}.py"
        path.write_text(FORMS.python_file(section, python), encoding="utf-8")
        written = read_theory(path)

        assert [finding.message for finding in written.findings.diagnostics] == []
        assert written.file == file


def test_every_construct_has_a_row() -> None:
    files = [_parsed(FORMS.golc_file(section, row)) for section in FORMS.SECTIONS for row in section.rows]
    shown = [node for file in files for node in descendants(file)]
    kinds = {kind for kind in vars(tree).values() if isinstance(kind, type) and issubclass(kind, tree.Node)}

    assert kinds - {type(node) for node in shown} == {tree.Node}
    assert {node.op for node in shown if isinstance(node, tree.Binary)} == {*typing.get_args(tree.BinaryOp)}
    assert {node.op for node in shown if isinstance(node, tree.Unary)} == {*typing.get_args(tree.UnaryOp)}
    assert {node.kind for node in shown if isinstance(node, tree.Quantifier)} == {*typing.get_args(tree.QuantifierKind)}


def test_the_page_is_up_to_date() -> None:
    assert FORMS.PAGE.read_text(encoding="utf-8") == FORMS.page(), "run `python docs/forms.py`"
