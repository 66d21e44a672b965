"""A theory in Python: an object whose methods and decorators declare what a file of the language declares."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from types import FunctionType
from typing import Any

from golc.diagnostics import Code
from golc.embed.declaring import Declaring
from golc.embed.errors import meaningless, refused
from golc.embed.given import MISSING, applied, left_to_the_function, named, needed, parameters_of, path_of, typed
from golc.embed.names import new_name
from golc.embed.parts import Parts, Written
from golc.embed.places import argument, caller
from golc.embed.reading import declarations
from golc.embed.tables import no_strings, table_of
from golc.embed.terms import Named
from golc.embed.types import type_node
from golc.embed.values import expr
from golc.embed.words import value_expr
from golc.syntax import tree


class Theory(Declaring):
    """A basic action theory with its programs, written in Python.

    Declarations come in the order in which Python meets them. Functions under a decorator are never run: their source
    is translated when the theory is complete, so that they may speak of what is declared further down. What is wrong
    with them is among the findings of ``golc.check`` then; a call that is wrong raises ``UserError`` at once.
    """

    def __init__(self, domain: str) -> None:
        place = caller()
        super().__init__(Parts(new_name(domain, argument(place, 0, "domain")), place))

    def __repr__(self) -> str:
        return f"<golc theory {self.name}>"

    def __str__(self) -> str:
        from golc.api.unfinished import showing

        return str(showing(self))

    def _repr_html_(self) -> str:
        from golc.api.unfinished import showing

        return showing(self)._repr_html_()

    @property
    def name(self) -> str:
        """The name of the domain."""
        return self._parts.domain.text

    def written(self) -> Written:
        """The tree of all declarations, with what is wrong with their Python."""
        return self._parts.written()

    def import_(self, path: str | PathLike[str]) -> None:
        """``import "warehouse.gl"``: the declarations of a file, relative to this one, join the theory."""
        span = caller()
        node = tree.Import(path_of(path, argument(span, 0, "path")), span=span)
        self._parts.put(("import", node.path), lambda: node)

    def include(self, other: Theory) -> None:
        """The declarations of another theory join this one, those still to come among them."""
        if not isinstance(other, Theory):
            raise refused(Code.PYTHON_VALUE, "only a theory can be included", caller())
        self._parts.include(other._parts)

    def const(self, what: Any = None, /, value: object = MISSING, *, name: str | None = None) -> Any:
        """``const c = e``; ``-D c=…`` on the command line replaces it. With a name and a value, or a decorator."""
        if not isinstance(what, str):
            left_to_the_function(value=value)
            return self._decorated(what, name, "const", declarations.const)
        ident, span = named(what, name)
        return self._add(tree.Const(ident, expr(needed(value, span), argument(span, 1, "value")), span=span), "const")

    def type(self, what: Any = None, /, value: object = MISSING, *, name: str | None = None) -> Any:
        """``type t = …``: a name for a type; unpacking it gives the symbols and integers of an enumeration.

        With a name and a type, or a decorator of a function that returns the type and may speak of what is declared
        further down.
        """
        if not isinstance(what, str):
            left_to_the_function(value=value)
            return self._decorated(what, name, "type", declarations.type_)
        ident, span = named(what, name)
        needed(value, span)
        node = tree.TypeDecl(ident, type_node(value, argument(span, 1, "value")), span=span)
        self._keep(ident.text, "type", lambda: node)
        return self._type(ident.text, node.type)

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
            left_to_the_function(type=type, value=value, parameters=parameters)
            return self._decorated(what, name, "static", declarations.static)
        ident, span = named(what, name)
        heads, place = parameters_of(parameters, span), argument(span, 2, "value")
        meant, returned = applied(needed(value, span), heads, span), typed(type, span)
        if isinstance(meant, Mapping):
            no_strings(meant, heads, returned, self._parts, place)
        node = table_of(meant, place) if isinstance(meant, Mapping) else expr(meant, place)
        return self._add(tree.Static(ident, heads, returned, node, span=span), "static", heads)

    def extern(self, *, file: str | PathLike[str], name: str | None = None) -> Callable[[Callable[..., Any]], Any]:
        """``extern f(a: t): u from "helpers.py"``: a function that Python computes; a decorator of a function without
        a body."""
        path = path_of(file, argument(caller(), None, "file"))
        return self._decorator("extern", lambda t, ident: declarations.extern(t, ident, path), name)

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
            left_to_the_function(type=type, initial=initial, parameters=parameters)
            return self._decorated(what, name, "fluent", declarations.fluent)
        ident, span = named(what, name)
        heads, place = parameters_of(parameters, span), argument(span, 2, "initial")
        value = None if initial is MISSING else value_expr(applied(initial, heads, span), place)
        return self._add(tree.Fluent(ident, heads, typed(type, span), value, span=span), "fluent", heads)

    def define(self, function: Callable[..., Any] | None = None, *, name: str | None = None) -> Any:
        """``define d(a: t) := e``: a name for a term or formula; a decorator."""
        return self._decorated(function, name, "definition", declarations.define)

    def action(self, function: Callable[..., Any] | None = None, *, name: str | None = None) -> Any:
        """``action a(x: t): …``, what a program does; a decorator of a function of ``poss``, ``causes`` …"""
        return self._decorated(function, name, "action", declarations.action)

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
        reporters = tuple(
            new_name(each, span, used=True) for each in ([sources] if isinstance(sources, str) else sources)
        )

        def make(t: declarations.Translator, ident: tree.Ident) -> tree.Exog:
            return declarations.exog(t, ident, bool(expected), reporters)

        return self._decorated(function, name, "exogenous action", make)

    def axiom(self, fluent: object) -> Callable[[Callable[..., Any]], Any]:
        """``axiom f(x): …``: the successor state axiom of a fluent, as a function of ``after``; a decorator."""
        if isinstance(fluent, FunctionType):
            raise meaningless("an axiom needs its fluent", caller(), "write `@theory.axiom(lit)`")
        head = new_name(fluent.name if isinstance(fluent, Named) else fluent, caller(), used=True)
        return self._decorator("fluent", lambda t, _: declarations.axiom(t, head), head.text, "axiom")

    def initially(self, condition: object) -> Any:
        """``initially φ``: a constraint on the first situation; with a formula, or a decorator."""
        if isinstance(condition, FunctionType):
            return self._translate(condition, "constraint", declarations.initially, "initially")
        span = caller()
        node = tree.Initially(expr(condition, argument(span, 0, "condition")), span=span)
        self._parts.put(object(), lambda: node)
        return None

    def invariant(self, name: Any = None, condition: object = MISSING) -> Any:
        """``invariant i: φ``: what every action preserves; with a name and a formula, or a decorator."""
        return self._add_formula(tree.Invariant, "invariant", name, condition)

    def goal(self, name: Any = None, condition: object = MISSING) -> Any:
        """``goal g: φ``: what a plan is to reach; with a name and a formula, or a decorator."""
        return self._add_formula(tree.Goal, "goal", name, condition)

    def prune(self, name: Any = None, condition: object = MISSING) -> Any:
        """``prune p: φ``: what look-ahead never enters; with a name and a formula, or a decorator of a function that
        returns a formula or says ``after(a(x), when=φ)``."""
        return self._add_formula(tree.Prune, "prune", name, condition)

    def proc(self, function: Callable[..., Any] | None = None, *, name: str | None = None) -> Any:
        """``proc p(x: t): …``: a program; a decorator."""
        return self._decorated(function, name, "procedure", declarations.proc)

    def scenario(self, function: Callable[..., Any] | None = None, *, name: str | None = None) -> Any:
        """``scenario s: …``: an executable test of a program; a decorator of a function of ``run``, ``on`` …"""
        return self._decorated(function, name, "scenario", declarations.scenario)

    def device(
        self, kind: str, *, file: str | PathLike[str] | None = None, name: str | None = None
    ) -> Callable[[Callable[..., Any]], Any]:
        """``device rcx left "left.nqc": …``: who carries the actions out; a decorator of a function of ``bind`` and
        ``setting``."""
        span = caller()
        if isinstance(kind, FunctionType):
            raise meaningless("a device needs its kind", span, 'write `@theory.device("operator")`')
        what = new_name(kind, span, used=True)
        path = None if file is None else path_of(file, argument(span, None, "file"))
        called = None if name is None else new_name(name, span, used=True)
        return self._decorator(
            "device", lambda t, _: declarations.device(t, what, called, path), kind, ("device", name)
        )
