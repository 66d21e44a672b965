"""What all rooms of the elaborator share: the names, the findings, and each declaration, resolved once.

Declarations come in any order, so a declaration is resolved when somebody first asks for it; one that is asked for
while it is being resolved depends on itself.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Protocol, TypeAlias

from golc.diagnostics import Code, Findings, Label, Source, Span
from golc.syntax import tree
from golc.theory.blame import Suspect
from golc.theory.closed import Closed
from golc.theory.complaints import Complaints
from golc.theory.declare import Declared
from golc.theory.python_file import PythonFiles
from golc.theory.scope import Entry, Names
from golc.theory.terms import Literal
from golc.theory.theory import Constant, Definition, Parameter, Static
from golc.theory.types import Type


@dataclass(frozen=True)
class Signature:
    """What a call has to fit, and its type (``bool`` for actions and procedures)."""

    entry: Entry
    parameters: tuple[Parameter, ...]
    type: Type


Resolved: TypeAlias = Constant | Type | Signature | Definition | Static | None


class Resolver(Protocol):
    """Gives a declaration its meaning; answers none if it has none, which is a finding already."""

    def __call__(self, context: Context, entry: Entry, /) -> Resolved: ...


class Constants(Protocol):
    """The value of a closed expression, which must fit a type if one is given; none if it has none (a finding).

    ``parameter`` names what has the type, and ``declared`` is the place of that name.
    """

    def __call__(
        self,
        context: Context,
        node: tree.Expr,
        expected: Type | None,
        parameter: str = "",
        declared: Span | None = None,
        /,
    ) -> Literal | None: ...


@dataclass
class Context:
    """The state of an elaboration. ``resolvers`` and ``constants`` come from the rooms that know how;
    ``python`` has the files that it may call."""

    source: Source
    declared: Declared
    findings: Findings
    overrides: Mapping[str, str]
    resolvers: Mapping[str, Resolver]
    constants: Constants
    python: PythonFiles
    device_names: tuple[str, ...] = ()
    inline_types: dict[int, Type] = field(default_factory=dict)
    """The enumerations that stand in place of a type's name and declare their symbols, by the identity of the node."""
    gaps: bool = False
    """Whether a value is missing that nothing is wrong with: it would take Python code that is not executed."""
    situational: dict[str, bool] = field(default_factory=dict)
    """Whether a definition depends on the situation, as far as somebody has asked."""
    complaints: Complaints = field(init=False)
    _resolved: dict[tuple[str, Entry], Resolved] = field(default_factory=dict)
    _closed: Closed | None = None
    _active: dict[tuple[str, Entry], None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.complaints = Complaints(self.source, self.declared.names, self.findings)

    @property
    def names(self) -> Names:
        return self.declared.names

    def signature(self, entry: Entry) -> Signature | None:
        """Of a fluent, static, definition, action or procedure."""
        resolved = self._resolve("signature", entry)
        assert resolved is None or isinstance(resolved, Signature)
        return resolved

    def constant(self, entry: Entry) -> Constant | None:
        """The value of a const."""
        resolved = self._resolve("constant", entry)
        assert resolved is None or isinstance(resolved, Constant)
        return resolved

    def type(self, entry: Entry) -> Type | None:
        """A declared type."""
        resolved = self._resolve("type", entry)
        assert resolved is None or isinstance(resolved, Type)
        return resolved

    def static(self, entry: Entry) -> Static | None:
        """A static function with its body."""
        resolved = self._resolve("static", entry)
        assert resolved is None or isinstance(resolved, Static)
        return resolved

    def definition(self, entry: Entry) -> Definition | None:
        """A definition with its body."""
        resolved = self._resolve("definition", entry)
        assert resolved is None or isinstance(resolved, Definition)
        return resolved

    def closed(self) -> Closed:
        """The evaluator of closed terms; it resolves declarations on demand, and all constants share its steps."""
        if self._closed is None:
            values = self.names.values.entries
            self._closed = Closed(lambda name: self.static(values[name]), lambda name: self.definition(values[name]))
        return self._closed

    def _resolve(self, what: str, entry: Entry) -> Resolved:
        key = (what, entry)
        if key in self._active:
            self._circular([active for _, active in [*self._active][[*self._active].index(key) :]])
            return None
        if key not in self._resolved:
            self._active[key] = None
            self._resolved[key] = self.resolvers[what](self, entry)
            del self._active[key]
        return self._resolved[key]

    def _circular(self, circle: list[Entry]) -> None:
        circle = [*dict.fromkeys(circle)]
        first = circle[0]
        steps = itertools.pairwise([*circle, first])
        labels = [Label(entry.span, f"which needs `{after.name}`") for entry, after in steps if entry is not first]
        self.error(
            Code.CIRCULAR,
            f"`{first.name}` depends on itself",
            first.span,
            f"needs `{circle[1].name}`" if len(circle) > 1 else "its value needs its value",
            labels=tuple(labels[:5]),
        )

    def error(
        self,
        code: Code,
        message: str,
        span: Span,
        marker: str = "",
        help: str | None = None,
        labels: tuple[Label, ...] = (),
        suspects: Iterable[Suspect] = (),
    ) -> None:
        """A finding; ``suspects`` are declarations whose fault it may be."""
        self.complaints.error(code, message, span, marker, help, labels, suspects)
