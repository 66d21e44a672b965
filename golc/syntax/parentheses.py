"""Parentheses that say nothing: a pair right inside another, or around all that stands behind a word."""

from __future__ import annotations

from collections.abc import Sequence

from lark import Token

from golc.syntax.layout import CLOSING, OPENING
from golc.syntax.words import RESERVED

_BEFORE = """
TEST IF ELIF WHILE GUARD ON POSS SENSES COST INITIALLY GIVEN UNTIL EXPECT WHEN WHERE ASSIGN
"""

BEFORE = frozenset(_BEFORE.split())
"""Behind these an expression begins."""

BEHIND = frozenset({"WHEN", "DOT"})
"""Before these, as at the end of a line or before the colon there, one ends."""

PROTECTED = RESERVED | {"actions", "waiting"}
"""Names that parentheses keep apart from a word of the language: `when (waiting)`, `expect (actions[0] = 1)`."""


def without_needless(words: Sequence[Token]) -> list[Token]:
    """The words of a statement without the parentheses that could go and leave the tree as it is."""
    pairs = matching(words)
    needless: set[int] = set()
    for start, end in pairs.items():
        if words[start].type == "LPAR" and _says_nothing(words, start, end, pairs):
            needless |= {start, end}
    return [word for place, word in enumerate(words) if place not in needless]


def matching(words: Sequence[Token]) -> dict[int, int]:
    """Where the bracket is closed that is opened at each place."""
    opened: list[int] = []
    pairs: dict[int, int] = {}
    for place, word in enumerate(words):
        if word.type in OPENING:
            opened.append(place)
        elif word.type in CLOSING:
            pairs[opened.pop()] = place
    return pairs


def _says_nothing(words: Sequence[Token], start: int, end: int, pairs: dict[int, int]) -> bool:
    if start == 0:
        return False
    if words[start - 1].type == "LPAR" and pairs[start - 1] == end + 1:
        return True
    if words[start - 1].type not in BEFORE or not _ends(words, end + 1):
        return False
    first = next(word for word in words[start:] if word.type != "LPAR")
    return first.type != "NAME" or str(first) not in PROTECTED


def _ends(words: Sequence[Token], place: int) -> bool:
    rest = [word.type for word in words[place : place + 2]]
    return rest in ([], ["COLON"]) or rest[0] in BEHIND
