"""Which names a file declares: the first pass, before anything is given a meaning."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from golc.diagnostics import Code, Findings, Label, Span
from golc.syntax import tree
from golc.syntax.walk import descendants
from golc.theory.scope import Entry, Kind, Names, Space

BUILTIN_TYPES = ("bool", "int", "real", "string")
FUNCTIONS = ("abs", "len", "first", "rest", "poss", "before")


@dataclass
class Declared:
    """The result: all names, and the entry of each declaration that has one (also of those that repeat a name)."""

    names: Names
    entries: dict[int, Entry] = field(default_factory=dict)
    """By the identity of the declaration's node."""

    def entry(self, node: tree.Node) -> Entry:
        return self.entries[id(node)]


def declare(file: tree.File, findings: Findings, assumed: frozenset[str]) -> Declared:
    """Collect the names of a file; repeated and built-in names are findings."""
    opened = any(isinstance(declaration, tree.Import) for declaration in file.declarations)
    collector = _Collector(Declared(Names(assumed=assumed, open=opened)), findings)
    for declaration in file.declarations:
        collector.declaration(declaration)
    types = [declaration for declaration in file.declarations if isinstance(declaration, tree.TypeDecl)]
    collector.enumerations([node for node in types if isinstance(node.type, tree.EnumType)])
    for node in types:
        if isinstance(node.type, tree.UnionType):
            collector.pieces(node, node.type)
    for enumeration in _inline_enumerations(file):
        collector.inline(enumeration)
    return collector.declared


def _inline_enumerations(file: tree.File) -> Iterator[tree.EnumType]:
    for declaration in file.declarations:
        if not isinstance(declaration, (tree.TypeDecl, tree.Const, tree.Device, tree.Scenario)):
            for node in descendants(declaration):
                if isinstance(node, tree.EnumType):
                    yield node


@dataclass
class _Collector:
    declared: Declared
    findings: Findings

    def declaration(self, node: tree.Declaration) -> None:
        match node:
            case tree.Const():
                self._value(Kind.CONSTANT, node.name, 0, node)
            case tree.TypeDecl():
                self._value(Kind.TYPE, node.name, 0, node)
            case tree.Fluent():
                self._value(Kind.FLUENT, node.name, len(node.parameters), node)
            case tree.Extern():
                self._value(Kind.EXTERN, node.name, len(node.parameters), node)
            case tree.Static():
                self._value(Kind.STATIC, node.name, len(node.parameters), node)
            case tree.Define():
                self._value(Kind.DEFINITION, node.name, len(node.parameters), node)
            case tree.Goal():
                self._value(Kind.GOAL, node.name, 0, node)
            case tree.Invariant():
                self._value(Kind.INVARIANT, node.name, 0, node)
            case tree.Action():
                self._doing(Kind.ACTION, node.name, len(node.parameters), node)
            case tree.Exog():
                self._doing(Kind.EXOGENOUS, node.name, len(node.parameters), node)
            case tree.Proc():
                self._doing(Kind.PROCEDURE, node.name, len(node.parameters), node)
            case _:
                pass  # imports, constraints, scenarios and devices have names of their own, or none

    def _value(self, kind: Kind, name: tree.Ident, arity: int, node: tree.Node) -> None:
        if name.text in BUILTIN_TYPES or (name.text in FUNCTIONS and arity):
            what = "type" if name.text in BUILTIN_TYPES else "function"
            self.findings.error(
                Code.DUPLICATE,
                f"`{name.text}` is a built-in {what} and cannot be declared as {kind.phrase}",
                name.span,
                "choose another name",
            )
        self._add(self.declared.names.values, Entry(kind, name.text, name.span, arity, node))

    def _doing(self, kind: Kind, name: tree.Ident, arity: int, node: tree.Node) -> None:
        self._add(self.declared.names.doings, Entry(kind, name.text, name.span, arity, node))

    def _add(self, space: Space, entry: Entry) -> None:
        if not isinstance(entry.node, tree.EnumType) and entry.kind is not Kind.SYMBOL:
            self.declared.entries[id(entry.node)] = entry
        first = space.entries.setdefault(entry.name, entry)
        if first is not entry:
            self._duplicate(first, entry.kind, entry.span)

    def _duplicate(self, first: Entry, kind: Kind, span: Span) -> None:
        self.findings.error(
            Code.DUPLICATE,
            f"`{first.name}` is declared twice"
            if first.kind is kind
            else f"`{first.name}` is declared as {kind.phrase}, but it is {first.kind.phrase} already",
            span,
            "declared again",
            labels=(Label(first.span, "first declared here"),),
            help="remove one of them, or choose another name",
        )

    # A symbol belongs to one enumeration. A declared enumeration that is part of a larger one (or repeats an earlier
    # one) is a subset of it and declares nothing.

    def enumerations(self, nodes: list[tree.TypeDecl]) -> None:
        """The symbols of the types that are enumerations."""
        largest: dict[str, tree.TypeDecl] = {}
        texts = {id(node): {symbol.text for symbol in _symbols(node.type)} for node in nodes}
        for node in nodes:
            for text in texts[id(node)]:
                if text not in largest or len(texts[id(largest[text])]) < len(texts[id(node)]):
                    largest[text] = node
        for node in nodes:
            symbols = _symbols(node.type)
            whole = largest[symbols[0].text] if symbols else node
            self._listed_twice(node.type)
            if whole is node or not texts[id(node)] <= texts[id(whole)]:
                self._symbols(symbols, node)

    def pieces(self, node: tree.TypeDecl, union: tree.UnionType) -> None:
        """The symbols that the pieces of a declared union declare."""
        for piece in union.pieces:
            if isinstance(piece, tree.EnumType):
                self._new_symbols(piece, node)

    def inline(self, enumeration: tree.EnumType) -> None:
        """The symbols of an enumeration in place of a type's name."""
        self._new_symbols(enumeration, enumeration)

    def _new_symbols(self, enumeration: tree.EnumType, node: tree.Node) -> None:
        self._listed_twice(enumeration)
        symbols = _symbols(enumeration)
        known = [symbol for symbol in symbols if self._is_symbol(symbol.text)]
        if not known:
            self._symbols(symbols, node)
            return
        for symbol in symbols:
            if not self._is_symbol(symbol.text):
                self._unknown(symbol)

    def _is_symbol(self, name: str) -> bool:
        entry = self.declared.names.values.get(name)
        return entry is not None and entry.kind is Kind.SYMBOL

    def _unknown(self, symbol: tree.Ident) -> None:
        if self.declared.names.assumes(symbol.text):
            return
        similar = self.declared.names.similar(symbol.text, [Kind.SYMBOL])
        self.findings.error(
            Code.UNKNOWN_NAME,
            f"unknown value `{symbol.text}`",
            symbol.span,
            "not declared, while others of this enumeration are",
            similar.help(symbol.span) if similar else "list only values that are declared, or only new ones",
            similar.labels if similar else (),
        )

    def _symbols(self, symbols: Iterable[tree.Ident], node: tree.Node) -> None:
        seen: set[str] = set()
        for symbol in symbols:
            if symbol.text not in seen:
                self._add(self.declared.names.values, Entry(Kind.SYMBOL, symbol.text, symbol.span, 0, node))
            seen.add(symbol.text)

    def _listed_twice(self, type_: tree.Type) -> None:
        seen: dict[object, Span] = {}
        for element in type_.elements if isinstance(type_, tree.EnumType) else ():
            value = element.text if isinstance(element, tree.Ident) else element.value
            if value in seen:
                labels = (Label(seen[value], "listed first here"),)
                self.findings.error(
                    Code.DUPLICATE, f"`{value}` is listed twice", element.span, "listed again", labels=labels
                )
            seen.setdefault(value, element.span)


def _symbols(type_: tree.Type) -> list[tree.Ident]:
    elements = type_.elements if isinstance(type_, tree.EnumType) else ()
    return [element for element in elements if isinstance(element, tree.Ident)]
