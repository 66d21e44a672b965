"""Programs of translated functions: from Python's statements to those of the language."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from types import FunctionType
from typing import Any

from golc.diagnostics import Code, Span
from golc.embed import words
from golc.embed.errors import meaningless, refused
from golc.embed.names import golc_name, new_name
from golc.embed.reading.bodies import Bodies
from golc.embed.reading.evaluate import NOT_PYTHON
from golc.embed.terms import PROGRAMS, Named, Term
from golc.syntax import tree

_BRANCHING: Mapping[words.Word, Any] = {
    words.choose: tree.Choose,
    words.together: tree.Together,
    words.prefer: tree.Prefer,
}
_SPOKEN: Mapping[words.Word, Any] = {words.say: tree.Say, words.abort: tree.Abort}
MODES = ("first", "shortest", "cheapest")


class Programs(Bodies):
    """Translates the body of a procedure."""

    def block(self, nodes: Sequence[ast.stmt]) -> tree.Block:
        """Statements one below the other."""
        pairs = list(zip(nodes, [*nodes[1:], None], strict=True))
        following = {id(node): after for node, after in pairs}
        previous = {id(after): node for node, after in pairs if after is not None}

        def one(node: ast.stmt) -> Iterator[tree.Statement]:
            if self._is_otherwise(node):
                before = previous.get(id(node))
                if before is None or self._with_word(before) is not words.within:
                    raise meaningless("`otherwise` follows directly on a `within`", self.head(node))
                return
            after = following[id(node)]
            yield from self.statement(node, after if after is not None and self._is_otherwise(after) else None)

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
                yield self._with(node, otherwise, span)
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
        decided = self._decided(node.test)
        if decided is not NOT_PYTHON:
            chosen = node.body if decided else node.orelse
            if chosen:
                yield from self.block(chosen).statements
            return
        branches = [(self.expr(node.test), self.block(node.body))]
        rest = node.orelse
        while len(rest) == 1 and isinstance(rest[0], ast.If) and self._is_elif(rest[0]):
            node = rest[0]
            decided = self._decided(node.test)
            if decided is not NOT_PYTHON and not decided:
                rest = node.orelse
                continue
            if decided is not NOT_PYTHON:
                rest = node.body
                break
            branches.append((self.expr(node.test), self.block(node.body)))
            rest = node.orelse
        yield tree.If(tuple(branches), self.block(rest) if rest else None, span=span)

    def _decided(self, node: ast.expr) -> object:
        """The truth of a condition of Python alone, which chooses between two programs."""
        value = self.python(node)
        return value if isinstance(value, bool) else NOT_PYTHON

    def _is_elif(self, node: ast.If) -> bool:
        return self.span(node).text.startswith("elif")

    def _for(self, node: ast.For, span: Span) -> Iterator[tree.Statement]:
        word = self.call_of(node.iter, words.pick, words.each, words.on)
        if word is None and not self.is_type(node.iter) and self._is_pythons(node.iter):
            yield from self.unrolled(node, lambda each: self.statement(each))
            return
        if word is words.on:
            raise meaningless("`on` stands in `with interrupts():`", self.span(node.iter))
        self.no_else(node)
        binders, where = self._ranges(node, word)
        with self.scope([name.id for name in self._names(node.target)]):
            condition = None if where is None else self.expr(where)
            made: Any = tree.Pick if word is words.pick else tree.For
            yield made(binders, condition, self.block(node.body), span=span)

    def _is_pythons(self, node: ast.expr) -> bool:
        """Whether a loop goes through something of Python that is no list of values of the language."""
        value = self.listed(node)
        of_values = isinstance(value, (list, tuple, range, set, frozenset)) and not any(map(_is_no_value, value))
        return self._is_known(node) and not of_values

    def _is_known(self, node: ast.expr) -> bool:
        """Whether Python knows what a loop goes through."""
        value = self.listed(node)
        if isinstance(value, (list, tuple)):
            return not any(each is NOT_PYTHON for each in value)
        return value is not NOT_PYTHON and not isinstance(value, Term)

    def _ranges(self, node: ast.For, word: words.Word | None) -> tuple[tuple[tree.Binder, ...], ast.expr | None]:
        if word is None:
            return self.binders(node.target, [node.iter]), None
        assert isinstance(node.iter, ast.Call)
        if not node.iter.args:
            raise refused(Code.ARITY, f"`{word.name}` needs a type or a list to go through", self.span(node.iter))
        ranges = self.every_argument(node.iter, ("where",))
        return self.binders(node.target, ranges), self.keyword(node.iter, "where")

    def _names(self, target: ast.expr) -> list[ast.Name]:
        return [each for each in ast.walk(target) if isinstance(each, ast.Name)]

    # Statements that begin with `with`

    def _with_word(self, node: ast.stmt) -> words.Word | None:
        if not isinstance(node, ast.With):
            return None
        call = node.items[0].context_expr
        word = self.python(call.func if isinstance(call, ast.Call) else call)
        return word if isinstance(word, words.Word) else None

    def _is_otherwise(self, node: ast.stmt) -> bool:
        return isinstance(node, ast.With) and self._with_word(node) is words.otherwise

    def _with(self, node: ast.With, otherwise: ast.stmt | None, span: Span) -> tree.Statement:
        item = node.items[0]
        if len(node.items) > 1:
            raise meaningless(
                "one word a `with`", self.span(node.items[1].context_expr), "write one `with` inside the other"
            )
        word, call = self._with_word(node), item.context_expr
        if word is not None and not isinstance(call, ast.Call):
            raise meaningless(f"`{word.name}` is called", self.span(call), f"write `with {word.name}():`")
        if not isinstance(call, ast.Call) or word is None:
            raise meaningless(
                "this `with` has no meaning in a theory", self.span(call), "`with choose():`, `with search():` …"
            )
        if word is words.let:
            return self._let(node, call, item.optional_vars, span)
        if item.optional_vars is not None:
            help_ = "write `for x in pick(station):`" if word is words.pick else "`with let(e) as x:` does"
            raise meaningless(f"`{word.name}` gives nothing a name", self.span(item.optional_vars), help_)
        if word in _BRANCHING:
            return _BRANCHING[word](self._branches(node, call, word), span=span)  # type: ignore[no-any-return]
        if word is words.interrupts:
            self.arguments(call, 0)
            return tree.Interrupts(self.each(node.body, self._handler), span=span)
        return self._single(node, call, word, otherwise, span)

    def _single(
        self, node: ast.With, call: ast.Call, word: words.Word, otherwise: ast.stmt | None, span: Span
    ) -> tree.Statement:
        if word is words.star:
            self.arguments(call, 0, ("at_most",))
            return tree.Star(self._given(call, "at_most"), self.block(node.body), span=span)
        if word is words.together_star:
            self.arguments(call, 0)
            return tree.TogetherStar(self.block(node.body), span=span)
        if word is words.guard:
            return tree.Guard(self.expr(self.arguments(call, 1)[0]), self.block(node.body), span=span)
        if word is words.search:
            return self._search(node, call, span)
        if word is words.within:
            (duration,) = self.arguments(call, 1)
            rest = self.block(otherwise.body) if isinstance(otherwise, ast.With) else None
            return tree.Within(self.expr(duration), self.block(node.body), rest, span=span)
        help_ = "write `for x in pick(station):`" if word is words.pick else f"it belongs in {word.place}"
        raise meaningless(f"`{word.name}` stands in the wrong place", self.span(call), help_)

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

    def _let(self, node: ast.With, call: ast.Call, target: ast.expr | None, span: Span) -> tree.Let:
        (value,) = self.arguments(call, 1)
        if not isinstance(target, ast.Name):
            raise meaningless("`let` gives one name", self.span(target or call), "write `with let(e) as x:`")
        name = new_name(golc_name(target.id), self.span(target))
        meant = self.expr(value)
        with self.scope([target.id]):
            return tree.Let(name, meant, self.block(node.body), span=span)

    def _branches(self, node: ast.With, call: ast.Call, word: words.Word) -> tuple[tree.Block, ...]:
        self.arguments(call, 0)

        def branch(part: ast.stmt) -> Iterator[tree.Block]:
            if isinstance(part, ast.For) and self._is_known(part.iter):
                yield from self.unrolled(part, branch)
                return
            if not isinstance(part, ast.With) or self._with_word(part) is not words.branch:
                help_ = f"write `with branch():` around each part of `{word.name}`"
                raise meaningless(f"only branches stand in `{word.name}`", self.head(part), help_)
            yield self.block(part.body)

        branches = self.each(node.body, branch)
        if len(branches) < 2:
            raise meaningless(f"`{word.name}` needs two branches", self.span(call), "write a second `with branch():`")
        return branches

    def _handler(self, node: ast.stmt) -> Iterator[tree.On]:
        span = self.span(node)
        if isinstance(node, ast.With) and self._with_word(node) is words.on:
            call = node.items[0].context_expr
            assert isinstance(call, ast.Call)
            (condition,) = self.arguments(call, 1)
            yield tree.On((), self.expr(condition), self.block(node.body), span=span)
        elif isinstance(node, ast.For) and self.call_of(node.iter, words.on):
            binders, where = self._ranges(node, words.on)
            if where is None:
                raise meaningless("`on` needs a condition", self.span(node.iter), "write `on(station, where=φ)`")
            with self.scope([name.id for name in self._names(node.target)]):
                yield tree.On(binders, self.expr(where), self.block(node.body), span=span)
        elif isinstance(node, ast.For) and self._is_known(node.iter):
            yield from self.unrolled(node, self._handler)
        else:
            help_ = "write `with on(φ):` or `for n in on(station, where=φ):`"
            raise meaningless("only `on` stands in `interrupts`", self.head(node), help_)


def _is_no_value(value: object) -> bool:
    """Whether something cannot be an element of a list of the language: an action, a tuple, a function."""
    if isinstance(value, Named):
        return value.kind in PROGRAMS
    return not (value is None or isinstance(value, (bool, int, float, str, Term)))
