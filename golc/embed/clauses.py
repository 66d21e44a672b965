"""The bodies of actions, axioms, prunes, scenarios and devices."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from typing import Any

from golc.diagnostics import Code, Span
from golc.embed import words
from golc.embed.bodies import Bodies
from golc.embed.errors import meaningless, refused
from golc.embed.evaluate import NOT_PYTHON
from golc.embed.names import golc_name, new_name, python_name
from golc.embed.terms import Named, Term, expr
from golc.syntax import tree

_CHANGE = "write `causes(fluent, value)`"
IN_ACTIONS: Mapping[type[ast.stmt], str] = {
    ast.Assign: _CHANGE,
    ast.AnnAssign: _CHANGE,
    ast.AugAssign: _CHANGE,
    ast.If: "write `causes(fluent, value, when=φ)`",
    ast.Assert: "write `poss(φ)`",
    ast.While: "write `for n in station:` with `causes(…)` in it",
    ast.Return: "write `senses(…)` for what a device answers",
}
"""What was probably meant in the body of an action."""


class Clauses(Bodies):
    """Translates the lines of a declaration's body, each a call of a word."""

    def call(self, node: ast.stmt, allowed: str) -> tuple[ast.Call, words.Word]:
        """The call that a statement is, and its word. Raises ``Refused``; ``allowed`` is for the help."""
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
            called = self.python(node.value.func)
            if isinstance(called, words.Word) and called.name in allowed.split():
                return node.value, called
        help_ = "write " + ", ".join(f"`{name}(…)`" for name in allowed.split())
        if "causes" in allowed.split():
            help_ = IN_ACTIONS.get(type(node), help_)
        raise meaningless("this line has no meaning here", self._head(node), help_)

    # Actions

    def clauses(self) -> tuple[tree.Clause, ...]:
        """The lines of an action."""
        return self.each([node for node in self.function.body() if not isinstance(node, ast.Pass)], self._clause)

    def _clause(self, node: ast.stmt) -> Iterator[tree.Clause]:
        if isinstance(node, ast.For):
            yield from self._for_all(node)
            return
        call, word = self.call(node, "poss causes senses cost")
        span = self.span(node)
        if word is words.causes:
            yield self._effect(call, (), None, span)
        else:
            (value,) = self.arguments(call, 1)
            made: Any = {"poss": tree.Precondition, "senses": tree.Senses, "cost": tree.Cost}[word.name]
            yield made(self.expr(value), span=span)

    def _for_all(self, node: ast.For) -> Iterator[tree.Clause]:
        """``for x in t: causes(…)``: an effect for every value; a loop of Python is written out."""
        word = self.call_of(node.iter, words.each)
        if word is None and not self.is_type(node.iter):
            value = self.python(node.iter)
            if value is not NOT_PYTHON and not isinstance(value, Term):
                yield from self.unrolled(node, self._clause)
                return
        self.no_else(node)
        where = None
        if word is None:
            binders = self.binders(node.target, [node.iter])
        else:
            assert isinstance(node.iter, ast.Call)
            binders = self.binders(node.target, self.arguments(node.iter, len(node.iter.args), ("where",)))
            where = self.keyword(node.iter, "where")
        names = [each.id for each in ast.walk(node.target) if isinstance(each, ast.Name)]
        with self.scope(names):
            condition = None if where is None else self.expr(where)
            for part in node.body:
                call, _ = self.call(part, "causes")
                yield self._effect(call, binders, condition, self.span(node))

    def _effect(
        self, call: ast.Call, binders: tuple[tree.Binder, ...], where: tree.Expr | None, span: Span
    ) -> tree.Effect:
        target, value = self.arguments(call, 2, ("when",))
        return tree.Effect(binders, where, self.application(target), self.value(value), self._when(call), span=span)

    def _when(self, call: ast.Call) -> tree.Expr | None:
        when = self.keyword(call, "when")
        return None if when is None else self.expr(when)

    # Axioms and prunes

    def heads(self) -> tuple[tree.Ident, ...]:
        """The parameters of an axiom, which have the types of the fluent."""
        for arg in self.function.parameters():
            if arg.annotation is not None:
                message = f"`{arg.arg}` has the type that the fluent gives it"
                raise meaningless(message, self.span(arg.annotation), "leave the annotation out")
        return tuple(new_name(golc_name(arg.arg), self.span(arg)) for arg in self.function.parameters())

    def cases(self) -> tuple[tree.After, ...]:
        """The lines of an axiom."""
        return self.each([node for node in self.function.body() if not isinstance(node, ast.Pass)], self._case)

    def _case(self, node: ast.stmt) -> Iterator[tree.After]:
        call, _ = self.call(node, "after")
        pattern, value = self.arguments(call, 2, ("when",))
        made, names = self._pattern(pattern)
        with self.scope(names):
            yield tree.After(made, self.value(value), self._when(call), span=self.span(node))

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
            return tree.PruneAfter(name, made, self._when(call), span=span)

    def _pattern(self, node: ast.expr) -> tuple[tree.Pattern, list[str]]:
        """An action with constants, parameters and new variables; these as Python names."""
        call = node if isinstance(node, ast.Call) else None
        named = node if call is None else call.func
        action = self.python(named)
        if not isinstance(action, Named):
            raise meaningless("this is no action", self.span(node), "write an action: `after(move(x, y), …)`")
        new: list[str] = []
        args = [self._pattern_arg(arg, new) for arg in (self.arguments(call, len(call.args)) if call else [])]
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

    def constant(self, node: ast.expr) -> Any:
        """A constant argument: an integer, a truth value, ``None``, a symbol."""
        match self.value(node):
            case tree.Number() | tree.Truth() | tree.Nothing() as constant:
                return constant
            case tree.Unary(op="-", operand=tree.Number(value=value)):
                return tree.Number(-value, span=self.span(node))
            case tree.Apply(name=name, args=()):
                return name
        raise meaningless(
            "this is no constant", self.span(node), "write a symbol, an integer, `True`, `False` or `None`"
        )

    # Scenarios

    def items(self) -> tuple[tree.ScenarioItem, ...]:
        """The lines of a scenario."""
        return self.each([node for node in self.function.body() if not isinstance(node, ast.Pass)], self._item)

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
        events = tuple(
            self.application(arg) for arg in self.arguments(call, len(call.args), ("after", "when", "waiting"))
        )
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
            return tree.ExpectActions(tuple(self.application(each) for each in actions.elts), span=span)
        (argument,) = self.arguments(call, 1, (*relations, "actions"))
        if not call.keywords:
            return tree.ExpectFormula(self.expr(argument), span=span)
        if len(call.keywords) > 1:
            raise meaningless("one relation an `expect`", self.span(call.keywords[1]), "write a second `expect`")
        (keyword,) = call.keywords
        relation = relations[keyword.arg or ""]
        return tree.ExpectCount(self.application(argument), relation, self.expr(keyword.value), span=span)

    # Devices

    def settings(self) -> tuple[tree.Binding | tree.Setting, ...]:
        """The lines of a device."""
        return self.each([node for node in self.function.body() if not isinstance(node, ast.Pass)], self._setting)

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
        action = self.python(bound.func if isinstance(bound, ast.Call) else bound)
        if not isinstance(action, Named):
            raise meaningless("this is no action", self.span(bound), "write an action: `bind(turn_around, number=0)`")
        ident = tree.Ident(action.name, span=self.span(bound.func if isinstance(bound, ast.Call) else bound))
        args = None
        if isinstance(bound, ast.Call) and bound.args:
            args = tuple(self._bound_arg(arg) for arg in self.arguments(bound, len(bound.args)))
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

    # Tables

    def table(self, node: ast.expr) -> tree.Table:
        """A dictionary as a table; a key of several arguments is a tuple."""
        if isinstance(node, ast.Dict):
            entries = []
            for key, value in zip(node.keys, node.values, strict=True):
                if key is None:
                    raise meaningless(
                        "`**` spreads no table", self.span(value), "make the dictionary outside the function"
                    )
                parts = key.elts if isinstance(key, ast.Tuple) else [key]
                made = tuple(self.expr(part) for part in parts)
                span = self.span(key).to(self.span(value))
                entries.append(tree.TableEntry(made, self.expr(value), span=span))
            return tree.Table(tuple(entries), span=self.span(node))
        found = self.python(node)
        if not isinstance(found, dict):
            raise meaningless("this is no table", self.span(node), "write a dictionary: `{hall: kitchen}`")
        return table_of(found, self.span(node))

    def is_table(self, node: ast.expr) -> bool:
        """Whether a static returns a table."""
        return isinstance(node, ast.Dict) or isinstance(self.python(node), dict)


def table_of(value: dict[Any, Any], span: Span) -> tree.Table:
    """A dictionary of Python as a table."""
    entries = []
    for key, each in value.items():
        parts = key if isinstance(key, tuple) else (key,)
        entries.append(tree.TableEntry(tuple(expr(part, span) for part in parts), expr(each, span), span=span))
    return tree.Table(tuple(entries), span=span)
