"""The words of the language as names of Python: most mean something only in translated functions."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from golc.diagnostics import Code, Span, counted
from golc.embed.errors import meaningless, refused
from golc.embed.places import caller
from golc.embed.terms import Compound, Named, Term, binary, function, plain_names, variable
from golc.embed.types import type_node
from golc.embed.values import expr
from golc.syntax import tree
from golc.syntax.python_names import golc_name
from golc.syntax.walk import descendants


class Word:
    """A word that a translated function is made of. Called anywhere else it says where it belongs."""

    __slots__ = ("name", "place")

    def __init__(self, name: str, place: str) -> None:
        self.name = name
        self.place = place

    def __repr__(self) -> str:
        return f"golc.embed.{self.name}"

    def __call__(self, *args: Any, **named: Any) -> Any:
        self._misplaced()

    def __enter__(self) -> Any:
        self._misplaced()

    def __exit__(self, *args: object) -> None:
        self._misplaced()

    def __iter__(self) -> Any:
        self._misplaced()

    def _misplaced(self) -> NoReturn:
        raise meaningless(f"`{self.name}` is not run by Python", caller(), f"it belongs in {self.place}")


class Operator(Word):
    """A word that also builds a term where Python runs it."""

    __slots__ = ("build",)

    def __init__(self, name: str, build: Callable[..., Term]) -> None:
        super().__init__(name, "a term")
        self.build = build

    def __call__(self, *args: Any, **named: Any) -> Term:
        try:
            inspect.signature(self.build).bind(*args, **named)
        except TypeError as error:
            raise refused(Code.ARITY, f"`{self.name}` has wrong arguments: {error}", caller()) from None
        return self.build(*args, **named)


def _words(place: str, names: str) -> list[Word]:
    return [Word(name, place) for name in names.split()]


_PROGRAM = "the program of a procedure: `@theory.proc`"
_ACTION = "the body of an action: `@theory.action` or `@theory.exog`"
_SCENARIO = "a scenario: `@theory.scenario`"
_DEVICE = "a device: `@theory.device(…)`"

causes, senses, cost = _words(_ACTION, "causes senses cost")
after = Word("after", "an axiom or a prune: `@theory.axiom(…)`, `@theory.prune`")
each = Word("each", "a `for` in a program or an action")
values = Word("values", "a `for`, `any`, `all` … in a translated function")
test, choose, branch, star, together, together_star, prefer, interrupts, guard = _words(
    _PROGRAM, "test choose branch star together together_star prefer interrupts guard"
)
search, wait, within, otherwise, say, abort, let, pick = _words(
    _PROGRAM, "search wait within otherwise say abort let pick"
)
on = Word("on", "`with interrupts():` of a program, or a scenario")
given, run, until, expect = _words(_SCENARIO, "given run until expect")
bind, setting, var = _words(_DEVICE, "bind setting var")


def _implies(premise: object, conclusion: object) -> Term:
    return binary("implies", premise, conclusion)


def _iff(left: object, right: object) -> Term:
    return binary("iff", left, right)


def _function(name: str) -> Operator:
    def build(argument: object) -> Term:
        return function(name, (argument,))

    return Operator(name, build)


def _epistemic(kind: Any) -> Operator:
    def build(body: object) -> Term:
        span = caller()
        return Compound(tree.Epistemic(kind, expr(body, span), span=span))

    return Operator(kind, build)


implies, iff = Operator("implies", _implies), Operator("iff", _iff)
poss, before, first, rest = _function("poss"), _function("before"), _function("first"), _function("rest")
known, knows, possible = _epistemic("known"), _epistemic("knows"), _epistemic("possible")


def _quantifier(kind: Any) -> Operator:
    def build(*parts: Any, where: Callable[..., object] | None = None) -> Term:
        span = caller()
        if len(parts) < 2 or not inspect.isfunction(parts[-1]):
            help_ = f"write `{kind}(station, lambda n: …)`"
            raise meaningless(f"`{kind}` takes types and a function of as many variables", span, help_)
        *ranges, body = parts
        variables = bound(body, len(ranges), span)
        binders = tuple(binder(each, over, span) for each, over in zip(variables, ranges, strict=True))

        def of(function: Callable[..., object]) -> tree.Expr:
            return of_variables(expr(function(*variables), span), variables, span)

        return Compound(tree.Quantifier(kind, binders, None if where is None else of(where), of(body), span=span))

    return Operator(kind, build)


def bound(body: Callable[..., object], count: int, span: Span, names: Sequence[str] | None = None) -> list[Named]:
    """The variables for which a function is called: of the given names, or named as its own parameters."""
    own = list(inspect.signature(body).parameters)
    if len(own) != count:
        raise refused(
            Code.ARITY, f"the function has {counted(len(own), 'variable')} for {counted(count, 'type')}", span
        )
    return [variable(name, span) for name in (names or [golc_name(name) for name in own])]


def of_variables(node: tree.Expr, variables: Sequence[Named], span: Span) -> tree.Expr:
    """The same term. Raises ``Refused`` if something else in it would be taken for one of the variables around it."""
    inside = [
        binder.name.text for each in descendants(node) if isinstance(each, tree.Quantifier) for binder in each.binders
    ]
    own = [*inside, *(each.name for each in variables)]
    for name in plain_names(node):
        if name in own and not any(name is each for each in own):
            message = f"another `{name}` cannot be meant where a variable has this name"
            raise meaningless(message, span, "give the variable of the `lambda` another name")
    return node


def binder(variable: Named, over: object, span: Span) -> tree.Binder:
    """A variable that ranges over a type, or over the elements of a term."""
    name = tree.Ident(variable.name, span=span)
    if isinstance(over, Term):
        return tree.Binder(name, collection=over.node, span=span)
    return tree.Binder(name, type_node(over, span), span=span)


exists, forall, count = _quantifier("exists"), _quantifier("forall"), _quantifier("count")


class Value:
    """What stands for a value that is not settled."""

    __slots__ = ("node",)

    def __init__(self, node: tree.Unknown | tree.OneOf) -> None:
        self.node = node


unknown = Value(tree.Unknown())


class _OneOf(Word):
    def __call__(self, *args: Any, **named: Any) -> Value:
        span = caller()
        if len(args) != 1 or named:
            raise refused(Code.ARITY, "`one_of` takes one list or set of values", span, "write `one_of([1, 2])`")
        return Value(tree.OneOf(expr(args[0], span), span=span))


one_of = _OneOf("one_of", "a value of a fluent")


def value_expr(value: object, span: Span) -> tree.ValueExpr:
    """The tree of a value of a fluent: a term, ``unknown`` or ``one_of(…)``."""
    if isinstance(value, Value):
        return tree.Unknown(span=span) if isinstance(value.node, tree.Unknown) else value.node
    return expr(value, span)
