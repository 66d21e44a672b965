"""What a theory declares, as tables for people."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from golc.diagnostics import Span, counted
from golc.syntax import tree
from golc.theory.theory import Action, BasicActionTheory, Device, Parameter

KINDS: Mapping[type[tree.Node], str] = {
    tree.TypeDecl: "type",
    tree.Const: "const",
    tree.Static: "static",
    tree.Extern: "static",
    tree.Fluent: "fluent",
    tree.Define: "definition",
    tree.Invariant: "invariant",
    tree.Goal: "goal",
    tree.Action: "action",
    tree.Exog: "exogenous action",
    tree.Proc: "procedure",
    tree.Prune: "prune",
    tree.PruneAfter: "prune",
    tree.Scenario: "scenario",
}
"""What is declared by name, in the order in which a table lists it."""


@dataclass(frozen=True)
class Table:
    """A heading of each column, and rows of as many texts; the first heading says what the rows are."""

    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def tables(theory: BasicActionTheory) -> list[Table]:
    """A table for each sort of thing that the theory declares any of."""
    fluents = [
        (_call(fluent.name, fluent.parameters), str(fluent.type), _text(fluent.initial.span))
        for fluent in theory.fluents.values()
    ]
    actions = [
        (
            _call(action.name, action.parameters),
            "; ".join([_text(term.span) for term in action.preconditions]),
            ", ".join(_remarks(action)),
        )
        for action in theory.actions.values()
    ]
    definitions = [(_call(each.name, each.parameters), _text(each.body.span)) for each in theory.definitions.values()]
    procedures = [(_call(each.name, each.parameters),) for each in theory.procedures.values()]
    devices = [(_device(each), each.file or "", counted(len(each.bindings), "line")) for each in theory.devices]
    found = [
        Table(("fluent", "type", "at first"), tuple(fluents)),
        Table(("action", "possible if", ""), tuple(actions)),
        Table(("definition", "stands for"), tuple(definitions)),
        Table(("procedure",), tuple(procedures)),
        Table(("device", "file", ""), tuple(devices)),
    ]
    return [table for table in found if table.rows]


def declared(file: tree.File) -> Table:
    """The names that a tree declares, whether or not a theory can be made of it."""
    names: dict[str, list[str]] = {kind: [] for kind in KINDS.values()}
    for node in file.declarations:
        if type(node) in KINDS:
            names[KINDS[type(node)]].append(node.name.text)  # type: ignore[union-attr]
    return Table(("declared so far", ""), tuple((kind, ", ".join(found)) for kind, found in names.items() if found))


def as_text(table: Table) -> Iterator[str]:
    """A table in aligned columns."""
    lines = [table.headings, *[(f"  {row[0]}", *row[1:]) for row in table.rows]]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        yield "  ".join([f"{cell:{width}}" for cell, width in zip(line, widths, strict=True)]).rstrip()


def _call(name: str, parameters: Sequence[Parameter]) -> str:
    named = ", ".join(f"{parameter.name}: {parameter.type}" for parameter in parameters)
    return f"{name}({named})" if named else name


def _text(span: Span) -> str:
    return " ".join(span.text.split())


def _remarks(action: Action) -> Iterator[str]:
    if action.exogenous:
        yield "exogenous"
    if action.senses:
        yield "senses " + ", ".join([_text(term.span) for term in action.senses])


def _device(device: Device) -> str:
    return device.kind if device.name == device.kind else f"{device.kind} {device.name}"
