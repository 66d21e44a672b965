"""Incomplete knowledge: values that are unknown, and what holds in every possible initial world."""

from __future__ import annotations

from collections.abc import Iterable

from golc.diagnostics import Code, Span
from golc.syntax import tree
from golc.theory.context import Context
from golc.theory.elaborate_terms import fitting, formula, term
from golc.theory.elaborate_types import LARGEST
from golc.theory.expectations import fits, mismatch, shown
from golc.theory.fitting import BROKEN, collection, overlap, size
from golc.theory.forms import describe
from golc.theory.reading import reached
from golc.theory.scope import Scope
from golc.theory.terms import Choice, DefinedTerm, Display, Epistemic, Literal, PossTerm, Term, subterms
from golc.theory.theory import BasicActionTheory
from golc.theory.types import BOOL, Collection, Type


def new_value(
    context: Context, scope: Scope, node: tree.ValueExpr, type_: Type, what: str, declared: Span | None = None
) -> Term | Choice | None:
    """What a fluent of a type is set to, in the beginning or by an effect; none, and a finding, if it is a choice that
    has no meaning. ``what`` names the fluent, and ``declared`` is the place of its name."""
    match node:
        case tree.Unknown():
            return _unknown(context, type_, node.span, what)
        case tree.OneOf():
            return _one_of(context, scope, node, type_, what)
        case _:
            return fitting(context, scope, node, type_, what, declared)


def _unknown(context: Context, type_: Type, span: Span, what: str) -> Choice | None:
    if type_ is BROKEN:
        return None
    if not type_.finite or size(type_) > LARGEST:
        why = f"has more than {LARGEST} values" if type_.finite else "cannot be enumerated"
        message = f"{what} cannot be unknown: its type {describe(type_, span)} {why}"
        help_ = f"say which are possible: `{span.either('one of {…}', 'one_of({…})')}`"
        context.error(Code.BAD_TYPE, message, span, "any of its values?", help_)
        return None
    among = Literal(tuple(type_.values), type=Collection("list", type_), span=span)
    return Choice(among, type=type_, span=span)


def _one_of(context: Context, scope: Scope, node: tree.OneOf, type_: Type, what: str) -> Choice | None:
    among = _among(context, scope, node.choices, type_, what)
    if among is None or type_ is BROKEN:
        return None
    if among in (Display((), type=among.type), Literal((), type=among.type), Literal(frozenset(), type=among.type)):
        context.error(Code.NO_CHOICE, f"{what} is one of no values", node.span, "at least one has to be possible")
        return None
    return Choice(among, type=type_, span=node.span)


def _among(context: Context, scope: Scope, node: tree.Expr, type_: Type, what: str) -> Term | None:
    """The collection of the values that are possible, whose elements fit a type."""
    is_set = isinstance(node, tree.SetLiteral) or (isinstance(node, tree.Comprehension) and node.kind == "set")
    found = term(context, scope, node, BROKEN if type_ is BROKEN else Collection("set" if is_set else "list", type_))
    if found.type is BROKEN or type_ is BROKEN:
        return None
    whole, word = collection(found.type), node.span.either("one of", "one_of")
    if whole is None:
        message = f"`{word}` chooses from a set or list, and this is of type {describe(found.type, node.span)}"
        help_ = f"write `{node.span.either(f'one of {{{node.span.text}}}', 'one_of({…})')}`"
        context.error(Code.TYPE_MISMATCH, message, node.span, "not a set or list", help_)
        return None
    needed = Collection(whole.kind, type_)
    if not overlap(whole.element, type_):
        relational = "a fluent without a type is relational, true or false" if type_ == BOOL else None
        mismatch(context, found, describe(needed, node.span), f"`{word}` for {what}", relational)
        return None
    return found if fits(context, found, needed, what) else None


def initially(context: Context, nodes: Iterable[tree.Initially]) -> tuple[Term, ...]:
    """The constraints on the possible initial worlds, as far as they have a meaning."""
    found = [formula(context, Scope(), node.condition, "`initially`") for node in nodes]
    return tuple([condition for condition in found if condition.type is not BROKEN])


def check_initially(context: Context, theory: BasicActionTheory) -> None:
    """A constraint tells possible worlds apart, one by one, so it cannot ask what is known in all of them."""
    for condition in theory.initially:
        for part in subterms(condition):
            if isinstance(part, Epistemic | DefinedTerm | PossTerm) and _asks_knowledge(theory, part):
                marker = "nothing is known before the first situation"
                message = "`initially` cannot depend on what the agent knows"
                if not isinstance(part, Epistemic):
                    message += f", which `{shown(part)}` asks"
                context.error(Code.NOT_CONSTANT, message, part.span, marker)
                break


def _asks_knowledge(theory: BasicActionTheory, term: Term) -> bool:
    return any(isinstance(part, Epistemic) for part in reached(theory, [term]))
