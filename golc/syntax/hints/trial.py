"""Hints by trial: the one word or sign whose insertion or removal lets the line be read."""

from __future__ import annotations

from typing import Any

from lark import Token, UnexpectedInput
from lark.lexer import LexerThread
from lark.parsers.lalr_parser_state import ParserState

from golc.diagnostics import Code, Diagnostic, Fix, Span
from golc.syntax.failure import LAYOUT, Failure, without_trees
from golc.syntax.hints.fixes import sign_at, without
from golc.syntax.layout import CLOSING, OPENING, LayoutError
from golc.syntax.parser import parser
from golc.syntax.terminals import TITLES, title, titles, word_of
from golc.syntax.words import RESERVED

SIGNS = ("COLON", "EQ", "ASSIGN", "COMMA", "RPAR", "RSQB", "RBRACE", "LPAR", "LBRACE", "DOT", "RANGE")
"""The signs that people forget, the likeliest first."""

NAMED = ("NAME", "INT", "STRING")
"""What else may be missing, if no sign and no word helps."""

CERTAIN = frozenset({"COLON", "EQ", "ASSIGN", "COMMA", "BY", "FROM", "WHERE"})
"""What can stand nowhere else: of a bracket nobody knows where it was to be."""


def doubled(failure: Failure) -> Diagnostic | None:
    """A word of the language right behind itself, perhaps read as a name: seldom is something missing between them."""
    bad, line = failure.bad, failure.line
    if len(line) > 1 and line[-1].type == "NAME" != line[-2].type and str(line[-1]) == str(line[-2]):
        return _written_twice(failure, line[-1])
    if bad is None or str(failure.previous) != str(bad) or word_of(bad.type) is None or "_NL" in failure.accepts:
        return None
    return _written_twice(failure, bad) if _goes_on(failure, None, failure.rest[len(bad) :]) else None


def one_token_off(failure: Failure) -> Diagnostic | None:
    """Something forgotten before the bad token, or the bad token one too many."""
    if failure.bad is None:
        return None
    behind = failure.rest[len(failure.bad) :]
    twice = _twice(failure, behind)
    if twice is not None:
        return _written_twice(failure, twice)
    forgotten = _forgotten(failure)
    if forgotten:
        what = titles(forgotten) or "a word"
        end = failure.kind in LAYOUT or failure.kind == "$END"
        where = "at the end of the line" if end else f"before `{failure.bad}`"
        place = failure.at(failure.place, failure.place) if failure.begins_line() else failure.gap()
        return failure.finding(
            Code.MISSING, f"{what} is missing {where}", place, f"write {what}", fix=_written(place, forgotten)
        )
    if failure.kind not in LAYOUT | {"$END"} and _goes_on(failure, None, behind):
        return failure.finding(Code.SYNTAX, f"`{failure.bad}` is too much here", help="remove it")
    return None


def _written_twice(failure: Failure, twice: Token) -> Diagnostic:
    fix = Fix(f"remove one `{twice}`", (without(failure.span(twice)),))
    return failure.finding(Code.SYNTAX, f"`{twice}` is written twice", failure.span(twice), "remove one", fix=fix)


def _twice(failure: Failure, behind: str) -> Token | None:
    """A word that repeats the one before it: the last read, or the bad one if the line can be read without it."""
    line, bad = [*failure.line, failure.bad], failure.bad
    words = [str(token) for token in line]
    if len(words) > 2 and words[-2] == words[-3] and words[-2].isidentifier():
        return line[-2]
    repeats = len(words) > 1 and words[-1] == words[-2] and words[-1].isidentifier()
    return bad if repeats and _goes_on(failure, None, behind) else None


def _written(place: Span, forgotten: list[str]) -> Fix | None:
    """What has been forgotten, where it is certain."""
    return (
        sign_at(place, title(forgotten[0]).strip("`")) if CERTAIN.issuperset(forgotten) and not forgotten[1:] else None
    )


def _forgotten(failure: Failure) -> list[str]:
    """The terminals of which one lets the line be read: a sign, or words."""
    # A colon would make a type of a word that begins a value, such as `false`.
    value = "EQ" in failure.accepts and str(failure.bad) in RESERVED - {"set", "list"}
    for sign in SIGNS[value:]:
        if sign in failure.accepts and goes_on(failure, sign):
            return [sign]
    words = sorted(terminal for terminal in failure.accepts if word_of(terminal) is not None)
    for terminals in (words, NAMED):
        found = [t for t in terminals if t in failure.accepts and goes_on(failure, t)]
        if found:
            return found
    return []


def goes_on(failure: Failure, terminal: str) -> bool:
    """Whether, with one more terminal, the rest of the line can be read."""
    return _goes_on(failure, terminal, "" if failure.kind in LAYOUT | {"$END"} else failure.rest)


def _goes_on(failure: Failure, inserted: str | None, rest: str) -> bool:
    """Whether, after one more terminal or none, the parser can read the rest of a line, with its end if it has one."""
    frontend: Any = parser().parser
    thread = LexerThread.from_text(frontend.lexer, rest.strip())
    state: Any = ParserState(without_trees(failure.start), thread, list(failure.stack), [])
    depth = len(failure.brackets) + _depth(inserted)
    lex: Any = thread.lex
    try:
        if inserted is not None:
            state.feed_token(Token(inserted, TITLES.get(inserted, "")))
        for token in lex(state):
            state.feed_token(token)
            depth += _depth(token.type)
        if depth > len(failure.brackets) and inserted in OPENING:
            return False
        if depth == 0:
            state.feed_token(Token("_NL", ""))
    except (UnexpectedInput, LayoutError):
        return False
    return True


def _depth(terminal: str | None) -> int:
    return (terminal in OPENING) - (terminal in CLOSING)
