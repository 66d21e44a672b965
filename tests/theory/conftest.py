"""Theories from texts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import pytest

from golc.diagnostics import Findings, Source
from golc.syntax.parse import parse_file
from golc.theory.elaborate import elaborate
from golc.theory.theory import BasicActionTheory

Elaborated: TypeAlias = tuple[BasicActionTheory | None, Findings]
Elaborate: TypeAlias = Callable[..., Elaborated]
Theory: TypeAlias = Callable[..., BasicActionTheory]
Found: TypeAlias = Callable[..., list[str]]


def _elaborated(text: str, constants: Mapping[str, str] | None = None) -> Elaborated:
    source = Source("test.gl", "domain trial\n" + text)
    findings = Findings()
    file = parse_file(source, findings)
    assert file is not None
    return elaborate(file, source, findings, constants), findings


@pytest.fixture
def theory() -> Theory:
    """The theory of a text without its domain line, which must be without errors."""

    def build(text: str, constants: Mapping[str, str] | None = None) -> BasicActionTheory:
        built, findings = _elaborated(text, constants)
        assert built is not None, findings.diagnostics
        return built

    return build


@pytest.fixture
def found() -> Found:
    """What is found in a text without its domain line: ``LINE:COLUMN CODE MESSAGE``, the line counted in the text."""

    def find(text: str, constants: Mapping[str, str] | None = None) -> list[str]:
        _, findings = _elaborated(text, constants)
        return [
            f"{d.span.line - (d.span.source.name == 'test.gl')}:{d.span.column} {d.code.code} {d.message}"
            for d in sorted(findings.diagnostics, key=lambda d: d.span.start)
        ]

    return find
