"""Diagnostics for people (the layout of the command line) and for programs (JSON)."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from itertools import groupby
from typing import Any

from golc.diagnostics import Diagnostic, Fix, Label, Severity, Source, Span

TAB = 4
"""Columns between tab stops."""

WIDEST = 160
"""Columns of a source line that are shown; of a longer one only what is around the place."""


class Style(Enum):
    """What a part of the text is; the values are ANSI escapes."""

    ERROR = "\x1b[1;31m"
    WARNING = "\x1b[1;33m"
    NOTE = "\x1b[1;36m"
    BOLD = "\x1b[1m"
    GUTTER = "\x1b[1;34m"


RESET = "\x1b[0m"
STYLES = {Severity.ERROR: Style.ERROR, Severity.WARNING: Style.WARNING, Severity.NOTE: Style.NOTE}


def render(diagnostic: Diagnostic, color: bool = False) -> str:
    """A diagnostic as text: its message, the place with its line, the labels with theirs, notes and help.

    The primary place comes first, the labels follow in the order of the text; those in the primary place's line stand
    under it. Tabs, wide and combining characters keep the marks under what they mark; control characters are made
    visible.
    """
    return "\n".join(_Layout(diagnostic, color).lines())


def to_json(diagnostic: Diagnostic) -> dict[str, Any]:
    """A diagnostic as JSON has it.

    ``code``, ``title``, ``severity`` (``error``, ``warning``, ``note``), ``message``, ``span``, ``marker`` (the text
    beside the mark, perhaps empty), ``labels`` (each a ``span`` and a ``text``), ``notes`` (texts), ``help`` (a text or
    null), ``fix`` (null, or what it ``does`` and its ``edits``, each a ``span`` and its new ``text``).
    A span has ``file``, ``line``, ``column``, ``end_line``, ``end_column``: all from 1, columns in characters, the end
    exclusive.
    """
    return {
        "code": diagnostic.code.code,
        "title": diagnostic.code.title,
        "severity": diagnostic.severity.value,
        "message": diagnostic.message,
        "span": _span(diagnostic.span),
        "marker": diagnostic.marker,
        "labels": [{"span": _span(label.span), "text": label.text} for label in diagnostic.labels],
        "notes": list(diagnostic.notes),
        "help": diagnostic.help,
        "fix": None if diagnostic.fix is None else _fix(diagnostic.fix),
    }


def _fix(fix: Fix) -> dict[str, Any]:
    return {"does": fix.does, "edits": [{"span": _span(edit.span), "text": edit.text} for edit in fix.edits]}


def _span(span: Span) -> dict[str, Any]:
    line, column = span.source.position(span.start)
    end_line, end_column = span.source.position(span.end)
    return {"file": span.source.name, "line": line, "column": column, "end_line": end_line, "end_column": end_column}


@dataclass(frozen=True)
class _Mark:
    """A part ``start..end`` (columns from 0, in characters) of a line that is underlined."""

    source: Source
    line: int
    start: int
    end: int
    primary: bool
    text: str


class _Layout:
    def __init__(self, diagnostic: Diagnostic, color: bool) -> None:
        self.diagnostic = diagnostic
        self.color = color
        self.primary = _marks(diagnostic.span, True, diagnostic.marker)
        self.labels = [mark for label in _in_order(diagnostic) for mark in _marks(label.span, False, label.text)]
        numbers = [mark.line for mark in (*self.primary, *self.labels)]
        self.width = len(str(max(numbers, default=1)))

    def lines(self) -> Iterator[str]:
        diagnostic = self.diagnostic
        head = f"{diagnostic.severity.value}[{diagnostic.code.code}]"
        yield self.paint(head, STYLES[diagnostic.severity]) + self.paint(f": {visible(diagnostic.message)}", Style.BOLD)
        yield f"{' ' * self.width}{self.paint('-->', Style.GUTTER)} {visible(_place(diagnostic.span))}"
        yield from self.snippets()
        for note in diagnostic.notes:
            yield f"{self.gutter('', '=')} {self.paint('note', Style.BOLD)}: {visible(note)}"
        if diagnostic.help is not None:
            yield f"{self.gutter('', '=')} {self.paint('help', Style.BOLD)}: {visible(diagnostic.help)}"

    def snippets(self) -> Iterator[str]:
        beside = [mark for mark in self.labels if self.primary and _line_of(mark) == _line_of(self.primary[-1])]
        shown: Source = self.diagnostic.span.source
        for group in (self.primary + beside, [mark for mark in self.labels if mark not in beside]):
            last: _Mark | None = None
            for _, marks in groupby(group, key=_line_of):
                found = [*marks]
                if found[0].source is not shown:
                    shown = found[0].source
                    place = f"{shown.name}:{found[0].line}:{found[0].start + 1}"
                    yield f"{' ' * self.width}{self.paint(':::', Style.GUTTER)} {visible(place)}"
                # The lines of one place follow each other; what lies between them is left out.
                follows = last is not None and last.primary and found[0].primary
                if not follows:
                    yield self.gutter("", "|")
                elif last is not None and found[0].line > last.line + 1:
                    yield self.paint("...", Style.GUTTER)
                yield from self.snippet(found)
                last = found[-1]

    def snippet(self, marks: list[_Mark]) -> Iterator[str]:
        """A line of a source and the marks under it."""
        first = marks[0]
        text = first.source.line(first.line)
        left, right = _window(text, first)
        cells = _cells(text[left:right])
        before, after = "…" * (left > 0), "…" * (right < len(text))
        yield f"{self.gutter(str(first.line), '|')} {before}{_expanded(text[left:right])}{after}".rstrip()
        for mark in marks:
            start = cells[min(max(mark.start, left), right) - left]
            end = cells[min(max(mark.end, left), right) - left]
            sign = "^" if mark.primary else "-"
            style = STYLES[self.diagnostic.severity] if mark.primary else Style.GUTTER
            under = sign * max(1, end - start) + (f" {visible(mark.text)}" if mark.text else "")
            yield f"{self.gutter('', '|')} {' ' * (len(before) + start)}{self.paint(under, style)}"

    def gutter(self, number: str, sign: str) -> str:
        return self.paint(f"{number:>{self.width}} {sign}", Style.GUTTER)

    def paint(self, text: str, style: Style) -> str:
        return f"{style.value}{text}{RESET}" if self.color else text


def _in_order(diagnostic: Diagnostic) -> list[Label]:
    """The labels in the order of the text, those in the primary place's file first."""
    home = diagnostic.span.source
    return sorted(
        [label for label in diagnostic.labels if label.span.source.text],
        key=lambda label: (label.span.source is not home, label.span.source.name, label.span.start),
    )


def _place(span: Span) -> str:
    """``file:line:column``; the name alone for what has no text (a file that cannot be read)."""
    return str(span) if span.source.text else span.source.name


def _line_of(mark: _Mark) -> tuple[int, int]:
    return id(mark.source), mark.line


def _marks(span: Span, primary: bool, text: str) -> list[_Mark]:
    """The marks of a span: one, or for a span of several lines one in its first and one in its last line."""
    source = span.source
    if not source.text:
        return []
    (line, column), (last, end) = source.position(span.start), source.position(span.end)
    if end == 1 and last > line:
        last, end = last - 1, len(source.line(last - 1)) + 1  # it ends with a line end
    if last == line:
        return [_Mark(source, line, column - 1, max(column - 1, end - 1), primary, text)]
    first = source.line(line)
    final = source.line(last)
    indentation = len(final) - len(final.lstrip())
    return [
        _Mark(source, line, column - 1, len(first.rstrip()), primary, ""),
        _Mark(source, last, min(indentation, end - 1), end - 1, primary, text),
    ]


def _window(text: str, mark: _Mark) -> tuple[int, int]:
    """The part of a line that is shown: all of it, or what is around the mark."""
    if len(text) <= WIDEST:
        return 0, len(text)
    left = max(0, min(mark.start - WIDEST // 4, len(text) - WIDEST))
    return left, min(len(text), left + WIDEST)


def _cells(text: str) -> list[int]:
    """For each character, and for the end, the column in which it is shown."""
    columns, column = [], 0
    for character in text:
        columns.append(column)
        column += _width(character, column)
    return [*columns, column]


def _width(character: str, column: int) -> int:
    if character == "\t":
        return TAB - column % TAB
    if unicodedata.east_asian_width(character) in "WF":
        return 2
    return 0 if unicodedata.category(character) in ("Mn", "Me") else 1


def _expanded(text: str) -> str:
    """A line with its tabs as spaces and its control characters made visible."""
    pieces, column = [], 0
    for character in text:
        width = _width(character, column)
        pieces.append(" " * width if character == "\t" else _seen(character))
        column += width
    return "".join(pieces)


def visible(text: str) -> str:
    """A text with stand-ins for the characters that would do something to a terminal instead of being seen."""
    return "".join(map(_seen, text))


def _seen(character: str) -> str:
    """A character, or a stand-in for one that would do something to a terminal instead of being seen."""
    code = ord(character)
    if code < 32:
        return chr(0x2400 + code)
    return "\N{REPLACEMENT CHARACTER}" if unicodedata.category(character) in ("Cc", "Cf", "Cs") else character
