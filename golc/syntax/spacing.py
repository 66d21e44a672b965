"""Which words of a line stand together and which apart, as the printer of trees writes them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from lark import Token

from golc.syntax.layout import CLOSING, OPENING

OPERANDS = frozenset({"NAME", "INT", "REAL", "STRING", "TRUE", "FALSE", "NONE", *CLOSING})
"""What an operand may end with: behind it ``-`` and ``[`` go on with it, behind anything else they begin another."""

CALLABLE = frozenset({"NAME", "MIN", "MAX", "KNOWN", "KNOWS", "POSSIBLE"})
LEFT_BOUND = frozenset({"COMMA", "COLON", "DOT", "QMARK", *CLOSING})


def spaces(words: Sequence[Token]) -> list[str]:
    """What stands before each word of a statement where it does not begin a line: a space or nothing."""
    kinds = [word.type for word in words]
    if not kinds:
        return []
    if kinds[:2] == ["SET", "NAME"]:
        kinds[1] = "SETTING"  # `set poll (1) s` is no call
    if kinds[1:2] == ["RANGE"]:
        kinds[1] = "NUMBERING"  # `8 .. look` is no interval
    return ["", *_spaces(kinds)]


def _spaces(kinds: list[str]) -> Iterator[str]:
    prefix = kinds[0] == "MINUS"
    for before, kind in pairwise(kinds):
        together = (
            prefix
            or kind in LEFT_BOUND
            or before in OPENING
            or "RANGE" in (before, kind)
            or (kind == "LPAR" and before in CALLABLE)
            or (kind == "LSQB" and before in (*OPERANDS, "SET", "LIST"))
        )
        prefix = kind == "MINUS" and before not in OPERANDS
        yield "" if together else " "
