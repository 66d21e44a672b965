"""Statements of a program that begin with ``with``: blocks under a word of the language."""

from __future__ import annotations

import ast
from abc import abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from golc.diagnostics import Span
from golc.embed import words
from golc.embed.errors import meaningless
from golc.embed.names import new_name
from golc.embed.reading.bodies import Bodies
from golc.syntax import tree
from golc.syntax.python_names import golc_name
from golc.theory.statements import Strategy

_BRANCHING: Mapping[words.Word, Any] = {
    words.choose: tree.Choose,
    words.together: tree.Together,
    words.prefer: tree.Prefer,
}
MODES = tuple(strategy.value for strategy in Strategy)


class Blocks(Bodies):
    """Translates blocks."""

    @abstractmethod
    def block(self, nodes: Sequence[ast.stmt]) -> tree.Block:
        """Statements one below the other."""

    def with_word(self, node: ast.stmt) -> words.Word | None:
        """The word under which a block stands, if the statement is one."""
        if not isinstance(node, ast.With):
            return None
        call = node.items[0].context_expr
        word = self.python(call.func if isinstance(call, ast.Call) else call)
        return word if isinstance(word, words.Word) else None

    def is_otherwise(self, node: ast.stmt) -> bool:
        """Whether a statement is what a ``within`` before it goes on with."""
        return isinstance(node, ast.With) and self.with_word(node) is words.otherwise

    def with_statement(self, node: ast.With, otherwise: ast.stmt | None, span: Span) -> tree.Statement:
        """A block; ``otherwise`` is the statement behind it, if that belongs to it."""
        word, call = self._opening(node)
        if word is words.let:
            return self._let(node, call, span)
        if word in _BRANCHING:
            return _BRANCHING[word](self._branches(node, call, word), span=span)  # type: ignore[no-any-return]
        if word is words.interrupts:
            self.arguments(call, 0)
            return tree.Interrupts(self.each(node.body, self._handler), span=span)
        if word is words.star:
            self.arguments(call, 0, ("at_most",))
            return tree.Star(self._given(call, "at_most"), self.block(node.body), span=span)
        if word is words.together_star:
            self.arguments(call, 0)
            return tree.TogetherStar(self.block(node.body), span=span)
        if word is words.guard:
            (condition,) = self.arguments(call, 1)
            return tree.Guard(self.expr(condition), self.block(node.body), span=span)
        if word is words.search:
            return self._search(node, call, span)
        if word is words.within:
            return self._within(node, call, otherwise, span)
        help_ = "write `for x in pick(station):`" if word is words.pick else f"it belongs in {word.place}"
        raise meaningless(f"`{word.name}` stands in the wrong place", self.span(call), help_)

    def _opening(self, node: ast.With) -> tuple[words.Word, ast.Call]:
        """The word under which a block stands, and its call. Raises ``Refused`` for whatever else is said there."""
        if len(node.items) > 1:
            second = self.span(node.items[1].context_expr)
            raise meaningless("one word a `with`", second, "write one `with` inside the other")
        word, call, target = self.with_word(node), node.items[0].context_expr, node.items[0].optional_vars
        if word is not None and not isinstance(call, ast.Call):
            raise meaningless(f"`{word.name}` is called", self.span(call), f"write `with {word.name}():`")
        if not isinstance(call, ast.Call) or word is None:
            help_ = "`with choose():`, `with search():` …"
            raise meaningless("this `with` has no meaning in a theory", self.span(call), help_)
        if target is not None and word is not words.let:
            help_ = "write `for x in pick(station):`" if word is words.pick else "`with let(e) as x:` does"
            raise meaningless(f"`{word.name}` gives nothing a name", self.span(target), help_)
        return word, call

    def _within(self, node: ast.With, call: ast.Call, otherwise: ast.stmt | None, span: Span) -> tree.Within:
        (duration,) = self.arguments(call, 1)
        rest = None
        if isinstance(otherwise, ast.With):
            self.arguments(self._opening(otherwise)[1], 0)
            rest = self.block(otherwise.body)
        return tree.Within(self.expr(duration), self.block(node.body), rest, span=span)

    def _given(self, call: ast.Call, name: str) -> tree.Expr | None:
        value = self.keyword(call, name)
        return None if value is None else self.expr(value)

    def _search(self, node: ast.With, call: ast.Call, span: Span) -> tree.Search:
        mode: Any = None
        given = self.arguments(call, min(len(call.args), 1), ("at_most", "within"))
        if given:
            match given[0]:
                case ast.Constant(value=str() as text) if text in MODES:
                    mode = text
                case other:
                    help_ = 'write `search("first")`, `search("shortest")` or `search("cheapest")`'
                    raise meaningless("this is no way to search", self.span(other), help_)
        limits = self._given(call, "at_most"), self._given(call, "within")
        return tree.Search(mode, *limits, self.block(node.body), span=span)

    def _let(self, node: ast.With, call: ast.Call, span: Span) -> tree.Let:
        (value,) = self.arguments(call, 1)
        target = node.items[0].optional_vars
        if not isinstance(target, ast.Name):
            raise meaningless("`let` gives one name", self.span(target or call), "write `with let(e) as x:`")
        name = new_name(golc_name(target.id), self.span(target))
        meant = self.expr(value)
        with self.scope([target.id]):
            return tree.Let(name, meant, self.block(node.body), span=span)

    def _branches(self, node: ast.With, call: ast.Call, word: words.Word) -> tuple[tree.Block, ...]:
        self.arguments(call, 0)

        def branch(part: ast.stmt) -> Iterator[tree.Block]:
            if isinstance(part, ast.For) and self.is_known(part.iter):
                yield from self.unrolled(part, branch)
                return
            if not isinstance(part, ast.With) or self.with_word(part) is not words.branch:
                help_ = f"write `with branch():` around each part of `{word.name}`"
                raise meaningless(f"only branches stand in `{word.name}`", self.head(part), help_)
            self.arguments(self._opening(part)[1], 0)
            yield self.block(part.body)

        known = len(self.found)
        branches = self.each(node.body, branch)
        if len(branches) < 2 and len(self.found) == known:
            raise meaningless(f"`{word.name}` needs two branches", self.span(call), "write a second `with branch():`")
        return branches

    def _handler(self, node: ast.stmt) -> Iterator[tree.On]:
        span = self.span(node)
        if isinstance(node, ast.With) and self.with_word(node) is words.on:
            (condition,) = self.arguments(self._opening(node)[1], 1)
            yield tree.On((), self.expr(condition), self.block(node.body), span=span)
        elif isinstance(node, ast.For) and self.call_of(node.iter, words.on):
            with self.loop(node, words.on) as (binders, where):
                if where is None:
                    raise meaningless("`on` needs a condition", self.span(node.iter), "write `on(station, where=φ)`")
                yield tree.On(binders, where, self.block(node.body), span=span)
        elif isinstance(node, ast.For) and self.is_known(node.iter):
            yield from self.unrolled(node, self._handler)
        else:
            help_ = "write `with on(φ):` or `for n in on(station, where=φ):`"
            raise meaningless("only `on` stands in `interrupts`", self.head(node), help_)
