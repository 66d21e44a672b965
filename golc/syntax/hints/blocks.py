"""Hints for lines and blocks: indentation, colons, branches, brackets."""

from __future__ import annotations

import re

from lark import Token

from golc.diagnostics import Code, Diagnostic, Fix, Label, Span
from golc.syntax.failure import LAYOUT, Failure, Hint
from golc.syntax.hints.fixes import block_below, end_of_line, indentation, insertion, line_end, removal, spaces_for_tabs
from golc.syntax.layout import CLOSING, LayoutError
from golc.syntax.spelling import closest
from golc.syntax.words import BRANCHES, CLAUSES, STATEMENTS

_HEADS = """
action exog axiom scenario proc device if elif else while choose or pick star for let together and prefer over
interrupts on guard search within
"""

HEADS = frozenset(_HEADS.split())
"""The words that begin a line with a block below it."""

CLOSING_OF = {"LPAR": "RPAR", "LSQB": "RSQB", "LBRACE": "RBRACE"}


def wrong_layout(part: Span, error: LayoutError) -> Diagnostic:
    """A tab, or a line that returns to no block."""
    span = Span(part.source, part.start + error.start, part.start + error.end)
    if error.kind == "tab":
        return Diagnostic(
            Code.INDENTATION,
            "this line is indented with a tab",
            span,
            help="indent with spaces, four for each block; most editors can do it for you",
            fix=spaces_for_tabs(part),
        )
    columns = [str(level) for level in error.levels]
    around = f"{', '.join(columns[:-1])} and {columns[-1]}" if columns[1:] else columns[0]
    return Diagnostic(
        Code.INDENTATION,
        f"this line is indented by {span.end - span.start}, which no block above it is",
        span,
        help=f"the blocks above it are indented by {around}",
    )


def missing_block(failure: Failure) -> Diagnostic | None:
    """Nothing is indented below a colon."""
    if failure.accepts != {"_INDENT"} or failure.previous is None or failure.bad is None:
        return None
    word = str(failure.line_before[0]) if failure.line_before else ""
    empty = {
        **dict.fromkeys(("device", "action", "exog"), "; without any, leave the colon out"),
        **dict.fromkeys(("axiom", "scenario", "interrupts"), ""),
    }
    return failure.finding(
        Code.MISSING,
        f"the block of this `{word}` is missing",
        failure.gap(),
        "indent the lines that belong to it by four spaces"
        + empty.get(word.lower(), "; a block that does nothing is `skip`"),
    )


def block_on_the_line(failure: Failure) -> Diagnostic | None:
    """Something stands behind the colon of a block."""
    if failure.accepts != {"_NL"} or failure.previous is None or failure.previous.type != "COLON":
        return None
    return failure.finding(
        Code.SYNTAX,
        "a block begins on a line of its own",
        help="put it on the next line, indented by four spaces",
        fix=None if re.search(":(?!=)", failure.rest) else block_below(failure.here()),
    )


def missing_colon(failure: Failure) -> Diagnostic | None:
    """A line that has a block below it, or a statement behind it, without a colon."""
    line = failure.line or failure.line_before
    if not line or line[0] not in HEADS:
        return None
    may_end = line[0] in ("action", "exog", "device") and line[-1].type != "COLON"
    follows = failure.kind == "_NL" or str(failure.bad) in STATEMENTS | CLAUSES.keys()
    could_come = "COLON" in failure.accepts and not failure.brackets and not _of_variable(failure)
    if not ((failure.kind == "_INDENT" and may_end) or (follows and could_come)):
        return None
    return failure.finding(
        Code.MISSING,
        f"the colon at the end of this `{line[0]}` is missing",
        failure.gap(),
        "end the line with `:`",
        fix=insertion(failure.gap(), ":"),
    )


def _of_variable(failure: Failure) -> bool:
    """Whether the colon that could come belongs to a variable: ``pick x``."""
    return "IN" in failure.accepts and "AND" not in failure.accepts


def unexpected_indent(failure: Failure) -> Diagnostic | None:
    """A line that is indented although no block begins."""
    if failure.kind != "_INDENT":
        return None
    start = failure.text.rfind("\n", 0, failure.place) + 1
    first = failure.previous is None
    return failure.finding(
        Code.INDENTATION,
        "the first line is indented" if first else "this line is indented, but no block begins above it",
        failure.at(start, failure.place),
        "let it begin in the first column"
        if first
        else "indent it as the line above; only after a colon a block begins",
    )


def lost_branch(failure: Failure) -> Diagnostic | None:
    """``else`` and the like at the beginning of a line that they do not go on with; ``choose`` without ``or``."""
    word = _branch_word(failure)
    if word is not None and word == "over" and "_OVER" in failure.accepts:
        span = failure.at((word.end_pos or 0), (word.end_pos or 0))
        message, help = "the colon behind this `over` is missing", "end the line with `:`"
        return failure.finding(Code.MISSING, message, span, help, fix=insertion(span, ":"))
    if word is not None:
        return failure.finding(
            Code.INDENTATION,
            f"this `{word}` belongs to no `{BRANCHES[word]}`",
            failure.span(word),
            help=f"`{word}` stands in the column of its `{BRANCHES[word]}`, behind that one's block",
        )
    for accepted, branch in (("OR", "or"), ("AND", "and"), ("_OVER", "over")):
        if failure.accepts == {accepted}:
            if failure.kind == "NAME" and closest(str(failure.bad), [branch]) is not None:
                return failure.finding(
                    Code.SYNTAX, f"`{failure.bad}` is no word here", help=f"did you mean `{branch}`?"
                )
            return failure.finding(
                Code.MISSING,
                f"this `{BRANCHES[branch]}` has one branch only",
                failure.gap(),
                f"add `{branch}:` with a block, in the column of `{BRANCHES[branch]}`",
            )
    if failure.accepts == {"_DEDENT"} and failure.previous == "unchanged":
        message = "`otherwise unchanged` is the last line of an axiom"
        return failure.finding(Code.SYNTAX, message, failure.span(failure.previous), "move it to the end")
    if "OTHERWISE" in failure.accepts and failure.kind in ("_DEDENT", "$END"):
        return failure.finding(
            Code.MISSING,
            "the last line of this `axiom` is missing",
            failure.gap(),
            "end it with `otherwise unchanged`",
            fix=_otherwise(failure),
        )
    return None


def _otherwise(failure: Failure) -> Fix:
    """The last line of an axiom, below the one before it."""
    last, end = failure.span(failure.line_before[0]), end_of_line(failure.gap())
    return insertion(end, f"{line_end(last)}{indentation(last)}otherwise unchanged")


def _branch_word(failure: Failure) -> Token | None:
    """The word at the beginning of the line that should go on with a statement, read as a name or not fitting."""
    if failure.bad is not None and failure.begins_line() and failure.bad in BRANCHES:
        return failure.bad
    if len(failure.line) == 1 and failure.line[0] in BRANCHES and failure.line[0].type == "NAME":
        return failure.line[0]
    return None


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


BRACKETS: tuple[Hint, ...] = (empty_brackets, wrong_bracket, unclosed_bracket)
LINES: tuple[Hint, ...] = (
    missing_block,
    block_on_the_line,
    missing_colon,
    unexpected_indent,
    lost_branch,
)
