"""Hints for what is missing in a line, and what is said of anything else."""

from __future__ import annotations

from golc.diagnostics import Code, Diagnostic
from golc.syntax.failure import Failure, Hint
from golc.syntax.hints.brackets import CLOSING_OF, not_closed
from golc.syntax.hints.fixes import insertion, sign_at
from golc.syntax.hints.quantifiers import QUANTIFIERS
from golc.syntax.hints.trial import goes_on, one_token_off
from golc.syntax.layout import CLOSING
from golc.syntax.terminals import title, titles

STARTS = frozenset({"NAME", "INT", "REAL", "STRING", "LPAR", "LBRACE", "TRUE", "FALSE", "NONE", *QUANTIFIERS})


def missing_type(failure: Failure) -> Diagnostic | None:
    """A parameter or variable without a type."""
    colon = failure.accepts <= {"COLON", "IN"} and "COLON" in failure.accepts
    name = failure.previous
    if colon and name is not None and name.type == "NAME" and failure.kind in ("RPAR", "COMMA", "WHERE", "_NL", "DOT"):
        message, help = f"`{name}` has no type", f"write `{name}: type`"
        return failure.finding(Code.MISSING, message, failure.gap(), help)
    if failure.accepts == {"COLON"} and name is not None and failure.kind == "NAME" and failure.brackets:
        message, help = f"the colon between `{name}` and its type is missing", f"write `{name}: {failure.bad}`"
        return failure.finding(Code.MISSING, message, failure.gap(), help, fix=insertion(failure.gap(), ":"))
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
    help = "write `rcx`, `operator`, `host` or `self`" if failure.previous == "device" else "write a name"
    return failure.finding(Code.MISSING, f"a name is missing after `{failure.previous}`", failure.gap(), help)


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


def missing_unit(failure: Failure) -> Diagnostic | None:
    """``wait 5``, ``search at most 20:``."""
    if "S" in failure.accepts:
        condition = failure.line[0] == "wait" and failure.line[1].type == "NAME" if len(failure.line) == 2 else False
        help = "write `s`, seconds; or `wait until …`, if it is a condition" if condition else "write `s`, seconds"
        return failure.finding(Code.MISSING, "the unit of this time is missing", failure.gap(), help)
    if "STEPS" in failure.accepts and failure.previous == "steps":
        span, help = failure.span(failure.previous), "write `at most n steps`, with a number for `n`"
        return failure.finding(Code.MISSING, "the number of steps is missing", span, help)
    if "STEPS" in failure.accepts:
        message, gap, help = "the word `steps` is missing", failure.gap(), "write `at most … steps`"
        fix = insertion(gap, " steps") if failure.kind == "COLON" else None
        return failure.finding(Code.MISSING, message, gap, help, fix=fix)
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
    if failure.kind == "ELSE" and "AND" in failure.accepts:
        message, help = "this `else` in an expression has no `if`", "write `x if condition else y`"
        return failure.finding(Code.MISSING, message, help=help)
    if failure.accepts == {"ON"}:
        help = "write `on condition:` with a block below it"
        return failure.finding(Code.SYNTAX, "a line of `interrupts` begins with `on`", help=help)
    return None


def missing_operand(failure: Failure) -> Diagnostic | None:
    """An operator, a comma or a word without the expression that belongs behind it."""
    if not failure.wants_expression or failure.previous is None:
        return None
    return failure.finding(
        Code.MISSING, f"an expression is missing after `{failure.previous}`", failure.gap(), "write what belongs there"
    )


def missing_operator(failure: Failure) -> Diagnostic | None:
    """Two expressions one behind the other."""
    if failure.accepts == {"IN"} and failure.previous is not None and failure.previous.type == "NOT":
        message, help = "an operator is missing beside `not`", "write `and not …`, or `not in …`"
        return failure.finding(Code.MISSING, message, failure.span(failure.previous), help)
    if failure.kind not in STARTS or "AND" not in failure.accepts or failure.previous is None:
        return None
    if failure.previous in ("and", "or", "implies", "iff", "in", "if"):
        message = f"an expression is missing before `{failure.previous}`"
        return failure.finding(Code.MISSING, message, failure.span(failure.previous), "write what belongs there")
    between = "an operator or a comma" if "COMMA" in failure.accepts else "an operator"
    help = "write what joins them" + ("" if failure.brackets else ", or begin another line")
    if "WHEN" in failure.accepts:
        help = "write `when` before a condition, or what joins them"
    return failure.finding(
        Code.MISSING,
        f"{between} is missing between `{failure.previous}` and `{failure.bad}`",
        failure.gap(),
        help,
    )


def two_calls(failure: Failure) -> Diagnostic | None:
    """``go home``."""
    if failure.accepts != {"LPAR", "_NL"} or failure.previous is None:
        return None
    return failure.finding(
        Code.SYNTAX,
        f"`{failure.bad}` cannot follow the call of `{failure.previous}`",
        help="arguments stand in parentheses, and each statement on a line of its own",
    )


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
    help = f"write {title(only)}"
    if only == "RANGE":
        help = "an interval is written `1..6`"
    elif failure.previous == "-":
        help = "write a number, or parentheses around what has no number: `(-n)`"
    message, gap = f"{title(only)} is missing after `{failure.previous}`", failure.gap()
    certain = only in ("COLON", "EQ", "ASSIGN") and goes_on(failure, only)
    fix = sign_at(gap, title(only).strip("`")) if certain else None
    return failure.finding(Code.MISSING, message, gap, help, fix=fix)


def anything(failure: Failure) -> Diagnostic:
    """What no other hint recognised."""
    expected = titles(failure.accepts)
    help = None if expected is None else f"here could stand {expected}"
    if failure.kind in ("_NL", "$END", "_DEDENT", "_INDENT"):
        what = f"the line ends too early, after `{failure.previous}`" if failure.previous else "there is nothing here"
        return failure.finding(Code.SYNTAX, what, failure.gap(), help)
    return failure.finding(Code.SYNTAX, f"`{failure.bad or failure.rest[:1]}` does not fit here", help=help)


HINTS: tuple[Hint, ...] = (
    missing_type,
    missing_bracket,
    missing_name,
    missing_text,
    missing_unit,
    missing_part,
    missing_operand,
    missing_operator,
    two_calls,
    missing_token,
    one_token_off,
    anything,
)
