"""Hints for values that are unknown, for prunes, and for functions of Python."""

from __future__ import annotations

from itertools import pairwise

from golc.diagnostics import Code, Diagnostic
from golc.syntax.failure import Failure, Hint


def bare_choices(failure: Failure) -> Diagnostic | None:
    """``one of a, b``, ``one of (a, b)``, ``one of 1..3``."""
    if ("one", "of") not in pairwise(failure.words) or {"{", "["} & {*map(str, failure.brackets)}:
        return None
    if failure.kind != "COMMA" and not failure.rest.startswith(".."):
        return None
    message, help = "behind `one of` stands a set or a list", "put the values in braces: `one of {a, b}`"
    return failure.finding(Code.SYNTAX, message, help=help)


def nameless_prune(failure: Failure) -> Diagnostic | None:
    """``prune after a: φ``, where ``after`` is read as a name."""
    if failure.line[:2] != ["prune", "after"] or failure.accepts != {"COLON"}:
        return None
    span = failure.span(failure.line[1])
    return failure.finding(Code.MISSING, "this prune has no name", span, "write `prune name: after …`")


def without_file(failure: Failure) -> Diagnostic | None:
    """``extern f(a: t): int``, also with a value."""
    if failure.line[:1] != ["extern"] or "FROM" not in failure.accepts:
        return None
    if failure.kind not in ("_NL", "$END", "EQ", "ASSIGN"):
        return None
    message, help = "this `extern` does not say in which file its function is", 'write `from "helpers.py"` at its end'
    return failure.finding(Code.MISSING, message, failure.gap(), help)


HINTS: tuple[Hint, ...] = (bare_choices, nameless_prune, without_file)
