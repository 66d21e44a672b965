"""From the path of a domain file to its theory, or to everything that is wrong with it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from golc.checks import check
from golc.diagnostics import Diagnostic, Findings, Severity, UserError
from golc.syntax.parse import parse_file
from golc.syntax.text import read_source
from golc.theory.elaborate import elaborate
from golc.theory.recursion import deep_recursion
from golc.theory.theory import BasicActionTheory


def load(path: str | Path, constants: Mapping[str, str] | None = None) -> BasicActionTheory:
    """The theory of a domain file; ``constants`` replace consts of the file, name to text (``-D``).

    Raises ``UserError`` with every error if there is one; warnings are not mentioned.
    """
    theory, diagnostics = examine(path, constants)
    if theory is None:
        raise UserError(*[diagnostic for diagnostic in diagnostics if diagnostic.severity is Severity.ERROR])
    return theory


def examine(
    path: str | Path, constants: Mapping[str, str] | None = None
) -> tuple[BasicActionTheory | None, list[Diagnostic]]:
    """The theory of a domain file, or None if it has errors, and all findings in the order of their places."""
    try:
        source = read_source(path)
    except UserError as error:
        return None, list(error.diagnostics)
    findings = Findings()
    file = parse_file(source, findings)
    theory = None if file is None else elaborate(file, source, findings, constants)
    if file is not None and theory is not None:
        with deep_recursion():
            for diagnostic in check(theory, file):
                findings.add(diagnostic)
    return None if findings.has_errors else theory, sorted(findings.diagnostics, key=_place)


def _place(diagnostic: Diagnostic) -> tuple[str, int, int, str]:
    """What is wrong with the command line (``-D``) comes first: its sources sort before any path's letters."""
    span = diagnostic.span
    return (span.source.name if span.source.name.startswith("-D ") else "~", span.start, span.end, diagnostic.code.code)
