"""Expressions to typed terms.

A term that cannot be elaborated is a finding and a literal of type ``BROKEN``, which fits everywhere: one mistake is
one finding. The elaborator calls itself from Python code alone, never through a builtin: a deep term costs no C stack.
"""

from __future__ import annotations

import itertools
from dataclasses import replace
from fractions import Fraction
from typing import cast

from golc.diagnostics import Code, Span
from golc.syntax import tree
from golc.theory import types
from golc.theory.context import Context, Signature
from golc.theory.elaborate_collections import (
    CollectionKind,
    combined,
    comprehension,
    determined,
    display,
    end,
    indexed,
    length,
    of_elements,
)
from golc.theory.elaborate_names import arity_fits, doing, is_misspelt_type, is_type, resolve
from golc.theory.elaborate_types import elaborate_type, finite_type, named_type, unknown_type
from golc.theory.expectations import as_number, broken, fits, mismatch
from golc.theory.fitting import BROKEN, collection, is_undetermined
from golc.theory.forms import sign
from golc.theory.relations import (
    conditional,
    equality,
    numeric,
    numeric_type,
    one_of,
    ordering,
    within_collection,
    within_type,
)
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
    Text,
    Variable,
)
from golc.theory.types import BOOL, INT, NONE, REAL, STRING, Collection, Type

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


def fitting(
    context: Context, scope: Scope, node: tree.Expr, needed: Type, what: str, declared: Span | None = None
) -> Term:
    """A term whose values may be of a type; ``what`` and ``declared`` are as for ``fits``."""
    found = term(context, scope, node, needed)
    return found if fits(context, found, needed, what, declared) else broken(node.span)


def term(context: Context, scope: Scope, node: tree.Expr, hint: Type | None = None) -> Term:
    """The typed term of an expression; ``hint`` is the type that is needed here, as far as it is known."""
    match node:
        case tree.Number(value=value):
            return Literal(value, type=INT, span=node.span)
        case tree.Real(value=decimal):
            return Literal(types.number(Fraction(decimal)), type=REAL, span=node.span)
        case tree.Truth(value=value):
            return Literal(value, type=BOOL, span=node.span)
        case tree.Nothing():
            return Literal(None, type=NONE, span=node.span)
        case tree.Apply():
            return _apply(context, scope, node, hint)
        case tree.Message():
            return _text(context, scope, node)
        case tree.Unary():
            return _unary(context, scope, node)
        case tree.Binary():
            return _binary(context, scope, node, hint)
        case tree.IfElse():
            return _conditional(context, scope, node, hint)
        case tree.Quantifier():
            return _quantifier(context, scope, node)
        case tree.Extremum(kind=kind, args=args):
            op = Operator.MINIMUM if kind == "min" else Operator.MAXIMUM
            return numeric(context, op, [number(context, scope, arg, f"`{kind}`") for arg in args], node.span)
        case tree.SetLiteral(elements=elements):
            return _display(context, scope, "set", elements, hint, node.span)
        case tree.ListLiteral(elements=elements):
            return _display(context, scope, "list", elements, hint, node.span)
        case tree.Comprehension():
            return _comprehension(context, scope, node, hint)
        case tree.Index(base=base, index=index):
            return indexed(context, term(context, scope, base), term(context, scope, index), node.span)
        case tree.Epistemic():
            return _epistemic(context, scope, node)


def number(context: Context, scope: Scope, node: tree.Expr, what: str) -> Term:
    """A term whose values may be numbers; ``what`` says for what it is needed."""
    return as_number(context, term(context, scope, node, REAL), what)


def _apply(context: Context, scope: Scope, node: tree.Apply, hint: Type | None) -> Term:
    if node.args and node.name.text in ("abs", "poss", "len", "first", "rest", "before"):
        return _function(context, scope, node, hint)
    found = resolve(context, scope, node, hint)
    match found:
        case Variable():
            return Variable(found.level, found.name, type=found.type, span=node.span, bound=found.bound)
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
        case Kind.STATIC | Kind.EXTERN:
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
            fitting(context, scope, arg, parameter.type, f"parameter `{parameter.name}` of `{name}`", parameter.span)
            for arg, parameter in zip(node.args, signature.parameters, strict=True)
        ]
    )


def _function(context: Context, scope: Scope, node: tree.Apply, hint: Type | None) -> Term:
    name, given, argument = node.name.text, len(node.args), node.args[0]
    if given != 1:
        message = f"`{name}` takes 1 argument, not {given}"
        context.error(Code.ARITY, message, node.name.span, f"{given} arguments here")
        return broken(node.span)
    match name:
        case "abs":
            return numeric(context, Operator.ABSOLUTE, [number(context, scope, argument, "`abs`")], node.span)
        case "poss":
            return _poss(context, scope, argument, node.span)
        case "len":
            return length(context, term(context, scope, argument), node.span)
        case "first" | "rest":
            op = Operator.FIRST if name == "first" else Operator.REST
            return end(context, op, term(context, scope, argument, hint if name == "rest" else None), node.span)
        case _:
            return _before(context, scope, argument, node.span)


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
        where = span.either("`prune … after … when`", "the `when` of an `after(…)` under `@theory.prune`")
        help_ = f"it stands in {where}, but not inside another one or inside `knows` and the like"
        context.error(Code.MISPLACED_CLAUSE, "`before(…)` has no meaning here", span, "before what?", help_)
        return broken(span)
    return body if body.type is BROKEN else Before(body, type=body.type, span=span)


def _unary(context: Context, scope: Scope, node: tree.Unary) -> Term:
    if node.op == "-":
        return numeric(context, Operator.NEGATE, [number(context, scope, node.operand, "`-`")], node.span)
    operand = formula(context, scope, node.operand, f"`{sign('not', node.span)}`")
    return Operation(Operator.NOT, (operand,), type=BOOL, span=node.span)


def _binary(context: Context, scope: Scope, node: tree.Binary, hint: Type | None) -> Term:
    # A chain of operators leans to the left: walk down it in a loop, and put equal ones of `and` or `or` into one.
    chain = [node]
    while isinstance(chain[-1].left, tree.Binary):
        chain.append(chain[-1].left)
    if any(binary.op not in ("+", "-") for binary in chain):
        hint = None  # the operands are of another type than the whole
    left = term(context, scope, chain[-1].left, hint)
    for op, group in itertools.groupby(reversed(chain), key=lambda binary: binary.op):
        if op in ("and", "or"):
            left = _junction(context, scope, left, [*group])
        else:
            for binary in group:
                left = _infix(context, scope, binary, left, hint)
    return left


def _junction(context: Context, scope: Scope, left: Term, group: list[tree.Binary]) -> Term:
    span, what = group[-1].span, f"`{sign(group[0].op, group[-1].span)}`"
    first = left if fits(context, left, BOOL, what) else broken(left.span)
    args = [first]
    for binary in group:
        args.append(formula(context, scope, cast(tree.Expr, binary.right), what))
    return Operation(LOGIC[group[0].op], tuple(args), type=BOOL, span=span)


def _infix(context: Context, scope: Scope, node: tree.Binary, left: Term, hint: Type | None) -> Term:
    op, span = node.op, node.span
    if op in ("in", "not in"):
        found = _membership(context, scope, left, node.right, span)
        return found if op == "in" else Operation(Operator.NOT, (found,), type=BOOL, span=span)
    right_node = cast(tree.Expr, node.right)
    if op in LOGIC:
        left = left if fits(context, left, BOOL, f"`{op}`") else broken(left.span)
        return Operation(LOGIC[op], (left, formula(context, scope, right_node, f"`{op}`")), type=BOOL, span=span)
    if op in ("+", "-") and collection(left.type) is not None:
        right = term(context, scope, right_node, hint if is_undetermined(left.type) else left.type)
        return combined(context, op, left, right, hint, span)
    if op in ARITHMETIC:
        left = as_number(context, left, f"`{op}`")
        if left.type is BROKEN:
            right = term(context, scope, right_node, BROKEN)
        else:
            right = number(context, scope, right_node, f"`{op}`")
        return numeric(context, ARITHMETIC[op], [left, right], span)
    right = term(context, scope, right_node, left.type)
    if op in EQUALITY:
        return equality(context, EQUALITY[op], left, right, span)
    return ordering(context, ORDER[op], left, right, span)


def _membership(context: Context, scope: Scope, element: Term, node: tree.Expr | tree.IntervalType, span: Span) -> Term:
    match node:
        case tree.SetLiteral(elements=elements) | tree.ListLiteral(elements=elements):
            choices = [term(context, scope, choice, element.type) for choice in elements]
            return one_of(context, element, choices, span, node.span)
        case tree.IntervalType():
            within = elaborate_type(context, node)
        case tree.Apply(name=name, args=()) if is_type(context, scope, name):
            within = named_type(context, name)
        case tree.Apply(name=name, args=()) if is_misspelt_type(context, scope, name):
            unknown_type(context, name)
            return broken(span)
        case _:
            hint = None if element.type is BROKEN else Collection("list", element.type)
            return within_collection(context, element, term(context, scope, node, hint), span)
    return within_type(context, element, within, span)


def _conditional(context: Context, scope: Scope, node: tree.IfElse, hint: Type | None) -> Term:
    condition = formula(context, scope, node.condition, "the condition of `if … else`")
    then = term(context, scope, node.then, hint)
    otherwise = term(context, scope, node.otherwise, hint or then.type)
    return conditional(context, then, condition, otherwise, hint, node.span)


def bind(context: Context, scope: Scope, nodes: tuple[tree.Binder, ...]) -> tuple[Scope, tuple[Binder, ...]]:
    """The scope inside some binders, each of which may speak of those before it."""
    found = []
    for node in nodes:
        type_, within = _range(context, scope, node)
        scope, variable = scope.bind(node.name, type_)
        found.append(Binder(variable, within))
    return scope, tuple(found)


def _range(context: Context, scope: Scope, node: tree.Binder) -> tuple[Type, Term | None]:
    """The type of a bound variable, and the set or list that it runs over unless it runs over its type."""
    what = f"variable `{node.name.text}`"
    match node:
        case tree.Binder(type=type_) if type_ is not None:
            return finite_type(context, type_, what), None
        case tree.Binder(collection=tree.Apply(name=name, args=())) if is_type(context, scope, name):
            return finite_type(context, tree.TypeName(name, span=name.span), what), None
    within = determined(context, term(context, scope, cast(tree.Expr, node.collection)))
    whole = collection(within.type)
    if whole is None and within.type is not BROKEN:
        mismatch(context, within, "a set or a list", f"`{node.name.text} in …`")
    return (BROKEN, None) if whole is None else (whole.element, within)


def _display(
    context: Context, scope: Scope, kind: CollectionKind, nodes: tuple[tree.Expr, ...], hint: Type | None, span: Span
) -> Term:
    inside = of_elements(hint)
    return display(context, kind, [term(context, scope, node, inside) for node in nodes], hint, span)


def _comprehension(context: Context, scope: Scope, node: tree.Comprehension, hint: Type | None) -> Term:
    inner, binders = bind(context, scope, node.binders)
    where = _where(context, inner, node)
    element = term(context, inner, node.element, of_elements(hint))
    return comprehension(node.kind, binders, where, element, hint, node.span)


def _where(context: Context, scope: Scope, node: tree.Comprehension | tree.Quantifier) -> Term | None:
    """The condition on the variables of a term, which Python writes behind an ``if``."""
    return None if node.where is None else formula(context, scope, node.where, node.span.either("`where`", "`if`"))


def _text(context: Context, scope: Scope, node: tree.Message) -> Term:
    parts = message_parts(context, scope, node)
    if all(isinstance(part, str) for part in parts):
        return Literal("".join(map(str, parts)), type=STRING, span=node.span)
    if any(not isinstance(part, str) and part.type is BROKEN for part in parts):
        return broken(node.span)
    return Text(parts, type=STRING, span=node.span)


def message_parts(context: Context, scope: Scope, node: tree.Message) -> tuple[str | Term, ...]:
    """The pieces of text and the terms of a message."""
    return tuple([part if isinstance(part, str) else term(context, scope, part) for part in node.parts])


def _quantifier(context: Context, scope: Scope, node: tree.Quantifier) -> Term:
    inner, binders = bind(context, scope, node.binders)
    where = _where(context, inner, node)
    logical = node.kind in ("exists", "forall", "count")
    body = (formula if logical else number)(context, inner, node.body, f"`{sign(node.kind, node.span)}`")
    if BROKEN in [body.type, *[binder.variable.type for binder in binders]]:
        return broken(node.span)
    type_ = BOOL if node.kind in ("exists", "forall") else INT if logical else numeric_type([body])
    return Quantified(node.kind, binders, where, body, type=type_, span=node.span)
