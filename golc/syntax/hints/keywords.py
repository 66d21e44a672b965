"""Hints for words: a line that begins no declaration, a misspelt word, a reserved one."""

from __future__ import annotations

import re
from collections.abc import Iterable

from lark import Token

from golc.diagnostics import Code, Diagnostic, Fix, Span
from golc.syntax.failure import Failure
from golc.syntax.hints.fixes import instead
from golc.syntax.spelling import close, closest, meant_declaration
from golc.syntax.terminals import word_of
from golc.syntax.words import BRANCHES, CLAUSES, DECLARATIONS, STATEMENTS

CALL = r"[A-Za-z]\w*[ \t]*(?:\([^\n]*\))?"
"""A line that may be a call."""


def no_declaration(failure: Failure) -> Diagnostic | None:
    """A line in the first column that begins no declaration."""
    if failure.tokens or "ACTION" not in failure.accepts:
        return None
    word = re.match(r"[A-Za-z]\w*|", failure.rest)
    found = word.group() if word else ""
    if failure.kind == "INT" and re.match(r"\d+[ \t]*(\.\.)?[ \t]*[A-Za-z]", failure.rest):
        return _lost_binding(failure, failure.here())
    if failure.kind == "_INDENT" or not found:
        return None
    span = failure.at(failure.place, failure.place + len(found))
    if ":-" in failure.rest:
        return _prolog(failure)
    if found in CLAUSES or found in STATEMENTS or found in BRANCHES:
        return _lost_line(failure, found)
    ours = meant_declaration(found)
    if ours is not None:
        message, help, fix = (
            f"`{found}` begins no declaration",
            f"did you mean `{ours}`?",
            _spelt(span, ours, DECLARATIONS),
        )
        return failure.finding(Code.SYNTAX, message, span, help, fix=fix)
    if re.search(r"\.[ \t]*(%.*)?$", failure.rest):
        return _prolog(failure)
    if re.match(r"(set[ \t]+\w+[ \t]+[\d(]|.*\bby[ \t]+(call|start|prompt)\b)", failure.rest):
        return _lost_binding(failure, span)
    kinds = ", ".join(f"`{kind}`" for kind in DECLARATIONS[1:])
    help = f"a declaration begins with {kinds}"
    if re.match(CALL + r"[ \t]*(#|$)", failure.rest):
        help = "a call is indented below its `proc`; " + help
    return failure.finding(Code.SYNTAX, f"`{found}` begins no declaration", span, help)


def _prolog(failure: Failure) -> Diagnostic:
    return failure.finding(
        Code.FOREIGN,
        "this is a clause of Prolog",
        failure.at(failure.place, failure.place + len(failure.rest)),
        "begin a declaration with its kind: `fluent`, `action`, `exog`, `proc`, …",
    )


def _lost_binding(failure: Failure, span: Span) -> Diagnostic:
    message = "this line of a `device` stands in the first column, outside of any declaration"
    return failure.finding(Code.INDENTATION, message, span, "indent it below its `device`")


def _lost_line(failure: Failure, word: str) -> Diagnostic:
    home = CLAUSES.get(word, "`proc`")
    return failure.finding(
        Code.INDENTATION,
        f"this `{word}` stands in the first column, outside of any declaration",
        failure.at(failure.place, failure.place + len(word)),
        f"indent it below its {home}",
    )


def misspelt(failure: Failure) -> Diagnostic | None:
    """A name where only words can stand, or behind one that looks like a word."""
    if failure.kind == "NAME":
        found = _misspelt(failure, failure.bad, failure.accepts)
        if found is not None:
            return found
    last = failure.tokens[-1] if failure.tokens else None
    if last is None or last.type != "NAME" or str(last) in _words(failure.chosen_from):
        return None
    # Behind `waiting` the line ends, so that it was not meant where the line goes on.
    return _misspelt(failure, last, failure.chosen_from - {"_WAITING"})


def _misspelt(failure: Failure, token: Token | None, accepts: frozenset[str]) -> Diagnostic | None:
    words = _words(accepts)
    ours = closest(str(token), words)
    if token is None or ours is None:
        return None
    span, message = failure.span(token), f"`{token}` is no word here"
    return failure.finding(Code.SYNTAX, message, span, f"did you mean `{ours}`?", fix=_spelt(span, ours, words))


def _spelt(span: Span, ours: str, words: Iterable[str]) -> Fix | None:
    """Our spelling, if no other word is close and no declaration has this name."""
    declared = re.search(rf"^[a-z]+[ \t]+{re.escape(span.text)}\b", span.source.text, re.MULTILINE)
    return instead(span, ours) if close(span.text, words) == [ours] and declared is None else None


def reserved(failure: Failure) -> Diagnostic | None:
    """A word that begins an expression in the place of a name."""
    last = failure.tokens[-1] if failure.tokens else None
    if last is None or str(last) not in AFTER:
        return None
    table = failure.brackets and failure.brackets[-1].type == "LBRACE"
    if failure.kind == "COLON" and "x: type" in AFTER[str(last)] and not table:
        message, help = f"a variable is missing after `{last}`", f"write `{last} x: type. …`"
        return failure.finding(Code.MISSING, message, failure.gap(), help)
    if failure.kind == "LPAR":
        message, help = f"`{last}` is no function", f"after it stands {AFTER[str(last)]}"
        return failure.finding(Code.SYNTAX, message, failure.span(last), help)
    return failure.finding(
        Code.RESERVED,
        f"`{last}` is a word of the language and cannot be a name",
        failure.span(last),
        f"after `{last}` stands {AFTER[str(last)]}",
    )


AFTER = {
    **dict.fromkeys(("exists", "forall", "count", "sum"), "a variable: `x: type. …`"),
    **dict.fromkeys(("min", "max"), "a variable, `x: type. …`, or arguments, `(a, b)`"),
    **dict.fromkeys(("known", "knows", "possible"), "an argument in parentheses"),
}
"""What has to stand behind a word that begins an expression."""


def _words(terminals: Iterable[str]) -> list[str]:
    return sorted(word for terminal in terminals if (word := word_of(terminal)) is not None)
