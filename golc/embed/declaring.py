"""How declarations come into a theory: as trees at once, or as functions that are translated when it is complete."""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any, TypeAlias

from golc.embed.errors import Refused, meaningless
from golc.embed.given import MISSING, named
from golc.embed.names import new_name
from golc.embed.owners import Owned
from golc.embed.parts import Making, Parts
from golc.embed.places import argument, caller
from golc.embed.reading import declarations
from golc.embed.reading.declarations import Formula, Translator
from golc.embed.reading.functions import translated
from golc.embed.terms import PROGRAMS, Named
from golc.embed.types import TypeHandle
from golc.embed.values import expr
from golc.syntax import tree
from golc.syntax.python_names import golc_name

Make: TypeAlias = Callable[[Translator, tree.Ident], tree.Declaration]
"""Makes the declaration of a name out of a function; raises ``Refused``."""

WITHOUT_PARAMETERS = ("const", "type", "constraint", "invariant", "goal", "prune", "scenario", "device")
"""The kinds of declarations whose functions have none."""

SPACES = {**dict.fromkeys(PROGRAMS, "action"), "scenario": "scenario"}
"""The namespaces of the kinds of declarations that do not share that of terms."""


class Declaring:
    """Takes declarations, and gives a handle for each: what stands for it from then on.

    ``kind`` is what a thing is, in the words of the language; ``space`` tells declarations of one name apart where
    their kind does not.
    """

    def __init__(self, parts: Parts) -> None:
        self._parts = parts

    def _add(self, node: Any, kind: str, parameters: tuple[tree.Parameter, ...] = ()) -> Any:
        """A declaration that is a tree already."""
        self._keep(node.name.text, kind, lambda: node)
        return self._handle(node.name.text, kind, tuple(parameter.name.text for parameter in parameters))

    def _add_formula(self, kind: Formula, what: str, name: Any, condition: object) -> Any:
        """A formula with a name, both given or both those of a function."""
        if condition is not MISSING:
            ident, span = named(name)
            return self._add(kind(ident, expr(condition, argument(span, 1, "condition")), span=span), what)
        if isinstance(name, FunctionType):
            return self._translate(name, what, lambda t, ident: declarations.formula(t, ident, kind))
        if name is not None and not isinstance(name, str):
            raise meaningless(f"the name of this {what} is a string", caller())
        return self._decorator(what, lambda t, ident: declarations.formula(t, ident, kind), name)

    def _decorated(self, function: Callable[..., Any] | None, name: str | None, kind: str, make: Make) -> Any:
        """What ``@theory.kind`` makes of a function, or ``@theory.kind(…)`` of the one that follows."""
        return self._decorator(kind, make, name) if function is None else self._translate(function, kind, make, name)

    def _decorator(self, kind: str, make: Make, name: str | None, space: object = None) -> Callable[..., Any]:
        """A decorator; a theory is not complete as long as one waits for its function."""
        span = caller()

        def nothing() -> tree.Declaration:
            help_ = "write it with `@` above a function, or give it all that it needs"
            raise meaningless("this declares nothing", span, help_)

        withdraw = self._parts.expect(nothing)

        def decorated(function: Callable[..., Any]) -> Any:
            withdraw()
            return self._translate(function, kind, make, name, space)

        return decorated

    def _translate(
        self, function: Callable[..., Any], kind: str, make: Make, name: str | None = None, space: object = None
    ) -> Any:
        """Keep a function until the theory is complete; its handle."""
        try:
            meant = translated(function)
            text = meant.name if name is None else name
            ident = new_name(text, meant.name_span)
            if kind in WITHOUT_PARAMETERS and meant.parameters():
                arg = meant.parameters()[0]
                help_ = "write `… for n in station` in it; with a default it is a constant of Python"
                raise meaningless(f"`{arg.arg}` is a parameter, and no {kind} has any", meant.place(arg), help_)
        except Refused as error:
            if isinstance(function, str):
                raise  # A name where the function belongs: there is nothing that could be gone on with.
            return self._broken(error, function, kind, name, space)

        def making() -> tree.Declaration:
            translator = Translator(meant)
            return translator.whole(lambda: make(translator, ident))

        self._keep(text, kind, making, space)
        return self._handle(text, kind, tuple(golc_name(arg.arg) for arg in meant.parameters()))

    def _broken(self, error: Refused, function: object, kind: str, name: str | None, space: object) -> Any:
        """A handle to go on with for a function that cannot be translated, which is said with everything else."""

        def making() -> tree.Declaration:
            raise error

        text = name or golc_name(getattr(function, "__name__", "nothing"))
        self._keep(text, kind, making, space)
        return self._handle(text, kind)

    def _keep(self, name: str, kind: str, making: Making, space: object = None) -> None:
        self._parts.put((space or SPACES.get(kind, "term"), name), making)

    def _handle(self, name: str, kind: str, parameters: tuple[str, ...] = ()) -> Any:
        return self._type(name) if kind == "type" else Named(Owned(name, self._parts), kind, parameters)

    def _type(self, name: str, value: tree.Type | None = None) -> TypeHandle:
        handle = self._parts.types[name] = TypeHandle(name, value, self._parts)
        return handle
