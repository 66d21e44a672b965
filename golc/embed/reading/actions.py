"""The bodies of actions and exogenous actions."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from typing import Any

from golc.diagnostics import Span
from golc.embed import words
from golc.embed.errors import meaningless
from golc.embed.reading.evaluate import NOT_PYTHON
from golc.embed.reading.lines import Lines
from golc.embed.terms import Term
from golc.syntax import tree

_CHANGE = "write `causes(fluent, value)`"
IN_ACTIONS: Mapping[type[ast.stmt], str] = {
    ast.Assign: _CHANGE,
    ast.AnnAssign: _CHANGE,
    ast.AugAssign: _CHANGE,
    ast.If: "write `causes(fluent, value, when=φ)`",
    ast.Assert: "write `poss(φ)`",
    ast.While: "write `for n in station:` with `causes(…)` in it",
    ast.Return: "write `poss(φ)` for what it needs, `senses(…)` for what a device answers",
}
"""What was probably meant in the body of an action."""


class Actions(Lines):
    """Translates the body of an action."""

    def clauses(self) -> tuple[tree.Clause, ...]:
        """The lines of an action."""
        return self.lines(self._clause)

    def _clause(self, node: ast.stmt) -> Iterator[tree.Clause]:
        if isinstance(node, ast.For):
            yield from self._for_all(node)
            return
        self._no_method(node)
        call, word = self.call(node, "poss causes senses cost", IN_ACTIONS)
        span = self.span(node)
        if word is words.causes:
            yield self._effect(call, (), None, span)
        else:
            (value,) = self.arguments(call, 1)
            made: Any = {"poss": tree.Precondition, "senses": tree.Senses, "cost": tree.Cost}[word.name]
            yield made(self.expr(value), span=span)

    def _no_method(self, node: ast.stmt) -> None:
        """Raise ``Refused`` for a method that changes sets or lists in Python, as in ``seen.add(n)``."""
        match node:
            case ast.Expr(value=ast.Call(func=ast.Attribute(value=owner, attr=name) as called)):
                if isinstance(self.python(owner), Term):
                    fluent = self.span(owner).text
                    help_ = f"write `causes({fluent}, {fluent} + …)`, or `-` to take away"
                    raise meaningless(f"a term has no method `{name}`", self.span(called), help_)

    def _for_all(self, node: ast.For) -> Iterator[tree.Clause]:
        """``for x in t: causes(…)``: an effect for every value; a loop of Python is written out."""
        word = self.call_of(node.iter, words.each)
        if word is None and not self.is_type(node.iter):
            value = self.python(node.iter)
            if value is not NOT_PYTHON and not isinstance(value, Term):
                yield from self.unrolled(node, self._clause)
                return
        with self.loop(node, word) as (binders, condition):

            def effect(part: ast.stmt) -> Iterator[tree.Effect]:
                call, _ = self.call(part, "causes", IN_ACTIONS)
                yield self._effect(call, binders, condition, self.span(node))

            yield from self.each(node.body, effect)

    def _effect(
        self, call: ast.Call, binders: tuple[tree.Binder, ...], where: tree.Expr | None, span: Span
    ) -> tree.Effect:
        target, value = self.arguments(call, 2, ("when",))
        return tree.Effect(binders, where, self.application(target), self.value(value), self.when(call), span=span)
