"""What is printed as Python is read as the tree that was printed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from golc.diagnostics import UserError
from golc.embed.modules import read_theory
from golc.embed.printing import python_text
from golc.syntax import tree as ast


@given(st.data())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_file_is_read_as_itself(trees: Any, tmp_path: Path, data: st.DataObject) -> None:
    file = data.draw(trees.files)
    try:
        text = python_text(file)
    except UserError:
        assume(False)
    path = tmp_path / "theory.py"
    path.write_text(text, encoding="utf-8")
    written = read_theory(path)

    assert [finding.message for finding in written.findings.diagnostics] == []
    assert written.file == file
