"""What every part of one translated function needs: places, the variables at a place, the arguments of calls."""

from __future__ import annotations

import ast
import contextlib
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import Any

from golc.diagnostics import Code, Diagnostic, Span, counted
from golc.embed.errors import Refused, refused
from golc.embed.reading.evaluate import Evaluator
from golc.embed.reading.functions import Function
from golc.embed.values import elements
from golc.syntax import tree


class Arguments(ABC):
    """Looks at one function. ``bound`` are the variables of the language at the place, by their Python names.

    ``unread`` are the parts that have been passed over so far, and ``found`` is what is said of them, each once;
    ``rounds`` is how often bodies of loops of Python have been written out.
    """

    def __init__(self, function: Function) -> None:
        self.function = function
        self.found: dict[Diagnostic, None] = {}
        self.unread: list[Span] = []
        self.rounds = 0
        self.bound: set[str] = {arg.arg for arg in function.parameters()}
        self.python = Evaluator(function, self.bound.__contains__)

    def pass_over(self, error: Refused, node: Any) -> Span:
        """Keep what is said of a part that cannot be translated, and go on without it."""
        span = self.span(node)
        self.found.update(dict.fromkeys(error.diagnostics))
        self.unread.append(span)
        return span

    def span(self, node: Any) -> Span:
        return self.function.place(node)

    @contextlib.contextmanager
    def scope(self, names: Sequence[str]) -> Iterator[None]:
        """Some names are variables of the language while this lasts."""
        new = [name for name in names if name not in self.bound]
        self.bound.update(new)
        try:
            yield
        finally:
            self.bound.difference_update(new)

    @abstractmethod
    def expr(self, node: ast.expr) -> tree.Expr:
        """A term or formula."""

    def arguments(self, node: ast.Call, count: int, named: Sequence[str] = ()) -> list[ast.expr]:
        """The arguments by place of a call of a word, which are ``count``; those by name are among ``named``."""
        known = ", ".join(f"`{each}=`" for each in named)
        for word in node.keywords:
            if word.arg not in named:
                help_ = f"it takes {known}" if known else "it takes arguments by place only"
                raise refused(Code.ARITY, f"`{ast.unparse(node.func)}` takes no `{word.arg}=`", self.span(word), help_)
        given = self.spread(node.args)
        if len(given) != count:
            takes = counted(count, "argument") if count else "no arguments"
            message = f"`{ast.unparse(node.func)}` takes {takes} by place, not {len(given)}"
            by_name = f"it takes {known}" if known and len(given) > count else None
            raise refused(Code.ARITY, message, self.span(node), by_name)
        return given

    def every_argument(self, node: ast.Call, named: Sequence[str] = ()) -> list[ast.expr]:
        """The arguments by place of a call of a word that takes any number of them."""
        return self.arguments(node, len(self.spread(node.args)), named)

    def spread(self, nodes: Sequence[ast.expr]) -> list[ast.expr]:
        """Expressions in a row; ``*values`` of a list of Python are its elements."""
        found: list[ast.expr] = []
        for node in nodes:
            values = self.python(node.value) if isinstance(node, ast.Starred) else None
            if isinstance(node, ast.Starred) and isinstance(values, (list, tuple, range)):
                numbers = (ast.Constant(k) for k, _ in enumerate(elements(values, self.span(node))))
                parts = [ast.Subscript(node.value, number, ast.Load()) for number in numbers]
                found += [ast.fix_missing_locations(ast.copy_location(part, node)) for part in parts]
            else:
                found.append(node)
        return found

    def keyword(self, node: ast.Call, name: str) -> ast.expr | None:
        """The argument of a call by name, if it is given."""
        return next((word.value for word in node.keywords if word.arg == name), None)
