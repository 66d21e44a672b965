"""Hints for comparisons that are chained and for quantifiers."""

from __future__ import annotations

import re

from lark import Token

from golc.diagnostics import Code, Diagnostic, Label
from golc.syntax.failure import Failure
from golc.syntax.hints.fixes import instead, sign_at
from golc.syntax.layout import CLOSING, OPENING
from golc.syntax.spelling import closest

QUANTIFIERS = frozenset({"EXISTS", "FORALL", "COUNT", "SUM", "MIN", "MAX"})
COMPARISONS = frozenset({"CMP", "EQ", "IN"})
BREAKS = frozenset({"AND", "OR", "IMPLIES", "COMMA", "ASSIGN", "WHEN", "IF", "ELSE", "TEST", "POSS", "UNTIL"})
"""Where a phrase of an expression begins anew."""


def missing_dot(failure: Failure) -> Diagnostic | None:
    """A quantifier whose variables are not followed by a dot."""
    quantifier = _open_quantifier(failure)
    if quantifier is None:
        return None
    if failure.rest.startswith(".") and {"COLON", "IN"} <= failure.accepts:
        return failure.finding(
            Code.MISSING, f"the variable `{failure.previous}` has no type", failure.gap(), "write `x: type. …`"
        )
    if failure.kind == "NAME" and "WHERE" in failure.accepts and closest(str(failure.bad), ["where"]) is not None:
        help, fix = "did you mean `where`?", instead(failure.here(), "where")
        return failure.finding(Code.SYNTAX, f"`{failure.bad}` is no word here", help=help, fix=fix)
    if "DOT" in failure.accepts and (failure.kind in ("COLON", "LPAR", "NOT", "NAME") or failure.rest[:1] == "|"):
        return failure.finding(
            Code.MISSING,
            f"the dot behind the variables of `{quantifier}` is missing",
            failure.gap(),
            f"write `{quantifier} x: type. …`",
            fix=sign_at(failure.here() if failure.rest[0] in ":|" else failure.gap(), "."),
        )
    if failure.kind == "LPAR" and {"COLON", "IN"} == failure.accepts and failure.tokens[-2].type == "COMMA":
        return failure.finding(
            Code.SYNTAX,
            f"a dot, not a comma, ends the variables of `{quantifier}`",
            failure.span(failure.tokens[-2]),
            f"write `{quantifier} x: type. …`",
            fix=sign_at(failure.span(failure.tokens[-2]), "."),
        )
    return None


def missing_quantifier(failure: Failure) -> Diagnostic | None:
    """``n: station. φ``."""
    name = failure.previous
    variable = failure.kind == "COLON" and "AND" in failure.accepts and re.match(r":[^:.]*[\w}\])]\.\s", failure.rest)
    if not variable or name is None or name.type != "NAME":
        return None
    message = f"`{name}: type.` is introduced by a quantifier"
    return failure.finding(Code.MISSING, message, failure.span(name), f"write for example `exists {name}: type. …`")


def _open_quantifier(failure: Failure) -> Token | None:
    """The quantifier whose variables are being read."""
    depth = 0
    for token in reversed(failure.line):
        depth += (token.type in CLOSING) - (token.type in OPENING)
        if depth == 0 and token.type == "DOT":
            return None
        if depth == 0 and token.type in QUANTIFIERS:
            return token
    return None


def chained(failure: Failure) -> Diagnostic | None:
    """``a < b < c``, ``a iff b iff c``."""
    iff = failure.kind in ("IFF", "IMPLIES")
    second = re.match(r"not\s+in\b", failure.rest)
    if not (iff or second or failure.kind in COMPARISONS) or "AND" not in failure.accepts:
        return None
    words = _phrase(failure)
    first = next((token for token in reversed(words) if token.type in (("IFF",) if iff else COMPARISONS)), None)
    if first is None:
        return None
    quantifier = next((token for token in words[: words.index(first)] if token.type in QUANTIFIERS), None)
    sign = second.group() if second else str(failure.bad)
    return failure.finding(
        Code.SYNTAX,
        f"`{sign}` cannot be chained" if sign == first else f"`{first}` and `{sign}` cannot be chained",
        help=_unchain(first, sign, quantifier),
        labels=(Label(failure.span(first), "the first one"),),
    )


def _unchain(first: Token, second: str, quantifier: Token | None) -> str:
    if quantifier is not None:
        return f"`{quantifier}` takes everything to its right: put it in parentheses, `({quantifier} …) {first} …`"
    if first.type == "IFF":
        return f"put one of them in parentheses: `(a {first} b) {second} c`"
    return f"write `a {first} b and b {second} c`"


def _phrase(failure: Failure) -> list[Token]:
    """The tokens of the line before the bad one that stand in the same brackets and the same part of the expression."""
    depth, words = 0, []
    for token in reversed(failure.line):
        depth += (token.type in CLOSING) - (token.type in OPENING)
        if depth < 0 or (depth == 0 and token.type in BREAKS):
            break
        if depth == 0:
            words.append(token)
    return words[::-1]
