"""Expressions of translated functions: from Python's tree to the tree of the language."""

from __future__ import annotations

import ast
import contextlib
from collections.abc import Mapping, Sequence
from decimal import Decimal
from typing import Any, Literal

from golc.diagnostics import Code, Span
from golc.embed import words
from golc.embed.errors import Refused, meaningless, refused
from golc.embed.reading.binders import chain
from golc.embed.reading.calls import Calls
from golc.embed.reading.evaluate import NOT_PYTHON
from golc.embed.reading.refusals import EXPRESSIONS, IDENTITY, OPERATORS
from golc.embed.terms import PROGRAMS, Named, Variable, plain_names
from golc.embed.types import BUILT_IN, TypeForm, TypeHandle, interval, is_built_in
from golc.embed.values import expr
from golc.embed.words import Value, Word
from golc.syntax import tree
from golc.syntax.python_names import golc_name

_ARITHMETIC: Mapping[type[ast.operator], Any] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.FloorDiv: "//",
    ast.Mod: "%",
    ast.BitAnd: "and",
    ast.BitOr: "or",
}
_COMPARISONS: Mapping[type[ast.cmpop], Any] = {
    ast.Eq: "=",
    ast.NotEq: "!=",
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.In: "in",
    ast.NotIn: "not in",
}


class Expressions(Calls):
    """Translates the expressions of one function."""

    def expr(self, node: ast.expr) -> tree.Expr:
        """A term or formula; for Python that is none a name that stands for it, and what is wrong is kept."""
        try:
            return self._expr(node)
        except Refused as error:
            return self.stand_in(error, node)

    def stand_in(self, error: Refused, node: ast.AST) -> tree.Apply:
        """A name that stands for what is passed over."""
        span = self.pass_over(error, node)
        return tree.Apply(tree.Ident(tree.STAND_IN, span=span), (), span=span)

    def _expr(self, node: ast.expr) -> tree.Expr:
        known = len(self.found)
        try:
            value = self.python(node)
        except Refused:
            # The first name that means nothing has ended this; the parts tell of every one.
            made = None
            with contextlib.suppress(Refused):
                made = self._by_parts(node)
            if made is None or len(self.found) == known:
                raise
            return made
        if value is not NOT_PYTHON:
            return self._of_value(node, value)
        if (made := self._by_parts(node)) is not None:
            return made
        span = self.span(node)
        match node:
            case ast.Constant(value=constant):
                return self._literal(constant, span)
            case ast.Subscript(value=base, slice=index) if not isinstance(index, ast.Slice):
                return tree.Index(self.expr(base), self.expr(index), span=span)
            case ast.Call():
                return self.call_expr(node)
            case ast.Attribute(attr=name):
                raise meaningless(f"a term has no attribute `{name}`", span, "write `f(x)` for a fluent with arguments")
        part = node.slice if isinstance(node, ast.Subscript) else node
        wrong, instead = EXPRESSIONS.get(type(part), ("this has no meaning in a theory", None))
        raise meaningless(wrong, self.span(part), instead)

    def _by_parts(self, node: ast.expr) -> tree.Expr | None:
        """What an operation becomes, a message or a collection; none for any other expression."""
        match node:
            case ast.JoinedStr():
                return self.message(node)
            case ast.BoolOp() | ast.UnaryOp() | ast.BinOp() | ast.Compare() | ast.IfExp():
                return self._operation(node, self.span(node))
            case ast.Set() | ast.List() | ast.Tuple() | ast.SetComp() | ast.ListComp():
                return self._collection(node, self.span(node))
            case ast.Call(args=[ast.GeneratorExp()]):
                return self.quantifier(node)
        return None

    def _operation(self, node: ast.BoolOp | ast.UnaryOp | ast.BinOp | ast.Compare | ast.IfExp, span: Span) -> tree.Expr:
        match node:
            case ast.BoolOp(op=op, values=parts):
                return chain("and" if isinstance(op, ast.And) else "or", [self.expr(part) for part in parts])
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.expr(operand)
            case ast.UnaryOp(op=op, operand=operand):
                return tree.Unary("-" if isinstance(op, ast.USub) else "not", self.expr(operand), span=span)
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _ARITHMETIC:
                return tree.Binary(_ARITHMETIC[type(op)], self.expr(left), self.expr(right), span=span)
            case ast.BinOp(op=op):
                message, help_ = OPERATORS[type(op)]
                raise meaningless(message, span, help_)
            case ast.Compare():
                return self._comparison(node)
            case ast.IfExp(test=test, body=then, orelse=otherwise):
                return tree.IfElse(self.expr(then), self.expr(test), self.expr(otherwise), span=span)

    def _collection(self, node: ast.Set | ast.List | ast.Tuple | ast.SetComp | ast.ListComp, span: Span) -> tree.Expr:
        match node:
            case ast.Set(elts=parts):
                return tree.SetLiteral(tuple(self.expr(part) for part in self.spread(parts)), span=span)
            case ast.List(elts=parts) | ast.Tuple(elts=parts):
                return tree.ListLiteral(tuple(self.expr(part) for part in self.spread(parts)), span=span)
            case ast.SetComp(elt=part, generators=generators) | ast.ListComp(elt=part, generators=generators):
                kind: Literal["set", "list"] = "set" if isinstance(node, ast.SetComp) else "list"
                with self.generators(generators) as (binders, where):
                    return tree.Comprehension(kind, self.expr(part), binders, where, span=span)

    def value(self, node: ast.expr) -> tree.ValueExpr:
        """What a fluent can get: a term, ``unknown`` or ``one_of(…)``; as for ``expr`` whatever is wrong is kept."""
        try:
            return self._value(node)
        except Refused as error:
            return self.stand_in(error, node)

    def _value(self, node: ast.expr) -> tree.ValueExpr:
        if isinstance(node, ast.Call) and self.python(node.func) is words.one_of:
            (choices,) = self.arguments(node, 1)
            return tree.OneOf(self.expr(choices), span=self.span(node))
        if isinstance(node, (ast.Name, ast.Attribute)) and isinstance(value := self.python(node), Value):
            return words.value_expr(value, self.span(node))
        return self.expr(node)

    def application(self, node: ast.expr) -> tree.Apply:
        """A name of the theory with arguments or without: an action, a procedure, a fluent."""
        found = self.expr(node)
        if not isinstance(found, tree.Apply):
            help_ = "write the name of an action or a fluent, with its arguments"
            error = meaningless("this is no action, procedure or fluent", self.span(node), help_)
            return self.stand_in(error, node)
        return found

    def message(self, node: ast.expr) -> tree.Message:
        """A string or an f-string, whose holes are terms."""
        parts: list[str | tree.Expr] = []
        pieces = node.values if isinstance(node, ast.JoinedStr) else [node]
        for piece in pieces:
            match piece:
                case ast.FormattedValue(value=hole, conversion=-1, format_spec=None):
                    value = self.expr(hole)
                    # A string of Python becomes a part of the text.
                    parts += value.parts if isinstance(value, tree.Message) else [value]
                case ast.FormattedValue():
                    raise meaningless("a hole in a message has no format", self.span(piece), "write `{e}` alone")
                case _:
                    text = self._expr(piece)
                    if not isinstance(text, tree.Message):
                        written = self.span(node).text
                        help_ = 'write one `f"… {e}"`' if '"' in written else f'write `f"{{{written}}}"`'
                        raise meaningless("a message is a string or an f-string", self.span(node), help_)
                    parts += text.parts
        return tree.Message(_joined(parts), span=self.span(node))

    def _of_value(self, node: ast.expr, value: object) -> tree.Expr:
        span = self.span(node)
        if isinstance(value, TypeHandle):
            return expr(value, span)
        if is_built_in(value):
            return tree.Apply(tree.Ident(BUILT_IN[value], span=span), (), span=span)
        if isinstance(value, Value):
            raise refused(Code.MISUSED_NAME, f"`{span.text}` stands only for the whole value of a fluent", span)
        if isinstance(value, Word):
            called = isinstance(value, words.Operator)
            help_ = f"write `{value.name}(…)`" if called else f"it belongs in {value.place}"
            raise refused(Code.MISUSED_NAME, f"`{value.name}` is no term", span, help_)
        found = expr(value, span)
        self._check_names(value, found, span)
        return found

    def _check_names(self, value: object, found: tree.Expr, span: Span) -> None:
        """Raise ``Refused`` if something declared would be taken for a variable that has its name in the theory."""
        if isinstance(value, Named) and value.kind in ("variable", *PROGRAMS):
            return
        taken = {golc_name(name) for name in self.bound}
        hidden = next((name for name in plain_names(found) if name in taken and not isinstance(name, Variable)), None)
        if hidden is not None:
            message = f"what is `{hidden}` in the theory cannot be meant where a variable has this name"
            raise meaningless(message, span, "give the variable another name")

    def _literal(self, value: object, span: Span) -> tree.Expr:
        if isinstance(value, float):
            return expr(Decimal(span.text.replace("_", "")), span)
        if isinstance(value, (bool, int, str)) or value is None:
            return expr(value, span)
        raise refused(Code.PYTHON_VALUE, f"`{span.text}` means nothing in a theory", span)

    def _comparison(self, node: ast.Compare) -> tree.Expr:
        """``a <= b <= c`` says two things, joined by ``and``."""
        sides = [node.left, *node.comparators]
        found: list[tree.Expr] = []
        for left, op, right in zip(sides, node.ops, node.comparators, strict=False):
            if isinstance(op, (ast.Is, ast.IsNot)):
                sign = "!=" if isinstance(op, ast.IsNot) else "=="
                raise meaningless(IDENTITY, self.span(node), f"write `{sign}`")
            membership = isinstance(op, (ast.In, ast.NotIn))
            first, second = self.expr(left), self._range(right) if membership else self.expr(right)
            span = self.span(node) if len(node.ops) == 1 else first.span.to(second.span)
            found.append(tree.Binary(_COMPARISONS[type(op)], first, second, span=span))
        return chain("and", found)

    def _range(self, node: ast.expr) -> Any:
        """The right side of ``in``: a term, or an interval."""
        if isinstance(node, ast.Call) and self.python(node.func) is interval:
            return self.type(node)
        value = self.python(node)
        return value.node if isinstance(value, TypeForm) else self.expr(node)


def _joined(parts: Sequence[str | tree.Expr]) -> tuple[str | tree.Expr, ...]:
    """The parts of a message with neighbouring texts as one."""
    joined: list[str | tree.Expr] = []
    for part in parts:
        if isinstance(part, str) and joined and isinstance(joined[-1], str):
            joined[-1] += part
        elif part != "":
            joined.append(part)
    return tuple(joined)
