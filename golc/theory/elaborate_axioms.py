"""Successor state axioms, translated into the effects that say the same.

A line ``after a(x, y) := e when c`` of an axiom for f(x) becomes an effect of the action a: what the pattern demands of
the action's arguments, and that no earlier line for the same action fits, goes into the effect's condition; a parameter
of the head that the pattern does not mention runs over its type.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from golc.diagnostics import Code, Findings, Label
from golc.syntax import tree
from golc.theory.context import Context, Signature
from golc.theory.elaborate_knowledge import new_value
from golc.theory.elaborate_names import arity_fits, unknown_fluent
from golc.theory.elaborate_patterns import acting, conjunction, matching
from golc.theory.elaborate_terms import formula
from golc.theory.fitting import BROKEN
from golc.theory.scope import Kind, Local, Scope
from golc.theory.terms import Binder, Literal, Operation, Operator, Term, Variable
from golc.theory.theory import Action, Effect
from golc.theory.types import BOOL, Type


def with_axioms(context: Context, nodes: Sequence[tree.Axiom], actions: Mapping[str, Action]) -> dict[str, Action]:
    """The actions with the effects that axioms describe; what is wrong with an axiom is a finding."""
    effects: dict[str, list[Effect]] = {}
    described: dict[str, tree.Axiom] = {}
    for node in nodes:
        signature = _head(context, node)
        if signature is None:
            for case in node.cases:
                acting(context, case.pattern, "an axiom")
            continue
        name = node.fluent.text
        if name in described:
            labels = (Label(described[name].fluent.span, "the first axiom"),)
            message = f"fluent `{name}` has two axioms"
            context.error(Code.DUPLICATE, message, node.fluent.span, "a second one", labels=labels)
        described.setdefault(name, node)
        _not_by_causes(context, node, actions)
        for action, effect in _Axiom(context, node, signature).effects():
            effects.setdefault(action, []).append(effect)
    return {
        name: replace(action, effects=(*action.effects, *effects.get(name, ()))) for name, action in actions.items()
    }


def _not_by_causes(context: Context, node: tree.Axiom, actions: Mapping[str, Action]) -> None:
    name = node.fluent.text
    clauses = [effect for action in actions.values() for effect in action.effects if effect.fluent == name]
    if clauses:
        context.error(
            Code.MISPLACED_CLAUSE,
            f"fluent `{name}` is described by an axiom and by `causes`",
            node.fluent.span,
            "an axiom says everything about a fluent",
            help="use one of the two",
            labels=tuple(Label(effect.span, "changes it, too") for effect in clauses[:5]),
        )


def _head(context: Context, node: tree.Axiom) -> Signature | None:
    """The fluent that an axiom describes; its parameters are names without types."""
    name = node.fluent
    entry = context.names.values.get(name.text)
    if entry is None:
        unknown_fluent(context, Scope(), name, len(node.parameters))
        return None
    if entry.kind is not Kind.FLUENT:
        labels = (Label(entry.span, "declared here"),)
        message = f"`{entry.name}` is {entry.kind.phrase}, and an axiom describes a fluent"
        context.error(Code.MISUSED_NAME, message, name.span, "a fluent is needed here", labels=labels)
        return None
    seen: dict[str, tree.Ident] = {}
    for parameter in node.parameters:
        if parameter.text in seen:
            labels = (Label(seen[parameter.text].span, "first here"),)
            message = f"two parameters have the name `{parameter.text}`"
            context.error(Code.DUPLICATE, message, parameter.span, "the same name again", labels=labels)
        seen.setdefault(parameter.text, parameter)
    head = tree.Apply(name, span=name.span)
    fits = arity_fits(context, head, entry, len(node.parameters)) and len(seen) == len(node.parameters)
    return context.signature(entry) if fits else None


@dataclass(frozen=True)
class _Line:
    """An ``after`` line whose action is known."""

    node: tree.After
    action: Signature

    @property
    def name(self) -> str:
        return self.action.entry.name


@dataclass(frozen=True)
class _Case:
    """What a line demands, in the scope of an effect: of the arguments (in order), and by its ``when``."""

    scope: Scope
    demands: tuple[Term, ...]
    condition: Term | None

    def conditions(self) -> tuple[Term, ...]:
        return self.demands if self.condition is None else (*self.demands, self.condition)


class _Axiom:
    """The lines of an axiom, and what they mean."""

    def __init__(self, context: Context, node: tree.Axiom, signature: Signature) -> None:
        self.context = context
        self.node = node
        self.signature = signature
        self.heads = {name.text: index for index, name in enumerate(node.parameters)}

    def effects(self) -> list[tuple[str, Effect]]:
        """An effect for each line that has a meaning, with the name of its action."""
        earlier: dict[str, list[_Line]] = {}
        found = []
        for case in self.node.cases:
            line = self.line(case)
            if line is None:
                continue
            effect = self.effect(line, earlier.get(line.name, ()))
            if effect is not None:
                earlier.setdefault(line.name, []).append(line)
                found.append((line.name, effect))
        return found

    def line(self, node: tree.After) -> _Line | None:
        action = acting(self.context, node.pattern, "an axiom")
        if action is None or BROKEN in [parameter.type for parameter in self.signature.parameters]:
            return None
        return _Line(node, action)

    def effect(self, line: _Line, earlier: Sequence[_Line]) -> Effect | None:
        """The effect of a line, below the earlier ones for the same action."""
        node, fluent = line.node, self.signature.entry.name
        heads, binders = self.head_variables(line)
        case = self.case(line, line, heads)
        declared = self.signature.entry.span
        value = new_value(self.context, case.scope, node.value, self.signature.type, f"fluent `{fluent}`", declared)
        if value is None or any(term.type is BROKEN for term in (*case.conditions(), value)):
            return None
        conditions = [*case.demands]
        for other in earlier:
            before = self.quietly(other, line, heads)
            if before is None or _exclude(case.demands, before.demands):
                continue
            fits = before.conditions()
            if not fits:
                return None  # the earlier line decides in every case
            conditions.append(Operation(Operator.NOT, (conjunction(fits),), type=BOOL, span=other.node.span))
        where = conjunction(conditions) if conditions else None
        return Effect(binders, where, fluent, heads, value, case.condition, span=node.span)

    def head_variables(self, line: _Line) -> tuple[tuple[Variable, ...], tuple[Binder, ...]]:
        """What each parameter of the head is in the effect: an argument of the action, or a variable over its type.

        An argument has the parameter's type here, for whatever else it may be is excluded by a demand.
        """
        places: dict[str, int] = {}
        for place, arg in enumerate(line.node.pattern.args):
            if isinstance(arg, tree.Ident) and arg.text in self.heads:
                places.setdefault(arg.text, place)
        level = len(line.action.parameters)
        heads: list[Variable] = []
        binders: list[Binder] = []
        for name, parameter in zip(self.node.parameters, self.signature.parameters, strict=True):
            if name.text in places:
                heads.append(Variable(places[name.text], name.text, type=parameter.type, span=name.span))
            else:
                bound = Variable(level, name.text, type=parameter.type, span=name.span)
                binders.append(Binder(bound))
                heads.append(bound)
                level += 1
        return tuple(heads), tuple(binders)

    def quietly(self, other: _Line, line: _Line, heads: tuple[Variable, ...]) -> _Case | None:
        """What an earlier line demands, seen from a later one; what is wrong with it has been said. None: it is wrong,
        which leaves no theory anyway."""
        outer, self.context.findings = self.context.findings, Findings()
        try:
            found = self.case(other, line, heads)
        finally:
            self.context.findings = outer
        return None if any(term.type is BROKEN for term in found.conditions()) else found

    def case(self, line: _Line, within: _Line, heads: tuple[Variable, ...]) -> _Case:
        """What ``line`` demands where the head's parameters are ``heads``, which the effect of ``within`` has made."""
        level = max([len(within.action.parameters), *(head.level + 1 for head in heads)])
        names = zip(self.node.parameters, heads, strict=True)
        known = {name.text: Local(head, name.span) for name, head in names}
        found = matching(self.context, line.node.pattern, line.action, known)
        scope = Scope(found.bound, level)
        node = line.node.condition
        condition = None if node is None else formula(self.context, scope, node, "`when`")
        return _Case(scope, found.demands, condition)


def _exclude(one: Sequence[Term], other: Sequence[Term]) -> bool:
    """Whether two lines demand different constants in one place, so that they never fit together."""
    constants = dict(_constants(one))
    return any(place in constants and constants[place] != value for place, value in _constants(other))


def _constants(demands: Sequence[Term]) -> list[tuple[int, tuple[Type, object]]]:
    return [
        (place.level, (place.type, value.value))
        for demand in demands
        if isinstance(demand, Operation) and demand.op is Operator.EQUAL
        for place, value in [demand.args]
        if isinstance(place, Variable) and isinstance(value, Literal)
    ]
