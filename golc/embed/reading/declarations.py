"""What a decorator of each kind makes of the function under it: a whole declaration.

Each takes the translator of the function and the name of what is declared. Raises ``Refused`` for Python that has no
meaning in such a declaration.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from golc.embed.errors import Refused, meaningless
from golc.embed.reading.actions import Actions
from golc.embed.reading.axioms import Axioms
from golc.embed.reading.devices import Devices
from golc.embed.reading.programs import Programs
from golc.embed.reading.scenarios import Scenarios
from golc.syntax import tree

Formula: TypeAlias = type[tree.Invariant] | type[tree.Goal] | type[tree.Prune]
"""The declarations that give a formula a name and say what it is for."""


class Translator(Actions, Axioms, Scenarios, Devices, Programs):
    """Everything that a translated function may hold."""

    def whole(self, make: Callable[[], tree.Declaration]) -> tree.Declaration:
        """What is made of the function. Raises ``Refused`` with all that is wrong in it, and with what is left."""
        try:
            made = make()
        except Refused as error:
            raise Refused(*dict.fromkeys((*self.found, *error.diagnostics))) from None
        if self.found:
            raise Refused.but(self.found, made, self.unread)
        return made


def const(t: Translator, name: tree.Ident) -> tree.Const:
    return tree.Const(name, t.expr(t.returned()), span=t.function.span)


def type_(t: Translator, name: tree.Ident) -> tree.TypeDecl:
    return tree.TypeDecl(name, t.type(t.returned()), span=t.function.span)


def static(t: Translator, name: tree.Ident) -> tree.Static:
    body = t.returned()
    value = t.table(body) if t.is_table(body) else t.expr(body)
    return tree.Static(name, t.parameters(), t.result(), value, span=t.function.span)


def extern(t: Translator, name: tree.Ident, file: str) -> tree.Extern:
    if body := t.function.body():
        message = f"an extern has no body: the function stands in `{file}`"
        raise meaningless(message, t.head(body[0]), "write `...` here; what is to be translated is a static")
    return tree.Extern(name, t.parameters(), t.result(), file, span=t.function.span)


def fluent(t: Translator, name: tree.Ident) -> tree.Fluent:
    value = t.value(t.returned()) if t.function.body() else None
    return tree.Fluent(name, t.parameters(), t.result(), value, span=t.function.span)


def define(t: Translator, name: tree.Ident) -> tree.Define:
    return tree.Define(name, t.parameters(), t.expr(t.returned()), span=t.function.span)


def action(t: Translator, name: tree.Ident) -> tree.Action:
    return tree.Action(name, t.parameters(), t.clauses(), span=t.function.span)


def exog(t: Translator, name: tree.Ident, expected: bool, sources: tuple[tree.Ident, ...]) -> tree.Exog:
    return tree.Exog(name, t.parameters(), expected, sources, t.clauses(), span=t.function.span)


def axiom(t: Translator, fluent: tree.Ident) -> tree.Axiom:
    return tree.Axiom(fluent, t.heads(), t.cases(), span=t.function.span)


def initially(t: Translator, _: tree.Ident) -> tree.Initially:
    return tree.Initially(t.expr(t.returned()), span=t.function.span)


def formula(t: Translator, name: tree.Ident, kind: Formula) -> tree.Declaration:
    if kind is tree.Prune and t.is_prune_after():
        return t.prune_after(name, t.function.span)
    return kind(name, t.expr(t.returned()), span=t.function.span)


def proc(t: Translator, name: tree.Ident) -> tree.Proc:
    # A body of nothing but a docstring is `skip`, which needs a place all the same.
    body = t.function.body() or t.function.node.body
    return tree.Proc(name, t.parameters(), t.block(body), span=t.function.span)


def scenario(t: Translator, name: tree.Ident) -> tree.Scenario:
    return tree.Scenario(name, t.items(), span=t.function.span)


def device(t: Translator, kind: tree.Ident, name: tree.Ident | None, file: str | None) -> tree.Device:
    return tree.Device(kind, name, file, t.settings(), span=t.function.span)
