"""Hints for brackets: not closed, not opened, closed by another one."""

from __future__ import annotations

from lark import Token

from golc.diagnostics import Code, Diagnostic, Label
from golc.syntax.failure import LAYOUT, Failure, Hint
from golc.syntax.hints.fixes import removal
from golc.syntax.layout import CLOSING
from golc.syntax.words import CLAUSES, STATEMENTS

CLOSING_OF = {"LPAR": "RPAR", "LSQB": "RSQB", "LBRACE": "RBRACE"}


def wrong_bracket(failure: Failure) -> Diagnostic | None:
    """A bracket that closes nothing, or another one."""
    if failure.kind not in CLOSING:
        return None
    sign = CLOSING[failure.kind]
    if not failure.brackets:
        return failure.finding(Code.MISSING, f"this `{sign}` closes nothing", help="remove it, or open it before")
    opening = failure.brackets[-1]
    if CLOSING_OF[opening.type] == failure.kind:
        return None
    return failure.finding(
        Code.MISSING,
        f"this `{sign}` does not close `{opening}`",
        help=f"write `{CLOSING[CLOSING_OF[opening.type]]}` first",
        labels=(Label(failure.span(opening), "opened here"),),
    )


def unclosed_bracket(failure: Failure) -> Diagnostic | None:
    """A bracket that is still open where another line begins, or where the text ends."""
    if not failure.brackets:
        return None
    opening = failure.brackets[-1]
    last = _last_before_next_line(failure, opening)
    if last is None:
        return None
    return not_closed(failure, opening, last.end_pos or 0)


def not_closed(failure: Failure, opening: Token, place: int) -> Diagnostic:
    """The finding that a bracket should have been closed at a place."""
    sign = CLOSING[CLOSING_OF[opening.type]]
    return failure.finding(
        Code.MISSING,
        f"the `{sign}` that closes `{opening}` is missing",
        failure.at(place, place),
        f"write `{sign}`",
        labels=(Label(failure.span(opening), "opened here"),),
    )


def _last_before_next_line(failure: Failure, opening: Token) -> Token | None:
    """The last token before a line inside the bracket that begins like one of its own, or before the end."""
    inside = [token for token in failure.tokens if (token.start_pos or 0) >= (opening.start_pos or 0)]
    following = [*inside[1:], failure.bad] if failure.bad is not None else inside[1:]
    for before, token in zip(inside, following, strict=False):
        if token.type in LAYOUT or token.type == "$END":
            return before
        if token.line != before.end_line and str(token) in STATEMENTS | CLAUSES.keys():
            return before
    closes = CLOSING_OF[opening.type] in failure.accepts
    if failure.kind == "ASSIGN" and not (failure.line[0] in ("causes", "after", "define") and _first_assign(failure)):
        return None
    if closes and (failure.kind in ("COLON", "ASSIGN", "WHEN", "WHERE", *CLOSING) or failure.begins_line()):
        return failure.previous
    return None


def _first_assign(failure: Failure) -> bool:
    return all(token.type != "ASSIGN" for token in failure.line)


def empty_brackets(failure: Failure) -> Diagnostic | None:
    """``p()``."""
    if failure.kind != "RPAR" or failure.previous is None or failure.previous.type != "LPAR":
        return None
    span = failure.span(failure.previous).to(failure.here())
    message, help = "empty parentheses are left out", "write the name alone"
    return failure.finding(Code.SYNTAX, message, span, help, fix=removal(span))


HINTS: tuple[Hint, ...] = (empty_brackets, wrong_bracket, unclosed_bracket)
