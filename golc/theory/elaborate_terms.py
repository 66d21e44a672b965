"""Expressions to typed terms.

A term that cannot be elaborated is a finding and a literal of type ``BROKEN``, which fits everywhere: one mistake is
one finding. The elaborator calls itself from Python code alone, never through a builtin: a deep term costs no C stack.
"""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import cast

from golc.diagnostics import Code, Span
from golc.syntax import tree
from golc.theory.context import Context, Signature
from golc.theory.elaborate_names import arity_fits, doing, resolve
from golc.theory.elaborate_types import elaborate_type, finite_type, named_type, unknown_type
from golc.theory.expectations import broken, fits
from golc.theory.fitting import BROKEN
from golc.theory.relations import conditional, equality, numeric, one_of, ordering, within_type
from golc.theory.scope import Kind, Scope
from golc.theory.terms import (
    Before,
    Binder,
    DefinedTerm,
    Epistemic,
    FluentTerm,
    Literal,
    Operation,
    Operator,
    PossTerm,
    Quantified,
    StaticTerm,
    Term,
    Variable,
)
from golc.theory.types import BOOL, INT, NONE, Type

LOGIC = {"and": Operator.AND, "or": Operator.OR, "implies": Operator.IMPLIES, "iff": Operator.IFF}
EQUALITY = {"=": Operator.EQUAL, "!=": Operator.DIFFERENT}
ORDER = {"<": Operator.LESS, "<=": Operator.LESS_EQUAL, ">": Operator.GREATER, ">=": Operator.GREATER_EQUAL}
ARITHMETIC = {
    "+": Operator.ADD,
    "-": Operator.SUBTRACT,
    "*": Operator.MULTIPLY,
    "//": Operator.DIVIDE,
    "%": Operator.MODULO,
}


def formula(context: Context, scope: Scope, node: tree.Expr, what: str) -> Term:
    """A term of type ``bool``; ``what`` says for what it is needed."""
    return fitting(context, scope, node, BOOL, what)


def fitting(context: Context, scope: Scope, node: tree.Expr, needed: Type, what: str) -> Term:
    """A term whose values may be of a type; ``what`` says for what it is needed."""
    found = term(context, scope, node, needed)
    return found if fits(context, found, needed, what) else broken(node.span)


def term(context: Context, scope: Scope, node: tree.Expr, hint: Type | None = None) -> Term:
    """The typed term of an expression; ``hint`` is the type that is needed here, as far as it is known."""
    match node:
        case tree.Number(value=value):
            return Literal(value, type=INT, span=node.span)
        case tree.Truth(value=value):
            return Literal(value, type=BOOL, span=node.span)
        case tree.Nothing():
            return Literal(None, type=NONE, span=node.span)
        case tree.Apply():
            return _apply(context, scope, node, hint)
        case tree.Unary():
            return _unary(context, scope, node)
        case tree.Binary():
            return _binary(context, scope, node)
        case tree.IfElse():
            return _conditional(context, scope, node, hint)
        case tree.Quantifier():
            return _quantifier(context, scope, node)
        case tree.Extremum(kind=kind, args=args):
            op = Operator.MINIMUM if kind == "min" else Operator.MAXIMUM
            return numeric(context, op, [_integer(context, scope, arg, f"`{kind}`") for arg in args], node.span)
        case tree.Epistemic():
            return _epistemic(context, scope, node)
        case _:
            if hint is not BROKEN:  # otherwise it is of a type that is not supported, which has been said
                context.unsupported(_unsupported(node), node.span)
            return broken(node.span)


def _unsupported(node: tree.Expr) -> str:
    match node:
        case tree.Real():
            return "real numbers are"
        case tree.Message():
            return "strings outside of messages are"
        case tree.Index():
            return "indexing is"
        case tree.Comprehension(kind=kind):
            return f"{kind} comprehensions are"
        case _:
            return "sets and lists as values are"


# ---- names


def _apply(context: Context, scope: Scope, node: tree.Apply, hint: Type | None) -> Term:
    if node.args and node.name.text in ("abs", "poss", "len", "first", "rest", "before"):
        return _function(context, scope, node)
    found = resolve(context, scope, node, hint)
    match found:
        case Variable():
            return Variable(found.level, found.name, type=found.type, span=node.span)
        case Literal():
            return found
        case Signature():
            args = arguments(context, scope, node, found)
            return broken(node.span) if args is None else _called(found, args, node.span)
        case _:
            for arg in node.args:
                term(context, scope, arg)
            return broken(node.span)


def _called(signature: Signature, args: tuple[Term, ...], span: Span) -> Term:
    name = signature.entry.name
    match signature.entry.kind:
        case Kind.FLUENT:
            return FluentTerm(name, args, type=signature.type, span=span)
        case Kind.STATIC:
            return StaticTerm(name, args, type=signature.type, span=span)
        case _:
            return DefinedTerm(name, args, type=signature.type, span=span)


def arguments(context: Context, scope: Scope, node: tree.Apply, signature: Signature) -> tuple[Term, ...] | None:
    """The arguments of a call, each of its parameter's type; none, and a finding, if their number is wrong."""
    if not arity_fits(context, node, signature.entry, len(node.args)):
        for arg in node.args:
            term(context, scope, arg)
        return None
    name = node.name.text
    return tuple(
        [
            fitting(context, scope, arg, parameter.type, f"parameter `{parameter.name}` of `{name}`")
            for arg, parameter in zip(node.args, signature.parameters, strict=True)
        ]
    )


def _function(context: Context, scope: Scope, node: tree.Apply) -> Term:
    name, given = node.name.text, len(node.args)
    if name in ("abs", "poss", "before") and given != 1:
        message = f"`{name}` takes 1 argument, not {given}"
        context.error(Code.ARITY, message, node.name.span, f"{given} arguments here")
        return broken(node.span)
    if name == "abs":
        operand = _integer(context, scope, node.args[0], "`abs`")
        return numeric(context, Operator.ABSOLUTE, [operand], node.span)
    if name == "poss":
        return _poss(context, scope, node.args[0], node.span)
    if name == "before":
        return _before(context, scope, node.args[0], node.span)
    context.unsupported(f"`{name}(…)` is", node.span)
    return broken(node.span)


def _poss(context: Context, scope: Scope, node: tree.Expr, span: Span) -> Term:
    if not isinstance(node, tree.Apply):
        context.error(Code.TYPE_MISMATCH, "`poss` is asked of an action", node.span, "not an action")
        return broken(span)
    entry = doing(context, node.name, len(node.args), (Kind.ACTION, Kind.EXOGENOUS))
    if entry is None:
        return broken(span)
    signature = context.signature(entry)
    if entry.kind is Kind.PROCEDURE:
        message = f"`{entry.name}` is a procedure, and `poss` is asked of an action"
        context.error(Code.MISUSED_NAME, message, node.name.span, "not an action")
        return broken(span)
    args = None if signature is None else arguments(context, scope, node, signature)
    return broken(span) if args is None else PossTerm(entry.name, args, type=BOOL, span=span)


# ---- knowledge and the past


def _epistemic(context: Context, scope: Scope, node: tree.Epistemic) -> Term:
    inner = replace(scope, before=False)
    if node.kind == "known":
        body = term(context, inner, node.body)
    else:
        body = formula(context, inner, node.body, f"`{node.kind}`")
    return broken(node.span) if body.type is BROKEN else Epistemic(node.kind, body, type=BOOL, span=node.span)


def _before(context: Context, scope: Scope, node: tree.Expr, span: Span) -> Term:
    body = term(context, replace(scope, before=False), node)
    if not scope.before:
        help_ = "it stands in `prune … after … when`, but not inside another one or inside `knows` and the like"
        context.error(Code.MISPLACED_CLAUSE, "`before(…)` has no meaning here", span, "before what?", help_)
        return broken(span)
    return body if body.type is BROKEN else Before(body, type=body.type, span=span)


# ---- operators


def _integer(context: Context, scope: Scope, node: tree.Expr, what: str) -> Term:
    return fitting(context, scope, node, INT, what)


def _unary(context: Context, scope: Scope, node: tree.Unary) -> Term:
    if node.op == "-":
        return numeric(context, Operator.NEGATE, [_integer(context, scope, node.operand, "`-`")], node.span)
    operand = formula(context, scope, node.operand, "`not`")
    return Operation(Operator.NOT, (operand,), type=BOOL, span=node.span)


def _binary(context: Context, scope: Scope, node: tree.Binary) -> Term:
    # A chain of operators leans to the left: walk down it in a loop, and put equal ones of `and` or `or` into one.
    chain = [node]
    while isinstance(chain[-1].left, tree.Binary):
        chain.append(chain[-1].left)
    left = term(context, scope, chain[-1].left)
    for op, group in itertools.groupby(reversed(chain), key=lambda binary: binary.op):
        if op in ("and", "or"):
            left = _junction(context, scope, left, [*group])
        else:
            for binary in group:
                left = _infix(context, scope, binary, left)
    return left


def _junction(context: Context, scope: Scope, left: Term, group: list[tree.Binary]) -> Term:
    op = group[0].op
    first = left if fits(context, left, BOOL, f"`{op}`") else broken(left.span)
    args = [first]
    for binary in group:
        args.append(formula(context, scope, cast(tree.Expr, binary.right), f"`{op}`"))
    return Operation(LOGIC[op], tuple(args), type=BOOL, span=group[-1].span)


def _infix(context: Context, scope: Scope, node: tree.Binary, left: Term) -> Term:
    op, span = node.op, node.span
    if op in ("in", "not in"):
        found = _membership(context, scope, left, node.right, span)
        return found if op == "in" else Operation(Operator.NOT, (found,), type=BOOL, span=span)
    right_node = cast(tree.Expr, node.right)
    if op in LOGIC:
        left = left if fits(context, left, BOOL, f"`{op}`") else broken(left.span)
        return Operation(LOGIC[op], (left, formula(context, scope, right_node, f"`{op}`")), type=BOOL, span=span)
    if op in ARITHMETIC:
        left = left if fits(context, left, INT, f"`{op}`") else broken(left.span)
        right = fitting(context, scope, right_node, BROKEN if left.type is BROKEN else INT, f"`{op}`")
        return numeric(context, ARITHMETIC[op], [left, right], span)
    right = term(context, scope, right_node, left.type)
    if op in EQUALITY:
        return equality(context, EQUALITY[op], left, right, span)
    return ordering(context, ORDER[op], left, right, span)


def _membership(context: Context, scope: Scope, element: Term, node: tree.Expr | tree.IntervalType, span: Span) -> Term:
    match node:
        case tree.SetLiteral(elements=elements):
            choices = [term(context, scope, choice, element.type) for choice in elements]
            return one_of(context, element, choices, span)
        case tree.IntervalType():
            within = elaborate_type(context, node)
        case tree.Apply(name=name, args=()) if _is_type(context, scope, name):
            within = named_type(context, name)
        case tree.Apply(name=name, args=()) if (
            scope.get(name.text) is None and name.text not in context.names.values.entries
        ):
            unknown_type(context, name)
            return broken(span)
        case _:
            if term(context, scope, node).type is not BROKEN:
                context.unsupported("`in` a set or list value is", node.span)
            return broken(span)
    return within_type(context, element, within, span)


def _is_type(context: Context, scope: Scope, name: tree.Ident) -> bool:
    if scope.get(name.text) is not None:
        return False
    entry = context.names.values.get(name.text)
    return name.text in ("bool", "int", "real", "string") or (entry is not None and entry.kind is Kind.TYPE)


def _conditional(context: Context, scope: Scope, node: tree.IfElse, hint: Type | None) -> Term:
    condition = formula(context, scope, node.condition, "the condition of `if … else`")
    then = term(context, scope, node.then, hint)
    otherwise = term(context, scope, node.otherwise, hint or then.type)
    return conditional(context, then, condition, otherwise, hint, node.span)


# ---- binders


def bind(context: Context, scope: Scope, nodes: tuple[tree.Binder, ...]) -> tuple[Scope, tuple[Binder, ...]]:
    """The scope inside some binders. What runs over a collection is bound, too, so that it is known in the body."""
    found = []
    for node in nodes:
        if node.type is None:
            collection = cast(tree.Expr, node.collection)
            context.unsupported(f"`{node.name.text} in …` over a set or list is", collection.span)
            type_: Type = BROKEN
        else:
            type_ = finite_type(context, node.type, f"variable `{node.name.text}`")
        scope, variable = scope.bind(node.name, type_)
        found.append(Binder(variable))
    return scope, tuple(found)


def _quantifier(context: Context, scope: Scope, node: tree.Quantifier) -> Term:
    inner, binders = bind(context, scope, node.binders)
    where = None if node.where is None else formula(context, inner, node.where, "`where`")
    logical = node.kind in ("exists", "forall", "count")
    body = fitting(context, inner, node.body, BOOL if logical else INT, f"`{node.kind}`")
    if any(binder.variable.type is BROKEN for binder in binders):
        return broken(node.span)
    type_ = BOOL if node.kind in ("exists", "forall") else INT
    return Quantified(node.kind, binders, where, body, type=type_, span=node.span)
