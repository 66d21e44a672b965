"""The theory of a text, as most rooms need it."""

from __future__ import annotations

from textwrap import dedent

from golc.diagnostics import Findings, Source
from golc.syntax.parse import parse_file
from golc.theory.elaborate import elaborate
from golc.theory.theory import BasicActionTheory


def theory_of(text: str) -> BasicActionTheory:
    """What a text declares, without the checks; it must have no errors."""
    source, findings = Source("trial.gl", dedent(text)), Findings()
    file = parse_file(source, findings)
    assert file is not None, findings.diagnostics
    theory = elaborate(file, source, findings)
    assert theory is not None, (text, findings.diagnostics)
    return theory
