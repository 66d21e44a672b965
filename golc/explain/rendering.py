"""Pages as text for a terminal, and as LaTeX."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from golc.explain.document import Document, Row, layout
from golc.explain.page import Page
from golc.explain.signs import TEX_TEXT

WIDTH = 92
"""Columns of a formula in a terminal: with its indentation it has a hundred."""

TEX_WIDTH = 76
"""The same on paper, where signs are narrower than they count."""

INDENT = "    "


def as_text(pages: Sequence[Page]) -> str:
    """Pages for a terminal, without a line end at the end."""
    return "\n\n".join("\n".join(_text(page)) for page in pages)


def _text(page: Page) -> Iterator[str]:
    yield page.title if page.span is None else f"{page.title}  ({page.span.source.name}:{page.span.line})"
    for section in page.sections:
        yield ""
        yield f"{INDENT}{section.heading}"
        for formula in section.formulas:
            for row in layout(formula, WIDTH):
                yield INDENT * 2 + " " * row.indent + "".join(text.plain for text in row.texts).rstrip()


def as_latex(pages: Sequence[Page]) -> str:
    """Pages as a part of a LaTeX document that uses amsmath, without a line end at the end."""
    return "\n".join(line for page in pages for line in _latex(page))


def _latex(page: Page) -> Iterator[str]:
    yield rf"\paragraph{{{page.title.translate(TEX_TEXT)}}}"
    for section in page.sections:
        yield rf"\subparagraph{{{section.heading.translate(TEX_TEXT)}}}"
        yield r"\begin{align*}"
        yield " \\\\\n".join(_tex_row(row) for row in _rows(section.formulas))
        yield r"\end{align*}"


def _rows(formulas: Sequence[Document]) -> Iterator[Row]:
    for formula in formulas:
        yield from layout(formula, TEX_WIDTH)


def _tex_row(row: Row) -> str:
    quads = r"\quad" * (row.indent // 4)
    return f"& {quads}{' ' if quads else ''}{''.join(text.tex for text in row.texts).rstrip()}"
