"""Parsing a piece of a source: a declaration, the domain line, an expression."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from golc.diagnostics import Diagnostic, Findings, Fix, Span
from golc.edits import moved
from golc.syntax import tree as ast
from golc.syntax.build import Builder, Placed, too_deep
from golc.syntax.draft import Draft
from golc.syntax.failure import Failure
from golc.syntax.layout import CLOSING, OPENING, split, unclosed
from golc.syntax.omissions import Omission, omissions
from golc.syntax.reading import Reading

OPENING_OF = dict(zip(CLOSING.values(), OPENING.values(), strict=True))

PATIENCE = 1_000_000
"""Characters that are read of a piece, mistake by mistake, before the rest of it is left alone."""


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

    After a mistake it is read on, with the mistake put right if it is clear what was meant, or passed over: as little
    of it as lets the parser come further. What is found by building the tree is added to ``findings``.
    """
    piece = Piece(part)
    if deep is not None:
        too_deep(findings, Span(part.source, deep, deep))
    else:
        reading = _read(piece, Reading(Draft.of(part, "" if start == "expr" else "\n"), start))
        if reading.parsed is not None:
            piece.node = builder(reading.placed, findings).build(reading.parsed)
    if piece.node is None:
        piece.unread = [part]
    return piece


def _read(piece: Piece, reading: Reading) -> Reading:
    """Read on from mistake to mistake; the last reading is whole, or it is the one after which nothing helps."""
    patience, guessed = PATIENCE, False
    while reading.parsed is None and patience > 0:
        finding, failed = reading.diagnosis
        following = None
        if finding.fix is not None:
            following = _with_fix(reading, finding, finding.fix)
            if following is None:
                finding = replace(finding, fix=None)
        if guessed:
            finding = replace(finding, fix=None)
        finding = reading.draft.finding(finding)
        if not _follows(piece, finding):
            piece.mistakes.append((finding, failed))
        if following is None:
            guessed, following = True, _with_omission(piece, reading)
        elif finding.fix and not any(edit.text for edit in finding.fix.edits):
            piece.unread.append(reading.draft.back(finding.span))
        if following is None or not following.has_content:
            break
        patience -= len(reading.draft.text)
        reading = following
    return reading


def _follows(piece: Piece, finding: Diagnostic) -> bool:
    """Whether a mistake is only a consequence of one before it: it stands right behind that, or it is a bracket whose
    opening one was passed over."""
    if not piece.mistakes:
        return False
    text, start, before = finding.span.source.text, finding.span.start, piece.mistakes[-1][0].span.end
    if finding.span.text in OPENING_OF:
        return OPENING_OF[finding.span.text] in unclosed(text[piece.part.start : start])
    return before <= start and text[before:start].strip(" ") == ""


def _with_fix(reading: Reading, finding: Diagnostic, fix: Fix) -> Reading | None:
    """The reading of a text with a fix, if that comes further: no fix is proposed that only leads to another error.

    Once lines are indented rightly, what is found next may be what is missing in the line before.
    """
    fixed = Reading(reading.draft.edited(fix.edits), reading.start)
    if fixed.parsed is not None or (reading.is_layout and not fixed.is_layout):
        return fixed
    inside = [edit for edit in fix.edits if edit.span.end <= reading.draft.whole.end]
    end = moved(finding.span.end, inside) - reading.draft.whole.start
    found = fixed.diagnosis[0].span
    return fixed if found.start > end or (found.start == end < found.end) else None


def _with_omission(piece: Piece, reading: Reading) -> Reading | None:
    """The reading of a text in which as little as possible is passed over, if that comes further."""
    for omission in omissions(reading):
        tried = Reading(reading.draft.edited(omission.edits), reading.start)
        if tried.parsed is not None or (tried.place > _behind(omission, reading) and _is_later(tried, reading)):
            piece.unread.append(reading.draft.back(omission.span))
            return tried
    return None


def _is_later(reading: Reading, before: Reading) -> bool:
    """Whether the mistake in a reading stands behind the one in another."""
    one, other = (each.draft.back(each.diagnosis[0].span) for each in (before, reading))
    return one.start < other.start


def _behind(omission: Omission, reading: Reading) -> int:
    """Where the place behind an omission comes to lie."""
    return moved(omission.span.end, omission.edits) - reading.draft.whole.start


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
