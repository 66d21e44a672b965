"""Types in translated functions: annotations, and what variables range over."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Any

from golc.diagnostics import Span
from golc.embed.errors import Refused, meaningless
from golc.embed.names import new_name
from golc.embed.reading.arguments import Arguments
from golc.embed.reading.evaluate import NOT_PYTHON
from golc.embed.types import (
    TypeObject,
    element,
    enum,
    enumeration,
    interval,
    is_built_in,
    join_nodes,
    optional,
    type_node,
    union,
)
from golc.syntax import tree
from golc.syntax.python_names import golc_name


class Annotations(Arguments):
    """Translates the types of one function."""

    def is_type(self, node: ast.expr) -> bool:
        """Whether an expression stands for a type."""
        if isinstance(node, ast.Call):
            called = self.python(node.func)
            if any(called is form for form in (interval, enum, union, optional, range)):
                return called is not range or len(node.args) < 3
        if isinstance(node, ast.Subscript):
            return self._is_collection(node.value)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.BitOr):
            return self.is_type(node.left)
        value = self.python(node)
        return isinstance(value, (TypeObject, range)) or is_built_in(value)

    def type(self, node: ast.expr) -> tree.Type:
        """The type that an annotation or an argument stands for. Raises ``Refused``."""
        span = self.span(node)
        match node:
            case ast.BinOp(left=left, op=ast.BitOr(), right=right):
                return self._union((left, right), span)
            case ast.Subscript(value=base, slice=inner) if self._is_collection(base):
                kind: Any = "set" if self.python(base) is set else "list"
                return tree.CollectionType(kind, self.type(inner), span=span)
            case ast.Call() if (form := self._form(node, span)) is not None:
                return form
            case ast.Constant(value=str() as text):
                return type_node(text, span)
        value = self.python(node)
        if value is NOT_PYTHON:
            raise meaningless("this is no type of the language", span, "write a declared type, `bool`, `int` …")
        return type_node(value, span)

    def _is_collection(self, node: ast.expr) -> bool:
        return any(self.python(node) is kind for kind in (set, list))

    def _form(self, node: ast.Call, span: Span) -> tree.Type | None:
        """A type that is the call of a word of the language, if it is one."""
        called = self.python(node.func)
        if called is interval:
            low, high = self.arguments(node, 2)
            return tree.IntervalType(self.expr(low), self.expr(high), span=span)
        if called is enum:
            return enumeration(tuple(self._element(arg) for arg in self.every_argument(node)), span)
        if called is union:
            return self._union(self.every_argument(node), span)
        if called is optional:
            return self._union([*self.arguments(node, 1), ast.Constant(None)], span)
        return None

    def _union(self, parts: Sequence[ast.expr], span: Span) -> tree.Type:
        types = [part for part in parts if not (isinstance(part, ast.Constant) and part.value is None)]
        return join_nodes([self.type(part) for part in types], len(types) < len(parts), span)

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
            span = self.span(arg)
            name = new_name(golc_name(arg.arg), Span(span.source, span.start, span.start + len(arg.arg)))
            found.append(tree.Parameter(name, self.annotation(arg.annotation or arg), span=span))
        return tuple(found)

    def result(self) -> tree.Type | None:
        """The type of what the function returns, if it says that."""
        returns = self.function.node.returns
        return None if returns is None else self.annotation(returns)

    def annotation(self, node: ast.expr | ast.arg) -> tree.Type:
        """The type in an annotation, in which parameters are not known; a name stands for one that is passed over.

        ``node`` is the parameter if it has none.
        """
        bound = set(self.bound)
        self.bound.clear()
        try:
            if isinstance(node, ast.arg):
                help_ = f"write `{node.arg}: station`"
                raise meaningless(f"the parameter `{node.arg}` has no type", self.span(node), help_)
            return self.type(node)
        except Refused as error:
            span = self.pass_over(error, node)
            return tree.TypeName(tree.Ident(tree.STAND_IN, span=span), span=span)
        finally:
            self.bound.update(bound)
