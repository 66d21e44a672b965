"""From the path of a domain file to its theory, or to everything that is wrong with it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from golc.checks import check
from golc.diagnostics import Diagnostic, Findings, Severity, Source, Span, UserError
from golc.syntax import tree
from golc.syntax.parse import parse_expression, parse_file
from golc.syntax.text import read_source
from golc.theory.elaborate import elaborate
from golc.theory.recursion import deep_recursion
from golc.theory.theory import BasicActionTheory

GOAL = "<goal>"
"""The name of the goal that a formula from outside the file becomes; no declaration can have it."""


def load(path: str | Path, constants: Mapping[str, str] | None = None, goal: str | None = None) -> BasicActionTheory:
    """The theory of a domain file; ``constants`` replace consts of the file, name to text (``-D``).

    ``goal`` is a formula that becomes one more goal, under the name ``GOAL``. Raises ``UserError`` with every error if
    there is one; warnings are not mentioned.
    """
    theory, diagnostics = examine(path, constants, goal)
    if theory is None:
        raise UserError(*[diagnostic for diagnostic in diagnostics if diagnostic.severity is Severity.ERROR])
    return theory


def examine(
    path: str | Path, constants: Mapping[str, str] | None = None, goal: str | None = None
) -> tuple[BasicActionTheory | None, list[Diagnostic]]:
    """The theory of a domain file, or None if it has errors, and all findings in the order of their places."""
    try:
        source = read_source(path)
    except UserError as error:
        return None, list(error.diagnostics)
    findings = Findings()
    file = parse_file(source, findings)
    if file is not None and goal is not None:
        file = _with_goal(file, goal, findings)
    theory = None if file is None else elaborate(file, source, findings, constants)
    if file is not None and theory is not None:
        with deep_recursion():
            for diagnostic in check(theory, file):
                findings.add(diagnostic)
    return None if findings.has_errors else theory, sorted(findings.diagnostics, key=_place)


def _with_goal(file: tree.File, text: str, findings: Findings) -> tree.File:
    source = Source(GOAL, text)
    condition = parse_expression(source, findings)
    if condition is None:
        return file
    span = Span(source, 0, len(text))
    goal = tree.Goal(tree.Ident(GOAL, span=span), condition, span=span)
    return replace(file, declarations=(*file.declarations, goal))


def _place(diagnostic: Diagnostic) -> tuple[str, int, int, str]:
    """What is wrong with the command line (``-D``) comes first: its sources sort before any path's letters."""
    span = diagnostic.span
    return (span.source.name if span.source.name.startswith("-D ") else "~", span.start, span.end, diagnostic.code.code)
