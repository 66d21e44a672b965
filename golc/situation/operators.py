"""Operations to Python expressions, for ``compile``: what the types do not prove is left to a check with its place."""

from __future__ import annotations

from typing import TYPE_CHECKING

from golc.situation import guards
from golc.situation.collections import known_value
from golc.theory.terms import Operation, Operator, Term
from golc.theory.types import number

if TYPE_CHECKING:
    from golc.situation.compile import Cells, Compiler

INFIX = {
    Operator.ADD: "+",
    Operator.SUBTRACT: "-",
    Operator.MULTIPLY: "*",
    Operator.DIVIDE: "//",
    Operator.MODULO: "%",
    Operator.EQUAL: "==",
    Operator.DIFFERENT: "!=",
    Operator.LESS: "<",
    Operator.LESS_EQUAL: "<=",
    Operator.GREATER: ">",
    Operator.GREATER_EQUAL: ">=",
    Operator.IFF: "==",
    Operator.AND: "and",
    Operator.OR: "or",
    Operator.UNION: "|",
    Operator.DIFFERENCE: "-",
    Operator.ELEMENT: "in",
}
CALLS = {Operator.ABSOLUTE: "abs", Operator.MINIMUM: "min", Operator.MAXIMUM: "max", Operator.LENGTH: "len"}
GUARDED = {
    Operator.FIRST: guards.first,
    Operator.REST: guards.rest,
    Operator.INDEX: guards.index,
    Operator.CONCATENATION: guards.joined,
}
"""What takes a list apart, which may not have the part, or makes a longer one."""

EXACT = {Operator.EQUAL, Operator.DIFFERENT}
"""Operators whose operands may be ``none``."""

LOGICAL = {Operator.IFF, Operator.AND, Operator.OR, Operator.NOT, Operator.IMPLIES}


def operation(compiler: Compiler, term: Operation, cells: Cells, depth: int) -> str:
    """An expression for an operation."""
    op, args = term.op, term.args
    if op is Operator.CONDITIONAL:
        then, otherwise = compiler.expression(args[0], cells, depth), compiler.expression(args[2], cells, depth)
        return f"({then} if {compiler.formula(args[1], cells, depth)} else {otherwise})"
    texts = _operands(compiler, term, cells, depth)
    match op:
        case Operator.NOT:
            return f"(not {texts[0]})"
        case Operator.IMPLIES:
            return f"(not {texts[0]} or {texts[1]})"
        case Operator.NEGATE:
            return f"(-{texts[0]})"
        case Operator.REMOVAL:
            return f"{compiler.bind('removal', guards.removal)}({', '.join(texts)})"
        case _ if op in GUARDED:
            return f"{compiler.bind(op.name.lower(), GUARDED[op](term))}({', '.join(texts)})"
        case Operator.MULTIPLY if not any(known_value(arg, cells)[0] for arg in args):
            product = compiler.bind("product", guards.product(term))
            return in_one_form(compiler, f"{product}({', '.join(texts)})", term)
        case _ if op in CALLS:
            return f"{CALLS[op]}({', '.join(texts)})"
        case _:
            return in_one_form(compiler, f"({f' {INFIX[op]} '.join(texts)})", term)


def _operands(compiler: Compiler, term: Operation, cells: Cells, depth: int) -> list[str]:
    op, args = term.op, term.args
    if op in EXACT:
        return [compiler.expression(arg, cells, depth) for arg in args]
    if op in LOGICAL:
        return [compiler.formula(arg, cells, depth) for arg in args]
    if op is Operator.ELEMENT:
        return [compiler.expression(args[0], cells, depth), _sought(compiler, args[1], cells, depth)]
    texts = [compiler.some(arg, cells, depth) for arg in args]
    if term.order is not None:
        order = compiler.bind("order", {value: place for place, value in enumerate(term.order)})
        return [f"{order}[{text}]" for text in texts]
    known, divisor = known_value(args[-1], cells)
    if op in (Operator.DIVIDE, Operator.MODULO) and not (known and divisor):
        texts[1] = f"{compiler.bind('divisor', guards.divisor(term))}({texts[1]})"
    return texts


def _sought(compiler: Compiler, whole: Term, cells: Cells, depth: int) -> str:
    """What an element is looked for in: a set, if that is known while compiling."""
    known, value = known_value(whole, cells)
    return compiler.bind("set", frozenset(value)) if known and value is not None else compiler.some(whole, cells, depth)


def in_one_form(compiler: Compiler, text: str, term: Term) -> str:
    """A number in its only form, which operations on reals do not always give."""
    return f"{compiler.bind('number', number)}({text})" if "real" in term.type.kinds else text
