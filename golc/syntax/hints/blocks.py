"""Hints for lines and blocks: indentation, colons, branches."""

from __future__ import annotations

import re

from lark import Token

from golc.diagnostics import Code, Diagnostic, Fix, Span
from golc.syntax.failure import Failure, Hint
from golc.syntax.hints.fixes import block_below, end_of_line, indentation, insertion, line_end, spaces_for_tabs
from golc.syntax.layout import LayoutError
from golc.syntax.spelling import closest
from golc.syntax.terminals import BRANCHING
from golc.syntax.words import BRANCHES, CLAUSES, STATEMENTS

_HEADS = """
action exog axiom scenario proc device if elif else while choose or pick star for let together and prefer over
interrupts on guard search within
"""

HEADS = frozenset(_HEADS.split())
"""The words that begin a line with a block below it."""


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


def bare_over(failure: Failure) -> Diagnostic | None:
    """``over`` without its colon."""
    word = _branch_word(failure)
    if word is None or word != "over" or "_OVER" not in failure.accepts:
        return None
    span = failure.at((word.end_pos or 0), (word.end_pos or 0))
    message, help = "the colon behind this `over` is missing", "end the line with `:`"
    return failure.finding(Code.MISSING, message, span, help, fix=insertion(span, ":"))


def lost_branch(failure: Failure) -> Diagnostic | None:
    """``else`` and the like at the beginning of a line that they do not go on with."""
    word = _branch_word(failure)
    if word is None:
        return None
    message, statement = f"this `{word}` belongs to no `{BRANCHES[word]}`", BRANCHES[word]
    help = f"`{word}` stands in the column of its `{statement}`, behind that one's block"
    return failure.finding(Code.INDENTATION, message, failure.span(word), help)


def only_branch(failure: Failure) -> Diagnostic | None:
    """``choose`` without ``or``."""
    branch = next((word for terminal, word in BRANCHING.items() if failure.accepts == {terminal}), None)
    if branch is None:
        return None
    if failure.kind == "NAME" and closest(str(failure.bad), [branch]) is not None:
        return failure.finding(Code.SYNTAX, f"`{failure.bad}` is no word here", help=f"did you mean `{branch}`?")
    message = f"this `{BRANCHES[branch]}` has one branch only"
    help = f"add `{branch}:` with a block, in the column of `{BRANCHES[branch]}`"
    return failure.finding(Code.MISSING, message, failure.gap(), help)


def end_of_axiom(failure: Failure) -> Diagnostic | None:
    """An axiom without ``otherwise unchanged``, or with a line behind it."""
    if failure.accepts == {"_DEDENT"} and failure.previous == "unchanged":
        message = "`otherwise unchanged` is the last line of an axiom"
        return failure.finding(Code.SYNTAX, message, failure.span(failure.previous), "move it to the end")
    if "OTHERWISE" in failure.accepts and failure.kind in ("_DEDENT", "$END"):
        message, help = "the last line of this `axiom` is missing", "end it with `otherwise unchanged`"
        return failure.finding(Code.MISSING, message, failure.gap(), help, fix=_otherwise(failure))
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


HINTS: tuple[Hint, ...] = (
    missing_block,
    block_on_the_line,
    missing_colon,
    unexpected_indent,
    bare_over,
    lost_branch,
    only_branch,
    end_of_axiom,
)
