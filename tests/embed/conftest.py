"""Theories in Python, written into files and read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from textwrap import dedent

import pytest

from golc.diagnostics import Diagnostic, UserError
from golc.embed.modules import read_theory
from golc.syntax.unparse import unparse


@pytest.fixture
def text_of(tmp_path: Path) -> Callable[[str], str]:
    """The text in the language of a theory in Python, which has nothing wrong with it."""

    def read(text: str) -> str:
        path = tmp_path / "theory.py"
        path.write_text(dedent(text), encoding="utf-8")
        written = read_theory(path)
        assert written.findings.diagnostics == []
        return unparse(written.file)

    return read


@pytest.fixture
def wrong_with(tmp_path: Path) -> Callable[[str], list[Diagnostic]]:
    """What is wrong with a theory in Python."""

    def read(text: str) -> list[Diagnostic]:
        path = tmp_path / "theory.py"
        path.write_text(dedent(text), encoding="utf-8")
        try:
            return read_theory(path).findings.diagnostics
        except UserError as error:
            return list(error.diagnostics)

    return read
