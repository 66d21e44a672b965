"""What each rule of the grammar builds from its parts."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from typing import TYPE_CHECKING, Any, TypeAlias

from lark import Token

from golc.diagnostics import Span
from golc.syntax import tree as ast

if TYPE_CHECKING:
    from golc.syntax.build import Builder

Rule: TypeAlias = Callable[["Builder", Span, list[Any]], Any]


def _tuple(value: tuple[Any, ...] | None) -> tuple[Any, ...]:
    return value or ()


def _first(kind: Any, children: list[Any]) -> Any:
    return next((child for child in children if isinstance(child, kind)), None)


def _all(b: Builder, span: Span, children: list[Any]) -> tuple[Any, ...]:
    return tuple(children)


def _file(b: Builder, span: Span, children: list[Any]) -> ast.File:
    return ast.File(children[0], tuple(children[1:]), span=span)


def _header(b: Builder, span: Span, children: list[Any]) -> ast.Ident:
    b.declare(children[0])
    name: ast.Ident = children[0]
    return name


def _only(b: Builder, span: Span, children: list[Any]) -> Any:
    return children[0]


def _import(b: Builder, span: Span, children: list[Any]) -> ast.Import:
    return ast.Import(b.plain(children[0]), span=span)


def _named(kind: Any) -> Rule:
    """A declaration of a name and one more part."""

    def build(b: Builder, span: Span, children: list[Any]) -> Any:
        b.declare(children[0])
        return kind(*children, span=span)

    return build


def _with_parameters(kind: Any) -> Rule:
    """A declaration of a name with parameters and further parts."""

    def build(b: Builder, span: Span, children: list[Any]) -> Any:
        name, parameters, *rest = children
        b.declare(name)
        return kind(name, _tuple(parameters), *rest, span=span)

    return build


def _params(b: Builder, span: Span, children: list[Any]) -> tuple[ast.Parameter, ...]:
    b.declare_parts(tuple(children))
    return tuple(children)


def _binders(b: Builder, span: Span, children: list[Any]) -> tuple[ast.Binder, ...]:
    b.declare_parts(tuple(children))
    return tuple(children)


def _binding_in(b: Builder, span: Span, children: list[Any]) -> ast.Binder:
    return ast.Binder(children[0], collection=children[1], span=span)


def _binding_range(b: Builder, span: Span, children: list[Any]) -> ast.Binder:
    """``x in 1..6`` says what ``x: 1..6`` says."""
    name, low, high = children
    return ast.Binder(name, ast.IntervalType(low, high, span=low.span.to(span)), span=span)


def _union(b: Builder, span: Span, children: list[Any]) -> ast.UnionType:
    return ast.UnionType(tuple(child for child in children if not isinstance(child, Token)), span=span)


def _collection_type(kind: Any) -> Rule:
    return lambda b, span, children: ast.CollectionType(kind, children[0], span=span)


def _enum(b: Builder, span: Span, children: list[Any]) -> ast.EnumType:
    b.declare(*(child for child in children if isinstance(child, ast.Ident)))
    return ast.EnumType(tuple(children), span=span)


def _integer(b: Builder, span: Span, children: list[Any]) -> ast.Number:
    minus, digits = children
    value = b.integer(digits)
    return ast.Number(-value if minus else value, span=span)


def _action(b: Builder, span: Span, children: list[Any]) -> ast.Action:
    name, parameters, *clauses = children
    b.declare(name)
    return ast.Action(name, _tuple(parameters), tuple(clauses), span=span)


def _exog(b: Builder, span: Span, children: list[Any]) -> ast.Exog:
    name, parameters, *rest = children
    b.declare(name)
    clauses: Any = tuple(part for part in rest if isinstance(part, ast.Node))
    sources = _first(tuple, rest)
    return ast.Exog(name, _tuple(parameters), "expected" in rest, _tuple(sources), clauses, span=span)


def _causes(b: Builder, span: Span, children: list[Any]) -> ast.Effect:
    for_all, target, value, condition = children
    binders, where = for_all or ((), None)
    return ast.Effect(binders, where, target, value, condition, span=span)


def _axiom(b: Builder, span: Span, children: list[Any]) -> ast.Axiom:
    fluent, parameters, *cases, _otherwise = children
    b.declare(*_tuple(parameters))
    return ast.Axiom(fluent, _tuple(parameters), tuple(cases), span=span)


def _pattern(b: Builder, span: Span, children: list[Any]) -> ast.Pattern:
    action, *args = children
    return ast.Pattern(action, tuple(arg for arg in args if arg is not None), span=span)


def _scenario(b: Builder, span: Span, children: list[Any]) -> ast.Scenario:
    name, *items = children
    b.declare(name)
    return ast.Scenario(name, tuple(items), span=span)


def _event(trigger: Any) -> Rule:
    def build(b: Builder, span: Span, children: list[Any]) -> ast.OnEvents:
        events, *argument = children
        return ast.OnEvents(events, trigger, argument[0] if argument else None, span=span)

    return build


def _expect_count(relation: Any) -> Rule:
    return lambda b, span, children: ast.ExpectCount(children[0], relation, children[1], span=span)


def _expect_actions(b: Builder, span: Span, children: list[Any]) -> ast.ExpectActions:
    return ast.ExpectActions(_tuple(children[0]), span=span)


def _device(b: Builder, span: Span, children: list[Any]) -> ast.Device:
    kind, name, file, *items = children
    return ast.Device(kind, name, None if file is None else b.plain(file), tuple(items), span=span)


def _bind(b: Builder, span: Span, children: list[Any]) -> ast.Binding:
    numbered, action, args, behaviour, *rest = children
    number, ranged = numbered or (None, False)
    table = _first(ast.Table, rest)
    timeout = next((part for part in rest if part is not table), None)
    return ast.Binding(action, args, number, ranged, behaviour, table, timeout, span=span)


def _bind_args(b: Builder, span: Span, children: list[Any]) -> tuple[Any, ...]:
    b.declare(*(child.name for child in children if isinstance(child, ast.Parameter)))
    return tuple(children)


def _by_prompt(b: Builder, span: Span, children: list[Any]) -> ast.ByPrompt:
    return ast.ByPrompt(b.message(children[0]), span=span)


def _setting(seconds: bool) -> Rule:
    return lambda b, span, children: ast.Setting(children[0], children[1], seconds, span=span)


def _block(b: Builder, span: Span, children: list[Any]) -> ast.Block:
    return ast.Block(tuple(children), span=children[0].span.to(children[-1].span))


def _call(b: Builder, span: Span, children: list[Any]) -> ast.Call:
    return ast.Call(children[0], span=span)


def _if(b: Builder, span: Span, children: list[Any]) -> ast.If:
    condition, body, *branches, otherwise = children
    return ast.If(((condition, body), *branches), otherwise, span=span)


def _branches(kind: Any) -> Rule:
    return lambda b, span, children: kind(tuple(children), span=span)


def _on(b: Builder, span: Span, children: list[Any]) -> ast.On:
    return ast.On((), *children, span=span)


def _search(b: Builder, span: Span, children: list[Any]) -> ast.Search:
    mode, *limits, body = children
    given = dict(limits)
    return ast.Search(mode, given.get("at most"), given.get("within"), body, span=span)


def _tagged(tag: str) -> Rule:
    return lambda b, span, children: (tag, children[0])


def _word(word: str) -> Rule:
    return lambda b, span, children: word


def _said(kind: Any) -> Rule:
    return lambda b, span, children: kind(b.message(children[0]), span=span)


def _number(b: Builder, span: Span, children: list[Any]) -> ast.Number:
    return ast.Number(b.integer(children[0]), span=span)


def _real(b: Builder, span: Span, children: list[Any]) -> ast.Real:
    return ast.Real(Decimal(children[0]), span=span)


def _truth(value: bool) -> Rule:
    return lambda b, span, children: ast.Truth(value, span=span)


def _apply(b: Builder, span: Span, children: list[Any]) -> ast.Apply:
    return ast.Apply(children[0], tuple(children[1:]), span=span)


def _infix(b: Builder, span: Span, children: list[Any]) -> ast.Binary:
    left, *words, right = children
    operator: Any = " ".join(words)
    return ast.Binary(operator, left, right, span=span)


def _worded(kind: Any) -> Rule:
    """A word or sign that tells which of several functions it is, and arguments."""
    return lambda b, span, children: kind(str(children[0]), *children[1:], span=span)


def _extremum(b: Builder, span: Span, children: list[Any]) -> ast.Extremum:
    kind: Any = str(children[0])
    return ast.Extremum(kind, tuple(children[1:]), span=span)


def _comprehension(kind: Any) -> Rule:
    return lambda b, span, children: ast.Comprehension(kind, *children, span=span)


def _entry(b: Builder, span: Span, children: list[Any]) -> ast.TableEntry:
    key, value = children
    return ast.TableEntry(key if isinstance(key, tuple) else (key,), value, span=span)


_NESTING = """
block binary not_in unary if_else quantifier apply index extremum epistemic one_of set_of list_of table
set_literal list_literal set_comprehension list_comprehension
"""

NESTING = frozenset(_NESTING.split())
"""The rules that nest: each is a level."""

SIMPLE: dict[str, Any] = {
    "initially": ast.Initially,
    "poss": ast.Precondition,
    "senses": ast.Senses,
    "cost": ast.Cost,
    "after": ast.After,
    "param": ast.Parameter,
    "binding_of": ast.Binder,
    "interval": ast.IntervalType,
    "type_name": ast.TypeName,
    "optional": ast.OptionalType,
    "one_of": ast.OneOf,
    "unknown": ast.Unknown,
    "given": ast.Given,
    "run": ast.Run,
    "until": ast.Until,
    "expect_formula": ast.ExpectFormula,
    "by_call": ast.ByCall,
    "by_start": ast.ByStart,
    "test": ast.Test,
    "skip": ast.Skip,
    "while_": ast.While,
    "pick": ast.Pick,
    "star": ast.Star,
    "for_": ast.For,
    "together_star": ast.TogetherStar,
    "on_some": ast.On,
    "guard": ast.Guard,
    "wait": ast.Wait,
    "wait_until": ast.WaitUntil,
    "wait_time": ast.WaitTime,
    "within": ast.Within,
    "none": ast.Nothing,
    "name": ast.Apply,
    "index": ast.Index,
    "if_else": ast.IfElse,
}
"""The rules whose parts are the fields of a node, in order."""

RULES: dict[str, Rule] = {
    "start": _file,
    "header": _header,
    "declaration": _only,
    "import_": _import,
    "const": _named(ast.Const),
    "type_decl": _named(ast.TypeDecl),
    "static": _with_parameters(ast.Static),
    "fluent": _with_parameters(ast.Fluent),
    "define": _with_parameters(ast.Define),
    "proc": _with_parameters(ast.Proc),
    "invariant": _named(ast.Invariant),
    "goal": _named(ast.Goal),
    "prune": _named(ast.Prune),
    "prune_after": _named(ast.PruneAfter),
    "params": _params,
    "binders": _binders,
    "binding_in": _binding_in,
    "binding_range": _binding_range,
    "set_of": _collection_type("set"),
    "list_of": _collection_type("list"),
    "union": _union,
    "enum": _enum,
    "integer": _integer,
    "true": _truth(True),
    "false": _truth(False),
    "action": _action,
    "exog": _exog,
    "expected": _word("expected"),
    "sources": _all,
    "causes": _causes,
    "for_all": _all,
    "axiom": _axiom,
    "names": _all,
    "otherwise": _word("otherwise"),
    "pattern": _pattern,
    "scenario": _scenario,
    "event_after": _event("after"),
    "event_when": _event("when"),
    "event_waiting": _event("waiting"),
    "events": _all,
    "expect_at_least": _expect_count("at least"),
    "expect_at_most": _expect_count("at most"),
    "expect_exactly": _expect_count("exactly"),
    "expect_actions": _expect_actions,
    "device": _device,
    "bind": _bind,
    "one_number": lambda b, span, children: (b.integer(children[0]), False),
    "first_number": lambda b, span, children: (b.integer(children[0]), True),
    "bind_args": _bind_args,
    "by_prompt": _by_prompt,
    "timeout": _only,
    "setting": _setting(False),
    "setting_seconds": _setting(True),
    "block": _block,
    "call": _call,
    "if_": _if,
    "let": _named(ast.Let),
    "elif_": _all,
    "choose": _branches(ast.Choose),
    "together": _branches(ast.Together),
    "prefer": _branches(ast.Prefer),
    "interrupts": _branches(ast.Interrupts),
    "on": _on,
    "search": _search,
    "first": _word("first"),
    "shortest": _word("shortest"),
    "cheapest": _word("cheapest"),
    "at_most": _tagged("at most"),
    "time_limit": _tagged("within"),
    "say": _said(ast.Say),
    "abort": _said(ast.Abort),
    "number": _number,
    "real": _real,
    "message": lambda b, span, children: b.message(children[0]),
    "apply": _apply,
    "binary": _infix,
    "not_in": _infix,
    "unary": _worded(ast.Unary),
    "quantifier": _worded(ast.Quantifier),
    "extremum": _extremum,
    "epistemic": _worded(ast.Epistemic),
    "set_literal": _branches(ast.SetLiteral),
    "list_literal": _branches(ast.ListLiteral),
    "set_comprehension": _comprehension("set"),
    "list_comprehension": _comprehension("list"),
    "table": _branches(ast.Table),
    "entry": _entry,
    "key": _all,
}
"""The other rules."""
