"""Pages about codes as text for a terminal."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

from golc.codes.pages import EXAMPLE, FENCE, Page

INDENT = "    "
NARROWEST, WIDEST = 40, 100
"""Columns of prose; a narrower terminal breaks lines by itself, and longer lines are hard to read."""


def as_text(page: Page, width: int) -> str:
    """A page with paragraphs of a width and its examples indented, without a line end at the end."""
    columns = min(max(width, NARROWEST), WIDEST)
    return "\n\n".join((f"{page.code.code}: {page.code.title}", *_parts(page.text, columns)))


def _parts(text: str, columns: int) -> Iterator[str]:
    end = 0
    for fence in FENCE.finditer(text):
        yield from _paragraphs(text[end : fence.start()], columns)
        if fence["name"] not in ("", EXAMPLE):
            yield f"{fence['name']}:"
        yield textwrap.indent(fence["text"].rstrip("\n"), INDENT)
        end = fence.end()
    yield from _paragraphs(text[end:], columns)


def _paragraphs(prose: str, columns: int) -> Iterator[str]:
    for paragraph in prose.split("\n\n"):
        if paragraph.strip():
            yield textwrap.fill(
                paragraph.strip().removeprefix("## "), columns, break_long_words=False, break_on_hyphens=False
            )
