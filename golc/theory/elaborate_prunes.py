"""Prunes: bad situations, which look-ahead never enters."""

from __future__ import annotations

from collections.abc import Iterable

from golc.diagnostics import Code, Label
from golc.syntax import tree
from golc.theory.context import Context
from golc.theory.elaborate_patterns import acting, conjunction, matching
from golc.theory.elaborate_terms import formula
from golc.theory.fitting import BROKEN
from golc.theory.scope import Scope
from golc.theory.terms import Literal
from golc.theory.theory import Prune
from golc.theory.types import BOOL


def prunes(context: Context, nodes: Iterable[tree.Prune | tree.PruneAfter]) -> dict[str, Prune]:
    """The prunes of a file by name; they have a namespace of their own."""
    found: dict[str, Prune] = {}
    places: dict[str, tree.Ident] = {}
    for node in nodes:
        name = node.name
        if name.text in places:
            labels = (Label(places[name.text].span, "first declared here"),)
            message = f"prune `{name.text}` is declared twice"
            context.error(Code.DUPLICATE, message, name.span, "declared again", labels=labels)
        places.setdefault(name.text, name)
        prune = _after(context, node) if isinstance(node, tree.PruneAfter) else _everywhere(context, node)
        if prune is not None:
            found.setdefault(prune.name, prune)
    return found


def _everywhere(context: Context, node: tree.Prune) -> Prune | None:
    condition = formula(context, Scope(), node.condition, f"prune `{node.name.text}`")
    return None if condition.type is BROKEN else Prune(node.name.text, None, condition, span=node.name.span)


def _after(context: Context, node: tree.PruneAfter) -> Prune | None:
    """A prune of what an action leads to: what the pattern demands becomes a part of the condition."""
    action = acting(context, node.pattern, "a prune")
    if action is None:
        return None
    found = matching(context, node.pattern, action, {})
    conditions = [*found.demands]
    if node.condition is not None:
        scope = Scope(found.bound, len(action.parameters), before=True)
        conditions.append(formula(context, scope, node.condition, "`when`"))
    if any(condition.type is BROKEN for condition in conditions):
        return None
    condition = conjunction(conditions) if conditions else Literal(True, type=BOOL, span=node.pattern.span)
    return Prune(node.name.text, action.entry.name, condition, span=node.name.span)
