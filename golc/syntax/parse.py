"""From text to tree: a whole file, or an expression."""

from __future__ import annotations

from lark import UnexpectedInput

from golc.diagnostics import Code, Findings, Source, Span
from golc.syntax import tree as ast
from golc.syntax.build import Builder, too_deep
from golc.syntax.friendly import diagnose
from golc.syntax.layout import Chunk, LayoutError, split
from golc.syntax.parser import parser


def parse_file(source: Source, findings: Findings) -> ast.File | None:
    """The tree of a file, with every syntax error in it among the findings.

    What could not be read is left out of the tree, and the next declaration in column 0 is read again; None if there is no
    declaration at all.
    """
    found = Findings()
    file = _whole(source, found)
    if file is None:
        found = Findings()
        file = _piece_by_piece(source, found)
    for diagnostic in sorted(found.diagnostics, key=lambda diagnostic: diagnostic.span.start):
        findings.add(diagnostic)
    return file


def parse_expression(source: Source, findings: Findings) -> ast.Expr | None:
    """The tree of a text that is one expression, or None and findings."""
    return _expression(Span(source, 0, len(source.text)), findings)


def _whole(source: Source, findings: Findings) -> ast.File | None:
    """A file without a syntax error, as the grammar says; None for any other."""
    if any(chunk.too_deep is not None for chunk in split(source.text)):
        return None
    try:
        parsed = parser().parse(source.text + "\n", start="start")
    except (UnexpectedInput, LayoutError):
        return None
    file: ast.File | None = _builder(source, 0, findings).build(parsed)
    return file


def _piece_by_piece(source: Source, findings: Findings) -> ast.File | None:
    """What can be read of a file with errors."""
    domain: ast.Ident | None = None
    declarations = []
    for chunk in split(source.text):
        node = _chunk(source, chunk, findings)
        if isinstance(node, ast.Ident):
            domain = node
        elif node is not None:
            declarations.append(node)
    if domain is None and not declarations:
        return None
    return ast.File(domain or ast.Ident(""), tuple(declarations), span=Span(source, 0, len(source.text)))


def _chunk(source: Source, chunk: Chunk, findings: Findings) -> ast.Declaration | ast.Ident | None:
    text = source.text[chunk.start : chunk.end]
    start = "header" if text.startswith("domain") else "declaration"
    node: ast.Declaration | ast.Ident | None = _parse(
        Span(source, chunk.start, chunk.end), start, chunk.too_deep, findings
    )
    return node


def _expression(span: Span, findings: Findings) -> ast.Expr | None:
    text = span.text
    start = span.start + len(text) - len(text.lstrip())
    stripped = Span(span.source, start, start + len(text.strip()))
    deep = next((chunk.too_deep for chunk in split(stripped.text) if chunk.too_deep is not None), None)
    node: ast.Expr | None = _parse(stripped, "expr", None if deep is None else start + deep, findings)
    return node


def _parse(span: Span, start: str, deep: int | None, findings: Findings) -> object:
    """The node of a part of a text, or None and a finding."""
    if deep is not None:
        too_deep(findings, Span(span.source, deep, deep + 1))
        return None
    text = span.text if start == "expr" else span.text + "\n"
    try:
        parsed = parser().parse(text, start=start)
    except (UnexpectedInput, LayoutError) as error:
        findings.add(diagnose(span, start, error))
        return None
    return _builder(span.source, span.start, findings).build(parsed)


def _builder(source: Source, base: int, findings: Findings) -> Builder:
    return Builder(source, base, findings, lambda span: _expression(span, findings))
