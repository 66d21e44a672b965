"""Strings: their escapes, and the expressions in the braces of a message."""

from __future__ import annotations

from collections.abc import Callable

from golc.diagnostics import Code, Findings, Span
from golc.syntax.tree import Expr, Message

ESCAPES = {'"': '"', "\\": "\\", "n": "\n", "t": "\t"}
"""What may follow a backslash, and what it writes."""


def plain_text(span: Span, findings: Findings) -> str:
    """The text of a string literal in which braces mean themselves."""
    text, pieces, place = span.source.text, [], span.start + 1
    while place < span.end - 1:
        piece, place = _character(text, place, span, findings)
        pieces.append(piece)
    return "".join(pieces)


def parse_message(span: Span, findings: Findings, inner: Callable[[Span], Expr | None]) -> Message:
    """The parts of the message literal at ``span``; ``inner`` parses the expression of each pair of braces."""
    text, end, place = span.source.text, span.end - 1, span.start + 1
    parts: list[str | Expr] = []
    piece: list[str] = []
    while place < end:
        if text[place] not in "{}":
            character, place = _character(text, place, span, findings)
            piece.append(character)
        elif text[place : place + 2] in ("{{", "}}") and place + 1 < end:
            piece.append(text[place])
            place += 2
        else:
            hole = _hole(Span(span.source, place, end), findings)
            expression = inner(Span(span.source, hole.start + 1, hole.end - 1)) if hole.end - hole.start > 1 else None
            if expression is not None:
                parts += [*_text(piece), expression]
                piece = []
            place = hole.end
    return Message((*parts, *_text(piece)), span=span)


def _text(piece: list[str]) -> list[str]:
    return ["".join(piece)] if piece else []


def _character(text: str, place: int, span: Span, findings: Findings) -> tuple[str, int]:
    """The character written at a place, and the place behind it."""
    if text[place] != "\\":
        return text[place], place + 1
    escape = text[place + 1]
    if escape not in ESCAPES:
        findings.error(
            Code.STRING,
            f"`\\{escape}` writes no character",
            Span(span.source, place, place + 2),
            help='a backslash is written `\\\\`; there are also `\\"`, `\\n` and `\\t`',
        )
    return ESCAPES.get(escape, escape), place + 2


def _hole(rest: Span, findings: Findings) -> Span:
    """The ``{e}`` that begins a text; a lone or an empty brace is a finding, and its span ends with the brace."""
    text, depth = rest.source.text, 0
    for place in range(rest.start, rest.end):
        depth += (text[place] == "{") - (text[place] == "}")
        if depth <= 0:
            break
    else:
        place = rest.start
    hole = Span(rest.source, rest.start, place + 1)
    brace = text[rest.start]
    if hole.end - hole.start == 1:
        what = "has no end" if brace == "{" else "has no beginning"
        findings.error(
            Code.STRING, f"the `{brace}` in this message {what}", hole, help=f"the character itself is `{brace * 2}`"
        )
    elif not hole.text[1:-1].strip():
        findings.error(
            Code.STRING,
            "the braces in this message hold no expression",
            hole,
            help="write one, or `{{` and `}}` for the characters themselves",
        )
        return Span(hole.source, hole.end - 1, hole.end)
    return hole
