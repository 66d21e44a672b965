"""What a term has to be where it stands, and what to say if it is not."""

from __future__ import annotations

from golc.diagnostics import Code, Span
from golc.theory.context import Context
from golc.theory.fitting import BROKEN, describe, overlap, strip_optional
from golc.theory.terms import Literal, Operation, Operator, Quantified, Term
from golc.theory.types import BOOL, NONE, Type, show


def broken(span: Span) -> Term:
    """What stands for a term that could not be elaborated."""
    return Literal(None, type=BROKEN, span=span)


def fits(context: Context, found: Term, needed: Type, what: str) -> bool:
    """Whether a term may have a value of a type; otherwise a finding. Constants have to be values of it."""
    if needed is BROKEN:
        return True
    stack, good = [found], True
    while stack:
        part = stack.pop()
        if isinstance(part, Operation) and part.op is Operator.CONDITIONAL:
            stack.extend((part.args[2], part.args[0]))
        elif isinstance(part, Literal) and part.type is not BROKEN and overlap(part.type, needed):
            if part.value not in needed:
                value = "" if shown(part) == show(part.value) else f" is {show(part.value)}, which"
                message = f"`{shown(part)}`{value} is outside {describe(needed)}"
                context.error(Code.OUTSIDE_TYPE, message, part.span, f"{what} needs {describe(needed)}")
                good = False
        elif not overlap(part.type, needed):
            mismatch(context, part, describe(needed), what, _cure(part, needed))
            good = False
    return good


def mismatch(context: Context, found: Term, needed: str, what: str, help: str | None = None) -> None:
    """Report a term of the wrong type."""
    if found.type == NONE:
        message = f"{what} needs {needed}, and `none` is no such value"
        context.error(Code.TYPE_MISMATCH, message, found.span, "never `none`", help)
    else:
        type_ = f"of type {describe(found.type)}"
        message = f"`{shown(found)}` is {type_}, but {what} needs {needed}"
        context.error(Code.TYPE_MISMATCH, message, found.span, f"this is {type_}", help)


def _cure(found: Term, needed: Type) -> str | None:
    if isinstance(found, Literal) and found.value is None:
        return f"the type `{needed}?` has the value `none`, too"
    if needed == BOOL and isinstance(found, Quantified):
        return f"write `({found.kind} …) = …`: without parentheses `{found.kind}` takes in everything to its right"
    if needed == BOOL:
        return f"compare it: `{shown(found)} = …`"
    return None


def shown(found: Term) -> str:
    """A term as it is written, for a message; a long one is cut off."""
    text = " ".join(found.span.text.split())
    return text if 0 < len(text) <= 40 else text[:39] + "…" if text else "this term"


def typed(found: Term) -> str:
    """A term with its type, for a message."""
    type_ = strip_optional(found.type)
    return f"`{shown(found)}`" if found.type == NONE else f"`{shown(found)}`, which is of type `{type_}`,"


def both(left: Term, right: Term) -> str:
    """Two terms with their types, for a message."""
    return f"{typed(left)} and {typed(right)}"
