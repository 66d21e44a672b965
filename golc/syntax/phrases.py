"""Hints for what stands in one line: signs, comparisons, quantifiers, what is missing between two words."""

from __future__ import annotations

import re

from lark import Token

from golc.diagnostics import Code, Diagnostic, Label
from golc.syntax.blocks import CLOSING_OF, not_closed
from golc.syntax.failure import Failure, Hint
from golc.syntax.layout import CLOSING, OPENING
from golc.syntax.terminals import title, titles

QUANTIFIERS = frozenset({"EXISTS", "FORALL", "COUNT", "SUM", "MIN", "MAX"})
COMPARISONS = frozenset({"CMP", "EQ", "IN"})
OPERATORS = frozenset({"CMP", "EQ", "IN", "PLUS", "MINUS", "STAR", "IDIV", "MOD"})
CHANGED = {"define": "a definition", "causes": "an effect", "after": "an effect"}


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
    return failure.finding(
        Code.SYNTAX,
        f"`{first}` and `{second.group() if second else failure.bad}` cannot be chained",
        help=_unchain(first, second.group() if second else str(failure.bad), quantifier),
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


BREAKS = frozenset({"AND", "OR", "IMPLIES", "COMMA", "ASSIGN", "WHEN", "IF", "ELSE", "TEST", "POSS", "UNTIL"})


def wrong_sign(failure: Failure) -> Diagnostic | None:
    """``=`` for ``:=`` and the reverse, and either for a colon."""
    first = str(failure.line[0]) if failure.line else ""
    if failure.kind == "EQ" and "ASSIGN" in failure.accepts:
        what = CHANGED.get(first, "a change")
        return failure.finding(Code.FOREIGN, f"`=` tests, `:=` changes: {what} is written with `:=`", help="write `:=`")
    if failure.kind == "ASSIGN" and "EQ" in failure.accepts:
        if first in VALUED:
            return failure.finding(
                Code.FOREIGN, f"`:=` changes: the value of a `{first}` is written with `=`", help="write `=`"
            )
        return failure.finding(
            Code.FOREIGN, "`:=` changes, `=` tests: a condition is written with `=`", help="write `=`"
        )
    if failure.kind in ("EQ", "ASSIGN") and failure.accepts == {"COLON"}:
        return failure.finding(
            Code.FOREIGN, f"after the name of a `{first}` stands `:`, not `{failure.bad}`", help="write `:`"
        )
    named = len(failure.line) == 2 and first in ("const", "type", "let", "define")
    if failure.kind == "COLON" and failure.accepts & {"EQ", "ASSIGN"} and named:
        sign = "=" if "EQ" in failure.accepts else ":="
        return failure.finding(
            Code.SYNTAX, f"after the name of a `{first}` stands `{sign}`", help=f"write `{sign}`; it has no type"
        )
    return None


VALUED = frozenset({"const", "type", "static", "fluent", "let"})


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


def missing_dot(failure: Failure) -> Diagnostic | None:
    """A quantifier whose variables are not followed by a dot."""
    quantifier = _open_quantifier(failure)
    if quantifier is None:
        return None
    if failure.rest.startswith(".") and {"COLON", "IN"} <= failure.accepts:
        return failure.finding(
            Code.MISSING, f"the variable `{failure.previous}` has no type", failure.gap(), "write `x: type. …`"
        )
    if "DOT" in failure.accepts and (failure.kind in ("COLON", "LPAR", "NOT", "NAME") or failure.rest[:1] == "|"):
        return failure.finding(
            Code.MISSING,
            f"the dot behind the variables of `{quantifier}` is missing",
            failure.gap(),
            f"write `{quantifier} x: type. …`",
        )
    if failure.kind == "LPAR" and {"COLON", "IN"} == failure.accepts and failure.tokens[-2].type == "COMMA":
        return failure.finding(
            Code.SYNTAX,
            f"a dot, not a comma, ends the variables of `{quantifier}`",
            failure.span(failure.tokens[-2]),
            f"write `{quantifier} x: type. …`",
        )
    return None


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


def missing_type(failure: Failure) -> Diagnostic | None:
    """A parameter or variable without a type."""
    colon = failure.accepts <= {"COLON", "IN"} and "COLON" in failure.accepts
    name = failure.previous
    if colon and name is not None and name.type == "NAME" and failure.kind in ("RPAR", "COMMA", "WHERE", "_NL", "DOT"):
        message, help = f"`{name}` has no type", f"write `{name}: type`"
        return failure.finding(Code.MISSING, message, failure.gap(), help)
    if failure.accepts == {"COLON"} and name is not None and failure.kind == "NAME" and failure.brackets:
        message, help = f"the colon between `{name}` and its type is missing", f"write `{name}: {failure.bad}`"
        return failure.finding(Code.MISSING, message, failure.gap(), help)
    if failure.wants_type and failure.kind not in ("NAME", "INT"):
        return failure.finding(
            Code.MISSING, "a type is missing", failure.gap(), "name a type, or write `1..6`, `{a, b}`"
        )
    return None


def missing_bracket(failure: Failure) -> Diagnostic | None:
    """A closing bracket that is missing before something that cannot stand in it."""
    if not failure.brackets or failure.kind in STARTS:
        return None
    opening = failure.brackets[-1]
    if CLOSING_OF[opening.type] not in failure.accepts or failure.previous is None:
        return None
    return not_closed(failure, opening, failure.previous.end_pos or 0)


def missing_name(failure: Failure) -> Diagnostic | None:
    """No name, or a number, where something is named."""
    if failure.accepts != {"NAME"} or failure.previous is None:
        return None
    if failure.kind in ("INT", "REAL"):
        return failure.finding(Code.SYNTAX, "a name begins with a letter", help="begin it with a letter")
    return failure.finding(Code.MISSING, f"a name is missing after `{failure.previous}`", failure.gap())


def missing_text(failure: Failure) -> Diagnostic | None:
    """``say hello``."""
    if failure.accepts != {"STRING"} or failure.previous is None:
        return None
    return failure.finding(
        Code.MISSING,
        f"after `{failure.previous}` stands a text in double quotes",
        failure.gap(),
        f'write `{failure.previous} "…"`',
    )


def last_comma(failure: Failure) -> Diagnostic | None:
    """``{a, b,}``."""
    if failure.kind not in CLOSING or failure.previous is None or failure.previous.type != "COMMA":
        return None
    message = "a comma stands between two elements, not behind the last"
    return failure.finding(Code.SYNTAX, message, failure.span(failure.previous), "remove it")


def comma(failure: Failure) -> Diagnostic | None:
    """``test a, b``."""
    if failure.kind != "COMMA" or "AND" not in failure.accepts:
        return None
    return failure.finding(Code.SYNTAX, "a comma does not join conditions", help="write `and`")


def missing_unit(failure: Failure) -> Diagnostic | None:
    """``wait 5``, ``search at most 20:``."""
    if "S" in failure.accepts:
        return failure.finding(Code.MISSING, "the unit of this time is missing", failure.gap(), "write `s`, seconds")
    if "STEPS" in failure.accepts:
        return failure.finding(Code.MISSING, "the word `steps` is missing", failure.gap(), "write `at most … steps`")
    return None


def missing_part(failure: Failure) -> Diagnostic | None:
    """``x if c`` without ``else``, ``on some`` without ``where``, ``interrupts`` without ``on``."""
    ends = failure.kind in ("_NL", "COLON", "COMMA", *CLOSING)
    if ends and "ELSE" in failure.accepts and "AND" in failure.accepts:
        return failure.finding(
            Code.MISSING, "this `if` in an expression has no `else`", failure.gap(), "write `x if condition else y`"
        )
    if ends and "WHERE" in failure.accepts and failure.line[:2] == ["on", "some"]:
        return failure.finding(
            Code.MISSING, "this `on some` has no condition", failure.gap(), "write `on some x: type where condition:`"
        )
    if failure.accepts == {"ON"}:
        help = "write `on condition:` with a block below it"
        return failure.finding(Code.SYNTAX, "a line of `interrupts` begins with `on`", help=help)
    return None


def computed_bound(failure: Failure) -> Diagnostic | None:
    """``1..n + 1`` as a type."""
    line = failure.line
    after_plus = failure.accepts == {"RANGE"} and len(line) > 1 and line[-2].type in ("PLUS", "MINUS")
    if not any(token.type == "RANGE" for token in line):
        return None
    if not after_plus and not (failure.kind in ("MINUS", "STAR", "IDIV", "MOD") and "AND" not in failure.accepts):
        return None
    return failure.finding(Code.SYNTAX, "a computed bound stands in parentheses", help="write for example `1..(n + 1)`")


def two_calls(failure: Failure) -> Diagnostic | None:
    """``go home``."""
    if failure.accepts != {"LPAR", "_NL"} or failure.previous is None:
        return None
    return failure.finding(
        Code.SYNTAX,
        f"`{failure.bad}` cannot follow the call of `{failure.previous}`",
        help="arguments stand in parentheses, and each statement on a line of its own",
    )


def part_of_name(failure: Failure) -> Diagnostic | None:
    """``robot.place``."""
    name = failure.previous
    if failure.kind != "DOT" or name is None or name.type != "NAME" or "AND" not in failure.accepts:
        return None
    help = f"what belongs to a thing is a fluent with an argument: `f({name})`"
    return failure.finding(Code.FOREIGN, f"`{name}` has no parts", help=help)


def missing_operand(failure: Failure) -> Diagnostic | None:
    """An operator, a comma or a word without the expression that belongs behind it."""
    if not failure.wants_expression or failure.previous is None:
        return None
    return failure.finding(
        Code.MISSING, f"an expression is missing after `{failure.previous}`", failure.gap(), "write what belongs there"
    )


def missing_operator(failure: Failure) -> Diagnostic | None:
    """Two expressions one behind the other."""
    if failure.kind not in STARTS or "AND" not in failure.accepts or failure.previous is None:
        return None
    between = "an operator or a comma" if "COMMA" in failure.accepts else "an operator"
    return failure.finding(
        Code.MISSING,
        f"{between} is missing between `{failure.previous}` and `{failure.bad}`",
        failure.gap(),
        None if failure.brackets else "one statement, one clause a line",
    )


STARTS = frozenset({"NAME", "INT", "REAL", "STRING", "LPAR", "LBRACE", "TRUE", "FALSE", "NONE", *QUANTIFIERS})


def missing_token(failure: Failure) -> Diagnostic | None:
    """Exactly one token could have come."""
    if len(failure.accepts) != 1 or failure.previous is None:
        return None
    (only,) = failure.accepts
    if only == "_NL":
        return failure.finding(
            Code.SYNTAX,
            f"the line should end before `{failure.bad}`",
            help="one declaration, clause or statement a line",
        )
    help = "an interval is written `1..6`" if only == "RANGE" else f"write {title(only)}"
    return failure.finding(Code.MISSING, f"{title(only)} is missing after `{failure.previous}`", failure.gap(), help)


def anything(failure: Failure) -> Diagnostic:
    """What no other hint recognised."""
    expected = titles(failure.accepts)
    help = None if expected is None else f"here could stand {expected}"
    if failure.kind in ("_NL", "$END", "_DEDENT", "_INDENT"):
        what = f"the line ends too early, after `{failure.previous}`" if failure.previous else "there is nothing here"
        return failure.finding(Code.SYNTAX, what, failure.gap(), help)
    return failure.finding(Code.SYNTAX, f"`{failure.bad or failure.rest[:1]}` does not fit here", help=help)


HINTS: tuple[Hint, ...] = (
    statement_sign,
    last_comma,
    comma,
    computed_bound,
    part_of_name,
    missing_unit,
    missing_part,
    missing_type,
    missing_bracket,
    missing_name,
    missing_text,
    missing_operand,
    missing_operator,
    two_calls,
    missing_token,
    anything,
)
