"""Declarations as Python: a call where Python may compute the arguments, otherwise a function under a decorator."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeAlias

from golc.embed.printing.clauses import action_body, after, axiom_body, device_body, scenario_body, table_doc
from golc.embed.printing.evaluated import keeps_type, keeps_value
from golc.embed.printing.functions import ELLIPSIS, decorator_doc, function_lines, parameter_docs, returned
from golc.embed.printing.layout import INDENT, WIDTH, Brackets, Doc, Joined, laid_out
from golc.embed.printing.names import KINDS, Names
from golc.embed.printing.programs import block
from golc.embed.printing.strings import quoted
from golc.embed.printing.terms import call_doc, keyword, optional, term_doc, type_doc
from golc.syntax import tree as ast
from golc.syntax.python_names import python_name
from golc.syntax.walk import descendants


@dataclass(frozen=True)
class Part:
    """Lines that belong together: without a ``kind`` a function; those of one kind stand close to each other."""

    kind: str
    lines: list[str]
    declaration: ast.Declaration | None = None


class Declarations:
    """Prints declarations one after the other."""

    def __init__(self, names: Names, file: ast.File) -> None:
        self.names = names
        self.mentioned = _mentioned(file)

    def parts(self, place: int, declaration: ast.Declaration) -> Iterator[Part]:
        """A declaration with the symbols that it brings: above it those that it has to name itself."""
        bound = [] if isinstance(declaration, ast.TypeDecl) else self.new_symbols(declaration)
        self.names.known.update(self.names.symbols[symbol] for symbol in bound)
        lines = self.call(place, declaration)
        kind = "" if lines is None else KINDS.get(type(declaration), "import")
        if bound:
            yield Part(kind or "symbols", self.symbols(bound), declaration)
        yield Part(kind, self.function(place, declaration) if lines is None else lines, declaration)
        self.names.known.add(self.names.declared.get(place, ""))
        if isinstance(declaration, ast.TypeDecl) and (brought := self.new_symbols(declaration)):
            self.names.known.update(self.names.symbols[symbol] for symbol in brought)
            yield Part("type", self.unpacked(place, declaration, brought), declaration)

    def new_symbols(self, declaration: ast.Declaration) -> list[str]:
        """The symbols of its enumerations that have no name yet, if one of them is ever named."""
        found: dict[str, None] = {}
        for node in descendants(declaration):
            if isinstance(node, ast.EnumType):
                found.update((element.text, None) for element in node.elements if isinstance(element, ast.Ident))
        table = self.names.symbols
        new = [symbol for symbol in found if symbol in table and table[symbol] not in self.names.known]
        return new if self.mentioned.intersection(new) else []

    def symbols(self, symbols: list[str]) -> list[str]:
        variables = [self.names.symbols[symbol] for symbol in symbols]
        return assigned(variables, call_doc(self.names.word("symbols"), *map(quoted, symbols)))

    def unpacked(self, place: int, declaration: ast.TypeDecl, symbols: list[str]) -> list[str]:
        """The symbols that a type brings: by unpacking it if it has nothing else."""
        if not isinstance(declaration.type, ast.EnumType):
            return self.symbols(symbols)
        table = self.names.symbols
        elements = [element.text for element in declaration.type.elements if isinstance(element, ast.Ident)]
        if len(elements) < len(declaration.type.elements) or any(element not in table for element in elements):
            return self.symbols(symbols)
        variables = [table[element] for element in elements]
        return assigned(variables, self.names.declared[place], unpacked=True)

    def call(self, place: int, declaration: ast.Declaration) -> list[str] | None:
        """A declaration as a call; None if its arguments may not be computed, or have parameters."""
        names = self.names
        match declaration:
            case ast.Import(path=path):
                return laid_out(call_doc("theory.import_", quoted(path)), 0)
            case ast.Const(value=value) if keeps_value(names, value):
                return self.assigned_call(place, declaration, term_doc(names, value))
            case ast.TypeDecl(type=type_) if keeps_type(names, type_, strings=True):
                return self.assigned_call(place, declaration, type_doc(names, type_, strings=True))
            case ast.Static(parameters=(), type=type_, value=value) if type_ is not None:
                if not isinstance(value, ast.Table) and self.keeps(type_, value):
                    return self.assigned_call(place, declaration, type_doc(names, type_), term_doc(names, value))
            case ast.Fluent(parameters=(), type=type_, initial=initial) if self.keeps(type_, initial):
                return self.assigned_call(place, declaration, *self.fluent(type_, initial))
        return None

    def keeps(self, type_: ast.Type | None, value: ast.ValueExpr | None) -> bool:
        kept = type_ is None or keeps_type(self.names, type_)
        return kept and (value is None or keeps_value(self.names, value))

    def fluent(self, type_: ast.Type | None, initial: ast.ValueExpr | None) -> Iterator[Doc]:
        if type_ is not None:
            yield type_doc(self.names, type_)
        if initial is not None:
            value = term_doc(self.names, initial)
            yield keyword("initial", value) if type_ is None else value

    def assigned_call(
        self, place: int, declaration: ast.Const | ast.TypeDecl | ast.Static | ast.Fluent, *args: Doc
    ) -> list[str]:
        call = call_doc(f"theory.{_method(declaration)}", quoted(declaration.name.text), *args)
        return assigned([self.names.declared[place]], call)

    def function(self, place: int, declaration: ast.Declaration) -> list[str]:
        """A declaration as a decorated function."""
        names = self.names
        match declaration:
            case ast.Initially(condition=formula):
                body = returned(term_doc(names, formula))
                return function_lines("theory.initially", names.declared[place], (), None, body)
            case ast.Axiom(fluent=fluent, parameters=parameters):
                variables = tuple(python_name(parameter.text) for parameter in parameters)
                head = call_doc("theory.axiom", self.described(fluent.text))
                return function_lines(head, names.declared[place], variables, None, axiom_body(names, declaration))
            case ast.Device(items=items):
                head = call_doc("theory.device", *_device(declaration))
                return function_lines(head, names.declared[place], (), None, device_body(names, items))
            case ast.Import():
                raise TypeError("an import is a call")
        return self.decorated(place, declaration)

    def described(self, fluent: str) -> Doc:
        """The fluent of an axiom; a string if it is declared further down or nowhere."""
        variable = self.names.terms.get(fluent)
        return variable if variable in self.names.known and variable is not None else quoted(fluent)

    def decorated(self, place: int, declaration: Declared) -> list[str]:
        """Annotations, in which Python sees no parameters, and the body, in which it does."""
        names, parameters = self.names, getattr(declaration, "parameters", ())
        type_ = declaration.type if isinstance(declaration, ast.Static | ast.Extern | ast.Fluent) else None
        returns = None if type_ is None else type_doc(names, type_)
        annotated = parameter_docs(names, parameters)
        options = tuple(_options(declaration))
        python = names.declared[place]
        decorator = decorator_doc(_method(declaration), python, declaration.name.text, options)
        with names.bound(parameter.name.text for parameter in parameters):
            return function_lines(decorator, python, annotated, returns, _body(names, declaration))


Declared: TypeAlias = (
    ast.Const
    | ast.TypeDecl
    | ast.Static
    | ast.Extern
    | ast.Fluent
    | ast.Define
    | ast.Invariant
    | ast.Goal
    | ast.Action
    | ast.Exog
    | ast.Proc
    | ast.Prune
    | ast.PruneAfter
    | ast.Scenario
)
"""Declarations that have a name."""


def _method(declaration: Declared) -> str:
    """The method of a theory that declares such a thing: mostly the kind of node has its name."""
    return type(declaration).__name__.lower().removesuffix("decl").removesuffix("after")


def _body(names: Names, declaration: Declared) -> Iterable[str]:
    match declaration:
        case ast.TypeDecl(type=type_):
            return returned(type_doc(names, type_, strings=True))
        case ast.Static(value=value):
            return returned(table_doc(names, value) if isinstance(value, ast.Table) else term_doc(names, value))
        case ast.Extern() | ast.Fluent(initial=None):
            return [ELLIPSIS]
        case ast.Fluent(initial=value) if value is not None:
            return returned(term_doc(names, value))
        case ast.Const(value=value) | ast.Define(body=value):
            return returned(term_doc(names, value))
        case ast.Invariant(condition=value) | ast.Goal(condition=value) | ast.Prune(condition=value):
            return returned(term_doc(names, value))
        case ast.PruneAfter(pattern=pattern, condition=condition):
            return after(names, pattern, None, condition)
        case ast.Action(clauses=clauses) | ast.Exog(clauses=clauses):
            return action_body(names, clauses)
        case ast.Scenario(items=items):
            return scenario_body(names, items)
        case ast.Proc(body=body):
            return block(names, body, INDENT)
    raise TypeError(f"{declaration!r} is no declaration")


def _options(declaration: Declared) -> Iterator[Doc]:
    """What the decorator of a declaration says besides its name."""
    match declaration:
        case ast.Extern(path=path):
            yield keyword("file", quoted(path))
        case ast.Exog(expected=expected, sources=sources):
            listed = Brackets("[", tuple(quoted(source.text) for source in sources), "]", packed=False)
            yield from optional("expected", "True" if expected else None)
            yield from optional("sources", listed if sources else None)


def _device(device: ast.Device) -> Iterator[Doc]:
    yield quoted(device.kind.text)
    yield from optional("file", None if device.file is None else quoted(device.file))
    yield from optional("name", None if device.name is None else quoted(device.name.text))


def assigned(variables: list[str], value: Doc, unpacked: bool = False) -> list[str]:
    """``a = …``, or ``a, b = …`` in parentheses if that is too long; ``(a,) = …`` takes a single thing apart."""
    targets: Doc = ", ".join(variables)
    if unpacked and len(variables) == 1:
        targets = f"({variables[0]},)"
    lines = laid_out(Joined((targets, " = ", value)), 0)
    if len(lines[0]) > WIDTH and len(variables) > 1:
        lines = laid_out(Joined((Brackets("(", tuple(variables), ")", packed=False), " = ", value)), 0)
    return lines


def _mentioned(file: ast.File) -> set[str]:
    """The names that may be those of symbols, outside of enumerations that a type declares."""
    found: set[str] = set()
    for declaration in file.declarations:
        own = list(_surface(declaration.type)) if isinstance(declaration, ast.TypeDecl) else []
        for node in descendants(declaration):
            match node:
                case ast.Apply(name=name):
                    found.add(name.text)
                case ast.Pattern(args=args) | ast.Binding(args=tuple(args)):
                    found.update(arg.text for arg in args if isinstance(arg, ast.Ident))
                case ast.EnumType(elements=elements) if not any(node is each for each in own):
                    found.update(element.text for element in elements if isinstance(element, ast.Ident))
    return found


def _surface(type_: ast.Type) -> Iterator[ast.Type]:
    """The types that a type is made of, those inside its bounds apart."""
    yield type_
    match type_:
        case ast.UnionType(pieces=pieces):
            yield from pieces
        case ast.OptionalType(base=inner) | ast.CollectionType(element=inner):
            yield from _surface(inner)
