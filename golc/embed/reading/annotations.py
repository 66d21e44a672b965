"""Types in translated functions: annotations, and what variables range over."""

from __future__ import annotations

import ast
import contextlib
from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import Any

from golc.diagnostics import Code, Span
from golc.embed.errors import meaningless, refused
from golc.embed.names import golc_name, new_name
from golc.embed.reading.evaluate import NOT_PYTHON, Evaluator
from golc.embed.reading.functions import Function
from golc.embed.types import (
    TypeObject,
    element,
    enum,
    enumeration,
    interval,
    join_nodes,
    optional,
    type_node,
    union,
)
from golc.embed.values import elements
from golc.syntax import tree


class Annotations(ABC):
    """Translates the types of one function. ``bound`` are the variables of the language at the place."""

    def __init__(self, function: Function) -> None:
        self.function = function
        self.bound: set[str] = {arg.arg for arg in function.parameters()}
        self.python = Evaluator(function, self.bound.__contains__)

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

    def is_type(self, node: ast.expr) -> bool:
        """Whether an expression stands for a type."""
        if isinstance(node, ast.Call):
            called = self.python(node.func)
            if any(called is form for form in (interval, enum, union, optional, range)):
                return called is not range or len(node.args) < 3
        if isinstance(node, ast.Subscript):
            return any(self.python(node.value) is kind for kind in (set, list))
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
            return self.is_type(node.left)
        value = self.python(node)
        return isinstance(value, (TypeObject, range)) or any(value is kind for kind in (bool, int, str, float))

    def type(self, node: ast.expr) -> tree.Type:
        """The type that an annotation or an argument stands for. Raises ``Refused``."""
        span = self.span(node)
        match node:
            case ast.BinOp(left=left, op=ast.BitOr(), right=right):
                parts = [part for part in (left, right) if not _is_none(part)]
                pieces: list[tree.Type] = []
                for part in parts:
                    found = self.type(part)
                    pieces += found.pieces if isinstance(found, tree.UnionType) else [found]
                return join_nodes(pieces, len(parts) == 1, span)
            case ast.Subscript(value=base, slice=inner) if any(self.python(base) is kind for kind in (set, list)):
                kind: Any = "set" if self.python(base) is set else "list"
                return tree.CollectionType(kind, self.type(inner), span=span)
            case ast.Call(func=function):
                called = self.python(function)
                if called is interval:
                    low, high = self.arguments(node, 2)
                    return tree.IntervalType(self.expr(low), self.expr(high), span=span)
                if called is enum:
                    args = self.every_argument(node)
                    return enumeration(tuple(self._element(arg) for arg in args), span)
                if called is union or called is optional:
                    pieces = [self.type(arg) for arg in self.every_argument(node)]
                    return join_nodes(pieces, called is optional, span)
            case ast.Constant(value=str() as text):
                return type_node(text, span)
        value = self.python(node)
        if value is NOT_PYTHON:
            raise meaningless("this is no type of the language", span, "write a declared type, `bool`, `int` …")
        return type_node(value, span)

    def _element(self, node: ast.expr) -> tree.Ident | tree.Number:
        match node:
            case ast.Constant(value=value):
                return element(value, self.span(node))
            case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() as value)):
                return element(-value, self.span(node))
        return element(self.python(node), self.span(node))

    def parameters(self) -> tuple[tree.Parameter, ...]:
        """The parameters of the function with their types."""
        found = []
        for arg in self.function.parameters():
            name = new_name(
                golc_name(arg.arg),
                Span(self.span(arg).source, self.span(arg).start, self.span(arg).start + len(arg.arg)),
            )
            if arg.annotation is None:
                raise meaningless(
                    f"the parameter `{arg.arg}` has no type", self.span(arg), f"write `{arg.arg}: station`"
                )
            found.append(tree.Parameter(name, self.annotation(arg.annotation), span=self.span(arg)))
        return tuple(found)

    def result(self) -> tree.Type | None:
        """The type of what the function returns, if it says that."""
        returns = self.function.node.returns
        return None if returns is None else self.annotation(returns)

    def annotation(self, node: ast.expr) -> tree.Type:
        """The type in an annotation, in which parameters are not known."""
        bound = set(self.bound)
        self.bound.clear()
        try:
            return self.type(node)
        finally:
            self.bound.update(bound)

    def arguments(self, node: ast.Call, count: int, named: Sequence[str] = ()) -> list[ast.expr]:
        """The arguments by place of a call of a word, which are ``count``; those by name are among ``named``."""
        for word in node.keywords:
            if word.arg not in named:
                known = ", ".join(f"`{each}=`" for each in named)
                help_ = f"it takes {known}" if known else "it takes arguments by place only"
                raise refused(Code.ARITY, f"`{ast.unparse(node.func)}` takes no `{word.arg}=`", self.span(word), help_)
        given = self.spread(node.args)
        if len(given) != count:
            takes = f"{count} argument{'s' * (count != 1)}" if count else "no arguments"
            message = f"`{ast.unparse(node.func)}` takes {takes} by place, not {len(given)}"
            raise refused(Code.ARITY, message, self.span(node))
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


def _is_none(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None
