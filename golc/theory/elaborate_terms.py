"""Expressions to typed terms.

A term that cannot be elaborated is a finding and a literal of type ``BROKEN``, which fits everywhere: one mistake is
one finding. The elaborator calls itself from Python code alone, never through a builtin: a deep term costs no C stack.
"""

from __future__ import annotations

import itertools
from typing import cast

from golc.diagnostics import Code, Span
from golc.syntax import tree
from golc.theory.closed import NoValueError, arithmetic
from golc.theory.context import Context, Signature
from golc.theory.elaborate_names import arity_fits, doing, resolve
from golc.theory.elaborate_types import elaborate_type, finite_type, named_type, unknown_type
from golc.theory.fitting import BROKEN, describe, join, overlap, strip_optional
from golc.theory.scope import Kind, Scope
from golc.theory.terms import (
    Binder,
    DefinedTerm,
    FluentTerm,
    Literal,
    Membership,
    Operation,
    Operator,
    PossTerm,
    Quantified,
    StaticTerm,
    Term,
    Variable,
    subterms,
)
from golc.theory.types import BOOL, INT, NONE, Enumeration, Optional, Type, Value, show

LARGEST = 1000
"""How large the tests may be that stand for ``x in {a, b}``: each repeats x, so that nested ones would grow like 2ⁿ."""

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


def broken(span: Span) -> Term:
    """What stands for a term that could not be elaborated."""
    return Literal(None, type=BROKEN, span=span)


def formula(context: Context, scope: Scope, node: tree.Expr, what: str) -> Term:
    """A term of type ``bool``; ``what`` says for what it is needed."""
    return fitting(context, scope, node, BOOL, what)


def fitting(context: Context, scope: Scope, node: tree.Expr, needed: Type, what: str) -> Term:
    """A term whose values may be of a type; ``what`` says for what it is needed."""
    found = term(context, scope, node, needed)
    return found if fits(context, found, needed, what) else broken(node.span)


def fits(context: Context, found: Term, needed: Type, what: str) -> bool:
    """Whether a term may have a value of a type; otherwise a finding. Constants have to be values of it."""
    if needed is BROKEN:
        return True
    stack, good = [found], True
    while stack:
        part = stack.pop()
        if isinstance(part, Operation) and part.op is Operator.CONDITIONAL:
            stack.extend((part.args[2], part.args[0]))
        elif isinstance(part, Literal) and part.type is not BROKEN and overlap(part.type, needed):
            if part.value not in needed:
                value = "" if _shown(part) == show(part.value) else f" is {show(part.value)}, which"
                message = f"`{_shown(part)}`{value} is outside {describe(needed)}"
                context.error(Code.OUTSIDE_TYPE, message, part.span, f"{what} needs {describe(needed)}")
                good = False
        elif not overlap(part.type, needed):
            mismatch(context, part, describe(needed), what, _cure(part, needed))
            good = False
    return good


def mismatch(context: Context, found: Term, needed: str, what: str, help: str | None = None) -> None:
    """Report a term of the wrong type."""
    if found.type == NONE:
        message = f"{what} needs {needed}, and `none` is no such value"
        context.error(Code.TYPE_MISMATCH, message, found.span, "never `none`", help)
    else:
        type_ = f"of type {describe(found.type)}"
        message = f"`{_shown(found)}` is {type_}, but {what} needs {needed}"
        context.error(Code.TYPE_MISMATCH, message, found.span, f"this is {type_}", help)


def _cure(found: Term, needed: Type) -> str | None:
    if isinstance(found, Literal) and found.value is None:
        return f"the type `{needed}?` has the value `none`, too"
    if needed == BOOL:
        return f"compare it: `{_shown(found)} = …`"
    return None


def _shown(found: Term) -> str:
    text = " ".join(found.span.text.split())
    return text if 0 < len(text) <= 40 else text[:39] + "…" if text else "this term"


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
            return _numeric(context, op, [_integer(context, scope, arg, f"`{kind}`") for arg in args], node.span)
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
        case tree.Epistemic(kind=kind):
            return f"`{kind}(…)` is"
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
    if name in ("abs", "poss") and given != 1:
        message = f"`{name}` takes 1 argument, not {given}"
        context.error(Code.ARITY, message, node.name.span, f"{given} arguments here")
        return broken(node.span)
    if name == "abs":
        operand = _integer(context, scope, node.args[0], "`abs`")
        return _numeric(context, Operator.ABSOLUTE, [operand], node.span)
    if name == "poss":
        return _poss(context, scope, node.args[0], node.span)
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


# ---- operators


def _integer(context: Context, scope: Scope, node: tree.Expr, what: str) -> Term:
    return fitting(context, scope, node, INT, what)


def _numeric(context: Context, op: Operator, args: list[Term], span: Span) -> Term:
    """An operation on integers; its value if all operands are constants."""
    if any(arg.type is BROKEN for arg in args):
        return broken(span)
    last = args[-1]
    values = [arg.value for arg in args if isinstance(arg, Literal)]
    division = op in (Operator.DIVIDE, Operator.MODULO) and isinstance(last, Literal) and last.value == 0
    if division:
        context.error(Code.NO_VALUE, "division by zero", span, "the divisor is 0")
        return broken(span)
    if len(values) < len(args):
        return Operation(op, tuple(args), type=INT, span=span)
    try:
        return Literal(arithmetic(op, cast(list[int], values), span), type=INT, span=span)
    except NoValueError as error:
        context.error(Code.NO_VALUE, f"`{_shown(args[0])} …` has no value: {error.reason}", span)
        return broken(span)


def _unary(context: Context, scope: Scope, node: tree.Unary) -> Term:
    if node.op == "-":
        return _numeric(context, Operator.NEGATE, [_integer(context, scope, node.operand, "`-`")], node.span)
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
        return _numeric(context, ARITHMETIC[op], [left, right], span)
    right = term(context, scope, right_node, left.type)
    if op in EQUALITY:
        return _equality(context, EQUALITY[op], left, right, span)
    return _ordering(context, ORDER[op], left, right, span)


def _kinds(found: Term) -> frozenset[str]:
    """The kinds of a term's values; of a symbol only the one that it has."""
    match found:
        case Literal(value=str(value), type=Enumeration(members=pairs)):
            return frozenset([f"symbol:{owner}" for symbol, owner in pairs if symbol == value])
        case _:
            return found.type.kinds


def _equality(context: Context, op: Operator, left: Term, right: Term, span: Span) -> Term:
    if not _comparable(left, right):
        message = f"{_both(left, right)} can never be equal"
        context.error(Code.TYPE_MISMATCH, message, span, "their types have nothing in common")
        return broken(span)
    return Operation(op, (left, right), type=BOOL, span=span)


def _both(left: Term, right: Term) -> str:
    return f"{_typed(left)} and {_typed(right)}"


def _typed(found: Term) -> str:
    """A term with its type, for a message."""
    text, type_ = _shown(found), strip_optional(found.type)
    return f"`{text}`" if found.type == NONE else f"`{text}`, which is of type `{type_}`,"


def _comparable(left: Term, right: Term) -> bool:
    return left.type is BROKEN or right.type is BROKEN or not _kinds(left).isdisjoint(_kinds(right))


def _ordering(context: Context, op: Operator, left: Term, right: Term, span: Span) -> Term:
    if left.type is BROKEN or right.type is BROKEN:
        return broken(span)
    kinds = (left.type.kinds | right.type.kinds) - {"none"}
    if kinds == INT.kinds:
        return Operation(op, (left, right), type=BOOL, span=span)
    order = _order(left, right) if _comparable(left, right) else None
    if order is None:
        message = f"{_both(left, right)} have no order"
        context.error(Code.TYPE_MISMATCH, message, span, "integers, or values of one enumeration, have an order")
        return broken(span)
    return Operation(op, (left, right), type=BOOL, span=span, order=order)


def _order(left: Term, right: Term) -> tuple[Value, ...] | None:
    """The order that decides between two terms: of the larger one of their types, if it has the values of both."""
    a, b = strip_optional(left.type), strip_optional(right.type)
    if not (isinstance(a, Enumeration) or isinstance(b, Enumeration)) or not (a.finite and b.finite):
        return None
    small, large = (a, b) if len(a.values) <= len(b.values) else (b, a)
    return tuple(large.values) if all(value in large for value in small.values) else None


def _membership(context: Context, scope: Scope, element: Term, node: tree.Expr | tree.IntervalType, span: Span) -> Term:
    match node:
        case tree.SetLiteral(elements=elements):
            return _one_of(context, scope, element, elements, span)
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
    if within is BROKEN or element.type is BROKEN:
        return broken(span)
    if _kinds(element).isdisjoint(within.kinds):
        message = f"{_typed(element)} can never be in {describe(within)}"
        context.error(Code.TYPE_MISMATCH, message, span, "always false")
        return broken(span)
    return Membership(element, within, type=BOOL, span=span)


def _is_type(context: Context, scope: Scope, name: tree.Ident) -> bool:
    if scope.get(name.text) is not None:
        return False
    entry = context.names.values.get(name.text)
    return name.text in ("bool", "int", "real", "string") or (entry is not None and entry.kind is Kind.TYPE)


def _one_of(context: Context, scope: Scope, element: Term, nodes: tuple[tree.Expr, ...], span: Span) -> Term:
    choices = [term(context, scope, node, element.type) for node in nodes]
    if element.type is BROKEN or any(choice.type is BROKEN for choice in choices):
        return broken(span)
    good = True
    for choice in choices:
        if not _comparable(element, choice):
            mismatch(context, choice, describe(element.type), f"a value of `{_shown(element)}`")
            good = False
    if not good:
        return broken(span)
    pairs = [_member(choice) for choice in choices]
    constants = [pair for pair in pairs if pair is not None]
    if len(constants) < len(choices):
        if len([*itertools.islice(subterms(element), LARGEST // len(choices) + 1)]) * len(choices) > LARGEST:
            context.error(Code.UNSUPPORTED, "this term is too large to be compared with several others", element.span)
            return broken(span)
        tests = [Operation(Operator.EQUAL, (element, choice), type=BOOL, span=choice.span) for choice in choices]
        return tests[0] if len(tests) == 1 else Operation(Operator.OR, tuple(tests), type=BOOL, span=span)
    values = Enumeration(tuple(dict.fromkeys([pair for pair in constants if pair[0] is not None])))
    within = values if len(values.members) == len({*constants}) else Optional(values)
    return Membership(element, within, type=BOOL, span=span)


def _member(choice: Term) -> tuple[Value, str] | None:
    """A constant and the enumeration that declared it; none for what is no member of an enumeration."""
    match choice:
        case Literal(value=None):
            return None, ""
        case Literal(value=bool()):
            return None  # a truth value is an `int` to Python, but never a member of an enumeration
        case Literal(value=int(value)):
            return value, ""
        case Literal(value=str(value), type=Enumeration(members=pairs)):
            return next((pair for pair in pairs if pair[0] == value), None)
        case _:
            return None


def _conditional(context: Context, scope: Scope, node: tree.IfElse, hint: Type | None) -> Term:
    condition = formula(context, scope, node.condition, "the condition of `if … else`")
    then = term(context, scope, node.then, hint)
    otherwise = term(context, scope, node.otherwise, hint or then.type)
    type_ = join(then.type, otherwise.type)
    if type_ is None and hint is not None and overlap(then.type, hint) and overlap(otherwise.type, hint):
        type_ = hint
    if type_ is None:
        message = f"{_both(then, otherwise)} cannot be two values of one term"
        context.error(Code.TYPE_MISMATCH, message, node.span, "their types have nothing in common")
        return broken(node.span)
    if BROKEN in (condition.type, type_):
        return broken(node.span)
    return Operation(Operator.CONDITIONAL, (then, condition, otherwise), type=type_, span=node.span)


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
