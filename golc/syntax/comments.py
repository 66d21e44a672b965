"""The words of a text with what no tree keeps: comments, blank lines, and where lines end inside brackets."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from lark import Token

from golc.syntax.parser import parser


@dataclass(frozen=True)
class Row:
    """One line of the text: its words, and the comment that ends it; ``blank``: a blank line stands before it."""

    words: tuple[Token, ...]
    comment: str | None = None
    blank: bool = False


@dataclass(frozen=True)
class Line:
    """A statement, which has further rows where it goes on inside brackets; or a comment that has a line of its own.

    ``level`` is the number of blocks around it; of such a comment it is that of the block that it belongs to.
    """

    level: int
    rows: tuple[Row, ...]


@dataclass(frozen=True)
class _Statement:
    """The words up to a line end; ``columns`` are those of the blocks around it, outermost first."""

    columns: tuple[int, ...]
    words: tuple[Token, ...]

    @property
    def level(self) -> int:
        return len(self.columns) - 1


@dataclass(frozen=True)
class _Gap:
    """What stands between two words: a comment in the line of the first, comments in lines of their own with their
    columns, and whether a blank line stands before the second, which begins a line if ``breaks``."""

    comment: str | None
    own: tuple[tuple[int, Row], ...]
    blank: bool
    breaks: bool


def lines(text: str) -> list[Line]:
    """The lines of a text that parses, in its order."""
    text = f"\n{text}\n"
    statements = list(_statements(text))
    ends = [0, *(statement.words[-1].end_pos or 0 for statement in statements)]
    begins = [*(statement.words[0].start_pos or 0 for statement in statements), len(text)]
    gaps = [_gap(text, start, end) for start, end in zip(ends, begins, strict=True)]
    found: list[Line] = []
    outer: tuple[int, ...] = (0,)
    for statement, before, behind in zip(statements, gaps, gaps[1:], strict=False):
        found += _between(before, outer, statement.level)
        found.append(Line(statement.level, tuple(_rows(text, statement.words, before.blank, behind.comment))))
        outer = statement.columns
    return [*found, *_between(gaps[-1], outer, 0)]


def _statements(text: str) -> Iterator[_Statement]:
    columns, words = [0], list[Token]()
    deeper = False
    for token in parser().parse_interactive(text, start="start").iter_parse():
        match token.type:
            case "_INDENT":
                deeper = True
            case "_DEDENT":
                columns.pop()
            case "_NL":
                if words:
                    yield _Statement(tuple(columns), tuple(words))
                words = []
            case _:
                if deeper:
                    columns.append((token.column or 1) - 1)
                deeper = False
                words.append(token)


def _between(gap: _Gap, outer: tuple[int, ...], level: int) -> Iterator[Line]:
    """The comments before a statement of a level; one before the end of a block belongs to the innermost block, of
    those whose columns are ``outer``, that its own column reaches."""
    for column, row in gap.own:
        yield Line(max(level, sum(column >= each for each in outer) - 1), (row,))


def _rows(text: str, words: tuple[Token, ...], blank: bool, comment: str | None) -> Iterator[Row]:
    """The rows of a statement; ``comment`` ends the last one, and a blank line may stand before the first."""
    row = [words[0]]
    for before, word in pairwise(words):
        gap = _gap(text, before.end_pos or 0, word.start_pos or 0)
        if gap.breaks:
            yield Row(tuple(row), gap.comment, blank)
            yield from (own for _, own in gap.own)
            row, blank = [], gap.blank
        row.append(word)
    yield Row(tuple(row), comment, blank)


_COMMENT = re.compile("#.*")


def _gap(text: str, start: int, end: int) -> _Gap:
    first, *others = text[start:end].split("\n")
    own, blank = [], False
    for line in others[:-1]:
        comment = _comment(line)
        if comment is not None:
            own.append((line.index("#"), Row((), comment, blank)))
        blank = comment is None
    return _Gap(_comment(first), tuple(own), blank, bool(others))


def _comment(line: str) -> str | None:
    found = _COMMENT.search(line)
    return None if found is None else found.group().rstrip()
