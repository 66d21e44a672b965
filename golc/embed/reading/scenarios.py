"""The bodies of scenarios."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from typing import Any

from golc.diagnostics import Span
from golc.embed import words
from golc.embed.errors import meaningless
from golc.embed.reading.lines import Lines
from golc.syntax import tree


class Scenarios(Lines):
    """Translates the body of a scenario."""

    def items(self) -> tuple[tree.ScenarioItem, ...]:
        """The lines of a scenario; one that was passed over may have said what it runs."""
        items = self.lines(self._item)
        span = next((span for span in self.unread if re.search(r"\brun\b", span.text)), None)
        if span is None:
            return items
        return *items, tree.Run(tree.Apply(tree.Ident(tree.STAND_IN, span=span), (), span=span), span=span)

    def _item(self, node: ast.stmt) -> Iterator[tree.ScenarioItem]:
        if isinstance(node, ast.For):
            yield from self.unrolled(node, self._item)
            return
        call, word = self.call(node, "given run on until expect")
        span = self.span(node)
        if word is words.on:
            yield self._events(call, span)
        elif word is words.expect:
            yield self._expect(call, span)
        else:
            (argument,) = self.arguments(call, 1)
            if word is words.run:
                yield tree.Run(self.application(argument), span=span)
            else:
                made: Any = tree.Given if word is words.given else tree.Until
                yield made(self.expr(argument), span=span)

    def _events(self, call: ast.Call, span: Span) -> tree.OnEvents:
        events = tuple(self.application(arg) for arg in self.every_argument(call, ("after", "when", "waiting")))
        if not events or len(call.keywords) != 1:
            help_ = "write `on(event(), after=n)`, `on(event(), when=φ)` or `on(event(), waiting=True)`"
            raise meaningless("`on` needs events and a time", span, help_)
        (keyword,) = call.keywords
        if keyword.arg == "waiting":
            if not (isinstance(keyword.value, ast.Constant) and keyword.value.value is True):
                raise meaningless("`waiting` is `True` or left out", self.span(keyword.value))
            return tree.OnEvents(events, "waiting", None, span=span)
        trigger: Any = keyword.arg
        return tree.OnEvents(events, trigger, self.expr(keyword.value), span=span)

    def _expect(self, call: ast.Call, span: Span) -> tree.ScenarioItem:
        relations: dict[str, Any] = {"at_least": "at least", "at_most": "at most", "exactly": "exactly"}
        actions = self.keyword(call, "actions")
        if actions is not None:
            self.arguments(call, 0, ("actions",))
            if not isinstance(actions, (ast.List, ast.Tuple)):
                raise meaningless("`actions` is a list", self.span(actions), "write `expect(actions=[a(), b(1)])`")
            return tree.ExpectActions(tuple(self.application(each) for each in self.spread(actions.elts)), span=span)
        (argument,) = self.arguments(call, 1, (*relations, "actions"))
        if not call.keywords:
            return tree.ExpectFormula(self.expr(argument), span=span)
        if len(call.keywords) > 1:
            raise meaningless("one relation an `expect`", self.span(call.keywords[1]), "write a second `expect`")
        (keyword,) = call.keywords
        relation = relations[keyword.arg or ""]
        return tree.ExpectCount(self.application(argument), relation, self.expr(keyword.value), span=span)
