"""What each rule of expressions and types builds from its parts."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from typing import TYPE_CHECKING, Any, TypeAlias

from lark import Token

from golc.diagnostics import Span
from golc.syntax import tree as ast

if TYPE_CHECKING:
    from golc.syntax.build import Builder

Rule: TypeAlias = Callable[["Builder", Span, list[Any]], Any]


def as_tuple(b: Builder, span: Span, children: list[Any]) -> tuple[Any, ...]:
    """The parts themselves."""
    return tuple(children)


def _binders(b: Builder, span: Span, children: list[Any]) -> tuple[ast.Binder, ...]:
    b.declare_parts(tuple(children))
    return tuple(children)


def _binding_in(b: Builder, span: Span, children: list[Any]) -> ast.Binder:
    return ast.Binder(children[0], collection=children[1], span=span)


def _binding_range(b: Builder, span: Span, children: list[Any]) -> ast.Binder:
    """``x in 1..6`` says what ``x: 1..6`` says."""
    name, low, high = children
    return ast.Binder(name, ast.IntervalType(low, high, span=low.span.to(span)), span=span)


def _union(b: Builder, span: Span, children: list[Any]) -> ast.UnionType:
    return ast.UnionType(tuple(child for child in children if not isinstance(child, Token)), span=span)


def _collection_type(kind: Any) -> Rule:
    return lambda b, span, children: ast.CollectionType(kind, children[0], span=span)


def _enum(b: Builder, span: Span, children: list[Any]) -> ast.EnumType:
    b.declare(*(child for child in children if isinstance(child, ast.Ident)))
    return ast.EnumType(tuple(children), span=span)


def _integer(b: Builder, span: Span, children: list[Any]) -> ast.Number:
    minus, digits = children
    value = b.integer(digits)
    return ast.Number(-value if minus else value, span=span)


def _number(b: Builder, span: Span, children: list[Any]) -> ast.Number:
    return ast.Number(b.integer(children[0]), span=span)


def _real(b: Builder, span: Span, children: list[Any]) -> ast.Real:
    return ast.Real(Decimal(children[0]), span=span)


def _truth(value: bool) -> Rule:
    return lambda b, span, children: ast.Truth(value, span=span)


def _apply(b: Builder, span: Span, children: list[Any]) -> ast.Apply:
    return ast.Apply(children[0], tuple(children[1:]), span=span)


def _infix(b: Builder, span: Span, children: list[Any]) -> ast.Binary:
    left, *words, right = children
    operator: Any = " ".join(words)
    return ast.Binary(operator, left, right, span=span)


def _worded(kind: Any) -> Rule:
    """A word or sign that tells which of several functions it is, and arguments."""
    return lambda b, span, children: kind(str(children[0]), *children[1:], span=span)


def _extremum(b: Builder, span: Span, children: list[Any]) -> ast.Extremum:
    kind: Any = str(children[0])
    return ast.Extremum(kind, tuple(children[1:]), span=span)


def _comprehension(kind: Any) -> Rule:
    return lambda b, span, children: ast.Comprehension(kind, *children, span=span)


def _entry(b: Builder, span: Span, children: list[Any]) -> ast.TableEntry:
    key, value = children
    return ast.TableEntry(key if isinstance(key, tuple) else (key,), value, span=span)


def sequence_of(kind: Any) -> Rule:
    """A node with one field, the tuple of the parts."""
    return lambda b, span, children: kind(tuple(children), span=span)


NODES: dict[str, Any] = {
    "binding_of": ast.Binder,
    "interval": ast.IntervalType,
    "type_name": ast.TypeName,
    "optional": ast.OptionalType,
    "one_of": ast.OneOf,
    "unknown": ast.Unknown,
    "none": ast.Nothing,
    "name": ast.Apply,
    "index": ast.Index,
    "if_else": ast.IfElse,
}
"""The rules whose parts are the fields of a node, in order."""

RULES: dict[str, Rule] = {
    "binders": _binders,
    "binding_in": _binding_in,
    "binding_range": _binding_range,
    "set_of": _collection_type("set"),
    "list_of": _collection_type("list"),
    "union": _union,
    "enum": _enum,
    "integer": _integer,
    "true": _truth(True),
    "false": _truth(False),
    "number": _number,
    "real": _real,
    "message": lambda b, span, children: b.message(children[0]),
    "apply": _apply,
    "binary": _infix,
    "not_in": _infix,
    "unary": _worded(ast.Unary),
    "quantifier": _worded(ast.Quantifier),
    "extremum": _extremum,
    "epistemic": _worded(ast.Epistemic),
    "set_literal": sequence_of(ast.SetLiteral),
    "list_literal": sequence_of(ast.ListLiteral),
    "set_comprehension": _comprehension("set"),
    "list_comprehension": _comprehension("list"),
    "table": sequence_of(ast.Table),
    "entry": _entry,
    "key": as_tuple,
}
"""The other rules."""
