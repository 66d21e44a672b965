"""Terms and formulas outside translated functions: Python's operators build the tree."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from typing import Any, NoReturn

from golc.diagnostics import NOWHERE, Code, Span
from golc.embed import asked
from golc.embed.asked import Unanswerable
from golc.embed.errors import Refused, refused
from golc.embed.places import caller, each_argument, node_at, span_of
from golc.embed.values import Meaningful, expr
from golc.syntax import tree
from golc.syntax.walk import descendants
from golc.theory.suggest import did_you_mean

_ORDERS: dict[type[ast.cmpop], str] = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}
_TURNED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "=", "!=": "!="}
"""What a comparison says with its sides exchanged."""


PROGRAMS = ("action", "exogenous action", "procedure")
"""The kinds of names that a program calls."""


class Variable(str):
    """The name of a bound variable; its identity tells it from others with this name."""

    __slots__ = ()


class Term(Unanswerable, Meaningful):
    """A term or formula of the language, a ``Named`` or a ``Compound``; its ``node`` is the tree that was built."""

    __slots__ = ("node",)

    def __init__(self, node: tree.Expr) -> None:
        self.node = node

    def _tree_at(self, span: Span) -> tree.Expr:
        return self.node

    def __repr__(self) -> str:
        from golc.syntax.unparse import unparse_expression

        return unparse_expression(self.node)

    def __hash__(self) -> int:
        if self._is_open() and asked.is_translating():
            raise asked.place_in_a_table()
        if self._is_open() and asked.is_membership(span := caller()):
            raise asked.membership(span)
        return object.__hash__(self)

    def __str__(self) -> str:
        if self._is_open() and asked.is_translating():
            raise asked.text()
        return repr(self)

    def _is_open(self) -> bool:
        """Whether what it stands for depends on the situation, or on what a variable stands for."""
        return True

    def __eq__(self, other: object) -> Term:  # type: ignore[override]
        return binary("=", self, other)

    def __ne__(self, other: object) -> Term:  # type: ignore[override]
        return binary("!=", self, other)

    def __lt__(self, other: object) -> Term:
        return binary("<", self, other)

    def __le__(self, other: object) -> Term:
        return binary("<=", self, other)

    def __gt__(self, other: object) -> Term:
        return binary(">", self, other)

    def __ge__(self, other: object) -> Term:
        return binary(">=", self, other)

    def __add__(self, other: object) -> Term:
        return binary("+", self, other)

    def __radd__(self, other: object) -> Term:
        return binary("+", other, self)

    def __sub__(self, other: object) -> Term:
        return binary("-", self, other)

    def __rsub__(self, other: object) -> Term:
        return binary("-", other, self)

    def __mul__(self, other: object) -> Term:
        return binary("*", self, other)

    def __rmul__(self, other: object) -> Term:
        return binary("*", other, self)

    def __floordiv__(self, other: object) -> Term:
        return binary("//", self, other)

    def __rfloordiv__(self, other: object) -> Term:
        return binary("//", other, self)

    def __mod__(self, other: object) -> Term:
        return binary("%", self, other)

    def __rmod__(self, other: object) -> Term:
        return binary("%", other, self)

    def __and__(self, other: object) -> Term:
        return binary("and", self, other)

    def __rand__(self, other: object) -> Term:
        return binary("and", other, self)

    def __or__(self, other: object) -> Term:
        return binary("or", self, other)

    def __ror__(self, other: object) -> Term:
        return binary("or", other, self)

    def __invert__(self) -> Term:
        return unary("not", self)

    def __neg__(self) -> Term:
        return unary("-", self)

    def __abs__(self) -> Term:
        return function("abs", (self,))

    def __getitem__(self, index: object) -> Term:
        span, (base, at) = _place(2)
        return Compound(tree.Index(expr(self, base), expr(index, at), span=span))

    def __getattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a term has no attribute `{name}`", name=name, obj=self)

    def __bool__(self) -> bool:
        raise asked.truth()

    def __iter__(self) -> Iterator[Term]:
        raise asked.elements()

    def __contains__(self, item: object) -> bool:
        raise asked.membership(caller())

    def __len__(self) -> int:
        raise asked.length()


class Compound(Term):
    """What operators, functions and calls have built.

    It is a class beside ``Named``, not above it: Python would ask the right side of a comparison first. ``truth`` says
    whether a formula is true in every situation, where that is plain.
    """

    __slots__ = ("truth",)

    def __init__(self, node: tree.Expr, truth: bool | None = None) -> None:
        super().__init__(node)
        self.truth = truth

    def __bool__(self) -> bool:
        return super().__bool__() if self.truth is None else self.truth


class Named(Term):
    """What a name of the theory stands for: a constant, symbol, fluent, action, procedure, …, a variable.

    ``parameters`` are the names of its arguments where they are known.
    """

    __slots__ = ("kind", "name", "parameters")

    def __init__(self, name: str, kind: str, parameters: tuple[str, ...] = (), span: Span = NOWHERE) -> None:
        self.name = name
        super().__init__(self._tree_at(span))
        self.kind = kind
        self.parameters = parameters

    def _tree_at(self, span: Span) -> tree.Expr:
        return tree.Apply(tree.Ident(self.name, span=span), (), span=span)

    def __hash__(self) -> int:
        return hash((Named, self.name)) if self.kind == "symbol" else super().__hash__()

    def _is_open(self) -> bool:
        return not self.parameters and self._is_unsettled()

    def _is_unsettled(self) -> bool:
        return self.kind in ("variable", "const", "static", "fluent", "definition")

    def __call__(self, *args: object, **named: object) -> Term:
        """The name applied to arguments, by place or by the names of the parameters."""
        span = caller()
        call = node_at(span)
        head = span_of(span.source, call.func) if isinstance(call, ast.Call) else span
        ordered = in_order(self, args, named.items(), span)
        nodes = tuple(map(expr, ordered, each_argument(span, len(ordered))))
        return Compound(tree.Apply(tree.Ident(self.name, span=head), nodes, span=span))


def in_order(
    named: Named, args: Iterable[object], given: Iterable[tuple[str, object]], span: Span
) -> tuple[object, ...]:
    """The arguments of a call in the order of the parameters. Raises ``Refused`` for a name that is none of them."""
    ordered = list(args)
    rest = dict(given)
    wrong = next((name for name in rest if name not in named.parameters[len(ordered) :]), None)
    if wrong is not None:
        raise _no_parameter(named, wrong, span)
    for parameter in named.parameters[len(ordered) :] if rest else ():
        if parameter not in rest:
            raise refused(Code.ARITY, f"`{named.name}` has no value for its parameter `{parameter}`", span)
        ordered.append(rest.pop(parameter))
    return tuple(ordered)


def _no_parameter(named: Named, wrong: str, span: Span) -> Refused:
    """An argument has the name of no parameter, or of one that has a value by its place."""
    known = ", ".join(f"`{parameter}`" for parameter in named.parameters) or "none"
    help_ = did_you_mean(wrong, named.parameters) or f"its parameters are: {known}"
    twice = wrong in named.parameters
    message = f"`{wrong}` of `{named.name}` has two values" if twice else f"`{named.name}` has no parameter `{wrong}`"
    return refused(Code.ARITY, message, span, None if twice else help_)


def variable(name: str, span: Span = NOWHERE) -> Named:
    """A bound variable."""
    return Named(Variable(name), "variable", (), span)


def binary(sign: Any, left: object, right: object) -> Term:
    """An infix operation at the place where Python computes it."""
    span, (first, second) = _place(2)
    if _turned(sign, node_at(span)):
        sign, left, right = _TURNED[sign], right, left
    node = tree.Binary(sign, expr(left, first), expr(right, second), span=span)
    return Compound(node, _plain_truth(sign, left, right))


def _plain_truth(sign: str, left: object, right: object) -> bool | None:
    """Whether a comparison is true in every situation, as one of two symbols is or is not."""
    match left, right:
        case Named(kind="symbol", name=one), Named(kind="symbol", name=other) if sign in ("=", "!="):
            return (one == other) == (sign == "=")
    return None


def _turned(sign: str, node: ast.AST | None) -> bool:
    """Whether Python has asked the right side of a comparison, because the left one is a number or a string."""
    match node:
        case ast.Compare(left=left, ops=[op]):
            return isinstance(left, ast.Constant) if sign in ("=", "!=") else _ORDERS.get(type(op), sign) != sign
    return False


def unary(sign: Any, operand: object) -> Term:
    """A prefix operation at the place where Python computes it."""
    span, (place,) = _place(1)
    return Compound(tree.Unary(sign, expr(operand, place), span=span))


def function(name: str, args: tuple[object, ...]) -> Term:
    """A function of the language applied to arguments."""
    span, places = _place(len(args))
    nodes = tuple(expr(arg, place) for arg, place in zip(args, places, strict=True))
    return Compound(tree.Apply(tree.Ident(name, span=span), nodes, span=span))


def _place(count: int) -> tuple[Span, list[Span]]:
    """Where Python is computing, and where its operands are written (all of it where that cannot be told)."""
    span = caller()
    source = span.source
    parts: list[ast.expr] = []
    match node_at(span):
        case ast.BinOp(left=left, right=right):
            parts = [left, right]
        case ast.Compare(left=left, comparators=[right]):
            parts = [left, right]
        case ast.UnaryOp(operand=operand):
            parts = [operand]
        case ast.Subscript(value=value, slice=index):
            parts = [value, index]
        case ast.Call():
            return span, each_argument(span, count)
    return span, [span_of(source, part) for part in parts] if len(parts) == count else [span] * count


def plain_names(node: tree.Expr) -> Iterator[str]:
    """The names in a term that have no arguments."""
    return (each.name.text for each in descendants(node) if isinstance(each, tree.Apply) and not each.args)
