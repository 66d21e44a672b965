"""Hints for statements that are written as in another language."""

from __future__ import annotations

from golc.diagnostics import Code, Diagnostic
from golc.syntax.failure import LAYOUT, Failure, Hint

SPOKEN = frozenset({"print", "echo", "write", "output", "printf", "display", "log"})
CALLED = frozenset({"do", "run", "call", "perform", "exec", "execute", "invoke"})
DECLARING = frozenset({"causes", "poss", "senses", "cost", "expect", "given"})


def call(failure: Failure) -> Diagnostic | None:
    """``print "…"``, ``call p``, ``causes f := e`` in the place of a statement."""
    if len(failure.line) != 1 or not {"_NL"} <= failure.accepts <= {"_NL", "LPAR"}:
        return None
    word = failure.line[0]
    if word in SPOKEN and failure.kind == "STRING":
        message, help = f"a message is given with `say`, not with `{word}`", 'write `say "…"`'
    elif word in CALLED and failure.kind == "NAME":
        message, help = "an action or a procedure is called by its name alone", f"remove `{word}`"
    elif word in DECLARING:
        message, help = f"`{word}` belongs to a declaration, not into a program", "declare an action, and call it here"
    else:
        return None
    return failure.finding(Code.FOREIGN, message, failure.span(word), help)


def wait(failure: Failure) -> Diagnostic | None:
    """``wait φ``, ``wait for φ``."""
    if failure.words[:1] != ["wait"] or len(failure.words) < 2:
        return None
    if failure.words[1] == "for":
        span = failure.span(failure.line[1])
        return failure.finding(
            Code.FOREIGN, "what is waited for stands behind `until`, not `for`", span, "write `until`"
        )
    formula = any(token.type in ("LPAR", "EQ", "CMP", "IN", "AND", "OR", "NOT") for token in failure.line)
    if formula and "S" in failure.accepts and failure.kind in LAYOUT:
        span = failure.span(failure.line[1])
        return failure.finding(Code.MISSING, "`until` is missing before a condition", span, "write `wait until …`")
    return None


def each(failure: Failure) -> Diagnostic | None:
    """``for each x: t``, ``for x of l``."""
    match failure.words, str(failure.bad or ""):
        case [("for" | "pick") as word, ("each" | "all" | "every" | "any") as more], _ if failure.kind == "NAME":
            span = failure.span(failure.line[1])
            return failure.finding(Code.FOREIGN, f"`{word} {more}` is `{word}`", span, f"remove `{more}`")
        case ["for" | "pick" | "on", *_], "of" if "IN" in failure.accepts:
            return failure.finding(Code.FOREIGN, "the word before a set or list is `in`, not `of`", help="write `in`")
    return None


HINTS: tuple[Hint, ...] = (call, wait, each)
