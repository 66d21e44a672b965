"""The bodies of successor state axioms, and prunes by the last action."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any

from golc.diagnostics import Span
from golc.embed import words
from golc.embed.errors import meaningless
from golc.embed.names import new_name
from golc.embed.reading.lines import Lines
from golc.embed.terms import Named
from golc.syntax import tree
from golc.syntax.python_names import golc_name


class Axioms(Lines):
    """Translates what is said of the time after an action."""

    def heads(self) -> tuple[tree.Ident, ...]:
        """The parameters of an axiom, which have the types of the fluent."""
        for arg in self.function.parameters():
            if arg.annotation is not None:
                message = f"`{arg.arg}` has the type that the fluent gives it"
                error = meaningless(message, self.span(arg.annotation), "leave the annotation out")
                self.pass_over(error, arg.annotation)
        return tuple(new_name(golc_name(arg.arg), self.span(arg)) for arg in self.function.parameters())

    def cases(self) -> tuple[tree.After, ...]:
        """The lines of an axiom."""
        return self.lines(self._case)

    def _case(self, node: ast.stmt) -> Iterator[tree.After]:
        call, _ = self.call(node, "after")
        pattern, value = self.arguments(call, 2, ("when",))
        made, names = self._pattern(pattern)
        with self.scope(names):
            yield tree.After(made, self.value(value), self.when(call), span=self.span(node))

    def is_prune_after(self) -> bool:
        """Whether a prune looks at the last action."""
        match self.function.body():
            case [ast.Expr(value=ast.Call() as call)]:
                return self.call_of(call, words.after) is not None
        return False

    def prune_after(self, name: tree.Ident, span: Span) -> tree.PruneAfter:
        """A prune by the last action."""
        (node,) = self.function.body()
        call, _ = self.call(node, "after")
        (pattern,) = self.arguments(call, 1, ("when",))
        made, names = self._pattern(pattern)
        with self.scope(names):
            return tree.PruneAfter(name, made, self.when(call), span=span)

    def _pattern(self, node: ast.expr) -> tuple[tree.Pattern, list[str]]:
        """An action with constants, parameters and new variables; these as Python names."""
        call = node if isinstance(node, ast.Call) else None
        named = node if call is None else call.func
        action = self.python(named)
        if not isinstance(action, Named):
            raise meaningless("this is no action", self.span(node), "write an action: `after(move(x, y), …)`")
        new: list[str] = []
        args = [self._pattern_arg(arg, new) for arg in (self.every_argument(call) if call else [])]
        ident = tree.Ident(action.name, span=self.span(named))
        return tree.Pattern(ident, tuple(args), span=self.span(node)), new

    def _pattern_arg(self, node: ast.expr, new: list[str]) -> Any:
        span = self.span(node)
        if isinstance(node, ast.Name) and (node.id in self.bound or self._unbound(node)):
            new.append(node.id)
            return tree.Ident(golc_name(node.id), span=span)
        return self.constant(node)

    def _unbound(self, node: ast.Name) -> bool:
        """Whether a name stands for nothing that could be a constant."""
        value = self.function.lookup(node.id)
        if isinstance(value, Named):
            return value.kind not in ("symbol", "const")
        return not (isinstance(value, (bool, int)) or value is None)
