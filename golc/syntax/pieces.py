"""Parsing a piece of a source: a declaration, the domain line, an expression."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from lark import UnexpectedInput

from golc.diagnostics import Findings, Source, Span
from golc.syntax import tree as ast
from golc.syntax.build import Builder, too_deep
from golc.syntax.failure import Failure
from golc.syntax.friendly import diagnose
from golc.syntax.layout import LayoutError, split
from golc.syntax.parser import parser


@dataclass(frozen=True)
class Piece:
    """What came of a piece of a source: its node, or None; ``failure`` tells where the parser failed, if it did."""

    part: Span
    node: Any
    failure: Failure | None = None


def parse_piece(part: Span, start: str, deep: int | None, findings: Findings) -> Piece:
    """Parse a part of a source from a start symbol; ``deep`` is the place where it is nested too deeply, if it is."""
    if deep is not None:
        too_deep(findings, part.source, deep)
        return Piece(part, None)
    text = part.text if start == "expr" else part.text + "\n"
    try:
        parsed = parser().parse(text, start=start)
    except (UnexpectedInput, LayoutError) as error:
        finding, failure = diagnose(part, start, text, error)
        findings.add(finding)
        return Piece(part, None, failure)
    return Piece(part, builder(part.source, part.start, findings).build(parsed))


def parse_inner(span: Span, findings: Findings) -> ast.Expr | None:
    """The expression that is all of a span, with spaces around it or without."""
    text = span.text
    start = span.start + len(text) - len(text.lstrip())
    part = Span(span.source, start, start + len(text.strip()))
    deep = next((start + chunk.too_deep for chunk in split(part.text) if chunk.too_deep is not None), None)
    node: ast.Expr | None = parse_piece(part, "expr", deep, findings).node
    return node


def builder(source: Source, base: int, findings: Findings) -> Builder:
    """A builder for a text that begins at ``base``."""
    return Builder(source, base, findings, lambda span: parse_inner(span, findings))
