"""From text to tree: a whole file, or an expression."""

from __future__ import annotations

import re
from dataclasses import replace

from lark import UnexpectedInput

from golc.diagnostics import Code, Findings, Source, Span
from golc.syntax import tree as ast
from golc.syntax.layout import LayoutError, split
from golc.syntax.parser import parser
from golc.syntax.recovery.declarations import recover
from golc.syntax.recovery.pieces import builder, parse_inner


def parse_file(source: Source, findings: Findings) -> ast.File | None:
    """The tree of a file, with every syntax error in it among the findings, in the order of the text.

    What could not be read is left out of the tree; reading goes on at the next declaration in column 0. None if there
    is nothing at all.
    """
    found = Findings()
    file = _whole(source, found)
    if file is None:
        found = Findings()
        file = recover(source, found)
        if not found.has_errors:
            found.error(Code.SYNTAX, "the file does not follow the grammar", Span(source, 0, 0))
    if file is not None:
        # A name that cannot be one is as good as unread: what it was to name is missing elsewhere.
        reserved = [finding.span for finding in found.diagnostics if finding.code is Code.RESERVED]
        file = replace(file, unread=(*file.unread, *reserved))
    for diagnostic in sorted(found.diagnostics, key=lambda diagnostic: diagnostic.span.start):
        findings.add(diagnostic)
    return file


def parse_expression(source: Source, findings: Findings) -> ast.Expr | None:
    """The tree of a text that is one expression, or None and findings."""
    if not re.sub("#.*", "", source.text).strip():
        findings.error(Code.SYNTAX, "there is no expression", Span(source, 0, len(source.text)))
        return None
    return parse_inner(Span(source, 0, len(source.text)), findings)


def _whole(source: Source, findings: Findings) -> ast.File | None:
    """The tree of a file that follows the grammar; None for any other, which is looked at piece by piece."""
    if any(chunk.too_deep is not None for chunk in split(source.text)):
        return None
    try:
        parsed = parser().parse(source.text + "\n", start="start")
    except (UnexpectedInput, LayoutError):
        return None
    file: ast.File | None = builder(lambda start, end: Span(source, start, end), findings).build(parsed)
    return file
