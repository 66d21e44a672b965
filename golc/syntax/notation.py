"""Expressions and types as text, with no more parentheses than they need."""

from __future__ import annotations

from collections.abc import Iterable
from decimal import Decimal
from typing import TypeAlias

from golc.syntax import tree as ast

CONDITIONAL, IMPLICATION, OR, AND, NOT, COMPARISON, SUM, PRODUCT, NEGATION, ATOM = range(10)
"""How tightly the forms of the grammar bind, the loosest first."""

BINARY: dict[ast.BinaryOp, tuple[int, int, int]] = {
    "implies": (IMPLICATION, OR, IMPLICATION),
    "iff": (IMPLICATION, OR, OR),
    "or": (OR, OR, AND),
    "and": (AND, AND, NOT),
    "=": (COMPARISON, SUM, SUM),
    "!=": (COMPARISON, SUM, SUM),
    "<": (COMPARISON, SUM, SUM),
    "<=": (COMPARISON, SUM, SUM),
    ">": (COMPARISON, SUM, SUM),
    ">=": (COMPARISON, SUM, SUM),
    "in": (COMPARISON, SUM, SUM),
    "not in": (COMPARISON, SUM, SUM),
    "+": (SUM, SUM, PRODUCT),
    "-": (SUM, SUM, PRODUCT),
    "*": (PRODUCT, PRODUCT, NEGATION),
    "//": (PRODUCT, PRODUCT, NEGATION),
    "%": (PRODUCT, PRODUCT, NEGATION),
}
"""How tightly an operation binds, and what its left and its right operand need."""

UNARY: dict[ast.UnaryOp, tuple[int, str]] = {"not": (NOT, "not "), "-": (NEGATION, "-")}
"""How tightly a prefix and its operand bind, and how it is written."""

ESCAPED = str.maketrans({"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t"})
BRACES = str.maketrans({"{": "{{", "}": "}}"})

Printable: TypeAlias = ast.ValueExpr | ast.IntervalType


def unparse_expression(expr: Printable) -> str:
    """The text of an expression or value, which parses to the same tree.

    Raises ``ValueError`` for a message inside a message, which no text can have.
    """
    return _expression(expr, CONDITIONAL, True)


def _expression(expr: Printable, least: int, last: bool) -> str:
    """The text where something binding at least so tightly is needed; ``last`` if nothing follows that a quantifier,
    which takes everything to its right, could take."""
    match expr:
        case ast.Binary(op=op, left=left, right=right):
            level, before, behind = BINARY[op]
            inner = last or level < least
            text = f"{_expression(left, before, False)} {op} {_expression(right, behind, inner)}"
        case ast.Unary(op=op, operand=operand):
            level, word = UNARY[op]
            text = word + _expression(operand, level, last or level < least)
        case ast.IfElse(then=then, condition=condition, otherwise=otherwise):
            level = CONDITIONAL
            text = f"{_expression(then, IMPLICATION, False)} if {_expression(condition, IMPLICATION, True)}"
            text += f" else {_expression(otherwise, CONDITIONAL, last or level < least)}"
        case ast.Quantifier():
            level = ATOM if last else CONDITIONAL - 1
            text = _quantifier(expr)
        case _:
            return _atom(expr)
    return text if level >= least else f"({text})"


def _quantifier(expr: ast.Quantifier) -> str:
    return f"{expr.kind} {binders(expr.binders, expr.where)}. {unparse_expression(expr.body)}"


def _atom(expr: Printable) -> str:
    match expr:
        case ast.Number(value=value):
            return str(value)
        case ast.Real(value=value):
            return _real(value)
        case ast.Message():
            return message(expr)
        case ast.Truth(value=value):
            return "true" if value else "false"
        case ast.Nothing():
            return "none"
        case ast.Apply(name=name, args=args):
            return name.text + (f"({commas(args)})" if args else "")
        case ast.Index(base=base, index=index):
            return f"{_indexed(base)}[{unparse_expression(index)}]"
        case ast.Extremum(kind=kind, args=args):
            return f"{kind}({commas(args)})"
        case ast.Epistemic(kind=kind, body=body):
            return f"{kind}({unparse_expression(body)})"
        case ast.SetLiteral(elements=elements):
            return f"{{{commas(elements)}}}"
        case ast.ListLiteral(elements=elements):
            return f"[{commas(elements)}]"
        case ast.Comprehension():
            return _comprehension(expr)
        case ast.Unknown():
            return "unknown"
        case ast.OneOf(choices=choices):
            return f"one of {unparse_expression(choices)}"
        case ast.IntervalType(low=low, high=high):
            return f"{_bound(low)}..{_bound(high)}"
        case _:
            raise TypeError(f"{expr!r} is no expression")


def _real(value: Decimal) -> str:
    text = f"{value:f}"
    return text if "." in text else f"{text}.0"


def _indexed(base: ast.Expr) -> str:
    text = unparse_expression(base)
    return text if isinstance(base, ast.Apply | ast.Index | ast.ListLiteral) else f"({text})"


def _comprehension(expr: ast.Comprehension) -> str:
    text = f"{unparse_expression(expr.element)} for {binders(expr.binders, expr.where)}"
    return f"{{{text}}}" if expr.kind == "set" else f"[{text}]"


def _bound(bound: ast.Expr) -> str:
    """A number, a const, or anything in parentheses."""
    text = unparse_expression(bound)
    match bound:
        case ast.Number() | ast.Apply(args=()) | ast.Unary(op="-", operand=ast.Number()):
            return text
    return f"({text})"


def commas(expressions: Iterable[ast.Expr]) -> str:
    """Expressions with commas between them."""
    return ", ".join(unparse_expression(expression) for expression in expressions)


def binders(parts: Iterable[ast.Binder], where: ast.Expr | None) -> str:
    """``x: t, y in e where φ``."""
    text = ", ".join(
        f"{part.name.text} in {unparse_expression(part.collection)}"
        if part.collection is not None
        else f"{part.name.text}: {type_text(part.type)}"
        for part in parts
    )
    return text + condition("where", where)


def condition(word: str, expr: ast.Expr | None) -> str:
    """A space, the word and the condition, if there is one."""
    return "" if expr is None else f" {word} {unparse_expression(expr)}"


def message(expr: ast.Message) -> str:
    """A message as it is written."""
    return '"' + "".join(_part(part) for part in expr.parts) + '"'


def _part(part: str | ast.Expr) -> str:
    if isinstance(part, str):
        return part.translate(ESCAPED).translate(BRACES)
    text = unparse_expression(part)
    if '"' in text:
        raise ValueError("a message inside a message cannot be written")
    space = " " if text.startswith("{") or text.endswith("}") else ""
    return f"{{{space}{text}{space}}}"


def string(text: str) -> str:
    """A string in which braces mean themselves."""
    return f'"{text.translate(ESCAPED)}"'


def type_text(type_: ast.Type | None) -> str:
    """The text of a type."""
    match type_:
        case ast.TypeName(name=name):
            return name.text
        case ast.IntervalType():
            return _atom(type_)
        case ast.EnumType(elements=elements):
            return f"{{{', '.join(constant(element) for element in elements)}}}"
        case ast.UnionType(pieces=pieces):
            return " + ".join(type_text(piece) for piece in pieces)
        case ast.OptionalType(base=base):
            return f"{type_text(base)}?"
        case ast.CollectionType(kind=kind, element=element):
            return f"{kind}[{type_text(element)}]"
        case _:
            raise TypeError(f"{type_!r} is no type")


def constant(value: ast.Ident | ast.Number | ast.Truth | ast.Nothing) -> str:
    """A symbol or another constant of a pattern, an enumeration or a binding."""
    return value.text if isinstance(value, ast.Ident) else _atom(value)
