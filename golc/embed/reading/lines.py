"""Bodies whose lines are calls of words: actions, axioms, scenarios, devices."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from types import FunctionType
from typing import Any

from golc.embed import words
from golc.embed.errors import meaningless
from golc.embed.reading.bodies import Bodies, T
from golc.syntax import tree


class Lines(Bodies):
    """Translates lines of a declaration's body."""

    def lines(self, translate: Callable[[ast.stmt], Iterable[T]]) -> tuple[T, ...]:
        """What the lines of the body become; ``pass`` is the body of one that has none."""
        return self.each([node for node in self.function.body() if not isinstance(node, ast.Pass)], translate)

    def call(
        self, node: ast.stmt, allowed: str, meant: Mapping[type[ast.stmt], str] | None = None
    ) -> tuple[ast.Call, words.Word]:
        """The call that a statement is, and its word, which is one of those allowed.

        Raises ``Refused`` for any other statement; ``meant`` tells what was probably meant by one.
        """
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
            called = self.python(node.value.func)
            if isinstance(called, words.Word) and called.name in allowed.split():
                return node.value, called
            if isinstance(called, FunctionType):
                help_ = f"write the lines of `{called.__name__}` here"
                raise meaningless("a function of Python does nothing in a declaration", self.head(node), help_)
        help_ = "write " + ", ".join(f"`{name}(…)`" for name in allowed.split())
        raise meaningless("this line has no meaning here", self.head(node), (meant or {}).get(type(node), help_))

    def constant(self, node: ast.expr) -> Any:
        """A constant argument: an integer, a truth value, ``None``, a symbol."""
        match self.value(node):
            case tree.Number() | tree.Truth() | tree.Nothing() as constant:
                return constant
            case tree.Unary(op="-", operand=tree.Number(value=value)):
                return tree.Number(-value, span=self.span(node))
            case tree.Apply(name=name, args=()):
                return name
        raise meaningless(
            "this is no constant", self.span(node), "write a symbol, an integer, `True`, `False` or `None`"
        )

    def when(self, call: ast.Call) -> tree.Expr | None:
        """The condition of a line."""
        when = self.keyword(call, "when")
        return None if when is None else self.expr(when)
