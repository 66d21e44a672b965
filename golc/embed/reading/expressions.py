"""Expressions of translated functions: from Python's tree to the tree of the language."""

from __future__ import annotations

import ast
import builtins
import contextlib
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from typing import Any

from golc.diagnostics import Code, Span
from golc.embed import words
from golc.embed.errors import Refused, meaningless, refused
from golc.embed.names import golc_name, new_name
from golc.embed.reading.annotations import Annotations
from golc.embed.reading.evaluate import NOT_PYTHON
from golc.embed.reading.refusals import EXPRESSIONS, OPERATORS
from golc.embed.terms import Named, Variable, in_order, plain_names
from golc.embed.types import (
    BUILT_IN,
    TypeForm,
    TypeHandle,
    interval,
)
from golc.embed.values import expr
from golc.embed.words import Value, Word
from golc.syntax import tree

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
_QUANTIFIERS: Mapping[object, tree.QuantifierKind] = {
    builtins.any: "exists",
    builtins.all: "forall",
    builtins.sum: "sum",
    builtins.min: "min",
    builtins.max: "max",
    words.count: "count",
}
_EPISTEMIC: Mapping[object, Any] = {words.known: "known", words.knows: "knows", words.possible: "possible"}
_FUNCTIONS: Mapping[object, str] = {
    builtins.abs: "abs",
    builtins.len: "len",
    words.first: "first",
    words.rest: "rest",
    words.before: "before",
    words.poss: "poss",
}
_CONNECTIVES: Mapping[object, Any] = {words.implies: "implies", words.iff: "iff"}


class Expressions(Annotations):
    """Translates the expressions of one function."""

    def expr(self, node: ast.expr) -> tree.Expr:
        """A term or formula. Raises ``Refused`` for Python that is none."""
        value = self.python(node)
        if value is not NOT_PYTHON:
            return self._of_value(node, value)
        span = self.span(node)
        match node:
            case ast.Constant(value=constant):
                return self._literal(node, constant, span)
            case ast.JoinedStr():
                return self.message(node)
            case ast.BoolOp(op=op, values=parts):
                word: Any = "and" if isinstance(op, ast.And) else "or"
                return self._chain(word, [self.expr(part) for part in parts])
            case ast.UnaryOp(op=op, operand=operand):
                return self._prefix(op, operand, span)
            case ast.BinOp(left=left, op=op, right=right):
                if type(op) not in _ARITHMETIC:
                    message, help_ = OPERATORS[type(op)]
                    raise meaningless(message, span, help_)
                return tree.Binary(_ARITHMETIC[type(op)], self.expr(left), self.expr(right), span=span)
            case ast.Compare():
                return self._comparison(node)
            case ast.IfExp(test=test, body=then, orelse=otherwise):
                return tree.IfElse(self.expr(then), self.expr(test), self.expr(otherwise), span=span)
            case ast.Subscript(value=base, slice=index) if not isinstance(index, ast.Slice):
                return tree.Index(self.expr(base), self.expr(index), span=span)
            case ast.Set(elts=parts):
                return tree.SetLiteral(tuple(self.expr(part) for part in self.spread(parts)), span=span)
            case ast.List(elts=parts) | ast.Tuple(elts=parts):
                return tree.ListLiteral(tuple(self.expr(part) for part in self.spread(parts)), span=span)
            case ast.SetComp(elt=part, generators=generators) | ast.ListComp(elt=part, generators=generators):
                kind: Any = "set" if isinstance(node, ast.SetComp) else "list"
                with self.generators(generators) as (binders, where):
                    return tree.Comprehension(kind, self.expr(part), binders, where, span=span)
            case ast.Call():
                return self._call(node)
            case ast.Attribute(attr=name):
                raise meaningless(f"a term has no attribute `{name}`", span, "write `f(x)` for a fluent with arguments")
        part = node.slice if isinstance(node, ast.Subscript) else node
        wrong, instead = EXPRESSIONS.get(type(part), ("this has no meaning in a theory", None))
        raise meaningless(wrong, self.span(part), instead)

    def value(self, node: ast.expr) -> tree.ValueExpr:
        """What a fluent can get: a term, ``unknown`` or ``one_of(…)``."""
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
            raise meaningless("this is no action, procedure or fluent", self.span(node), help_)
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
                    text = self.expr(piece)
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
        if isinstance(value, type) and value in BUILT_IN:
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
        if isinstance(value, Named) and value.kind in ("variable", "action", "exogenous action", "procedure"):
            return
        taken = {golc_name(name) for name in self.bound}
        hidden = next((name for name in plain_names(found) if name in taken and not isinstance(name, Variable)), None)
        if hidden is not None:
            message = f"what is `{hidden}` in the theory cannot be meant where a variable has this name"
            raise meaningless(message, span, "give the variable another name")

    def _literal(self, node: ast.Constant, value: object, span: Span) -> tree.Expr:
        if isinstance(value, float):
            text = span.text.replace("_", "")
            return expr(Decimal(text), span)
        if isinstance(value, (bool, int, str)) or value is None:
            return expr(value, span)
        raise refused(Code.PYTHON_VALUE, f"`{span.text}` means nothing in a theory", span)

    def _prefix(self, op: ast.unaryop, operand: ast.expr, span: Span) -> tree.Expr:
        if isinstance(op, ast.UAdd):
            return self.expr(operand)
        word: Any = "-" if isinstance(op, ast.USub) else "not"
        return tree.Unary(word, self.expr(operand), span=span)

    def _chain(self, word: Any, parts: Sequence[tree.Expr]) -> tree.Expr:
        whole, *rest = parts
        for part in rest:
            whole = tree.Binary(word, whole, part, span=whole.span.to(part.span))
        return whole

    def _comparison(self, node: ast.Compare) -> tree.Expr:
        """``a <= b <= c`` says two things, joined by ``and``."""
        sides = [node.left, *node.comparators]
        found: list[tree.Expr] = []
        for left, op, right in zip(sides, node.ops, node.comparators, strict=False):
            if isinstance(op, (ast.Is, ast.IsNot)):
                sign = "!=" if isinstance(op, ast.IsNot) else "=="
                message = "`is` asks for one object of Python, not for equal values"
                raise meaningless(message, self.span(node), f"write `{sign}`")
            membership = isinstance(op, (ast.In, ast.NotIn))
            first, second = self.expr(left), self.range(right) if membership else self.expr(right)
            span = self.span(node) if len(node.ops) == 1 else first.span.to(second.span)
            found.append(tree.Binary(_COMPARISONS[type(op)], first, second, span=span))
        return self._chain("and", found)

    def range(self, node: ast.expr) -> Any:
        """The right side of ``in``: a term, or an interval."""
        if isinstance(node, ast.Call) and self.python(node.func) is interval:
            return self.type(node)
        value = self.python(node)
        return value.node if isinstance(value, TypeForm) else self.expr(node)

    # Calls

    def _call(self, node: ast.Call) -> tree.Expr:
        span = self.span(node)
        called = self.python(node.func)
        if isinstance(called, Named):
            return self._apply(node, called, span)
        if called in (builtins.set, builtins.list) and not node.args and not node.keywords:
            return tree.SetLiteral((), span=span) if called is builtins.set else tree.ListLiteral((), span=span)
        kind = next((found for word, found in _QUANTIFIERS.items() if called is word), None)
        if kind is not None and len(node.args) == 1 and isinstance(node.args[0], ast.GeneratorExp):
            self.arguments(node, 1)
            generator = node.args[0]
            with self.generators(generator.generators) as (binders, where):
                return tree.Quantifier(kind, binders, where, self.expr(generator.elt), span=span)
        if kind in ("min", "max") and len(node.args) > 1:
            args = tuple(self.expr(arg) for arg in self.every_argument(node))
            return tree.Extremum(kind, args, span=span)
        return self._word_call(node, called, span)

    def _word_call(self, node: ast.Call, called: object, span: Span) -> tree.Expr:
        for table, build in ((_FUNCTIONS, self._function), (_EPISTEMIC, tree.Epistemic)):
            word: Any = next((found for each, found in table.items() if called is each), None)
            if word is not None:
                (argument,) = self.arguments(node, 1)
                return build(word, self.expr(argument), span=span)
        if called is words.implies or called is words.iff:
            left, right = self.arguments(node, 2)
            return tree.Binary(_CONNECTIVES[called], self.expr(left), self.expr(right), span=span)
        raise self._uncallable(node, called)

    def _function(self, word: str, argument: tree.Expr, span: Span) -> tree.Expr:
        return tree.Apply(
            tree.Ident(word, span=Span(span.source, span.start, span.start + len(word))), (argument,), span=span
        )

    def _uncallable(self, node: ast.Call, called: object) -> Refused:
        span = self.span(node.func)
        if called is words.count:
            return meaningless("`count` needs `… for n in station` here", span, "write `count(φ for n in station)`")
        if isinstance(called, Word):
            return meaningless(f"`{called.name}` stands in the wrong place", span, f"it belongs in {called.place}")
        name = getattr(called, "__name__", None)
        if called in (builtins.any, builtins.all, builtins.sum, builtins.min, builtins.max):
            return meaningless(f"`{name}` needs `… for n in station` here", span, f"write `{name}(… for n in station)`")
        if isinstance(name, str):
            return meaningless(f"`{name}` has no meaning in a theory", span)
        return meaningless("this cannot be called", span)

    def _apply(self, node: ast.Call, called: Named, span: Span) -> tree.Apply:
        named = tuple((golc_name(self._keyword(word)), word.value) for word in node.keywords)
        args: Sequence[Any] = in_order(called, self.spread(node.args), named, span)
        head = tree.Ident(called.name, span=self.span(node.func))
        return tree.Apply(head, tuple(self.argument(arg) for arg in args), span=span)

    def argument(self, node: ast.expr) -> tree.Expr:
        """An argument of an action or a fluent."""
        return self.expr(node)

    def _keyword(self, word: ast.keyword) -> str:
        if word.arg is None:
            raise meaningless("`**` spreads no terms", self.span(word), "write the arguments one by one")
        return word.arg

    # Binders

    @contextlib.contextmanager
    def generators(
        self, generators: list[ast.comprehension]
    ) -> Iterator[tuple[tuple[tree.Binder, ...], tree.Expr | None]]:
        """The binders and the condition of ``… for x in t for y in u if φ``; the variables are bound while it lasts."""
        binders: list[tree.Binder] = []
        conditions: list[tree.Expr] = []
        tests: list[ast.expr] = []
        with contextlib.ExitStack() as stack:
            for generator in generators:
                if generator.is_async:
                    raise meaningless("`async` has no meaning in a theory", self.span(generator.target), "write `for`")
                if not isinstance(generator.target, ast.Name):
                    raise meaningless(
                        "one variable a `for`", self.span(generator.target), "write `for x in t for y in u`"
                    )
                earlier = (each.id for test in tests for each in ast.walk(test) if isinstance(each, ast.Name))
                if generator.target.id in earlier:
                    message = f"`{generator.target.id}` means something else in the `if` before"
                    raise meaningless(message, self.span(generator.target), "give this variable another name")
                tests += generator.ifs
                binders.append(self.binder(generator.target, generator.iter))
                stack.enter_context(self.scope([generator.target.id]))
                conditions += [self.expr(condition) for condition in generator.ifs]
            yield tuple(binders), self._chain("and", conditions) if conditions else None

    def binder(self, target: ast.Name, over: ast.expr) -> tree.Binder:
        """A variable over a type, or over the elements of a set or list."""
        name = new_name(golc_name(target.id), self.span(target))
        span = name.span.to(self.span(over))
        if isinstance(over, ast.Call) and self.python(over.func) is words.values:
            (collection,) = self.arguments(over, 1)
            return tree.Binder(name, collection=self.expr(collection), span=span)
        if self.is_type(over):
            return tree.Binder(name, self.type(over), span=span)
        return tree.Binder(name, collection=self.expr(over), span=span)


def _joined(parts: Sequence[str | tree.Expr]) -> tuple[str | tree.Expr, ...]:
    """The parts of a message with neighbouring texts as one."""
    joined: list[str | tree.Expr] = []
    for part in parts:
        if isinstance(part, str) and joined and isinstance(joined[-1], str):
            joined[-1] += part
        elif part != "":
            joined.append(part)
    return tuple(joined)
