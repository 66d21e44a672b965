"""The terminals of the grammar in the words of a message."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

from golc.syntax.parser import parser

TITLES = {
    "NAME": "a name",
    "INT": "a number",
    "REAL": "a number with a fraction",
    "STRING": "a text in double quotes",
    "CMP": "a comparison",
    "_NL": "the end of the line",
    "_INDENT": "an indented block",
    "_DEDENT": "the end of the block",
    "$END": "the end",
    "_OVER": "`over`",
    "_ACTIONS": "`actions`",
    "_WAITING": "`waiting`",
}

BRANCHING = {"OR": "or", "AND": "and", "_OVER": "over"}
"""The words that begin a further branch of a statement."""


def word_of(terminal: str) -> str | None:
    """The word that a terminal stands for; None if it is a sign or has many forms."""
    title = TITLES.get(terminal)
    if title is not None:
        return title.strip("`") if title.startswith("`") else None
    value = parser().get_terminal(terminal).pattern.value
    return value if value.isalpha() else None


@cache
def words() -> dict[str, str]:
    """The terminal of each word of the language."""
    return {word: terminal.name for terminal in parser().terminals if (word := word_of(terminal.name)) is not None}


def title(terminal: str) -> str:
    """How a message names a terminal."""
    return TITLES.get(terminal) or f"`{parser().get_terminal(terminal).pattern.value}`"


def titles(terminals: Iterable[str], most: int = 6) -> str | None:
    """A list of what could come, None if it is too long to help."""
    known = sorted(title(terminal) for terminal in terminals)
    if not known or len(known) > most:
        return None
    return known[0] if len(known) == 1 else f"{', '.join(known[:-1])} or {known[-1]}"
