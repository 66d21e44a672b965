"""What a hint may put right by itself: one sign for another, what is too much, what is missing."""

from __future__ import annotations

import re
from collections.abc import Iterator

from golc.diagnostics import Edit, Fix, Span
from golc.syntax.layout import INDENT, split

_INDENTED = re.compile(r"^[ \t]+(?=[^\s#])", re.MULTILINE)
_TABS = re.compile(r"^\t+(?=\S)", re.MULTILINE)


def instead(span: Span, text: str) -> Fix:
    """Write something else; between a word and what stands beside it comes a space."""
    source = span.source.text
    before, behind = source[: span.start][-1:], source[span.end : span.end + 1]
    word = text[:1].isalpha()
    spaced = (" " if word and not (before.isspace() or before in "([{") else "") + text
    spaced += " " if word and not (behind.isspace() or behind in ":,.)]}") else ""
    return Fix(f"write `{text}` for `{span.text}`", (Edit(span, spaced),))


def sign_at(span: Span, sign: str) -> Fix:
    """Write a sign or a word for another one, or for nothing, with the spaces that it has: none before a colon."""
    start = span.start
    if sign in (":", ".", ","):
        start -= len(_blanks_before(span))
    else:
        sign = sign if _blanks_before(span) else f" {sign}"
        sign = sign if span.source.text[span.end : span.end + 1].isspace() else f"{sign} "
    what = f"write `{sign.strip()}` for `{span.text}`" if span.text else f"write `{sign.strip()}`"
    return Fix(what, (Edit(Span(span.source, start, span.end), sign),))


def insertion(span: Span, text: str) -> Fix:
    """Write what is missing at the beginning of a span."""
    return Fix(f"write `{text.strip()}`", (Edit(Span(span.source, span.start, span.start), text),))


def removal(span: Span) -> Fix:
    """Remove a span, and the blanks before it if the line ends behind it."""
    return Fix(f"remove `{span.text}`", (without(span) if ends_line(span) else Edit(span, ""),))


def without(span: Span) -> Edit:
    """The edit that removes a span with the blanks before it."""
    return Edit(Span(span.source, span.start - len(_blanks_before(span)), span.end), "")


def ends_line(span: Span) -> bool:
    """Whether nothing but a comment stands behind a span in its line."""
    return re.compile(r"[ \t]*(\r?$|#)", re.MULTILINE).match(span.source.text, span.end) is not None


def line_end(span: Span) -> str:
    """How the line of a span ends: as the first line of its source."""
    first = span.source.line_starts[1:2]
    return "\r\n" if first and span.source.text[: first[0]].endswith("\r\n") else "\n"


def indentation(span: Span) -> str:
    """The blanks at the beginning of the line of a span."""
    line = span.source.line(span.line)
    return line[: len(line) - len(line.lstrip(" \t"))]


def end_of_line(span: Span) -> Span:
    """The end of the line of a span, behind its comment."""
    source = span.source
    end = source.line_starts[span.line - 1] + len(source.line(span.line))
    return Span(source, end, end)


def block_below(span: Span) -> Fix:
    """Put what stands behind a colon below its line."""
    start = span.start - len(_blanks_before(span))
    text = line_end(span) + indentation(span) + " " * INDENT
    return Fix("begin a new line for the block", (Edit(Span(span.source, start, span.start), text),))


def spaces_for_tabs(part: Span) -> Fix | None:
    """Indent with four spaces for each tab, in all declarations of the source that are indented with nothing but tabs;
    None if this part is not, for then nobody knows how wide a tab is."""
    if not _only_tabs(part):
        return None
    return Fix("write four spaces for each tab", tuple(_tabs(part)))


def _tabs(part: Span) -> Iterator[Edit]:
    for chunk in split(part.source.text):
        declaration = Span(part.source, chunk.start, chunk.end)
        if _only_tabs(declaration):
            for tabs in _TABS.finditer(declaration.text):
                start, end = (chunk.start + place for place in tabs.span())
                yield Edit(Span(part.source, start, end), " " * (INDENT * (end - start)))


def _only_tabs(part: Span) -> bool:
    return all(found.group().strip("\t") == "" for found in _INDENTED.finditer(part.text))


def _blanks_before(span: Span) -> str:
    before = span.source.text[: span.start]
    return before[len(before.rstrip(" \t")) :]
