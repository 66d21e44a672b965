"""Bodies of translated functions: what goes wrong in one statement does not hide the next."""

from __future__ import annotations

import ast
import contextlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import TypeVar

from golc.diagnostics import Code, Span
from golc.embed import words
from golc.embed.errors import Refused, meaningless, refused
from golc.embed.reading.evaluate import NOT_PYTHON
from golc.embed.reading.expressions import Expressions
from golc.embed.reading.refusals import STATEMENTS
from golc.embed.terms import PROGRAMS, Named, Term
from golc.embed.values import MOST_ELEMENTS, elements
from golc.syntax import tree

T = TypeVar("T")


class Bodies(Expressions):
    """Translates statements; every finding about them is collected, and raised at the end."""

    def returned(self) -> ast.expr:
        """What a function returns whose only statement that is."""
        body = self.function.body()
        match body:
            case [ast.Return(value=value)] if value is not None:
                return value
            case [ast.Return()]:
                raise meaningless("nothing is returned", self.span(body[0]), "write `return` and a term")
            case []:
                help_ = "write `return` and a term"
                raise meaningless(f"`{self.function.node.name}` returns nothing", self.function.name_span, help_)
        for node, after in pairwise(body):
            if isinstance(node, ast.Return):
                raise meaningless("what follows a `return` is never reached", self.head(after))
        first = next(node for node in body if not isinstance(node, ast.Return))
        help_ = "write one `return` with the whole term; give parts of it names with `@theory.define`"
        raise meaningless("the body of this function is one `return`", self.head(first), help_)

    def each(self, nodes: Iterable[ast.stmt], translate: Callable[[ast.stmt], Iterable[T]]) -> tuple[T, ...]:
        """What every statement becomes that can be translated; what is wrong with the others is kept."""
        made: list[T] = []
        for node in nodes:
            try:
                made += translate(node)
            except Refused as error:
                self.pass_over(error, node)
        return tuple(made)

    def unrolled(self, node: ast.For, translate: Callable[[ast.stmt], Iterable[T]]) -> Iterator[T]:
        """The statements of a loop of Python, once for each of its values."""
        values = self.listed(node.iter)
        if values is NOT_PYTHON or not isinstance(values, Iterable):
            help_ = "Python goes through what it knows: a list, a tuple, a dictionary"
            raise meaningless("there is nothing to go through here", self.span(node.iter), help_)
        if isinstance(values, Iterator) and not isinstance(node.iter, ast.Call):
            help_ = "make a list of it: `list(…)`"
            raise meaningless("this can be gone through only once", self.span(node.iter), help_)
        self.no_else(node)
        # The order of a set changes from run to run.
        ordered = sorted(values, key=repr) if isinstance(values, (set, frozenset)) else values
        before = len(self.found)
        for value in elements(ordered, self.span(node.iter)):
            if len(self.found) > before:
                return  # what is wrong in one round is wrong in most
            self.rounds += 1
            if self.rounds > MOST_ELEMENTS:
                message = f"with this loop more than {MOST_ELEMENTS} rounds of one function would be written out"
                help_ = "write `for n in interval(1, 6):` for integers in a row"
                raise refused(Code.PYTHON_VALUE, message, self.span(node.iter), help_)
            with self._round(node.target, value):
                yield from self.each(node.body, translate)

    @contextlib.contextmanager
    def _round(self, target: ast.expr, value: object) -> Iterator[None]:
        """One round of a loop of Python: while it lasts its variables are constants, and hide what has their names."""
        fixed, bound = dict(self.function.fixed), set(self.bound)
        try:
            self._assign(target, value)
            yield
        finally:
            self.function.fixed.clear()
            self.function.fixed.update(fixed)
            self.bound |= bound

    def listed(self, node: ast.expr) -> object:
        """What a loop of Python goes through: a value of Python, or a list that is written out."""
        if isinstance(node, (ast.Tuple, ast.List)):
            return [self._listed_part(part, (ast.Tuple,)) for part in self.spread(node.elts)]
        return self.python(node)

    def _listed_part(self, node: ast.expr, inside: tuple[type[ast.expr], ...]) -> object:
        """An element of a list that is written out; of the kinds ``inside`` also one that is written out itself."""
        match node:
            case ast.Constant(value=value):
                return value
            case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int() | float() as value)):
                return -value
            case ast.Tuple(elts=parts) | ast.List(elts=parts) if isinstance(node, inside):
                values = [self._listed_part(part, (ast.Tuple, ast.List)) for part in self.spread(parts)]
                return NOT_PYTHON if any(each is NOT_PYTHON for each in values) else tuple(values)
        return self.python(node)

    def _assign(self, target: ast.expr, value: object) -> None:
        match target:
            case ast.Name(id=name):
                self.function.fixed[name] = value
                self.bound.discard(name)
            case ast.Tuple(elts=parts) | ast.List(elts=parts) if isinstance(value, Sequence) and len(value) == len(
                parts
            ):
                for part, each in zip(parts, value, strict=True):
                    self._assign(part, each)
            case _:
                raise meaningless("the values do not fit these names", self.span(target))

    def is_pythons(self, node: ast.expr) -> bool:
        """Whether a loop goes through something of Python that is no list of values of the language."""
        value = self.listed(node)
        of_values = isinstance(value, (list, tuple, range, set, frozenset)) and not any(map(_is_no_value, value))
        return self.is_known(node) and not of_values

    def is_known(self, node: ast.expr) -> bool:
        """Whether Python knows what a loop goes through."""
        value = self.listed(node)
        if isinstance(value, (list, tuple)):
            return not any(each is NOT_PYTHON for each in value)
        return value is not NOT_PYTHON and not isinstance(value, Term)

    @contextlib.contextmanager
    def loop(
        self, node: ast.For, word: words.Word | None
    ) -> Iterator[tuple[tuple[tree.Binder, ...], tree.Expr | None]]:
        """The variables of a ``for`` of the language with its condition; they are bound while this lasts.

        ``word`` is called around the types and lists that it goes through, if there is more to say than one of them.
        """
        self.no_else(node)
        ranges, where = [node.iter], None
        if word is not None:
            assert isinstance(node.iter, ast.Call), "the word is called"
            ranges, where = self.every_argument(node.iter, ("where",)), self.keyword(node.iter, "where")
            if not ranges:
                raise refused(Code.ARITY, f"`{word.name}` needs a type or a list to go through", self.span(node.iter))
        binders = self.binders(node.target, ranges)
        with self.scope([each.id for each in ast.walk(node.target) if isinstance(each, ast.Name)]):
            yield binders, None if where is None else self.expr(where)

    def no_else(self, node: ast.For | ast.While) -> None:
        """A loop of the language has no ``else``."""
        if node.orelse:
            raise meaningless(
                "a loop of a program has no `else`", self.span(node.orelse[0]), "write it behind the loop"
            )

    def refuse(self, node: ast.stmt) -> Refused:
        """What to say of a statement that has no meaning where it stands."""
        message, help_ = STATEMENTS.get(type(node), ("this has no meaning here", None))
        return meaningless(message, self.head(node), help_)

    def head(self, node: ast.stmt) -> Span:
        """The first line of a statement."""
        span = self.span(node)
        line = span.text.partition("\n")[0].rstrip()
        return Span(span.source, span.start, span.start + len(line))


def _is_no_value(value: object) -> bool:
    """Whether something cannot be an element of a list of the language: an action, a tuple, a function."""
    if isinstance(value, Named):
        return value.kind in PROGRAMS
    return not (value is None or isinstance(value, (bool, int, float, str, Term)))
