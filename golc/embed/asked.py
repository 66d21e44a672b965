"""What Python asks of a term at once, before there is a situation: what to say of it, at the place where it asks."""

from __future__ import annotations

import ast
import contextlib
import contextvars
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from types import FrameType, ModuleType
from typing import NoReturn

from golc.diagnostics import Code, Source, Span
from golc.embed.errors import Refused, meaningless, refused
from golc.embed.places import caller, calling_frame, node_at, span_of, tree_of
from golc.embed.reading.refusals import IDENTITY, OPERATORS

TRANSLATED = "write it in a translated function: `@theory.goal`, `@theory.define` …"
_INSTEAD: Mapping[str, str] = {
    "any": "write `exists(station, lambda n: …)`, or write it in a translated function",
    "all": "write `forall(station, lambda n: …)`, or write it in a translated function",
}
_DECIDING: Mapping[type[ast.AST], str] = {
    ast.If: "if",
    ast.While: "while",
    ast.IfExp: "… if … else …",
    ast.Assert: "assert",
}

_translating: contextvars.ContextVar[bool] = contextvars.ContextVar("translating", default=False)


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
    word, test = _decisions(span.source).get((span.start, span.end), ("", None))
    if test is not None:
        span = span_of(span.source, test)
    if isinstance(test or node_at(span), ast.Compare) and is_membership(span):
        return membership(span)
    what, help_ = _asking(test or node_at(span), word)
    return refused(Code.PYTHON_TRUTH, f"{what} a term for its truth now, before there is a situation", span, help_)


def _asking(node: ast.expr | None, word: str) -> tuple[str, str]:
    """What it is that asks, as the beginning of a sentence, and what to write instead; ``word``: what decides by it."""
    match node:
        case ast.Compare(ops=ops, comparators=others) if len(ops) > 1:
            help_ = "write two comparisons: `(a <= x) & (x <= b)`"
            if any(isinstance(each, ast.BinOp) and isinstance(each.op, (ast.BitAnd, ast.BitOr)) for each in others):
                help_ = "`&` and `|` bind before comparisons do: write `(a == x) & (b == y)`"
            return "a chain of comparisons asks", f"{help_}; or write it in a translated function"
        case ast.BoolOp(op=op):
            sign = ("and", "&") if isinstance(op, ast.And) else ("or", "|")
            return f"`{sign[0]}` asks", f"write `(…) {sign[1]} (…)`, or write it in a translated function"
        case ast.UnaryOp(op=ast.Not()):
            return "`not` asks", "write `~(…)`, or write it in a translated function"
    if word:
        help_ = "Python decides it once, while it makes the theory: write it in a translated function"
        return f"`{word}` asks", help_
    match node:
        case ast.Call(func=ast.Name(id=called) | ast.Attribute(attr=called)):
            return f"`{called}` asks", _INSTEAD.get(called, TRANSLATED)
    signs = "write `&`, `|` and `~` with each comparison in parentheses; or write it in a translated function"
    return "`if`, `and`, `or`, `not` and a chain of comparisons ask", signs


@cache
def _decisions(source: Source) -> dict[tuple[int, int], tuple[str, ast.expr]]:
    """The conditions in a source, each with the word that asks for it.

    By the place of the condition, and by that of what it decides, which is what Python gives for a call or a name.
    """
    found: dict[tuple[int, int], tuple[str, ast.expr]] = {}
    for node in ast.walk(tree_of(source)):
        match node:
            case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test) | ast.Assert(test=test):
                tests, word = [test], _DECIDING[type(node)]
            case ast.ListComp() | ast.SetComp() | ast.GeneratorExp() | ast.DictComp():
                tests, word = [test for each in node.generators for test in each.ifs], "if"
            case _:
                continue
        places = [(test, test) for test in tests] + ([(node, tests[0])] if len(tests) == 1 else [])
        for place, test in places:
            span = span_of(source, place)
            found[span.start, span.end] = (word, test)
    return found


def membership(span: Span) -> Refused:
    """Python looks for a term among others."""
    return meaningless("Python's `in` answers at once, before there is a situation", span, TRANSLATED)


def is_membership(span: Span) -> bool:
    """Whether Python is looking for something with ``in``."""
    match node_at(span):
        case ast.Compare(ops=ops):
            return any(isinstance(op, (ast.In, ast.NotIn)) for op in ops)
    return False


def answered(span: Span, is_open: Callable[[object], bool]) -> Refused | None:
    """What to say of a truth value that is Python's answer to ``is`` or ``in`` about a term, if it is one."""
    node = node_at(span)
    if not isinstance(node, ast.Compare):
        return None
    kinds = (ast.Is, ast.IsNot, ast.In, ast.NotIn)
    if not any(isinstance(op, kinds) for op in node.ops) or not _speaks_of(node, calling_frame(), is_open):
        return None
    if is_membership(span):
        return membership(span)
    sign = "!=" if any(isinstance(op, ast.IsNot) for op in node.ops) else "=="
    return meaningless(IDENTITY, span, f"write `{sign}`; if Python's answer is meant, `bool({span.text})`")


def _speaks_of(node: ast.expr, frame: FrameType, is_open: Callable[[object], bool]) -> bool:
    """Whether a name in an expression that a frame computes stands for something whose value is not known yet."""
    for each in ast.walk(node):
        match each:
            case ast.Name(id=name):
                value = frame.f_locals.get(name, frame.f_globals.get(name))
            case ast.Attribute(value=ast.Name(id=owner), attr=name):
                module = frame.f_locals.get(owner, frame.f_globals.get(owner))
                value = vars(module).get(name) if isinstance(module, ModuleType) else None
            case _:
                continue
        if is_open(value):
            return True
    return False


def length() -> Refused:
    """Python's ``len`` asks how long a term is."""
    return meaningless("Python's `len` answers at once, before there is a situation", caller(), TRANSLATED)


def elements() -> Refused:
    """Python goes through a term."""
    help_ = "a loop or comprehension in a translated function goes through it: `for x in …`"
    return meaningless("Python cannot go through a term, whose value depends on the situation", caller(), help_)


def place_in_a_table() -> Refused:
    """Python looks a term up in a dictionary or a set."""
    help_ = "make a dictionary a static, whose value is this dictionary; write a set with `{…}` in the function"
    return looked_up(caller(), help_)


def looked_up(span: Span, help_: str) -> Refused:
    """Python looks a term up in something; what helps depends on what that is."""
    return meaningless("Python looks a term up at once, before there is a situation", span, help_)


def text() -> Refused:
    """Python writes a term into a string."""
    help_ = 'write the term into the message itself: `say(f"{e}")`'
    return meaningless("Python writes a term at once, before there is a situation", caller(), help_)


def _operator(kind: type[ast.operator]) -> Callable[[object, object], NoReturn]:
    """What Python calls for an operator that has no meaning on terms."""

    def refuse(self: object, other: object) -> NoReturn:
        message, help_ = OPERATORS[kind]
        raise meaningless(message, caller(), help_)

    return refuse


def _number(self: object, *_: object) -> NoReturn:
    """Python needs the number itself: to convert or round it, to count up to it, as an index."""
    span = caller()
    match node_at(span):
        case ast.Subscript():
            help_ = "make the list a static, whose value is a table: `start = theory.static(…)`"
        case ast.Call(func=ast.Name(id="range")):
            help_ = "write `interval(1, n)`, or go through it in a translated function"
        case _:
            help_ = "`+`, `-`, `*`, `//`, `%` and `abs` of terms are terms; what Python computes can be an extern"
    raise meaningless("Python asks for the number that a term stands for, before there is a situation", span, help_)


class Unanswerable:
    """The operations of Python that have no meaning on terms."""

    __slots__ = ()

    __truediv__ = __rtruediv__ = _operator(ast.Div)
    __pow__ = __rpow__ = _operator(ast.Pow)
    __matmul__ = __rmatmul__ = _operator(ast.MatMult)
    __lshift__ = __rlshift__ = _operator(ast.LShift)
    __rshift__ = __rrshift__ = _operator(ast.RShift)
    __xor__ = __rxor__ = _operator(ast.BitXor)
    __int__ = __float__ = __complex__ = __index__ = __round__ = __divmod__ = __rdivmod__ = _number

    def __setitem__(self, index: object, value: object) -> NoReturn:
        raise meaningless("only actions change a fluent", caller(), "write `causes(f(x), value)` in an action")
