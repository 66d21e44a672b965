"""Which names a file declares, which variables are in scope, and what an unknown name probably meant."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

from golc.diagnostics import Label, Span
from golc.syntax import tree
from golc.theory.forms import name_text
from golc.theory.suggest import closest
from golc.theory.terms import Variable
from golc.theory.types import Type


class Kind(Enum):
    """What a declared name is; the value is what messages call it."""

    CONSTANT = "const"
    TYPE = "type"
    SYMBOL = "value"
    FLUENT = "fluent"
    STATIC = "static"
    EXTERN = "extern"
    DEFINITION = "definition"
    GOAL = "goal"
    INVARIANT = "invariant"
    ACTION = "action"
    EXOGENOUS = "exogenous action"
    PROCEDURE = "procedure"

    @property
    def phrase(self) -> str:
        """With its article."""
        return f"an {self.value}" if self.value[0] in "aeiou" else f"a {self.value}"


@dataclass(frozen=True, eq=False)
class Entry:
    """A declared name. ``span`` is the place of the name; ``node`` declares it (for a symbol: the ``TypeDecl``, or the
    ``EnumType`` that stands in place of a type's name)."""

    kind: Kind
    name: str
    span: Span
    arity: int
    node: tree.Node


@dataclass(frozen=True)
class Space:
    """One namespace."""

    entries: dict[str, Entry] = field(default_factory=dict)

    def get(self, name: str) -> Entry | None:
        return self.entries.get(name)

    def of(self, *kinds: Kind) -> list[Entry]:
        """The entries of some kinds, in the order of declaration."""
        return [entry for entry in self.entries.values() if entry.kind in kinds]


@dataclass(frozen=True)
class Suggestion:
    """A declared name like an unknown one: what it is, and where it is declared (none for a variable)."""

    name: str
    kind: str
    labels: tuple[Label, ...]

    def help(self, place: Span) -> str:
        """The question for somebody who has written the unknown name at a place."""
        return f"did you mean `{name_text(self.name, place)}`?"


@dataclass
class Names:
    """Everything that a file declares.

    ``values`` holds consts, types, symbols, fluents, statics, externs, definitions, goals and invariants; ``doings``
    actions and procedures. ``assumed`` are names about which nothing can be said, because what may declare them could
    not be read: they are not reported as unknown. ``open`` says that any name may come from elsewhere (an import),
    ``nameless`` that a declaration without a name, or an import without a file, may be what brings one. In
    ``headless`` declarations the parameters could not be read.
    """

    values: Space = field(default_factory=Space)
    doings: Space = field(default_factory=Space)
    assumed: frozenset[str] = frozenset()
    open: bool = False
    nameless: bool = False
    headless: tuple[Span, ...] = ()
    _suggested: dict[tuple[object, ...], Suggestion | None] = field(default_factory=dict)

    def assumes(self, name: str) -> bool:
        """Whether an unknown name is no finding of its own."""
        return self.open or name in self.assumed

    def similar(
        self,
        name: str,
        kinds: Iterable[Kind],
        arity: int | None = None,
        variables: Iterable[str] = (),
        first: Iterable[str] = (),
    ) -> Suggestion | None:
        """What an unknown name probably meant: something of the given kinds and, if there is one, of the same arity.

        ``variables`` are local names that fit; ``first`` are names that fit better than all others (the values of the
        type that is needed here).
        """
        key = (name, tuple(kinds), arity, tuple(variables), tuple(first))
        if key not in self._suggested:
            # An unknown name is compared with every declared one: after many of them, more guesses help nobody.
            self._suggested[key] = self._similar(*key) if len(self._suggested) < 200 else None
        return self._suggested[key]

    def _similar(
        self,
        name: str,
        kinds: tuple[Kind, ...],
        arity: int | None,
        variables: tuple[str, ...],
        first: tuple[str, ...],
    ) -> Suggestion | None:
        entries = [entry for space in (self.values, self.doings) for entry in space.of(*kinds)]
        same = [entry.name for entry in entries if entry.arity == arity]
        for candidates in (first, (*variables, *same), [entry.name for entry in entries]):
            found = closest(name, candidates)
            if found is not None:
                return self._suggestion(found, {entry.name: entry for entry in entries}, found in variables)
        return None

    def _suggestion(self, name: str, entries: Mapping[str, Entry], local: bool) -> Suggestion:
        if local:
            return Suggestion(name, "variable", ())
        entry = entries.get(name) or self.values.entries[name]
        label = Label(entry.span, f"{entry.kind.phrase} with a similar name is declared here")
        return Suggestion(name, entry.kind.value, (label,))


@dataclass(frozen=True)
class Local:
    """A variable in scope and the place that binds it."""

    variable: Variable
    span: Span


@dataclass(frozen=True)
class Scope:
    """The variables around a term, innermost last; ``before``: whether ``before(e)`` may stand in it."""

    locals: Mapping[str, Local] = field(default_factory=dict)
    level: int = 0
    before: bool = False

    def get(self, name: str) -> Variable | None:
        local = self.locals.get(name)
        return local.variable if local else None

    def bind(self, name: tree.Ident, type_: Type) -> tuple[Scope, Variable]:
        """One variable more, on the next level."""
        variable = Variable(self.level, name.text, type=type_, span=name.span, bound=name.span)
        locals_ = {**self.locals, name.text: Local(variable, name.span)}
        return replace(self, locals=locals_, level=self.level + 1), variable
