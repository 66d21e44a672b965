"""The Python names of what a tree declares and uses: one for each thing, none for two of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator
from contextlib import contextmanager

from golc.syntax import tree as ast
from golc.syntax.python_names import python_name
from golc.syntax.walk import children, descendants

KINDS: dict[type[ast.Node], str] = {
    ast.Const: "const",
    ast.TypeDecl: "type",
    ast.Static: "static",
    ast.Extern: "static",
    ast.Fluent: "fluent",
    ast.Define: "definition",
    ast.Action: "action",
    ast.Exog: "action",
    ast.Axiom: "axiom",
    ast.Initially: "initially",
    ast.Invariant: "invariant",
    ast.Goal: "goal",
    ast.Prune: "prune",
    ast.PruneAfter: "prune",
    ast.Scenario: "scenario",
    ast.Proc: "proc",
    ast.Device: "device",
}
"""What is added to a name that another thing has already."""

TERMS = (ast.Const, ast.Static, ast.Extern, ast.Fluent, ast.Define, ast.Invariant, ast.Goal)
PROGRAMS = (ast.Action, ast.Exog, ast.Proc)
OTHERS = (ast.Prune, ast.PruneAfter, ast.Scenario)

PYTHON_TYPES = {"bool": "bool", "int": "int", "real": "float", "string": "str"}
"""The types of the language that are builtins of Python."""


class Names:
    """Python names for the things of a file, and what of them and of ``golc.embed`` has been used so far.

    ``declared``: the name of each declaration; ``symbols``: of each symbol; ``outside`` and ``outside_types``: of what
    is declared nowhere in the file; ``words``: those of ``golc.embed``; ``known``: the names that the text has given
    so far, and those of what stands outside; ``parameters``: those of each action and procedure.
    """

    def __init__(self, file: ast.File) -> None:
        self._taken = {python_name(node.text) for node in descendants(file) if isinstance(node, ast.Ident)}
        self._given: set[str] = set()
        symbols = _enumerated(file)
        self._clashing = {name for declaration in file.declarations for name in _clashes(declaration, symbols)}
        self._locals: Counter[str] = Counter()
        self.words: set[str] = set()
        self.known: set[str] = set()
        self.declared: dict[int, str] = {}
        self.symbols: dict[str, str] = {}
        self.terms: dict[str, str] = {}
        self.types: dict[str, str] = {}
        self.programs: dict[str, str] = {}
        self.parameters = {
            node.name.text: tuple(parameter.name.text for parameter in node.parameters)
            for node in reversed(file.declarations)
            if isinstance(node, ast.Action | ast.Exog | ast.Proc)
        }
        self.outside: dict[str, str] = {}
        self.outside_types: dict[str, str] = {}
        self._declare(file, symbols)

    def word(self, name: str) -> str:
        """A word of ``golc.embed``, which has to be imported."""
        self.words.add(name)
        return name

    def type(self, name: str) -> str:
        """A type where a type stands."""
        if name in self.types:
            return self.types[name]
        if name in PYTHON_TYPES:
            return PYTHON_TYPES[name]
        if name not in self.outside_types:
            self.outside_types[name] = self._new(name, "type")
            self.known.add(self.outside_types[name])
        return self.outside_types[name]

    def term(self, name: str) -> str:
        """A name in an expression: a variable, what is declared, or what stands elsewhere."""
        if self._locals[name]:
            return python_name(name)
        for table in (self.terms, self.symbols, self.types, self.outside_types):
            if name in table:
                return table[name]
        return self._elsewhere(name) if name not in PYTHON_TYPES else PYTHON_TYPES[name]

    def program(self, name: str) -> str:
        """An action or a procedure."""
        return self.programs[name] if name in self.programs else self._elsewhere(name)

    def function(self, name: str) -> str:
        """What is applied to arguments in an expression; variables cannot be."""
        for table in (self.terms, self.symbols):
            if name in table:
                return table[name]
        return self._elsewhere(name)

    def element(self, name: str) -> str:
        """An element of an enumeration."""
        return self.symbols[name] if name in self.symbols else self.terms.get(name) or self.types[name]

    def is_type(self, name: str) -> bool:
        """Whether a name in an expression is that of a type."""
        if self._locals[name] or name in self.terms or name in self.symbols:
            return False
        return name in self.types or name in self.outside_types or name in PYTHON_TYPES

    def is_local(self, name: str) -> bool:
        return self._locals[name] > 0

    @contextmanager
    def bound(self, names: Iterable[str] = ()) -> Iterator[None]:
        """Inside, variables of these names hide what is declared; more may become known (``bind``)."""
        before = self._locals.copy()
        self._locals.update(names)
        try:
            yield
        finally:
            self._locals = before

    def bind(self, name: str) -> None:
        """From here to the end of the innermost ``bound`` a variable has this name."""
        self._locals[name] += 1

    def _elsewhere(self, name: str) -> str:
        for table in (self.programs, self.outside):
            if name in table:
                return table[name]
        self.outside[name] = self._new(name, "name")
        self.known.add(self.outside[name])
        return self.outside[name]

    def _declare(self, file: ast.File, symbols: Iterable[str]) -> None:
        """Terms come first, for they are named most often; what nothing else names comes last."""
        tables: list[tuple[tuple[type[ast.Node], ...], dict[str, str]]] = [
            (TERMS, self.terms),
            ((ast.TypeDecl,), self.types),
            (PROGRAMS, self.programs),
            (OTHERS, {}),
        ]
        for kinds, table in tables:
            if kinds is PROGRAMS:
                self._declare_symbols(symbols)
            for place, declaration in enumerate(file.declarations):
                if isinstance(declaration, kinds):
                    name = declaration.name.text  # type: ignore[union-attr]
                    self.declared[place] = self._new(name, KINDS[type(declaration)])
                    table.setdefault(name, self.declared[place])
        for place, declaration in enumerate(file.declarations):
            match declaration:
                case ast.Initially():
                    self.declared[place] = self._own("initially", "")
                case ast.Axiom(fluent=fluent):
                    self.declared[place] = self._own(fluent.text, "axiom")
                case ast.Device(kind=kind, name=device):
                    self.declared[place] = self._own(kind.text if device is None else device.text, "device")

    def _declare_symbols(self, symbols: Iterable[str]) -> None:
        for symbol in symbols:
            if symbol not in self.terms and symbol not in self.types:
                self.symbols[symbol] = self._new(symbol, "symbol")

    def _new(self, name: str, kind: str) -> str:
        natural = python_name(name)
        if name in self._clashing or natural in self._given:
            return self._own(name, kind)
        self._given.add(natural)
        return natural

    def _own(self, name: str, kind: str) -> str:
        """A name that the file does not have."""
        base = f"{name}_{kind}" if kind else name
        number, found = 1, base
        while found in self._taken or found in self._given:
            number += 1
            found = f"{base}_{number}"
        self._given.add(found)
        return found


def _enumerated(file: ast.File) -> dict[str, None]:
    """The symbols of all enumerations, in order."""
    enumerations = (node for node in descendants(file) if isinstance(node, ast.EnumType))
    elements = (element for node in enumerations for element in node.elements)
    return {element.text: None for element in elements if isinstance(element, ast.Ident)}


def _clashes(declaration: ast.Declaration, symbols: Container[str]) -> set[str]:
    """The names that are variables of a declaration and also something else in it that Python could not tell apart.

    In annotations Python sees no parameters: each is looked at by itself.
    """
    body: list[ast.Node] = [declaration]
    found: set[str] = set()
    for child in children(declaration):
        annotation = child.type if isinstance(child, ast.Parameter) else child
        if isinstance(annotation, ast.Type):
            found |= _clashing(descendants(annotation), symbols)
            body += [child] if child is not annotation else []
        else:
            body += descendants(child)
    return found | _clashing(body, symbols)


def _clashing(nodes: Iterable[ast.Node], symbols: Container[str]) -> set[str]:
    variables: set[str] = set()
    others: set[str] = set()
    for node in nodes:
        match node:
            case ast.Parameter(name=name) | ast.Binder(name=name) | ast.Let(name=name):
                variables.add(name.text)
            case ast.Pattern(action=action, args=args):
                others.add(action.text)
                variables.update(arg.text for arg in args if isinstance(arg, ast.Ident) and arg.text not in symbols)
            case ast.Axiom(parameters=parameters):
                variables.update(parameter.text for parameter in parameters)
            case ast.TypeName(name=name):
                others.add(name.text)
            case ast.Apply(name=name, args=args) if args:
                others.add(name.text)
                others.update(arg.name.text for arg in args if name.text == "poss" and isinstance(arg, ast.Apply))
            case ast.Call(target=target) | ast.Run(program=target) | ast.ExpectCount(action=target):
                others.add(target.name.text)
            case ast.OnEvents(events=targets) | ast.ExpectActions(actions=targets):
                others.update(target.name.text for target in targets)
            case ast.EnumType(elements=elements):
                others.update(element.text for element in elements if isinstance(element, ast.Ident))
    return variables & others
