"""Blocks of statements to typed programs."""

from __future__ import annotations

from fractions import Fraction

from golc.diagnostics import Code, Label
from golc.syntax import tree
from golc.theory import statements as typed
from golc.theory.context import Context, Signature
from golc.theory.elaborate_collections import determined
from golc.theory.elaborate_names import doing
from golc.theory.elaborate_terms import arguments, bind, fitting, formula, message_parts, number, term
from golc.theory.elaborate_types import parameters
from golc.theory.elaborate_values import parameter_scope
from golc.theory.scope import Entry, Kind, Scope
from golc.theory.terms import Literal, Term
from golc.theory.theory import Procedure
from golc.theory.types import BOOL, INT, show


def procedure_signature(context: Context, entry: Entry) -> Signature:
    """The parameters of a procedure."""
    assert isinstance(entry.node, tree.Proc)
    found = parameters(context, entry.node.parameters, f"procedure `{entry.name}`", infinite=True)
    return Signature(entry, found, BOOL)


def procedure(context: Context, entry: Entry) -> Procedure | None:
    """A procedure with its body; whether it is recursive is not known yet."""
    assert isinstance(entry.node, tree.Proc)
    signature = context.signature(entry)
    if signature is None:
        return None
    scope = parameter_scope(context, signature.parameters, entry.node.parameters)
    body = block(context, scope, entry.node.body)
    return Procedure(entry.name, signature.parameters, body, recursive=False, span=entry.span)


def block(context: Context, scope: Scope, node: tree.Block) -> typed.Statement:
    """The program of a block."""
    parts = [statement(context, scope, part) for part in node.statements]
    return parts[0] if len(parts) == 1 else typed.Sequence(tuple(parts), span=node.span)


def statement(context: Context, scope: Scope, node: tree.Statement) -> typed.Statement:
    """The program of a statement."""
    span = node.span
    match node:
        case tree.Call(target=target):
            return _call(context, scope, target)
        case tree.Test(condition=condition):
            return typed.Test(formula(context, scope, condition, "`test`"), span=span)
        case tree.Skip():
            return typed.Skip(span=span)
        case tree.If():
            return _if(context, scope, node)
        case tree.While(condition=condition, body=body):
            test = formula(context, scope, condition, "`while`")
            return typed.While(test, block(context, scope, body), span=span)
        case tree.Choose(branches=branches):
            return typed.Choose(_blocks(context, scope, branches), span=span)
        case tree.Together(branches=branches):
            return typed.Together(_blocks(context, scope, branches), span=span)
        case tree.Prefer(branches=branches):
            return typed.Prefer(_blocks(context, scope, branches), span=span)
        case tree.Pick():
            inner, binders = bind(context, scope, node.binders)
            where = None if node.where is None else formula(context, inner, node.where, "`where`")
            return typed.Pick(binders, where, block(context, inner, node.body), span=span)
        case tree.Let(name=name, value=value, body=body):
            found = determined(context, term(context, scope, value))
            inner, variable = scope.bind(name, found.type)
            return typed.Let(variable, found, block(context, inner, body), span=span)
        case tree.Interrupts(handlers=handlers):
            return typed.Interrupts(tuple([_interrupt(context, scope, handler) for handler in handlers]), span=span)
        case tree.Wait():
            return typed.Wait(span=span)
        case tree.WaitUntil(condition=condition):
            return typed.WaitUntil(
                formula(context, scope, condition, span.either("`wait until`", "`wait(until=…)`")), span=span
            )
        case tree.Say(message=message):
            return typed.Say(spoken(context, scope, message), span=span)
        case tree.Abort(message=message):
            return typed.Abort(spoken(context, scope, message), span=span)
        case _:
            return _repeated(context, scope, node)


def spoken(context: Context, scope: Scope, node: tree.Message) -> typed.Message:
    """A message with its terms."""
    return typed.Message(message_parts(context, scope, node))


def _repeated(context: Context, scope: Scope, node: tree.Statement) -> typed.Statement:
    """What does a block several times, under a condition, with look-ahead, or in some time."""
    span = node.span
    match node:
        case tree.Star(limit=limit, body=body):
            what = span.either("`star at most`", "`star(at_most=…)`")
            most = None if limit is None else _count(context, scope, limit, what)
            return typed.Star(most, block(context, scope, body), span=span)
        case tree.For():
            inner, binders = bind(context, scope, node.binders)
            where = None if node.where is None else formula(context, inner, node.where, "`where`")
            return typed.For(binders, where, block(context, inner, node.body), span=span)
        case tree.TogetherStar(body=body):
            return typed.TogetherStar(block(context, scope, body), span=span)
        case tree.Guard(condition=condition, body=body):
            guard = formula(context, scope, condition, "`guard`")
            return typed.Guard(guard, block(context, scope, body), span=span)
        case tree.Search(mode=mode, at_most=at_most, within=within, body=body):
            strategy = typed.Strategy(mode or "first")
            what = span.either("`at most … steps`", "`search(at_most=…)`")
            steps = None if at_most is None else _count(context, scope, at_most, what)
            seconds = None if within is None else _seconds(context, scope, within)
            return typed.Search(strategy, steps, seconds, block(context, scope, body), span=span)
        case tree.Within(duration=duration, body=body):
            otherwise = typed.Skip(span=span) if node.otherwise is None else block(context, scope, node.otherwise)
            return typed.Within(_seconds(context, scope, duration), block(context, scope, body), otherwise, span=span)
        case tree.WaitTime(duration=duration):
            return typed.WaitTime(_seconds(context, scope, duration), span=span)
    raise AssertionError(node)


def _count(context: Context, scope: Scope, node: tree.Expr, what: str) -> Term:
    found = fitting(context, scope, node, INT, what)
    if isinstance(found, Literal) and isinstance(found.value, int) and found.value < 0:
        context.error(Code.OUTSIDE_TYPE, f"the number {found.value} is negative", node.span, "at least 0")
    return found


def _seconds(context: Context, scope: Scope, node: tree.Expr) -> typed.Duration:
    found = number(context, scope, node, "a time in seconds")
    if isinstance(found, Literal) and isinstance(found.value, int | Fraction) and found.value < 0:
        context.error(Code.OUTSIDE_TYPE, f"the time {show(found.value)} s is negative", node.span, "at least 0")
    return found.value if isinstance(found, Literal) and isinstance(found.value, Fraction) else found


def _blocks(context: Context, scope: Scope, nodes: tuple[tree.Block, ...]) -> tuple[typed.Statement, ...]:
    return tuple([block(context, scope, node) for node in nodes])


def _if(context: Context, scope: Scope, node: tree.If) -> typed.Statement:
    found: typed.Statement = typed.Skip(span=node.span)
    if node.otherwise is not None:
        found = block(context, scope, node.otherwise)
    for condition, body in reversed(node.branches):
        test = formula(context, scope, condition, "`if`")
        found = typed.If(test, block(context, scope, body), found, span=condition.span.to(body.span))
    return found


def _interrupt(context: Context, scope: Scope, node: tree.On) -> typed.Interrupt:
    inner, binders = bind(context, scope, node.binders)
    condition = formula(context, inner, node.condition, "`where`" if binders else "`on`")
    return typed.Interrupt(binders, condition, block(context, inner, node.body), span=node.span)


def _call(context: Context, scope: Scope, node: tree.Apply) -> typed.Statement:
    entry = doing(context, node.name, len(node.args), (Kind.ACTION, Kind.PROCEDURE))
    signature = None if entry is None else context.signature(entry)
    if entry is None or signature is None:
        for arg in node.args:
            term(context, scope, arg)
        return typed.Skip(span=node.span)
    if entry.kind is Kind.EXOGENOUS:
        labels = (Label(entry.span, "declared here"),)
        message = f"`{entry.name}` is an exogenous action: it happens, a program cannot do it"
        waiting = node.span.either("wait until", "wait(until=…)")
        help_ = f"wait for it, for example with `{waiting}`"
        context.error(Code.MISUSED_NAME, message, node.name.span, "not an action of the agent", help_, labels)
    args = arguments(context, scope, node, signature)
    if args is None:
        return typed.Skip(span=node.span)
    if entry.kind is Kind.PROCEDURE:
        return typed.Invoke(entry.name, args, span=node.span)
    return typed.Perform(entry.name, args, span=node.span)
