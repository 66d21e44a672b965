from __future__ import annotations

from collections.abc import Callable

import pytest

from golc.diagnostics import Findings, Source
from golc.syntax.parse import parse_file
from golc.theory.elaborate import elaborate
from golc.theory.theory import BasicActionTheory


@pytest.fixture(scope="session")
def theory_of() -> Callable[[str], BasicActionTheory]:
    """The theory of a text, which must be without errors."""

    def make(text: str) -> BasicActionTheory:
        source, findings = Source("test.gl", text), Findings()
        file = parse_file(source, findings)
        assert file is not None, findings.diagnostics
        theory = elaborate(file, source, findings)
        assert theory is not None, findings.diagnostics
        return theory

    return make
