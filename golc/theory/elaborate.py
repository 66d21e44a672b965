"""The elaborator: the tree of a file to a typed basic action theory.

Names are resolved, types are inferred and checked, constants are evaluated. The work is done in rooms: ``declare``
collects the names, ``context`` resolves each declaration once, the ``elaborate_*`` modules know how.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TypeVar

from golc.diagnostics import Code, Findings, Label, Source
from golc.syntax import tree
from golc.theory import elaborate_actions as actions
from golc.theory import elaborate_statements as programs
from golc.theory import elaborate_types as types
from golc.theory import elaborate_values as values
from golc.theory.calls import circular, substatements
from golc.theory.context import Context, Resolver, Signature
from golc.theory.declare import declare
from golc.theory.elaborate_axioms import with_axioms
from golc.theory.elaborate_devices import device_name, devices
from golc.theory.elaborate_knowledge import check_initially, initially
from golc.theory.elaborate_prunes import prunes
from golc.theory.elaborate_scenarios import scenarios
from golc.theory.python_file import PythonFiles
from golc.theory.recursion import deep_recursion
from golc.theory.scope import Entry, Kind
from golc.theory.statements import Invoke
from golc.theory.terms import DefinedTerm, PossTerm, Term, subterms
from golc.theory.theory import (
    Action,
    BasicActionTheory,
    Constant,
    Definition,
    Fluent,
    Procedure,
    Static,
)
from golc.theory.types import Type
from golc.theory.unfolding import check_unfolding
from golc.theory.unread import brings_a_name, is_about, names_in

T = TypeVar("T")


def elaborate(
    file: tree.File,
    source: Source,
    findings: Findings,
    constants: Mapping[str, str] | None = None,
    trust: bool = False,
) -> BasicActionTheory | None:
    """The theory that a file describes, or None if it has errors; every finding is added to ``findings``.

    ``constants`` are values of consts as texts, which replace those in the file (``-D``). ``trust``: Python code may be
    executed; without it there is no theory, only notes, if a value in its declarations takes that. Of what could not
    be read, names that may be declared there are not reported.
    """
    theory = outline(file, source, findings, constants, trust)
    return None if findings.has_errors else theory


def outline(
    file: tree.File,
    source: Source,
    findings: Findings,
    constants: Mapping[str, str] | None = None,
    trust: bool = False,
) -> BasicActionTheory | None:
    """As ``elaborate``, but if there are errors what is left without the parts that have them, where that can be said;
    what it speaks of need not be in it."""
    found = Findings()
    if not findings.has_errors:
        _no_imports(file, found)
    theory = None
    try:
        with deep_recursion():
            theory = _elaborate(file, source, found, constants or {}, PythonFiles(trust))
    except RecursionError:
        message = "the declarations of this file depend on each other too deeply"
        found.error(Code.NESTING, message, file.domain.span, "more than golc can follow")
    findings.diagnostics += [finding for finding in found.diagnostics if not is_about(finding, file.unread)]
    return theory


def _no_imports(file: tree.File, findings: Findings) -> None:
    """Where nothing is wrong so far, imports have been joined, or there is no file whose folder they could be in."""
    for node in file.declarations:
        if isinstance(node, tree.Import):
            word = node.span.either("import", "import_")
            message = f"there can be no `{word}` in a text that is no file"
            findings.error(Code.NO_FILE, message, node.span, "relative to no folder")


def _elaborate(
    file: tree.File,
    source: Source,
    findings: Findings,
    constants: Mapping[str, str],
    python: PythonFiles,
) -> BasicActionTheory | None:
    declared = declare(file, findings, frozenset(names_in(file.unread)))
    declared.names.nameless = any(map(brings_a_name, file.unread))
    context = Context(source, declared, findings, constants, RESOLVERS, values.constant_value, python)
    blocks = [node for node in file.declarations if isinstance(node, tree.Device)]
    context.device_names = tuple([device_name(node) for node in blocks])
    values.check_overrides(context)
    built = _Builder(context)
    for node in file.declarations:
        built.declaration(node)
    axioms = [node for node in file.declarations if isinstance(node, tree.Axiom)]
    built.actions = with_axioms(context, axioms, built.actions)
    theory = BasicActionTheory(
        file.domain.text,
        source,
        built.constants,
        built.types,
        built.statics,
        built.fluents,
        built.definitions,
        built.actions,
        _with_recursion(built.procedures),
        devices(context, blocks, {action.name: action.senses for action in built.actions.values()}),
        tuple(context.inline_types.values()),
        tuple(built.named[Kind.GOAL]),
        tuple(built.named[Kind.INVARIANT]),
        scenarios(context, [node for node in file.declarations if isinstance(node, tree.Scenario)]),
        initially(context, [node for node in file.declarations if isinstance(node, tree.Initially)]),
        prunes(context, [node for node in file.declarations if isinstance(node, tree.Prune | tree.PruneAfter)]),
        context.python,
    )
    if not _has_circles(context, theory):
        check_unfolding(context, theory)
    check_initially(context, theory)
    context.complaints.finish()
    return None if context.gaps else theory


class _Builder:
    """Elaborates every declaration in order and keeps those that have a meaning."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.constants: dict[str, Constant] = {}
        self.types: dict[str, Type] = {}
        self.statics: dict[str, Static] = {}
        self.fluents: dict[str, Fluent] = {}
        self.definitions: dict[str, Definition] = {}
        self.actions: dict[str, Action] = {}
        self.procedures: dict[str, Procedure] = {}
        self.named: dict[Kind, list[str]] = {Kind.GOAL: [], Kind.INVARIANT: []}

    def declaration(self, node: tree.Declaration) -> None:
        """Elaborate a declaration. One that repeats a name is elaborated, too, for what is wrong inside it."""
        context = self.context
        entry = context.declared.entries.get(id(node))
        if entry is None:
            return  # what has no name that other declarations use comes later
        match entry.kind:
            case Kind.CONSTANT:
                _keep(self.constants, entry, context.constant(entry))
            case Kind.TYPE:
                _keep(self.types, entry, context.type(entry))
            case Kind.STATIC | Kind.EXTERN:
                _keep(self.statics, entry, context.static(entry))
            case Kind.FLUENT:
                _keep(self.fluents, entry, actions.fluent(context, entry))
            case Kind.DEFINITION | Kind.GOAL | Kind.INVARIANT:
                _keep(self.definitions, entry, context.definition(entry))
                if entry.kind is not Kind.DEFINITION:
                    self.named[entry.kind].append(entry.name)
            case Kind.PROCEDURE:
                _keep(self.procedures, entry, programs.procedure(context, entry))
            case _:
                _keep(self.actions, entry, actions.action(context, entry))


def _keep(kept: dict[str, T], entry: Entry, found: T | None) -> None:
    if found is not None:
        kept.setdefault(entry.name, found)


def _with_recursion(procedures: dict[str, Procedure]) -> Mapping[str, Procedure]:
    calls = {
        name: frozenset([part.procedure for part in substatements(procedure.body) if isinstance(part, Invoke)])
        for name, procedure in procedures.items()
    }
    recursive = {name for part in circular(calls) for name in part}
    return {name: replace(procedure, recursive=name in recursive) for name, procedure in procedures.items()}


def _has_circles(context: Context, theory: BasicActionTheory) -> bool:
    """Whether a precondition asks for itself through ``poss(…)``, which is a finding; definitions alone are checked
    where they are resolved."""
    graph = {f"action {name}": _asks(action.preconditions) for name, action in theory.actions.items()}
    graph |= {f"definition {name}": _asks((found.body,)) for name, found in theory.definitions.items()}
    circles = circular(graph)
    for circle in circles:
        places = [_place(theory, node) for node in circle]
        action = next(place for place in places if isinstance(place, Action))
        labels = tuple([Label(place.span, "part of the circle") for place in places if place is not action][:5])
        message = f"the precondition of `{action.name}` depends on itself"
        context.error(Code.CIRCULAR, message, action.span, "asks `poss` of itself", labels=labels)
    return bool(circles)


def _place(theory: BasicActionTheory, node: str) -> Action | Definition:
    kind, name = node.split(" ")
    return theory.actions[name] if kind == "action" else theory.definitions[name]


def _asks(terms: tuple[Term, ...]) -> frozenset[str]:
    asked = set()
    for term in terms:
        for part in subterms(term):
            match part:
                case PossTerm(action=name):
                    asked.add(f"action {name}")
                case DefinedTerm(definition=name):
                    asked.add(f"definition {name}")
    return frozenset(asked)


def _signature(context: Context, entry: Entry) -> Signature | None:
    match entry.kind:
        case Kind.FLUENT:
            return actions.fluent_signature(context, entry)
        case Kind.STATIC | Kind.EXTERN:
            return values.static_signature(context, entry)
        case Kind.DEFINITION | Kind.GOAL | Kind.INVARIANT:
            return actions.definition_signature(context, entry)
        case Kind.PROCEDURE:
            return programs.procedure_signature(context, entry)
        case _:
            return actions.action_signature(context, entry)


RESOLVERS: Mapping[str, Resolver] = {
    "signature": _signature,
    "constant": values.constant,
    "type": types.declared_type,
    "static": values.static,
    "definition": actions.definition,
}
