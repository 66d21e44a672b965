"""Fluents, definitions and actions."""

from __future__ import annotations

from fractions import Fraction

from golc.diagnostics import Code, Label, Span
from golc.syntax import tree
from golc.theory.context import Context, Signature
from golc.theory.elaborate_collections import determined
from golc.theory.elaborate_knowledge import new_value
from golc.theory.elaborate_names import unknown_fluent
from golc.theory.elaborate_terms import arguments, bind, formula, number, term
from golc.theory.elaborate_types import LARGEST, elaborate_type, give_a_range, parameters
from golc.theory.elaborate_values import closed_term, parameter_scope
from golc.theory.expectations import fits
from golc.theory.fitting import BROKEN, size
from golc.theory.forms import is_call, type_text, typed_declaration
from golc.theory.scope import Entry, Kind, Scope
from golc.theory.suggest import did_you_mean
from golc.theory.terms import Choice, Literal, Term
from golc.theory.theory import Action, Definition, Effect, Fluent
from golc.theory.types import BOOL, Type, show

SOURCES = ("rcx", "operator", "host", "self")
"""The kinds of device; who may report an exogenous action is one of them, or a device by its name."""


def fluent_signature(context: Context, entry: Entry) -> Signature:
    """The parameters of a fluent, all of finite types, and its type: ``bool`` if none is written."""
    assert isinstance(entry.node, tree.Fluent)
    found = parameters(context, entry.node.parameters, f"fluent `{entry.name}`")
    type_ = BOOL if entry.node.type is None else elaborate_type(context, entry.node.type)
    instances = 1
    for parameter in found:
        instances *= 1 if parameter.type is BROKEN else size(parameter.type)
    if instances > LARGEST:
        message = f"fluent `{entry.name}` has more than {LARGEST} instances"
        context.error(Code.BAD_TYPE, message, entry.span, "too many to enumerate")
    return Signature(entry, found, type_)


def fluent(context: Context, entry: Entry) -> Fluent | None:
    """A fluent with its initial value, which reads no other fluent."""
    node = entry.node
    assert isinstance(node, tree.Fluent)
    signature = context.signature(entry)
    if signature is None:
        return None
    scope = parameter_scope(context, signature.parameters, node.parameters)
    if node.initial is None:
        _no_initial(context, node, signature)
        return None
    initial = _initial_value(context, scope, node, node.initial, signature)
    if initial is None:
        return None
    return Fluent(entry.name, signature.parameters, signature.type, initial, span=entry.span)


def _initial_value(
    context: Context, scope: Scope, node: tree.Fluent, written: tree.ValueExpr, signature: Signature
) -> Term | Choice | None:
    what = f"fluent `{node.name.text}`"
    if isinstance(written, tree.Unknown | tree.OneOf):
        choice = new_value(context, scope, written, signature.type, what)
        closed = isinstance(choice, Choice) and closed_term(context, choice.among, "an initial value")
        return choice if closed else None
    initial = term(context, scope, written, signature.type)
    if node.type is None and initial.type is not BROKEN and initial.type.kinds.isdisjoint(BOOL.kinds):
        message = f"{what} has no type, which makes it relational (`bool`), but its initial value is not a formula"
        declared = typed_declaration("fluent", node.name, initial.type, initial.span.text)
        marker = f"this is of type `{type_text(initial.type, initial.span)}`"
        context.error(Code.TYPE_MISMATCH, message, initial.span, marker, f"write its type: `{declared}`")
        return None
    good = fits(context, initial, signature.type, what) and closed_term(context, initial, "an initial value")
    return initial if good else None


def _no_initial(context: Context, node: tree.Fluent, signature: Signature) -> None:
    name = node.name.text
    if signature.type is BROKEN:
        return
    message, marker = f"fluent `{name}` has no initial value", "what is it at first?"
    context.error(Code.NO_INITIAL, message, node.name.span, marker, _add_value(node.name, signature.type))


def _add_value(name: tree.Ident, type_: Type) -> str:
    """How a declaration gets the initial value that it lacks."""
    value = name.span.either("false", "False") if type_ == BOOL else "…"
    python = f"write `return {value}` in its body"
    if is_call(name.span):
        python = f"write it behind the type: `{typed_declaration('fluent', name, type_, value)}`"
    return name.span.either(f"add `= {value}` at the end of the declaration", python)


def definition_signature(context: Context, entry: Entry) -> Signature | None:
    """The parameters of a definition and the type of its body."""
    found = context.definition(entry)
    return None if found is None else Signature(entry, found.parameters, found.type)


def definition(context: Context, entry: Entry) -> Definition | None:
    """A definition with its body; goals and invariants are formulas without parameters."""
    node = entry.node
    if isinstance(node, (tree.Goal, tree.Invariant)):
        condition = formula(context, Scope(), node.condition, f"{entry.kind.value} `{entry.name}`")
        return None if condition.type is BROKEN else Definition(entry.name, (), BOOL, condition, span=entry.span)
    assert isinstance(node, tree.Define)
    found = parameters(context, node.parameters, f"definition `{entry.name}`", infinite=True)
    body = determined(context, term(context, parameter_scope(context, found, node.parameters), node.body))
    if body.type is BROKEN or BROKEN in [parameter.type for parameter in found]:
        return None
    return Definition(entry.name, found, body.type, body, span=entry.span)


def action_signature(context: Context, entry: Entry) -> Signature:
    """The parameters of an action."""
    assert isinstance(entry.node, (tree.Action, tree.Exog))
    what = f"{entry.kind.value} `{entry.name}`"
    return Signature(entry, parameters(context, entry.node.parameters, what, infinite=True), BOOL)


def action(context: Context, entry: Entry) -> Action | None:
    """An action with its clauses."""
    node = entry.node
    assert isinstance(node, (tree.Action, tree.Exog))
    signature = context.signature(entry)
    if signature is None:
        return None
    scope = parameter_scope(context, signature.parameters, node.parameters)
    exogenous = isinstance(node, tree.Exog)
    preconditions: list[Term] = []
    effects: list[Effect] = []
    senses: list[Term] = []
    costs: list[tuple[Span, Term]] = []
    for clause in node.clauses:
        match clause:
            case tree.Precondition(condition=condition):
                preconditions.append(formula(context, scope, condition, "`poss`"))
            case tree.Effect():
                effects.extend(_effect(context, scope, clause))
            case tree.Senses(value=value):
                _only_primitive(context, exogenous, "senses", clause.span, entry)
                senses.append(determined(context, term(context, scope, value)))
            case tree.Cost(value=value):
                _only_primitive(context, exogenous, "costs", clause.span, entry)
                costs.append((clause.span, _cost(context, scope, value)))
    _one_cost(context, entry, [span for span, _ in costs])
    expected = isinstance(node, tree.Exog) and node.expected
    if expected:
        _enumerable(context, signature)
    return Action(
        entry.name,
        signature.parameters,
        exogenous,
        tuple(preconditions),
        tuple(effects),
        tuple(senses),
        costs[0][1] if costs else None,
        _sources(context, node) if isinstance(node, tree.Exog) else (),
        expected,
        span=entry.span,
    )


def _only_primitive(context: Context, exogenous: bool, what: str, span: Span, entry: Entry) -> None:
    if exogenous:
        message = f"`{entry.name}` is an exogenous action: it {what} nothing, for it is not the agent who does it"
        context.error(Code.MISPLACED_CLAUSE, message, span, "only a primitive action has this clause")


def _one_cost(context: Context, entry: Entry, spans: list[Span]) -> None:
    for span in spans[1:]:
        labels = (Label(spans[0], "the first one"),)
        context.error(Code.MISPLACED_CLAUSE, f"`{entry.name}` has two costs", span, "a second cost", labels=labels)


def _cost(context: Context, scope: Scope, node: tree.Expr) -> Term:
    cost = number(context, scope, node, "`cost`")
    if isinstance(cost, Literal) and isinstance(cost.value, int | Fraction) and cost.value < 0:
        context.error(Code.OUTSIDE_TYPE, f"the cost {show(cost.value)} is negative", node.span, "at least 0")
    return cost


def _enumerable(context: Context, signature: Signature) -> None:
    """Look-ahead tries an expected action with all its arguments."""
    for parameter in signature.parameters:
        if parameter.type is not BROKEN and not parameter.type.finite:
            what = f"parameter `{parameter.name}` of expected exogenous action `{signature.entry.name}`"
            place, marker = parameter.span, "look-ahead tries every value"
            written = type_text(parameter.type, place)
            message = f"{what} has to be of a type that can be enumerated, and `{written}` cannot"
            context.error(Code.BAD_TYPE, message, place, marker, give_a_range(place))


def _sources(context: Context, node: tree.Exog) -> tuple[str, ...]:
    known = [*dict.fromkeys((*SOURCES, *context.device_names))]
    for source in node.sources:
        if source.text not in known:
            reporting = [name for name in known if name not in ("host", "self")]
            help_ = did_you_mean(source.text, reporting) or f"write one of {', '.join(reporting)}"
            message = f"unknown source `{source.text}`"
            context.error(Code.UNKNOWN_NAME, message, source.span, "neither a kind of device nor a device", help_)
    return tuple([source.text for source in node.sources])


def _effect(context: Context, scope: Scope, node: tree.Effect) -> tuple[Effect, ...]:
    """The effect of a clause, or nothing if it has no meaning."""
    inner, binders = bind(context, scope, node.binders)
    where = None if node.where is None else formula(context, inner, node.where, "`where`")
    signature = _target(context, inner, node.target)
    args = None if signature is None else arguments(context, inner, node.target, signature)
    if signature is None:
        for arg in node.target.args:
            term(context, inner, arg)
    type_ = BROKEN if signature is None else signature.type
    declared = None if signature is None else signature.entry.span
    value = new_value(context, inner, node.value, type_, f"fluent `{node.target.name.text}`", declared)
    condition = None if node.condition is None else formula(context, inner, node.condition, "`when`")
    if signature is None or args is None or value is None:
        return ()
    return (Effect(binders, where, signature.entry.name, args, value, condition, span=node.span),)


def _target(context: Context, scope: Scope, node: tree.Apply) -> Signature | None:
    entry = context.names.values.get(node.name.text)
    if entry is None:
        unknown_fluent(context, scope, node.name, len(node.args))
        return None
    if entry.kind is not Kind.FLUENT:
        message = f"`{entry.name}` is {entry.kind.phrase}, and only fluents change"
        labels = (Label(entry.span, "declared here"),)
        context.error(Code.MISUSED_NAME, message, node.name.span, "a fluent is needed here", labels=labels)
        return None
    return context.signature(entry)
