"""Hints for values that are unknown, for the beginning, and for prunes."""

from __future__ import annotations

from itertools import pairwise

from golc.diagnostics import Code, Diagnostic
from golc.syntax.failure import Failure, Hint
from golc.syntax.fixes import removal


def bare_choices(failure: Failure) -> Diagnostic | None:
    """``one of a, b``, ``one of (a, b)``, ``one of 1..3``."""
    if ("one", "of") not in pairwise(map(str, failure.line)) or {"{", "["} & {*map(str, failure.brackets)}:
        return None
    if failure.kind != "COMMA" and not failure.rest.startswith(".."):
        return None
    message, help = "behind `one of` stands a set or a list", "put the values in braces: `one of {a, b}`"
    return failure.finding(Code.SYNTAX, message, help=help)


def initially_colon(failure: Failure) -> Diagnostic | None:
    """``initially: φ``."""
    if failure.kind != "COLON" or failure.line != ["initially"]:
        return None
    message = "behind `initially` stands a formula, without a colon"
    return failure.finding(Code.SYNTAX, message, help="remove the colon", fix=removal(failure.here()))


def nameless_prune(failure: Failure) -> Diagnostic | None:
    """``prune after a: φ``, where ``after`` is read as a name."""
    if failure.line[:2] != ["prune", "after"] or failure.accepts != {"COLON"}:
        return None
    span = failure.span(failure.line[1])
    return failure.finding(Code.MISSING, "this prune has no name", span, "write `prune name: after …`")


HINTS: tuple[Hint, ...] = (bare_choices, initially_colon, nameless_prune)
