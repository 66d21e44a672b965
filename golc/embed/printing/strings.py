"""Strings and messages as Python."""

from __future__ import annotations

from collections.abc import Callable

from golc.syntax import tree as ast

ESCAPES = {"\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


def quoted(text: str) -> str:
    """A string literal."""
    quote = _quote(text)
    return quote + _escaped(text, quote) + quote


def message_text(message: ast.Message, text_of: Callable[[ast.Expr], str]) -> str:
    """A message as a string literal, with holes an f-string; ``text_of`` writes what stands in them.

    Raises ``ValueError`` for a message inside a message, which golc cannot write either.
    """
    if all(isinstance(part, str) for part in message.parts):
        return quoted("".join(part for part in message.parts if isinstance(part, str)))
    quote = _quote("".join(part for part in message.parts if isinstance(part, str)))
    return f"f{quote}{''.join(_part(part, quote, text_of) for part in message.parts)}{quote}"


def _part(part: str | ast.Expr, quote: str, text_of: Callable[[ast.Expr], str]) -> str:
    if isinstance(part, str):
        return _escaped(part, quote).replace("{", "{{").replace("}", "}}")
    text = text_of(part)
    if '"' in text or "'" in text:
        raise ValueError("a message inside a message cannot be written")
    before, behind = " " * text.startswith("{"), " " * text.endswith("}")
    return f"{{{before}{text}{behind}}}"


def _quote(text: str) -> str:
    """The quotes that need fewer escapes, double ones if in doubt."""
    return "'" if text.count('"') > text.count("'") else '"'


def _escaped(text: str, quote: str) -> str:
    return "".join(_character(character, quote) for character in text)


def _character(character: str, quote: str) -> str:
    if character in ESCAPES:
        return ESCAPES[character]
    if character == quote:
        return f"\\{quote}"
    return character if character.isprintable() else character.encode("unicode_escape").decode()
