"""What there is to say about a name of a theory: a page for each thing that has it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from golc.diagnostics import Code, Diagnostic, Source, Span, UserError
from golc.explain import signs
from golc.explain.actions import action_page, prune_page
from golc.explain.document import Document, Line, Nest, join
from golc.explain.fluents import fluent_page
from golc.explain.formulas import Formulas
from golc.explain.page import Page, Section, head, implied, says
from golc.explain.pieces import OR, SUM, type_text, value_text
from golc.explain.programs import program
from golc.theory.border import PythonFunction
from golc.theory.recursion import deep_recursion
from golc.theory.suggest import did_you_mean
from golc.theory.theory import BasicActionTheory, Definition, Parameter, Procedure, Static
from golc.theory.types import BOOL, Enumeration, Interval, Type, Value

NAME = "<name>"
"""What messages call the name that somebody asks about."""


def explain(theory: BasicActionTheory, name: str) -> list[Page]:
    """The pages about a name, at least one; raises ``UserError`` if nothing has it."""
    with deep_recursion():
        pages = list(_pages(theory, name))
    if not pages:
        span = Span(Source(NAME, name), 0, len(name))
        message = f"nothing in the domain `{theory.name}` has the name `{name}`"
        raise UserError(Diagnostic(Code.UNKNOWN_NAME, message, span, help=did_you_mean(name, _names(theory))))
    return pages


def _names(theory: BasicActionTheory) -> Iterator[str]:
    tables: tuple[Mapping[str, object], ...] = (
        theory.fluents,
        theory.actions,
        theory.procedures,
        theory.definitions,
        theory.statics,
        theory.prunes,
        theory.types,
        theory.constants,
    )
    for table in tables:
        yield from table
    yield from map(str, theory.symbols)


def _pages(theory: BasicActionTheory, name: str) -> Iterator[Page]:
    if name in theory.fluents:
        yield fluent_page(theory, theory.fluents[name])
    if name in theory.definitions:
        yield _definition(theory, theory.definitions[name])
    if name in theory.statics:
        yield _static(theory, theory.statics[name])
    if name in theory.constants:
        constant = theory.constants[name]
        value = says(signs.words(name), signs.EQUALS, value_text(constant.value, constant.type))
        yield _page("const", name, constant.span, value)
    if name in theory.types:
        yield _page("type", name, None, says(signs.words(name), signs.EQUALS, _written_out(theory.types[name])))
    if name in theory.symbols:
        yield from _symbol(theory, name)
    if name in theory.actions:
        yield action_page(theory, theory.actions[name])
    if name in theory.procedures:
        yield _procedure(theory, theory.procedures[name])
    if name in theory.prunes:
        yield prune_page(theory, theory.prunes[name])


def _page(kind: str, name: str, span: Span | None, *formulas: Document) -> Page:
    return Page(f"{kind} {name}", span, (Section("Definition", formulas),))


def _formulas(theory: BasicActionTheory, parameters: tuple[Parameter, ...]) -> Formulas:
    return Formulas(theory, taken=frozenset({"s"})).extended([parameter.name for parameter in parameters])


def _definition(theory: BasicActionTheory, definition: Definition) -> Page:
    name = definition.name
    formulas = _formulas(theory, definition.parameters).at(signs.SITUATION)
    left = formulas.applied(signs.words(name), formulas.names, formulas.situation_of(name))
    sections = [Section("Definition", (_defined(formulas, left, definition),))]
    kind = "goal" if name in theory.goals else "invariant" if name in theory.invariants else "define"
    if kind == "invariant":
        below = join(signs.INITIAL, signs.BELOW, signs.SITUATION)
        sections.append(Section("State constraint", (implied([below], left),)))
    return Page(head(kind, name, definition.parameters), definition.span, tuple(sections))


def _defined(formulas: Formulas, left: Document, definition: Definition) -> Document:
    if definition.type == BOOL:
        return says(left, signs.EQUIVALENT, formulas.term(definition.body, OR))
    return says(left, signs.EQUALS, formulas.term(definition.body, SUM))


def _static(theory: BasicActionTheory, static: Static) -> Page:
    kind = "extern" if isinstance(static.body, PythonFunction) else "static"
    title = head(kind, static.name, static.parameters)
    formulas = _formulas(theory, static.parameters)
    if isinstance(static.body, Mapping):
        rows = tuple([_row(formulas, static, args, value) for args, value in static.body.items()])
        return Page(title, static.span, (Section("Definition", rows),))
    left = formulas.applied(signs.words(static.name), formulas.names)
    if isinstance(static.body, PythonFunction):
        of_type = join(left, signs.IN, type_text(static.type))
        return Page(title, static.span, (Section(f"Function of {static.body.path}", (of_type,)),))
    definition = Definition(static.name, static.parameters, static.type, static.body)
    return Page(title, static.span, (Section("Definition", (_defined(formulas, left, definition),)),))


def _row(formulas: Formulas, static: Static, args: tuple[Value, ...], value: Value) -> Document:
    """A row of a table: ``next(hall) = kitchen``."""
    types = [parameter.type for parameter in static.parameters]
    left = formulas.applied(signs.words(static.name), [value_text(*pair) for pair in zip(args, types, strict=True)])
    if static.type == BOOL:
        return left if value else join(signs.NOT, left)
    return says(left, signs.EQUALS, value_text(value, static.type))


def _written_out(type_: Type) -> Document:
    return type_text(replace(type_, name=None) if isinstance(type_, Interval | Enumeration) else type_)


def _symbol(theory: BasicActionTheory, name: str) -> Iterator[Page]:
    types = [type_ for type_ in (*theory.types.values(), *theory.inline_types) if type_.finite and name in type_]
    yield _page("symbol", name, None, *(join(signs.words(name), signs.IN, type_text(type_)) for type_ in types))


def _procedure(theory: BasicActionTheory, procedure: Procedure) -> Page:
    formulas = Formulas(theory).extended([parameter.name for parameter in procedure.parameters])
    call = formulas.applied(signs.words(procedure.name), formulas.names)
    body = Nest(join(Line(always=True), program(formulas, procedure.body)))
    whole = join(signs.keyword("proc "), call, body, Line(always=True), signs.keyword("endProc"))
    title = head("procedure", procedure.name, procedure.parameters)
    return Page(title, procedure.span, (Section("Program", (whole,)),))
