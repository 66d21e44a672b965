"""Patterns of actions, ``a(x, 3)``: what they demand of the arguments, and which names they bind."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from golc.diagnostics import Code, Label
from golc.syntax import tree
from golc.theory.context import Context, Signature
from golc.theory.elaborate_names import arity_fits, doing
from golc.theory.elaborate_terms import fitting
from golc.theory.expectations import broken
from golc.theory.fitting import BROKEN, includes, overlap
from golc.theory.forms import describe
from golc.theory.relations import equality
from golc.theory.scope import Kind, Local, Scope
from golc.theory.terms import Membership, Operation, Operator, Term, Variable
from golc.theory.theory import Parameter
from golc.theory.types import BOOL


@dataclass(frozen=True)
class Match:
    """The names that are known beside a pattern, and what it demands of the action's arguments, in order."""

    bound: Mapping[str, Local]
    demands: tuple[Term, ...]


def acting(context: Context, pattern: tree.Pattern, who: str) -> Signature | None:
    """The action that a pattern speaks of; none, and a finding, if there is none. ``who`` is what has the pattern."""
    entry = doing(context, pattern.action, len(pattern.args), (Kind.ACTION, Kind.EXOGENOUS))
    if entry is not None and entry.kind is Kind.PROCEDURE:
        labels = (Label(entry.span, "declared here"),)
        message = f"`{entry.name}` is a procedure, and {who} speaks of actions"
        context.error(Code.MISUSED_NAME, message, pattern.action.span, "not an action", labels=labels)
        return None
    signature = None if entry is None else context.signature(entry)
    if entry is None or signature is None or not arity_fits(context, pattern, entry, len(pattern.args)):
        return None
    return None if BROKEN in [parameter.type for parameter in signature.parameters] else signature


def matching(context: Context, pattern: tree.Pattern, action: Signature, known: Mapping[str, Local]) -> Match:
    """What a pattern means where some names are known: the action's parameters are the variables of the first levels.

    Numbers and the names of consts and symbols are demanded, known names have to match, other names are bound.
    """
    bound = dict(known)
    demands: list[Term] = []
    for place, (arg, parameter) in enumerate(zip(pattern.args, action.parameters, strict=True)):
        given = Variable(place, parameter.name, type=parameter.type, span=arg.span, bound=parameter.span)
        if isinstance(arg, tree.Ident) and _is_new(context, arg.text, bound):
            bound[arg.text] = Local(given, arg.span)
        elif isinstance(arg, tree.Ident) and arg.text in bound:
            demands += _same(context, given, bound[arg.text].variable, arg)
        else:
            demands.append(_constant(context, given, arg, parameter, action.entry.name))
    return Match(bound, tuple(demands))


def conjunction(terms: Sequence[Term]) -> Term:
    """All of some formulas, at least one."""
    return terms[0] if len(terms) == 1 else Operation(Operator.AND, tuple(terms), type=BOOL, span=terms[0].span)


def _is_new(context: Context, name: str, bound: Mapping[str, Local]) -> bool:
    """Whether a name in a pattern is bound there: it is neither bound already nor a constant."""
    entry = context.names.values.get(name)
    return name not in bound and (entry is None or entry.kind not in (Kind.SYMBOL, Kind.CONSTANT))


def _same(context: Context, given: Variable, other: Variable, arg: tree.Ident) -> list[Term]:
    """The demand that an argument is what its name stands for already; if it is that very argument, that it is of the
    type that is known of it."""
    if not overlap(given.type, other.type):
        there, here = describe(other.type, arg.span), describe(given.type, arg.span)
        message = f"`{arg.text}` is of type {there}, and here of type {here}"
        context.error(Code.TYPE_MISMATCH, message, arg.span, "their types have nothing in common")
        return [broken(arg.span)]
    if given.level != other.level:
        return [Operation(Operator.EQUAL, (given, other), type=BOOL, span=arg.span)]
    if given.type.finite and includes(other.type, given.type):
        return []
    return [Membership(given, other.type, type=BOOL, span=arg.span)]


def _constant(
    context: Context,
    given: Variable,
    arg: tree.Ident | tree.Number | tree.Truth | tree.Nothing,
    parameter: Parameter,
    action: str,
) -> Term:
    node: tree.Expr = tree.Apply(arg, (), span=arg.span) if isinstance(arg, tree.Ident) else arg
    what = f"parameter `{parameter.name}` of `{action}`"
    value = fitting(context, Scope(), node, given.type, what, parameter.span)
    return equality(context, Operator.EQUAL, given, value, arg.span)
