"""The bodies of devices."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any

from golc.diagnostics import Code
from golc.embed import words
from golc.embed.errors import meaningless, refused
from golc.embed.names import new_name
from golc.embed.reading.lines import Lines
from golc.embed.reading.tables import Tables
from golc.embed.terms import Named
from golc.syntax import tree
from golc.syntax.python_names import python_name


class Devices(Lines, Tables):
    """Translates the body of a device."""

    def settings(self) -> tuple[tree.Binding | tree.Setting, ...]:
        """The lines of a device."""
        return self.lines(self._setting)

    def _setting(self, node: ast.stmt) -> Iterator[tree.Binding | tree.Setting]:
        if isinstance(node, ast.For):
            yield from self.unrolled(node, self._setting)
            return
        call, word = self.call(node, "bind setting")
        yield self._binding(call) if word is words.bind else self._set(call)

    def _set(self, call: ast.Call) -> tree.Setting:
        seconds = self.keyword(call, "seconds")
        name, *values = self.arguments(call, 1 if seconds is not None else 2, ("seconds",))
        ident = new_name(self._text(name), self.span(name), used=True)
        value = seconds if seconds is not None else values[0]
        return tree.Setting(ident, self.expr(value), seconds is not None, span=self.span(call))

    def _text(self, node: ast.expr) -> str:
        """A string of Python."""
        value = node.value if isinstance(node, ast.Constant) else self.python(node)
        if not isinstance(value, str):
            raise meaningless("this must be a string", self.span(node))
        return value

    def _binding(self, call: ast.Call) -> tree.Binding:
        known = ("number", "first", "call", "start", "prompt", "timeout", "table")
        (bound,) = self.arguments(call, 1, known)
        named = bound.func if isinstance(bound, ast.Call) else bound
        action = self.python(named)
        if not isinstance(action, Named):
            raise meaningless("this is no action", self.span(bound), "write an action: `bind(turn_around, number=0)`")
        ident = tree.Ident(action.name, span=self.span(named))
        parts = self.every_argument(bound) if isinstance(bound, ast.Call) else []
        args = tuple(self._bound_arg(arg) for arg in parts) or None
        given = {word.arg: word.value for word in call.keywords}
        timeout = None if "timeout" not in given else self.expr(given["timeout"])
        table = None if "table" not in given else self.table(given["table"])
        variables = [arg.name.text for arg in args or () if isinstance(arg, tree.Parameter)]
        with self.scope([python_name(name) for name in (*action.parameters, *variables)]):
            behaviour = self._behaviour(call, given)
        return tree.Binding(ident, args, *self._number(call, given), behaviour, table, timeout, span=self.span(call))

    def _number(self, call: ast.Call, given: dict[str | None, ast.expr]) -> tuple[int | None, bool]:
        one, first = given.get("number"), given.get("first")
        node = first if one is None else one
        if one is not None and first is not None:
            raise meaningless("a binding has one number, or the first of several", self.span(call))
        if node is None:
            return None, False
        value = node.value if isinstance(node, ast.Constant) else self.python(node)
        if not isinstance(value, int) or isinstance(value, bool) or value < 0:
            raise refused(Code.PYTHON_VALUE, "the number of an action is a natural number", self.span(node))
        return value, first is not None

    def _bound_arg(self, node: ast.expr) -> Any:
        if self.call_of(node, words.var):
            assert isinstance(node, ast.Call)
            name, type_ = self.arguments(node, 2)
            return tree.Parameter(new_name(self._text(name), self.span(name)), self.type(type_), span=self.span(node))
        return self.constant(node)

    def _behaviour(self, call: ast.Call, given: dict[str | None, ast.expr]) -> Any:
        ways = [name for name in ("call", "start", "prompt") if name in given]
        if len(ways) > 1:
            raise meaningless("an action is carried out in one way", self.span(call), "leave all but one out")
        if not ways:
            return None
        node = given[ways[0]]
        if ways[0] == "prompt":
            return tree.ByPrompt(self.message(node), span=self.span(node))
        name = new_name(self._text(node), self.span(node), used=True)
        made: Any = tree.ByCall if ways[0] == "call" else tree.ByStart
        return made(name, span=self.span(node))
