"""A theory in Python: an object whose methods and decorators declare what a file of the language declares."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import FunctionType
from typing import Any, TypeVar, overload

from golc.diagnostics import Code, Span
from golc.embed import words
from golc.embed.errors import Refused, meaningless, refused
from golc.embed.names import golc_name, new_name
from golc.embed.parts import Parts, Written
from golc.embed.places import argument, caller, calling_frame, frame_span
from golc.embed.reading.actions import Actions
from golc.embed.reading.axioms import Axioms
from golc.embed.reading.devices import Devices
from golc.embed.reading.functions import translated
from golc.embed.reading.programs import Programs
from golc.embed.reading.scenarios import Scenarios
from golc.embed.reading.tables import table_of
from golc.embed.symbols import no_strings
from golc.embed.terms import Named, Term, expr
from golc.embed.types import TypeHandle, elsewhere, type_node
from golc.syntax import tree

MISSING: Any = object()
Decorated = TypeVar("Decorated", Named, TypeHandle)

WITHOUT_PARAMETERS = ("const", "type", "constraint", "invariant", "goal", "prune", "scenario", "device")
"""The kinds of declarations whose functions have none."""

SPACES = {"action": "action", "exogenous action": "action", "procedure": "action", "scenario": "scenario"}
"""The namespaces of the kinds of declarations that do not share that of terms."""


class Translator(Actions, Axioms, Scenarios, Devices, Programs):
    """Everything that a translated function may hold."""


class Theory:
    """A basic action theory with its programs, written in Python.

    Declarations come in the order in which Python meets them. Functions under a decorator are never run: their source
    is translated when the theory is complete, so that they may speak of what is declared further down.
    """

    def __init__(self, domain: str) -> None:
        self._place = caller()
        self._domain = new_name(domain, self._place)
        self._parts = Parts()
        self._types: dict[str, object] = {}

    def __repr__(self) -> str:
        return f"<golc theory {self._domain.text}>"

    @property
    def name(self) -> str:
        """The name of the domain."""
        return self._domain.text

    # What the theory is made of

    def import_(self, path: str) -> None:
        """``import "warehouse.gl"``: the declarations of a file, relative to this one, join the theory."""
        node = tree.Import(path, span=caller())
        self._parts.put(("import", path), lambda: node)

    def include(self, other: Theory) -> None:
        """The declarations of another theory join this one."""
        if not isinstance(other, Theory):
            raise refused(Code.PYTHON_VALUE, "only a theory can be included", caller())
        self._parts.include(other._parts)

    @overload
    def const(self, what: str, /, value: object) -> Named: ...
    @overload
    def const(self, what: Callable[..., Any], /) -> Named: ...
    @overload
    def const(self, /, *, name: str) -> Callable[[Callable[..., Any]], Named]: ...
    def const(self, what: Any = None, /, value: object = MISSING, *, name: str | None = None) -> Any:
        """``const c = e``; ``-D c=…`` on the command line replaces it. Without a value: a decorator."""
        if not isinstance(what, str):

            def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
                return tree.Const(ident, t.expr(t.returned()), span=t.function.span)

            return self._decorated(what, name, "const", make)
        ident, span = self._named(what)
        node = tree.Const(ident, expr(self._needed(value, span), argument(span, 1, "value")), span=span)
        self._types[ident.text] = node.value
        return self._add(node, "const")

    def type(self, what: Any = None, /, value: object = MISSING, *, name: str | None = None) -> Any:
        """``type t = …``: a name for a type; unpacking it gives the symbols and integers of an enumeration.

        With a name and a type, or a decorator of a function that returns the type and may speak of what is declared
        further down.
        """
        if not isinstance(what, str):

            def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
                return tree.TypeDecl(ident, t.type(t.returned()), span=t.function.span)

            def decorated(function: Callable[..., Any]) -> TypeHandle:
                made = self._translate(function, "type", make, name)
                handle = elsewhere(tree.Ident(made.name))
                self._types[made.name] = handle
                return handle

            return self._waiting(decorated) if what is None else decorated(what)
        ident, span = self._named(what)
        self._needed(value, span)
        node = tree.TypeDecl(ident, type_node(value, span), span=span)
        self._parts.put(("term", ident.text), lambda: node)
        handle = TypeHandle(ident.text, node.type, self._types.get)
        self._types[ident.text] = handle
        return handle

    def static(
        self,
        what: Any = None,
        /,
        type: object = None,
        value: object = MISSING,
        *,
        name: str | None = None,
        parameters: Mapping[str, object] | None = None,
    ) -> Any:
        """``static f(a: t): u = e``, what never changes. A decorator, or called with a name, a type and a value.

        ``parameters`` maps names to types; ``value`` is a term, a dictionary (a table), or with parameters a function
        that is called with the variables.
        """
        if not isinstance(what, str):

            def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
                body = t.returned()
                meant = t.table(body) if t.is_table(body) else t.expr(body)
                return tree.Static(ident, t.parameters(), self._returns(t), meant, span=t.function.span)

            return self._decorated(what, name, "static", make)
        ident, span = self._named(what)
        heads = self._heads(parameters or {}, span)
        meant = self._applied(self._needed(value, span), heads, span)
        returned, place = self._typed(type, span), argument(span, 2, "value")
        if isinstance(meant, dict):
            no_strings(meant, heads, returned, self._types, place)
        node = table_of(meant, place) if isinstance(meant, dict) else expr(meant, place)
        return self._add(tree.Static(ident, heads, returned, node, span=span), "static", heads)

    def extern(self, *, file: str, name: str | None = None) -> Callable[[Callable[..., Any]], Named]:
        """``extern f(a: t): u from "helpers.py"``: a function that Python computes; a decorator of a function without
        a body."""

        def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
            return tree.Extern(ident, t.parameters(), self._returns(t), file, span=t.function.span)

        return self._waiting(lambda function: self._translate(function, "extern", make, name))

    def fluent(
        self,
        what: Any = None,
        /,
        type: object = None,
        initial: object = MISSING,
        *,
        name: str | None = None,
        parameters: Mapping[str, object] | None = None,
    ) -> Any:
        """``fluent f(a: t): u = e``, what actions change. A decorator, or called with a name, a type and a first value.

        Without a type it is relational, true or false. The first value may be ``unknown`` or ``one_of(…)``; the rest
        is as for ``static``.
        """
        if not isinstance(what, str):

            def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
                value = t.value(t.returned()) if t.function.body() else None
                return tree.Fluent(ident, t.parameters(), self._returns(t), value, span=t.function.span)

            return self._decorated(what, name, "fluent", make)
        ident, span = self._named(what)
        heads = self._heads(parameters or {}, span)
        place = argument(span, 2, "initial")
        value = None if initial is MISSING else words.value_expr(self._applied(initial, heads, span), place)
        return self._add(tree.Fluent(ident, heads, self._typed(type, span), value, span=span), "fluent", heads)

    def define(self, function: Callable[..., Any] | None = None, *, name: str | None = None) -> Any:
        """``define d(a: t) := e``: a name for a term or formula; a decorator."""

        def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
            return tree.Define(ident, t.parameters(), t.expr(t.returned()), span=t.function.span)

        return self._decorated(function, name, "definition", make)

    def action(self, function: Callable[..., Any] | None = None, *, name: str | None = None) -> Any:
        """``action a(x: t): …``, what a program does; a decorator of a function of ``poss``, ``causes`` …"""

        def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
            return tree.Action(ident, t.parameters(), t.clauses(), span=t.function.span)

        return self._decorated(function, name, "action", make)

    def exog(
        self,
        function: Callable[..., Any] | None = None,
        *,
        name: str | None = None,
        expected: bool = False,
        sources: Sequence[str] = (),
    ) -> Any:
        """``exog e(x: t): …``, what happens by itself; ``expected``: look-ahead may count on it; ``sources``: who may
        report it. A decorator."""
        span = caller()
        reporters = tuple(new_name(source, span, used=True) for source in sources)

        def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
            return tree.Exog(ident, t.parameters(), bool(expected), reporters, t.clauses(), span=t.function.span)

        return self._decorated(function, name, "exogenous action", make)

    def axiom(self, fluent: object) -> Callable[[Callable[..., Any]], Named]:
        """``axiom f(x): …``: the successor state axiom of a fluent, as a function of ``after``; a decorator."""
        span = caller()
        name = fluent.name if isinstance(fluent, Named) else fluent
        head = new_name(name, span, used=True)

        def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
            return tree.Axiom(head, t.heads(), t.cases(), span=t.function.span)

        return self._waiting(lambda function: self._translate(function, "fluent", make, head.text, "axiom"))

    def initially(self, condition: object) -> Any:
        """``initially φ``: a constraint on the first situation; with a formula, or a decorator."""
        if isinstance(condition, FunctionType):
            return self._translate(
                condition,
                "constraint",
                lambda t, _: tree.Initially(t.expr(t.returned()), span=t.function.span),
                "initially",
            )
        span = caller()
        node = tree.Initially(expr(condition, argument(span, 0, "condition")), span=span)
        self._parts.put(object(), lambda: node)
        return None

    def invariant(self, name: Any = None, condition: object = MISSING) -> Any:
        """``invariant i: φ``: what every action preserves; with a name and a formula, or a decorator."""
        return self._formula(tree.Invariant, "invariant", name, condition)

    def goal(self, name: Any = None, condition: object = MISSING) -> Any:
        """``goal g: φ``: what a plan is to reach; with a name and a formula, or a decorator."""
        return self._formula(tree.Goal, "goal", name, condition)

    def prune(self, name: Any = None, condition: object = MISSING) -> Any:
        """``prune p: φ``: what look-ahead never enters; with a name and a formula, or a decorator of a function that
        returns a formula or says ``after(a(x), when=φ)``."""
        return self._formula(tree.Prune, "prune", name, condition)

    def proc(self, function: Callable[..., Any] | None = None, *, name: str | None = None) -> Any:
        """``proc p(x: t): …``: a program; a decorator."""

        def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
            nodes = t.function.body() or t.function.node.body
            return tree.Proc(ident, t.parameters(), t.block(nodes), span=t.function.span)

        return self._decorated(function, name, "procedure", make)

    def scenario(self, function: Callable[..., Any] | None = None, *, name: str | None = None) -> Any:
        """``scenario s: …``: an executable test of a program; a decorator of a function of ``run``, ``on`` …"""

        def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
            return tree.Scenario(ident, t.items(), span=t.function.span)

        return self._decorated(function, name, "scenario", make)

    def device(
        self, kind: str, *, file: str | None = None, name: str | None = None
    ) -> Callable[[Callable[..., Any]], Named]:
        """``device rcx left "left.nqc": …``: who carries the actions out; a decorator of a function of ``bind`` and
        ``setting``."""
        span = caller()
        what = new_name(kind, span, used=True)
        called = None if name is None else new_name(name, span, used=True)

        def make(t: Translator, _: tree.Ident) -> tree.Declaration:
            return tree.Device(what, called, file, t.settings(), span=t.function.span)

        return self._waiting(lambda function: self._translate(function, "device", make, kind, ("device", name)))

    # How it becomes a tree

    def written(self) -> Written:
        """The tree of all declarations, with what is wrong with their Python."""
        return self._parts.written(self._domain, self._place)

    # What the declarations share

    def _decorated(
        self,
        function: Callable[..., Any] | None,
        name: str | None,
        kind: str,
        make: Callable[[Translator, tree.Ident], tree.Declaration],
    ) -> Any:
        if function is None:
            return self._waiting(lambda decorated: self._translate(decorated, kind, make, name))
        return self._translate(function, kind, make, name)

    def _waiting(
        self, decorate: Callable[[Callable[..., Any]], Decorated]
    ) -> Callable[[Callable[..., Any]], Decorated]:
        """A decorator; a theory is not complete as long as one waits for its function."""
        span = caller()

        def nothing() -> tree.Declaration:
            help_ = "write it with `@` above a function, or give it all that it needs"
            raise meaningless("this declares nothing", span, help_)

        withdraw = self._parts.expect(nothing)

        def decorated(function: Callable[..., Any]) -> Decorated:
            withdraw()
            return decorate(function)

        return decorated

    def _translate(
        self,
        function: Callable[..., Any],
        kind: str,
        make: Callable[[Translator, tree.Ident], tree.Declaration],
        name: str | None = None,
        space: object = None,
    ) -> Named:
        """Keep a function until the theory is complete; what stands for it in the meantime."""
        try:
            meant = translated(function)
            text = meant.name if name is None else name
            ident = new_name(text, meant.name_span)
            if kind in WITHOUT_PARAMETERS and meant.parameters():
                arg = meant.parameters()[0]
                help_ = "write `… for n in station` in it; with a default it is a constant of Python"
                raise meaningless(f"`{arg.arg}` is a parameter, and no {kind} has any", meant.place(arg), help_)
        except Refused as error:
            return self._broken(error, function, kind, name, space)

        def making() -> tree.Declaration:
            return make(Translator(meant), ident)

        self._parts.put((space or SPACES.get(kind, "term"), text), making)
        return Named(text, kind, tuple(golc_name(arg.arg) for arg in meant.parameters()))

    def _broken(self, error: Refused, function: object, kind: str, name: str | None, space: object) -> Named:
        """Something to go on with for a function that cannot be translated, which is said with everything else."""

        def making() -> tree.Declaration:
            raise error

        text = name or golc_name(getattr(function, "__name__", "nothing"))
        self._parts.put((space or SPACES.get(kind, "term"), text), making)
        return Named(text, kind)

    def _formula(self, kind: Any, what: str, name: Any, condition: object) -> Any:
        if condition is not MISSING:
            ident, span = self._named(name)
            return self._add(kind(ident, expr(condition, argument(span, 1, "condition")), span=span), what)

        def make(t: Translator, ident: tree.Ident) -> tree.Declaration:
            if kind is tree.Prune and t.is_prune_after():
                return t.prune_after(ident, t.function.span)
            node: tree.Declaration = kind(ident, t.expr(t.returned()), span=t.function.span)
            return node

        if isinstance(name, FunctionType):
            return self._translate(name, what, make)
        if name is not None and not isinstance(name, str):
            raise meaningless(f"the name of this {what} is a string", caller())
        return self._waiting(lambda function: self._translate(function, what, make, name))

    def _add(self, node: Any, kind: str, heads: tuple[tree.Parameter, ...] = ()) -> Named:
        self._parts.put((SPACES.get(kind, "term"), node.name.text), lambda: node)
        return Named(node.name.text, kind, tuple(head.name.text for head in heads))

    def _named(self, name: object) -> tuple[tree.Ident, Span]:
        """The name of a declaration that is a call, and the place of the call."""
        span = frame_span(calling_frame())
        return new_name(name, span), span

    def _needed(self, value: object, span: Span) -> object:
        if value is MISSING:
            raise meaningless("a value is missing", span, "write it behind the type")
        return value

    def _typed(self, type_: object, span: Span) -> tree.Type | None:
        return None if type_ is None else type_node(type_, span)

    def _heads(self, parameters: Mapping[str, object], span: Span) -> tuple[tree.Parameter, ...]:
        return tuple(
            tree.Parameter(new_name(name, span), type_node(type_, span), span=span)
            for name, type_ in parameters.items()
        )

    def _applied(self, value: object, heads: tuple[tree.Parameter, ...], span: Span) -> object:
        """A value that is a function of the parameters, for variables with their names."""
        if not isinstance(value, FunctionType):
            return value
        variables = words.bound(value, len(heads), span, [head.name.text for head in heads])
        made = value(*variables)
        if isinstance(made, Term):
            words.of_variables(made.node, variables, span)
        return made

    def _returns(self, translator: Translator) -> tree.Type | None:
        annotation = translator.function.node.returns
        return None if annotation is None else translator.annotation(annotation)
