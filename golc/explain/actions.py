"""The pages of actions and of bad situations: preconditions, effects, what is sensed, and what is known afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from golc.explain import signs
from golc.explain.document import Document, join
from golc.explain.formulas import Formulas
from golc.explain.logic import conjuncts
from golc.explain.page import Page, Section, called, conjunction, enclosed, head, implied, says
from golc.explain.pieces import NOT, OR, SUM, quantified
from golc.theory.reading import fluents_read
from golc.theory.terms import Choice, Literal, Term
from golc.theory.theory import Action, BasicActionTheory, Effect, Prune
from golc.theory.types import BOOL

TAKEN = frozenset({"s"})
"""The variable of the axioms themselves."""


def action_page(theory: BasicActionTheory, action: Action) -> Page:
    """When an action is possible, what it changes, and what it finds out."""
    formulas = Formulas(theory, taken=TAKEN).extended([parameter.name for parameter in action.parameters])
    this = _this(formulas, action)
    sections = [
        Section("Action precondition axiom", (_precondition(formulas, action, this),)),
        Section("Effects", tuple([_effect(formulas, this, effect) for effect in action.effects])),
        Section("Sensed fluent axiom", tuple(_sensed(formulas, action, this))),
        Section("Possible worlds", tuple([worlds_after(theory, action)] if _changes_knowledge(theory, action) else [])),
        Section("Cost", tuple(_cost(formulas, action, this))),
    ]
    kind = "exogenous action" if action.exogenous else "action"
    title = head(kind, action.name, action.parameters)
    return Page(title, action.span, tuple([section for section in sections if section.formulas]))


def prune_page(theory: BasicActionTheory, prune: Prune) -> Page:
    """Which situations are bad."""
    parameters = () if prune.action is None else theory.actions[prune.action].parameters
    formulas = Formulas(theory, taken=TAKEN).extended([parameter.name for parameter in parameters])
    now: Document = signs.SITUATION
    if prune.action is not None:
        now = called("do", _this(formulas, theory.actions[prune.action]), signs.SITUATION)
    condition = formulas.at(now, signs.SITUATION).term(prune.condition, OR, False)
    found = implied([condition], called("BadSituation", now))
    return Page(f"prune {prune.name}", prune.span, (Section("Bad situations", (found,)),))


def is_successor(action: Document, before: Document, after: Document = signs.SUCCESSOR) -> Document:
    """``s′ ∈ Do(a, s)``: s′ is one of the worlds that s may become by an action with uncertain effects."""
    return join(after, signs.IN, called("Do", action, before))


def leaves_open(action: Action, fluent: str | None = None) -> bool:
    """Whether effects of an action (on a fluent) leave open what a fluent becomes."""
    return any(isinstance(effect.value, Choice) and fluent in (None, effect.fluent) for effect in action.effects)


def worlds_after(theory: BasicActionTheory, action: Action) -> Document:
    """Which worlds are possible after an action: the successors of those before it, if they agree on what was sensed
    (Scherl & Levesque 2003), and of an exogenous action those in which it was possible."""
    formulas = Formulas(theory, taken=TAKEN).extended([parameter.name for parameter in action.parameters])
    this = _this(formulas, action)
    real, world, after = called("do", this, signs.SITUATION), signs.SUCCESSOR, signs.SECOND_SUCCESSOR
    conditions = [called("K", world, signs.SITUATION)]
    if action.exogenous and action.preconditions:
        conditions.append(called("Poss", this, world))
    if leaves_open(action):
        conditions.append(is_successor(this, world, after))
    else:
        conditions.append(join(after, signs.sign(" = "), called("do", this, world)))
    for term in action.senses:
        relational = term.type == BOOL
        sign, level = (signs.EQUIVALENT, OR) if relational else (signs.EQUALS, SUM)
        same = says(formulas.at(after).term(term, level, False), sign, formulas.at(real).term(term, level))
        conditions.append(enclosed(same) if relational else same)
    return says(called("K", after, real), signs.EQUIVALENT, quantified(signs.EXISTS, world, conjunction(conditions)))


def _changes_knowledge(theory: BasicActionTheory, action: Action) -> bool:
    """Whether there is something to say about the possible worlds after an action."""
    incomplete = any(isinstance(fluent.initial, Choice) for fluent in theory.fluents.values()) or any(
        map(leaves_open, theory.actions.values())
    )
    return incomplete and bool(action.senses or leaves_open(action) or (action.exogenous and action.preconditions))


def _this(formulas: Formulas, action: Action) -> Document:
    return formulas.applied(signs.words(action.name), formulas.names)


def _precondition(formulas: Formulas, action: Action, this: Document) -> Document:
    inner = formulas.at(signs.SITUATION)
    parts = list(chain.from_iterable(map(conjuncts, action.preconditions)))
    possible = called("Poss", this, signs.SITUATION)
    match parts:
        case []:
            return says(possible, signs.EQUIVALENT, signs.words("true"))
        case [only]:
            return says(possible, signs.EQUIVALENT, inner.term(only, OR))
        case _:
            return says(possible, signs.EQUIVALENT, inner.infix(signs.AND, parts, NOT, True))


def _effect(formulas: Formulas, this: Document, effect: Effect) -> Document:
    """``φ ⊃ f(t, do(a, s)) = e``."""
    inner, binders = formulas.at(signs.SITUATION).bound(effect.binders)
    demands: list[Term] = [*conjuncts(effect.where), *conjuncts(effect.condition)]
    level = OR if len(demands) == 1 else NOT
    conditions = [inner.term(demand, level, False) for demand in demands]
    args = [inner.term(arg) for arg in effect.args]
    uncertain = isinstance(effect.value, Choice)
    after = signs.SUCCESSOR if uncertain else called("do", this, signs.SITUATION)
    fluent = inner.applied(signs.words(effect.fluent), args, after)
    if uncertain:
        conditions.append(is_successor(this, signs.SITUATION))
    body = implied(conditions, _becomes(inner, effect, fluent, bool(conditions)))
    return quantified(signs.FORALL, binders, body) if effect.binders else body


def _becomes(formulas: Formulas, effect: Effect, fluent: Document, inside: bool) -> Document:
    match effect.value:
        case Choice() as choice:
            return join(fluent, signs.IN, formulas.among(choice))
        case Literal(value=bool(truth)) if formulas.theory.fluents[effect.fluent].type == BOOL:
            return fluent if truth else join(signs.NOT, fluent)
        case value if formulas.theory.fluents[effect.fluent].type == BOOL:
            found = says(fluent, signs.EQUIVALENT, formulas.term(value, OR))
            return enclosed(found) if inside else found
        case value:
            return says(fluent, signs.EQUALS, formulas.term(value, SUM))


def _sensed(formulas: Formulas, action: Action, this: Document) -> Iterator[Document]:
    """*SF* of a formula, *SR* of any other term; after the effects of the action itself, if it has any on them."""
    changed = {effect.fluent for effect in action.effects}
    for number, term in enumerate(action.senses, 1):
        name = "SF" if term.type == BOOL else "SR"
        sign = signs.words(name) if len(action.senses) == 1 else signs.indexed(name, number)
        reads = not changed.isdisjoint(fluents_read(formulas.theory, [term]))
        now: Document = called("do", this, signs.SITUATION) if reads else signs.SITUATION
        left = formulas.applied(sign, [this], signs.SITUATION)
        if term.type == BOOL:
            yield says(left, signs.EQUIVALENT, formulas.at(now).term(term, OR))
        else:
            yield says(left, signs.EQUALS, formulas.at(now).term(term, SUM))


def _cost(formulas: Formulas, action: Action, this: Document) -> Iterator[Document]:
    if action.cost is not None:
        cost = formulas.at(signs.SITUATION).term(action.cost, SUM)
        yield says(called("cost", this, signs.SITUATION), signs.EQUALS, cost)
