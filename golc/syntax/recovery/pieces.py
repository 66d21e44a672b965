"""Parsing a piece of a source: a declaration, the domain line, an expression."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from golc.diagnostics import Diagnostic, Findings, Span
from golc.syntax import tree as ast
from golc.syntax.build import Builder, Placed, too_deep
from golc.syntax.failure import Failure
from golc.syntax.layout import split
from golc.syntax.recovery.mending import mended


@dataclass
class Piece:
    """What came of a piece of a source: its node, or None.

    ``mistakes`` are what the parser met in the order of the text, each with how it failed if it did; ``unread`` is
    what was passed over, all of it if there is no node.
    """

    part: Span
    node: Any = None
    mistakes: list[tuple[Diagnostic, Failure | None]] = field(default_factory=list)
    unread: list[Span] = field(default_factory=list)


def parse_piece(part: Span, start: str, deep: int | None, findings: Findings) -> Piece:
    """Parse a part of a source from a start symbol; ``deep`` is the place where it is nested too deeply, if it is.

    What is found by building the tree is added to ``findings``.
    """
    if deep is not None:
        too_deep(findings, Span(part.source, deep, deep))
        return Piece(part, unread=[part])
    read = mended(part, start, "" if start == "expr" else "\n")
    if read.reading.parsed is None:
        return Piece(part, None, read.mistakes, [part])
    node = builder(read.reading.placed, findings).build(read.reading.parsed)
    return Piece(part, node, read.mistakes, [part] if node is None else read.unread)


def parse_inner(span: Span, findings: Findings) -> ast.Expr | None:
    """The expression that is all of a span, with spaces around it or without; None after a mistake in it."""
    text = span.text
    start = span.start + len(text) - len(text.lstrip())
    part = Span(span.source, start, start + len(text.strip()))
    deep = next((start + chunk.too_deep for chunk in split(part.text) if chunk.too_deep is not None), None)
    piece = parse_piece(part, "expr", deep, findings)
    findings.diagnostics += [finding for finding, _ in piece.mistakes]
    node: ast.Expr | None = None if piece.mistakes else piece.node
    return node


def builder(placed: Placed, findings: Findings) -> Builder:
    """A builder for a text whose places are known."""
    return Builder(placed, findings, lambda span: parse_inner(span, findings))
