"""What Python itself can compute without changing the tree: the arguments of ``theory.fluent(…)`` and the like.

Python computes ``2 * 3`` and forgets the order of a set, and nothing can be named before it is there. What may not be
computed stands in a function, which is translated instead.
"""

from __future__ import annotations

from decimal import Decimal

from golc.embed.printing.names import PYTHON_TYPES, Names
from golc.embed.printing.terms import real
from golc.syntax import tree as ast

ARITHMETIC = ("+", "-", "*", "//", "%")


def keeps_value(names: Names, expr: ast.ValueExpr) -> bool:
    """Whether an expression, of the Python names that are known so far, gives its own tree when it is computed."""
    match expr:
        case ast.Number() | ast.Truth() | ast.Nothing() | ast.Unknown() | ast.SetLiteral(elements=()):
            return True
        case ast.Real(value=value):
            return _is_float(value)
        case ast.Message(parts=parts):
            return all(isinstance(part, str) for part in parts)
        case ast.Unary(op="-", operand=ast.Number(value=number)):
            return number > 0
        case ast.Unary(op="-", operand=ast.Real(value=value)):
            return value > 0 and _is_float(value)
        case ast.ListLiteral(elements=elements):
            return all(keeps_value(names, element) for element in elements)
        case ast.OneOf(choices=choices):
            return keeps_value(names, choices)
        case ast.Unary() | ast.Binary() | ast.Apply():
            return _is_term(names, expr)
    return False


def _is_term(names: Names, expr: ast.Expr | ast.IntervalType) -> bool:
    """Whether Python meets an object of ours, which builds the tree."""
    match expr:
        case ast.Apply(name=name, args=()) if not names.is_type(name.text):
            return names.term(name.text) in names.known
        case ast.Unary(op="-", operand=operand):
            return _is_term(names, operand)
        case ast.Binary(op=op, left=left, right=ast.Number() as right) | ast.Binary(op=op, left=right, right=left):
            if op not in ARITHMETIC or isinstance(left, ast.IntervalType) or isinstance(right, ast.IntervalType):
                return False
            return _is_term(names, left) and keeps_value(names, right)
    return False


def _is_float(value: Decimal) -> bool:
    text = real(value)
    return Decimal(repr(float(text))) == value


def keeps_type(names: Names, type_: ast.Type, strings: bool = False) -> bool:
    """Whether a type gives its own tree when Python computes it; ``strings`` is as for ``type_doc``."""
    match type_:
        case ast.EnumType(elements=elements):
            symbols = (element.text for element in elements if isinstance(element, ast.Ident))
            return strings or all(names.element(symbol) in names.known for symbol in symbols)
        case ast.TypeName(name=name):
            return names.type(name.text) in names.known or _is_builtin(names, type_)
        case ast.IntervalType(low=low, high=high):
            return keeps_value(names, low) and keeps_value(names, high)
        case ast.UnionType(pieces=(first, second, *_) as pieces):
            plain = _is_builtin(names, first) and _is_builtin(names, second)
            return not plain and all(keeps_type(names, piece, strings) for piece in pieces)
        case ast.OptionalType(base=base):
            return keeps_type(names, base, strings)
        case ast.CollectionType(element=element):
            return keeps_type(names, element, strings)
    return True


def _is_builtin(names: Names, type_: ast.Type) -> bool:
    """Whether it is a class of Python, which knows no more than other classes what ``|`` means here."""
    return isinstance(type_, ast.TypeName) and names.type(type_.name.text) in PYTHON_TYPES.values()
