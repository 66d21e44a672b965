"""The canonical layout of a text: its words stay as they are, what stands between them is put in order.

- A block is indented by four spaces; a comment in a line of its own as what it stands before, two spaces stand before
  one that ends a line.
- Of several blank lines one is left, none at the beginning of the file or of a block; none comes in.
- A line end inside brackets stays. What is longer than ``WIDTH`` goes on in a new line where a bracket has a place for
  it; a line inside brackets is indented deeper by four than the one in which they open, by eight where a block follows.
- Parentheses stay unless they say nothing (see ``parentheses``) and the statement fits into one line without them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from golc.diagnostics import Findings, Source
from golc.syntax.breaks import Breaks
from golc.syntax.comments import Line, Row, lines
from golc.syntax.layout import CLOSING, INDENT, OPENING
from golc.syntax.parentheses import without_needless
from golc.syntax.parse import parse_file

WIDTH = 100
"""Columns of a line, without the comment at its end."""


def formatted(source: Source, findings: Findings) -> str | None:
    """A text in canonical layout; None, with findings, if it does not parse."""
    found = Findings()
    parse_file(source, found)
    for diagnostic in found.diagnostics:
        findings.add(diagnostic)
    if found.has_errors:
        return None
    return "".join(f"{line}\n" for line in _lines(lines(source.text)))


def _lines(found: list[Line]) -> Iterator[str]:
    for before, line, behind in zip([None, *found], found, [*found[1:], None], strict=False):
        if line.rows[0].blank and before is not None and line.level <= before.level:
            yield ""
        yield from _Statement(line, behind is not None and behind.level > line.level).lines()


class _Statement:
    """Lays out a statement, or a comment in a line of its own.

    ``brackets`` has for each bracket that is open the indentation of the line in which it opens, and that inside it.
    """

    def __init__(self, line: Line, heads_block: bool) -> None:
        self.base = line.level * INDENT
        self.deeper = 2 * INDENT if heads_block else INDENT
        self.brackets: list[tuple[int, int]] = []
        self.rows = _simplified(line.rows, WIDTH - self.base)
        self.breaks = Breaks([word for row in self.rows for word in row.words])

    def lines(self) -> Iterator[str]:
        """Its lines, the comments and blank lines inside its brackets among them."""
        place, opens = 0, True
        for row in self.rows:
            if row.blank and not opens:
                yield ""
            *lines, last = self.row(place, place + len(row.words))
            yield from lines
            yield last + ("  " if row.words and row.comment else "") + (row.comment or "")
            place += len(row.words)
            opens = bool(row.words) and row.words[-1].type in OPENING

    def row(self, start: int, end: int) -> Iterator[str]:
        """The lines of the words ``start..end``, at least one."""
        while True:
            indent = self.indentation(start, end)
            stop = self.breaks.stop(start, end, WIDTH - indent)
            yield " " * indent + self.breaks.text(start, stop)
            self.follow(start, stop, indent)
            if stop == end:
                return
            start = stop

    def indentation(self, start: int, end: int) -> int:
        """That of a line with these words: one that closes brackets stands below the line in which they open."""
        closed = 0
        while start + closed < end and self.breaks.words[start + closed].type in CLOSING:
            closed += 1
        if closed:
            return self.brackets[-closed][0]
        return self.brackets[-1][1] if self.brackets else self.base

    def follow(self, start: int, stop: int, indent: int) -> None:
        """Remember the brackets that a line opens and closes."""
        inside = indent + (self.deeper if indent == self.base else INDENT)
        for word in self.breaks.words[start:stop]:
            if word.type in OPENING:
                self.brackets.append((indent, inside))
            elif word.type in CLOSING:
                self.brackets.pop()


def _simplified(rows: tuple[Row, ...], width: int) -> tuple[Row, ...]:
    """The rows without parentheses that say nothing, if it is one row of at most this width then."""
    row, *others = rows
    if others or not row.words:
        return rows
    words = without_needless(row.words)
    breaks = Breaks(words)
    return (replace(row, words=tuple(words)),) if breaks.width(0, len(words)) <= width else rows
