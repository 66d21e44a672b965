"""What formulas are made of: the signs of the operations and how tightly they bind, brackets, quantifiers, values."""

from __future__ import annotations

from collections.abc import Sequence

from golc.explain import signs
from golc.explain.document import Document, Group, Line, Nest, Text, join, separated
from golc.syntax.notation import string
from golc.theory.terms import Operator
from golc.theory.types import STRING, Optional, Type, Value, show

OPEN, IMPLICATION, OR, AND, NOT, COMPARISON, SUM, PRODUCT, NEGATION, ATOM = range(10)
"""How tightly the forms bind, the loosest first."""

INFIX: dict[Operator, tuple[int, int, int, str, str]] = {
    Operator.EQUAL: (COMPARISON, SUM, SUM, "=", "="),
    Operator.DIFFERENT: (COMPARISON, SUM, SUM, "≠", r"\neq"),
    Operator.LESS: (COMPARISON, SUM, SUM, "<", "<"),
    Operator.LESS_EQUAL: (COMPARISON, SUM, SUM, "≤", r"\leq"),
    Operator.GREATER: (COMPARISON, SUM, SUM, ">", ">"),
    Operator.GREATER_EQUAL: (COMPARISON, SUM, SUM, "≥", r"\geq"),
    Operator.ELEMENT: (COMPARISON, SUM, SUM, "∈", r"\in"),
    Operator.ADD: (SUM, SUM, PRODUCT, "+", "+"),
    Operator.SUBTRACT: (SUM, SUM, PRODUCT, "-", "-"),
    Operator.UNION: (SUM, SUM, PRODUCT, "∪", r"\cup"),
    Operator.DIFFERENCE: (SUM, SUM, PRODUCT, "∖", r"\setminus"),
    Operator.CONCATENATION: (SUM, SUM, PRODUCT, "⌢", r"\frown"),
    Operator.REMOVAL: (SUM, SUM, PRODUCT, "∖", r"\setminus"),
    Operator.MULTIPLY: (PRODUCT, PRODUCT, NEGATION, "·", r"\cdot"),
    Operator.MODULO: (PRODUCT, PRODUCT, NEGATION, "mod", r"\bmod"),
}
"""How tightly an operation binds, what its operands need, and its sign."""

AGGREGATES = {
    "count": Text("#", r"\#"),
    "sum": Text("∑", r"\sum "),
    "min": Text("min", r"\min "),
    "max": Text("max", r"\max "),
}

BRACKETS = {
    "list": (signs.sign("["), signs.sign("]")),
    "set": (Text("{", r"\{"), Text("}", r"\}")),
}


def infixed(sign: Text, operands: Sequence[Document]) -> Document:
    """``a ∧ b ∧ c``, with the sign at the beginning of a line where it is broken."""
    return Group(separated([Nest(operand) for operand in operands], Line(), sign))


def quantified(sign: Text, binders: Document, body: Document) -> Document:
    """``∃x: t. φ``."""
    return Group(join(sign, binders, Text(".", r".\;"), Nest(join(Line(), body))))


def type_text(type_: Type) -> Document:
    """A type by its name, or written out."""
    match type_:
        case Optional(base=base):
            return join(type_text(base), signs.UNION, signs.words("{none}"))
        case _:
            return signs.words(str(type_))


def value_text(value: Value, type_: Type) -> Document:
    """A value; a string in quotes."""
    return signs.words(string(str(value)) if type_ == STRING else show(value))


def listed(kind: str, parts: Sequence[Document]) -> Document:
    """Parts in brackets, with commas between them."""
    opening, closing = BRACKETS[kind]
    return join(opening, Nest(separated(parts, signs.sign(","), Line())), closing)
