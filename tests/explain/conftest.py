"""Theories from texts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from golc.loading import load
from golc.theory.theory import BasicActionTheory


@pytest.fixture
def theory(tmp_path: Path) -> Callable[[str], BasicActionTheory]:
    """The theory of a text without its domain line, which must be without errors."""

    def build(text: str) -> BasicActionTheory:
        path = tmp_path / "trial.gl"
        path.write_text(f"domain trial\n{text}", encoding="utf-8")
        return load(path)

    return build
