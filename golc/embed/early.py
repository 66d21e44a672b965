"""What Python asks of a term at once, though its value depends on the situation, and there is none yet."""

from __future__ import annotations

import ast
import contextlib
import contextvars
from collections.abc import Iterator

from golc.diagnostics import Code
from golc.embed.errors import Refused, meaningless, refused
from golc.embed.places import caller, node_at

_translating: contextvars.ContextVar[bool] = contextvars.ContextVar("translating", default=False)

_TRANSLATED = "write it in a translated function: `@theory.goal`, `@theory.define` …"


@contextlib.contextmanager
def translating() -> Iterator[None]:
    """While this lasts Python runs for a translated function: terms stand for values that nobody knows yet."""
    token = _translating.set(True)
    try:
        yield
    finally:
        _translating.reset(token)


def is_translating() -> bool:
    """Whether Python runs for a translated function, rather than from top to bottom through a module."""
    return _translating.get()


def truth() -> Refused:
    """Python asks a term for its truth."""
    span = caller()
    what = "`if`, `and`, `or`, `not` and a chain of comparisons ask a term for its truth"
    help_ = "write `&`, `|` and `~` with each comparison in parentheses;"
    match node_at(span):
        case ast.Compare(ops=ops) if len(ops) > 1:
            what = "a chain of comparisons asks a term for its truth"
            help_ = "write two comparisons: `(a <= x) & (x <= b)`;"
        case ast.BoolOp(op=op):
            word, sign = ("and", "&") if isinstance(op, ast.And) else ("or", "|")
            what, help_ = f"`{word}` asks a term for its truth", f"write `(…) {sign} (…)`,"
        case ast.UnaryOp(op=ast.Not()):
            what, help_ = "`not` asks a term for its truth", "write `~(…)`,"
    message = f"{what} now, before there is a situation"
    return refused(Code.PYTHON_TRUTH, message, span, f"{help_} or write it in a translated function")


def membership() -> Refused:
    """Python's ``in`` asks what is in a term or a type."""
    return meaningless("Python's `in` answers at once, before there is a situation", caller(), _TRANSLATED)


def length() -> Refused:
    """Python's ``len`` asks how long a term is."""
    return meaningless("Python's `len` answers at once, before there is a situation", caller(), _TRANSLATED)


def elements() -> Refused:
    """Python goes through a term."""
    return meaningless("Python cannot go through a term, whose value depends on the situation", caller())


def place_in_a_table() -> Refused:
    """Python looks a term up in a dictionary or a set."""
    help_ = "make a dictionary a static, whose value is this dictionary; write a set with `{…}` in the function"
    return meaningless("Python looks a term up at once, before there is a situation", caller(), help_)


def text() -> Refused:
    """Python writes a term into a string."""
    help_ = 'write the term into the message itself: `say(f"{e}")`'
    return meaningless("Python writes a term at once, before there is a situation", caller(), help_)
