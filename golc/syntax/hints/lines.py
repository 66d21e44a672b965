"""Hints for lines that begin with a word they cannot begin with here, or without the one that they need."""

from __future__ import annotations

import re

from golc.diagnostics import Code, Diagnostic
from golc.syntax.failure import LAYOUT, Failure, Hint
from golc.syntax.hints.fixes import insertion
from golc.syntax.words import CLAUSES, DECLARATIONS, STATEMENTS

_BEGINS = re.compile(r'[a-z]+[ \t]+[A-Za-z"({\d-]')
"""What stands behind a word that begins a declaration, a clause or a statement."""

_INFIX = re.compile(r"(?:and|or|implies|iff|in|not[ \t]+in)\b(?![ \t]*:)|!=|<=|>=|//|[-+*%=<>]")
"""What an expression goes on with."""

_MARGIN = re.compile(r"\n( *)(?=[^\s#])")
"""The blanks at the beginning of a line that is not empty."""

_HEADER = re.compile(r".*:[ \t]*(?:#.*)?$")


def indented_declaration(failure: Failure) -> Diagnostic | None:
    """``action a`` inside the block of another declaration."""
    word = failure.line[0] if failure.line else failure.bad
    if word is None or str(word) not in DECLARATIONS[1:] or len(failure.line) > 1:
        return None
    place = word.start_pos or 0
    margin = failure.text[:place].rpartition("\n")[2]
    if not margin or margin.strip(" ") or not _BEGINS.match(failure.text, place):
        return None
    message, help = f"this `{word}` is indented, as a part of what stands above it", "let it begin in the first column"
    return failure.finding(Code.INDENTATION, message, failure.span(word), help)


def lost_on(failure: Failure) -> Diagnostic | None:
    """``on φ:`` in the column of a statement."""
    if not _is_call(failure) or failure.line[0] != "on" or not _HEADER.match(failure.rest):
        return None
    message, help = "this `on` belongs to no `interrupts`", "indent it below its `interrupts:`, all in one column"
    return failure.finding(Code.INDENTATION, message, failure.span(failure.line[0]), help)


def second_on_line(failure: Failure) -> Diagnostic | None:
    """``causes a := 1 causes b := 2``."""
    first = not failure.line or failure.brackets or "_NL" not in failure.accepts
    if first or str(failure.bad) not in {*CLAUSES, *STATEMENTS, *DECLARATIONS} or not _BEGINS.match(failure.rest):
        return None
    message, help = f"the line should end before `{failure.bad}`", "one declaration, clause or statement a line"
    return failure.finding(Code.SYNTAX, message, help=help)


def missing_some(failure: Failure) -> Diagnostic | None:
    """``on x: t where φ:``."""
    match failure.words, failure.kind:
        case ["on", _, ":"], "NAME" | "INT" | "LBRACE" if _HEADER.match(failure.rest):
            gap = failure.at(failure.line[0].end_pos or 0, failure.line[0].end_pos or 0)
            message, help = "`some` is missing after `on`", "write `on some x: type where condition:`"
            return failure.finding(Code.MISSING, message, gap, help, fix=insertion(gap, " some"))
    return None


def missing_head(failure: Failure) -> Diagnostic | None:
    """``x = e:``, ``x in l:``, ``x: t:``, ``until φ`` and ``not φ`` in the place of a statement."""
    if not _is_call(failure):
        return None
    word, header = failure.line[0], _HEADER.match(failure.rest) is not None
    if word == "until":
        missing = "`wait`"
    elif (failure.kind == "IN" and header) or (failure.kind == "COLON" and _HEADER.match(failure.rest[1:])):
        missing = "`for` or `pick`"
    elif header and (failure.kind in ("CMP", "AND", "OR", "PLUS", "MINUS") or word == "not"):
        missing = "`if` or `while`"
    elif header and failure.kind == "EQ":
        missing = "`if`, `let` or `while`"
    elif word == "not":
        return failure.finding(
            Code.SYNTAX, "an expression is no statement", failure.span(word), "a condition is tested with `test …`"
        )
    else:
        return None
    place = failure.at(word.start_pos or 0, word.start_pos or 0)
    return failure.finding(Code.MISSING, f"{missing} is missing before `{word}`", place, f"write {missing}")


def going_on(failure: Failure) -> Diagnostic | None:
    """A line that begins with an operator, or one that ends with it and goes on further to the right."""
    if failure.previous is None or failure.previous.type == "COLON" or failure.brackets:
        return None
    if failure.kind in LAYOUT and failure.wants_expression and failure.line and _deeper(failure):
        message, span = f"the line ends behind `{failure.previous}`, where it cannot end", failure.gap()
    elif failure.begins_line() and (infix := _INFIX.match(failure.rest)) and _deeper(failure):
        message, span = (
            f"a line cannot begin with `{infix.group()}`",
            failure.at(failure.place, failure.place + infix.end()),
        )
    else:
        return None
    return failure.finding(Code.SYNTAX, message, span, "put parentheses around what goes over several lines")


def _is_call(failure: Failure) -> bool:
    """Whether the first word of the line has been read as a call."""
    return len(failure.line) == 1 and {"_NL"} <= failure.accepts <= {"_NL", "LPAR"} and failure.kind not in LAYOUT


def _deeper(failure: Failure) -> bool:
    """Whether the line that begins at the bad place, or behind it, is indented deeper than the one before it."""
    last = failure.previous
    if last is None:
        return False
    line = failure.text[: last.end_pos or 0].rpartition("\n")[2]
    below = _MARGIN.search(failure.text, last.end_pos or 0)
    return below is not None and len(below[1]) > len(line) - len(line.lstrip(" "))


HINTS: tuple[Hint, ...] = (indented_declaration, lost_on, missing_some, missing_head, going_on)
