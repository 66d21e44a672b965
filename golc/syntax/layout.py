"""Lines and indentation: what makes blocks, what is nested, and where a declaration begins."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from lark import Token
from lark.lark import PostLex

from golc.syntax.words import DECLARATIONS

INDENT = 4
"""Spaces for each level of blocks, as golc writes them; it reads any number."""

DEEPEST = 500
"""Levels of nesting that a text and its tree may have."""

LONGEST_NUMBER = 4000
"""Digits that a number may have; Python refuses to read or print much longer integers."""

OPENING = {"LPAR": "(", "LSQB": "[", "LBRACE": "{"}
CLOSING = {"RPAR": ")", "RSQB": "]", "RBRACE": "}"}


class LayoutError(Exception):
    """The indentation at ``start..end`` makes no block, below blocks in the columns ``levels``: ``tab``, ``dedent``."""

    def __init__(self, kind: str, start: int, end: int, levels: tuple[int, ...] = ()) -> None:
        super().__init__(kind)
        self.kind = kind
        self.start = start
        self.end = end
        self.levels = levels


class Layout(PostLex):
    """Turns line ends into ``_NL``, ``_INDENT`` and ``_DEDENT``, outside of brackets; keeps no state between texts.

    ``_NL`` and ``_DEDENT`` stand, without width, at the end of the token before them: so what a rule spans ends with
    its last word, and what is missing is missing there. With names accepted everywhere a word is never read as a
    shorter one and a rest (``andy`` as ``and`` and ``y``); ``:=`` is never read as two signs.
    """

    always_accept = ("_NL", "NAME", "ASSIGN")

    def process(self, stream: Iterator[Token]) -> Iterator[Token]:
        """The tokens of a text with its layout; raises ``LayoutError``."""
        levels, depth, previous = [0], 0, None
        for token in stream:
            if token.type == "_NL":
                if depth == 0:
                    yield from _line_end(token, previous, levels)
                continue
            if previous is None and levels == [0] and token.column is not None and token.column > 1:
                yield _placed("_INDENT", token, token)
            depth = max(0, depth + (token.type in OPENING) - (token.type in CLOSING))
            previous = token
            yield token
        if previous is not None:
            yield from (_after("_DEDENT", previous) for _ in levels[1:])


def _line_end(token: Token, previous: Token | None, levels: list[int]) -> Iterator[Token]:
    """The tokens that a line end stands for; ``levels`` are the columns of the open blocks."""
    indentation = token.rsplit("\n", 1)[1]
    end = token.end_pos or 0
    start = end - len(indentation)
    yield _after("_NL", token if previous is None else previous)
    if "\t" in indentation:
        raise LayoutError("tab", start + indentation.index("\t"), end, tuple(levels))
    width = len(indentation)
    if width > levels[-1]:
        levels.append(width)
        yield Token("_INDENT", "", end, token.end_line, token.end_column, token.end_line, token.end_column, end)
    seen = tuple(levels)
    while width < levels[-1]:
        levels.pop()
        yield _after("_DEDENT", previous or token)
    if width != levels[-1]:
        raise LayoutError("dedent", start, end, seen)


def _after(kind: str, token: Token) -> Token:
    line, column, end = token.end_line, token.end_column, token.end_pos
    return Token(kind, "", end, line, column, line, column, end)


def _placed(kind: str, text: str, token: Token) -> Token:
    return Token.new_borrow_pos(kind, text, token)


@dataclass(frozen=True)
class Chunk:
    """The text ``start..end`` of one declaration; ``too_deep`` is the place where it is nested too deeply."""

    start: int
    end: int
    too_deep: int | None = None


_MARK = re.compile(r'^[ \t]*(?=[^\s#])|"(?:\\[^\n]|[^"\\\n])*"?|#[^\n]*|[()\[\]{}]', re.MULTILINE)
_DECLARATION = re.compile(rf'(?:{"|".join(DECLARATIONS)})[ \t]+[A-Za-z"({{]')


def split(text: str) -> list[Chunk]:
    """The declarations of a text: each begins at column 0, what stands before the first one is a chunk of its own.

    Inside brackets only a line that looks like a declaration begins one, so that a forgotten bracket costs no more than
    its own declaration. A loop over marks: neither brackets nor blocks can be deep enough to trouble it.
    """
    chunks: list[Chunk] = []
    start, too_deep, brackets, levels = 0, None, 0, [0]
    for mark in _MARK.finditer(text):
        found = mark.group()
        if found in ("(", "[", "{"):
            brackets += 1
        elif found in (")", "]", "}"):
            brackets = max(0, brackets - 1)
        elif found.strip(" \t") == "":
            if found == "" and _begins(text, mark.end(), brackets):
                if mark.end() > start:
                    chunks.append(Chunk(start, mark.end(), too_deep))
                start, too_deep, brackets, levels = mark.end(), None, 0, [0]
            elif brackets == 0:
                _indent(levels, len(found))
        if too_deep is None and brackets + len(levels) - 1 > DEEPEST:
            too_deep = mark.end() - 1 if brackets else mark.end()
    return [*chunks, Chunk(start, len(text), too_deep)]


def unclosed(text: str) -> list[str]:
    """The brackets that are open at the end of a text."""
    brackets: list[str] = []
    for mark in _MARK.finditer(text):
        if mark.group() in ("(", "[", "{"):
            brackets.append(mark.group())
        elif mark.group() in (")", "]", "}") and brackets:
            brackets.pop()
    return brackets


def _begins(text: str, place: int, brackets: int) -> bool:
    if brackets:
        return _DECLARATION.match(text, place) is not None
    return text[place] not in ")]}"


def _indent(levels: list[int], width: int) -> None:
    while width < levels[-1]:
        levels.pop()
    if width > levels[-1]:
        levels.append(width)
