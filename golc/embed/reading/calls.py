"""Calls in the expressions of translated functions: of what the theory declares, and of words of the language."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Mapping, Sequence
from typing import Any

from golc.diagnostics import Span
from golc.embed import words
from golc.embed.errors import Refused, meaningless
from golc.embed.reading.binders import Binders
from golc.embed.terms import Named, in_order
from golc.embed.words import Word
from golc.syntax import tree
from golc.syntax.python_names import golc_name

_QUANTIFIERS: Mapping[object, Any] = {
    builtins.any: "exists",
    builtins.all: "forall",
    builtins.sum: "sum",
    builtins.min: "min",
    builtins.max: "max",
    words.count: "count",
}
_EPISTEMIC: Mapping[object, Any] = {words.known: "known", words.knows: "knows", words.possible: "possible"}
_FUNCTIONS: Mapping[object, str] = {
    builtins.abs: "abs",
    builtins.len: "len",
    words.first: "first",
    words.rest: "rest",
    words.before: "before",
    words.poss: "poss",
}
_EMPTY: Mapping[object, Any] = {builtins.set: tree.SetLiteral, builtins.list: tree.ListLiteral}
_CONNECTIVES: Mapping[object, Any] = {words.implies: "implies", words.iff: "iff"}


def _meant(table: Mapping[object, Any], called: object) -> Any:
    """What a function stands for; compared by identity, for what is called may be anything."""
    return next((meaning for function, meaning in table.items() if function is called), None)


class Calls(Binders):
    """Translates calls."""

    def call_of(self, node: ast.expr, *expected: words.Word) -> words.Word | None:
        """The word that a call calls, if it is one of those expected."""
        if not isinstance(node, ast.Call):
            return None
        called = self.python(node.func)
        return called if isinstance(called, words.Word) and called in expected else None

    def call_expr(self, node: ast.Call) -> tree.Expr:
        """A call that is a term: of a name of the theory, or of a word of the language."""
        span = self.span(node)
        called = self.python(node.func)
        if isinstance(called, Named):
            return self._apply(node, called, span)
        if (empty := _meant(_EMPTY, called)) and not node.args and not node.keywords:
            return empty((), span=span)  # type: ignore[no-any-return]
        if (quantified := self.quantifier(node)) is not None:
            return quantified
        kind = _meant(_QUANTIFIERS, called)
        if kind in ("min", "max") and len(node.args) > 1:
            args = tuple(self.expr(arg) for arg in self.every_argument(node))
            return tree.Extremum(kind, args, span=span)
        return self._word_call(node, called, span)

    def quantifier(self, node: ast.Call) -> tree.Quantifier | None:
        """A call that binds variables, as in ``any(free(n) for n in station)``, if it is one."""
        kind = _meant(_QUANTIFIERS, self.python(node.func))
        if kind is None or len(node.args) != 1 or not isinstance(node.args[0], ast.GeneratorExp):
            return None
        self.arguments(node, 1)
        generator = node.args[0]
        with self.generators(generator.generators) as (binders, where):
            return tree.Quantifier(kind, binders, where, self.expr(generator.elt), span=self.span(node))

    def _word_call(self, node: ast.Call, called: object, span: Span) -> tree.Expr:
        if function := _meant(_FUNCTIONS, called):
            (argument,) = self.arguments(node, 1)
            return tree.Apply(tree.Ident(function, span=self.span(node.func)), (self.expr(argument),), span=span)
        if kind := _meant(_EPISTEMIC, called):
            (argument,) = self.arguments(node, 1)
            return tree.Epistemic(kind, self.expr(argument), span=span)
        if connective := _meant(_CONNECTIVES, called):
            left, right = self.arguments(node, 2)
            return tree.Binary(connective, self.expr(left), self.expr(right), span=span)
        raise self._uncallable(node, called)

    def _uncallable(self, node: ast.Call, called: object) -> Refused:
        span = self.span(node.func)
        if called is words.count:
            return meaningless("`count` needs `… for n in station` here", span, "write `count(φ for n in station)`")
        if called is words.exists or called is words.forall:
            instead = "any" if called is words.exists else "all"
            message = f"`{called.name}(…)` is for Python outside translated functions"
            return meaningless(message, span, f"write `{instead}(φ for n in station)`")
        if isinstance(called, Word):
            return meaningless(f"`{called.name}` stands in the wrong place", span, f"it belongs in {called.place}")
        name = getattr(called, "__name__", None)
        if _meant(_QUANTIFIERS, called):
            return meaningless(f"`{name}` needs `… for n in station` here", span, f"write `{name}(… for n in station)`")
        if isinstance(name, str):
            return meaningless(f"`{name}` has no meaning in a theory", span)
        if isinstance(node.func, ast.Attribute):
            help_ = "terms have `in`, `+`, `-`, `len(x)`, `first(x)`, `rest(x)`, `x[i]` and comprehensions"
            return meaningless(f"a term has no method `{node.func.attr}`", span, help_)
        return meaningless("this cannot be called", span)

    def _apply(self, node: ast.Call, called: Named, span: Span) -> tree.Apply:
        named = tuple((golc_name(self._keyword(word)), word.value) for word in node.keywords)
        args: Sequence[Any] = in_order(called, self.spread(node.args), named, span)
        head = tree.Ident(called.name, span=self.span(node.func))
        return tree.Apply(head, tuple(self.expr(arg) for arg in args), span=span)

    def _keyword(self, word: ast.keyword) -> str:
        if word.arg is None:
            raise meaningless("`**` spreads no terms", self.span(word), "write the arguments one by one")
        return word.arg
