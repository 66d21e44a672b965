"""The variables of quantifiers, comprehensions and loops in translated functions, and what they range over."""

from __future__ import annotations

import ast
import contextlib
from collections.abc import Iterator, Sequence
from typing import Any

from golc.diagnostics import counted
from golc.embed import words
from golc.embed.errors import meaningless
from golc.embed.names import new_name
from golc.embed.reading.annotations import Annotations
from golc.syntax import tree
from golc.syntax.python_names import golc_name


class Binders(Annotations):
    """Translates what binds variables."""

    @contextlib.contextmanager
    def generators(
        self, generators: list[ast.comprehension]
    ) -> Iterator[tuple[tuple[tree.Binder, ...], tree.Expr | None]]:
        """The binders and the condition of ``… for x in t for y in u if φ``; the variables are bound while it lasts."""
        binders: list[tree.Binder] = []
        conditions: list[tree.Expr] = []
        tests: list[ast.expr] = []
        with contextlib.ExitStack() as stack:
            for generator in generators:
                name = self._variable(generator, tests)
                binders.append(self.binder(name, generator.iter))
                stack.enter_context(self.scope([name.id]))
                tests += generator.ifs
                conditions += [self.expr(condition) for condition in generator.ifs]
            yield tuple(binders), chain("and", conditions) if conditions else None

    def _variable(self, generator: ast.comprehension, before: Sequence[ast.expr]) -> ast.Name:
        """The variable of one ``for``, of which the conditions before it do not speak.

        They are all said behind the last one, where its name would mean another thing.
        """
        target = generator.target
        if generator.is_async:
            raise meaningless("`async` has no meaning in a theory", self.span(target), "write `for`")
        if not isinstance(target, ast.Name):
            raise meaningless("one variable a `for`", self.span(target), "write `for x in t for y in u`")
        if target.id in (each.id for test in before for each in ast.walk(test) if isinstance(each, ast.Name)):
            message = f"`{target.id}` means something else in the `if` before"
            raise meaningless(message, self.span(target), "give this variable another name")
        return target

    def binder(self, target: ast.Name, over: ast.expr) -> tree.Binder:
        """A variable over a type, or over the elements of a set or list."""
        name = new_name(golc_name(target.id), self.span(target))
        span = name.span.to(self.span(over))
        if isinstance(over, ast.Call) and self.python(over.func) is words.values:
            (collection,) = self.arguments(over, 1)
            return tree.Binder(name, collection=self.expr(collection), span=span)
        if self.is_type(over):
            return tree.Binder(name, self.type(over), span=span)
        return tree.Binder(name, collection=self.expr(over), span=span)

    def binders(self, target: ast.expr, ranges: Sequence[ast.expr]) -> tuple[tree.Binder, ...]:
        """The variables of a ``for`` with what they range over; a range may use the variables before it."""
        parts = target.elts if isinstance(target, (ast.Tuple, ast.List)) else [target]
        names = [part for part in parts if isinstance(part, ast.Name)]
        if len(names) != len(parts) or len(names) != len(ranges):
            message = f"{counted(len(parts), 'variable')} for {counted(len(ranges), 'type')}"
            raise meaningless(message, self.span(target), "write as many names as types: `for x, y in pick(t, u)`")
        made = []
        with contextlib.ExitStack() as stack:
            for name, over in zip(names, ranges, strict=True):
                made.append(self.binder(name, over))
                stack.enter_context(self.scope([name.id]))
        return tuple(made)


def chain(word: Any, parts: Sequence[tree.Expr]) -> tree.Expr:
    """``a and b and c`` is ``(a and b) and c``."""
    whole, *rest = parts
    for part in rest:
        whole = tree.Binary(word, whole, part, span=whole.span.to(part.span))
    return whole
