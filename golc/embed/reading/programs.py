"""Programs of translated functions: from Python's statements to those of the language."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from types import FunctionType
from typing import Any

from golc.diagnostics import Span
from golc.embed import words
from golc.embed.errors import meaningless
from golc.embed.reading.blocks import Blocks
from golc.embed.reading.evaluate import NOT_PYTHON
from golc.embed.terms import Named
from golc.syntax import tree

_SPOKEN: Mapping[words.Word, Any] = {words.say: tree.Say, words.abort: tree.Abort}


class Programs(Blocks):
    """Translates the body of a procedure."""

    def block(self, nodes: Sequence[ast.stmt]) -> tree.Block:
        """Statements one below the other."""
        pairs = list(zip(nodes, [*nodes[1:], None], strict=True))
        following = {id(node): after for node, after in pairs}
        previous = {id(after): node for node, after in pairs if after is not None}

        def one(node: ast.stmt) -> Iterator[tree.Statement]:
            if self.is_otherwise(node):
                before = previous.get(id(node))
                if before is None or self.with_word(before) is not words.within:
                    raise meaningless("`otherwise` follows directly on a `within`", self.head(node))
                return
            after = following[id(node)]
            yield from self.statement(node, after if after is not None and self.is_otherwise(after) else None)

        statements = self.each(nodes, one)
        span = self.span(nodes[0]).to(self.span(nodes[-1]))
        return tree.Block(statements or (tree.Skip(span=span),), span=span)

    def statement(self, node: ast.stmt, otherwise: ast.stmt | None = None) -> Iterator[tree.Statement]:
        """What a statement of Python becomes: one statement, or several where a loop of Python is written out."""
        span = self.span(node)
        match node:
            case ast.Pass():
                yield tree.Skip(span=span)
            case ast.Expr(value=ast.Constant(value=str())):
                return
            case ast.Expr(value=value):
                yield self._simple(value, span)
            case ast.If():
                yield from self._if(node, span)
            case ast.While(test=test, body=body):
                self.no_else(node)
                yield tree.While(self.expr(test), self.block(body), span=span)
            case ast.For():
                yield from self._for(node, span)
            case ast.With():
                yield self.with_statement(node, otherwise, span)
            case _:
                raise self.refuse(node)

    def _simple(self, node: ast.expr, span: Span) -> tree.Statement:
        if not isinstance(node, ast.Call):
            value = self.python(node)
            help_ = f"write `{span.text}()`" if isinstance(value, Named) else "call an action or a procedure"
            raise meaningless("this does nothing", span, help_)
        word = self.python(node.func)
        if word is words.test:
            return tree.Test(self.expr(self.arguments(node, 1)[0]), span=span)
        if word is words.wait:
            return self._wait(node, span)
        if isinstance(word, words.Word) and word in _SPOKEN:
            (text,) = self.arguments(node, 1)
            return _SPOKEN[word](self.message(text), span=span)  # type: ignore[no-any-return]
        if isinstance(word, words.Operator):
            help_ = "write `test(φ)` to wait for what holds" + (", and `poss` in an action" * (word is words.poss))
            raise meaningless("this does nothing", span, help_)
        if isinstance(word, FunctionType) and self.python(node) is None:
            help_ = f"put `@theory.proc` above `def {word.__name__}`, or write its lines here"
            raise meaningless("a function of Python does nothing in a program", span, help_)
        return tree.Call(self.application(node), span=span)

    def _wait(self, node: ast.Call, span: Span) -> tree.Statement:
        self.arguments(node, 0, ("until", "seconds"))
        condition, duration = self.keyword(node, "until"), self.keyword(node, "seconds")
        if condition is not None and duration is not None:
            raise meaningless(
                "a `wait` is for a condition or for a time", span, "write `with within(seconds):` around it"
            )
        if condition is not None:
            return tree.WaitUntil(self.expr(condition), span=span)
        return tree.Wait(span=span) if duration is None else tree.WaitTime(self.expr(duration), span=span)

    def _if(self, node: ast.If, span: Span) -> Iterator[tree.Statement]:
        branches: list[tuple[tree.Expr, tree.Block]] = []
        rest: list[ast.stmt] = [node]
        while len(rest) == 1 and isinstance(part := rest[0], ast.If) and (part is node or self._is_elif(part)):
            decided = self._decided(part.test)
            if decided is True:
                rest = part.body
                break
            if decided is NOT_PYTHON:
                span = span if branches else self.span(part)
                branches.append((self.expr(part.test), self.block(part.body)))
            rest = part.orelse
        if branches:
            yield tree.If(tuple(branches), self.block(rest) if rest else None, span=span)
        elif rest:
            yield from self.block(rest).statements

    def _decided(self, node: ast.expr) -> object:
        """The truth of a condition of Python alone, which chooses between two programs."""
        value = self.python(node)
        return value if isinstance(value, bool) else NOT_PYTHON

    def _is_elif(self, node: ast.If) -> bool:
        return self.span(node).text.startswith("elif")

    def _for(self, node: ast.For, span: Span) -> Iterator[tree.Statement]:
        word = self.call_of(node.iter, words.pick, words.each, words.on)
        if word is None and not self.is_type(node.iter) and self.is_pythons(node.iter):
            yield from self.unrolled(node, lambda each: self.statement(each))
            return
        if word is words.on:
            raise meaningless("`on` stands in `with interrupts():`", self.span(node.iter))
        made: Any = tree.Pick if word is words.pick else tree.For
        with self.loop(node, word) as (binders, condition):
            yield made(binders, condition, self.block(node.body), span=span)
