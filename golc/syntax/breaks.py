"""Where a statement that is too long for its line goes on in another one: inside its widest brackets."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

from lark import Token

from golc.syntax.layout import CLOSING, OPENING
from golc.syntax.parentheses import matching
from golc.syntax.spacing import OPERANDS, spaces

NARROWEST = 20
"""Columns of the narrowest bracket that is broken: a long line is easier to read than a torn ``f(a, b)``."""

BEHIND = {"COMMA": 0, "DOT": 4}
"""Behind these words a new line may begin; the lower the number, the rather."""

BEFORE = {
    "FOR": 1,
    "WHERE": 1,
    "IF": 1,
    "ELSE": 1,
    "IMPLIES": 2,
    "IFF": 2,
    "OR": 3,
    "AND": 4,
    "EQ": 5,
    "CMP": 5,
    "PLUS": 6,
    "MINUS": 6,
    "TIMES": 7,
    "IDIV": 7,
    "MOD": 7,
}
"""Before these words a new line may begin; the loosest operators rather than the tightest."""


class Breaks:
    """The words of a statement, measured as if they stood in one line, and the places where it may be broken."""

    def __init__(self, words: Sequence[Token]) -> None:
        self.words = words
        self.gaps = spaces(words)
        self.ends = [0, *accumulate(len(gap) + len(word) for gap, word in zip(self.gaps, words, strict=True))]
        self.around = self._around()

    def _around(self) -> list[tuple[int, int]]:
        """For each word the number of brackets around it, and the width of the innermost of them, negative."""
        pairs = matching(self.words)
        opened: list[int] = []
        found = []
        for place, word in enumerate(self.words):
            if word.type in CLOSING:
                opened.pop()
            width = self.width(opened[-1], pairs[opened[-1]] + 1) if opened else 0
            found.append((len(opened), -width))
            if word.type in OPENING:
                opened.append(place)
        return found

    def width(self, start: int, stop: int) -> int:
        """The columns that the words take."""
        return self.ends[stop] - self.ends[start] - len(self.gaps[start]) if start < stop else 0

    def text(self, start: int, stop: int) -> str:
        """The words in one line."""
        parts = (part for place in range(start, stop) for part in (self.gaps[place], self.words[place]))
        return "".join(parts).lstrip(" ")

    def stop(self, start: int, end: int, width: int) -> int:
        """Where a line of a width that begins with a word ends: at ``end`` if all fits, otherwise at the best place,
        which is the first one if it comes too late already, and ``end`` if there is none."""
        if self.width(start, end) <= width:
            return end
        best: tuple[tuple[int, int, int, int], int] | None = None
        for place in range(start + 1, end):
            rank = self._rank(place)
            late = self.width(start, place) > width
            if late and (best is not None or rank is not None):
                return place if best is None else best[1]
            if rank is not None:
                key = (*self.around[place], rank, -place)
                best = min(best, (key, place)) if best is not None else (key, place)
        return end if best is None else best[1]

    def _rank(self, place: int) -> int | None:
        """How good it is to begin a line with a word; None if that cannot be."""
        before, word = self.words[place - 1].type, self.words[place].type
        depth, width = self.around[place]
        if depth == 0 or -width < NARROWEST:
            return None
        if word == "MINUS" and before not in OPERANDS:
            return None
        return BEHIND.get(before, BEFORE.get(word))
