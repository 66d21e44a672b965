"""Hints for signs: one in place of another, or where none can stand."""

from __future__ import annotations

import re

from golc.diagnostics import Code, Diagnostic
from golc.syntax.failure import Failure, Hint
from golc.syntax.hints.fixes import instead, removal, sign_at
from golc.syntax.layout import CLOSING

OPERATORS = frozenset({"CMP", "EQ", "IN", "PLUS", "MINUS", "TIMES", "IDIV", "MOD"})
VALUED = frozenset({"const", "type", "static", "fluent", "let"})
LOOSE = re.compile(r"\b(or|implies|iff|if|exists|forall|count|sum|min|max)\b")
"""What binds less tightly than ``and``, so that one in the place of a comma would take its operands from it."""

CHANGED = {"define": "a definition", "causes": "an effect", "after": "an effect"}


def wrong_sign(failure: Failure) -> Diagnostic | None:
    """``=`` for ``:=`` and the reverse, and either for a colon."""
    first = str(failure.line[0]) if failure.line else ""
    here = failure.here()
    if failure.kind == "EQ" and "ASSIGN" in failure.accepts:
        what = CHANGED.get(first, "a change")
        message, help = f"`=` tests, `:=` changes: {what} is written with `:=`", "write `:=`"
        return failure.finding(Code.FOREIGN, message, help=help, fix=sign_at(here, ":="))
    if failure.kind == "ASSIGN" and "EQ" in failure.accepts:
        message = "`:=` changes, `=` tests: a condition is written with `=`"
        if first in VALUED:
            message = f"`:=` changes: the value of a `{first}` is written with `=`"
        return failure.finding(Code.FOREIGN, message, help="write `=`", fix=sign_at(here, "="))
    if failure.kind in ("EQ", "ASSIGN") and failure.accepts == {"COLON"}:
        message = f"behind the name of `{first}` stands `:`, not `{failure.bad}`"
        return failure.finding(Code.FOREIGN, message, help="write `:`", fix=sign_at(here, ":"))
    named = len(failure.line) == 2 and first in ("const", "type", "let", "define")
    if failure.kind == "COLON" and failure.accepts & {"EQ", "ASSIGN"} and named:
        sign = "=" if "EQ" in failure.accepts else ":="
        return failure.finding(
            Code.SYNTAX, f"after the name of a `{first}` stands `{sign}`", help=f"write `{sign}`; it has no type"
        )
    return None


def late_not(failure: Failure) -> Diagnostic | None:
    """``a = not b``, where ``not`` is read as a name."""
    if len(failure.line) < 2 or failure.line[-1] != "not" or failure.line[-2].type not in OPERATORS:
        return None
    operator, word = failure.line[-2:]
    return failure.finding(
        Code.SYNTAX,
        f"`not` binds less tightly than the `{operator}` before it",
        failure.span(word),
        f"put it in parentheses: `… {operator} (not …)`",
    )


def statement_sign(failure: Failure) -> Diagnostic | None:
    """``f := e`` or ``f = e`` in the place of a statement."""
    infix = OPERATORS | {"ASSIGN", "AND", "OR", "IMPLIES", "IFF", "NOT", "LSQB"}
    if failure.kind not in infix or not {"_NL"} <= failure.accepts <= {"_NL", "LPAR"}:
        return None
    if failure.kind == "ASSIGN":
        return failure.finding(
            Code.SYNTAX,
            "a program cannot change a fluent itself",
            help="declare an action with `causes` and call it; a name for a value is `let x = e:`",
        )
    return failure.finding(Code.SYNTAX, "an expression is no statement", help="a condition is tested with `test …`")


def last_comma(failure: Failure) -> Diagnostic | None:
    """``{a, b,}``."""
    if failure.kind not in CLOSING or failure.previous is None or failure.previous.type != "COMMA":
        return None
    message = "a comma stands between two elements, not behind the last"
    span = failure.span(failure.previous)
    return failure.finding(Code.SYNTAX, message, span, "remove it", fix=removal(span))


def comma(failure: Failure) -> Diagnostic | None:
    """``test a, b``."""
    if failure.kind != "COMMA" or "AND" not in failure.accepts:
        return None
    around = [*failure.words, failure.rest]
    fix = None if any(map(LOOSE.search, around)) else instead(failure.here(), "and")
    return failure.finding(Code.SYNTAX, "a comma does not join conditions", help="write `and`", fix=fix)


def computed_bound(failure: Failure) -> Diagnostic | None:
    """``1..n + 1`` as a type."""
    line = failure.line
    after_plus = failure.accepts == {"RANGE"} and len(line) > 1 and line[-2].type in ("PLUS", "MINUS")
    if not any(token.type == "RANGE" for token in line):
        return None
    if not after_plus and not (failure.kind in ("MINUS", "TIMES", "IDIV", "MOD") and "AND" not in failure.accepts):
        return None
    return failure.finding(Code.SYNTAX, "a computed bound stands in parentheses", help="write for example `1..(n + 1)`")


def part_of_name(failure: Failure) -> Diagnostic | None:
    """``robot.place``."""
    name = failure.previous
    if failure.kind != "DOT" or name is None or name.type != "NAME" or "AND" not in failure.accepts:
        return None
    help = f"what belongs to a thing is a fluent with an argument: `f({name})`"
    return failure.finding(Code.FOREIGN, f"`{name}` has no parts", help=help)


HINTS: tuple[Hint, ...] = (
    statement_sign,
    last_comma,
    comma,
    computed_bound,
    part_of_name,
)
