"""What each rule of declarations and programs builds from its parts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from golc.diagnostics import Span
from golc.syntax import expression_rules
from golc.syntax import tree as ast
from golc.syntax.expression_rules import Rule, as_tuple, sequence_of

if TYPE_CHECKING:
    from golc.syntax.build import Builder


def _tuple(value: tuple[Any, ...] | None) -> tuple[Any, ...]:
    return value or ()


def _first(kind: Any, children: list[Any]) -> Any:
    return next((child for child in children if isinstance(child, kind)), None)


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


def _extern(b: Builder, span: Span, children: list[Any]) -> ast.Extern:
    name, parameters, type_, path = children
    b.declare(name)
    return ast.Extern(name, _tuple(parameters), type_, b.plain(path), span=span)


def _params(b: Builder, span: Span, children: list[Any]) -> tuple[ast.Parameter, ...]:
    b.declare_parts(tuple(children))
    return tuple(children)


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


_NESTING = """
block binary not_in unary if_else quantifier apply index extremum epistemic one_of set_of list_of table
set_literal list_literal set_comprehension list_comprehension
"""

NESTING = frozenset(_NESTING.split())
"""The rules that nest: each is a level."""

SIMPLE: dict[str, Any] = {
    **expression_rules.NODES,
    "initially": ast.Initially,
    "poss": ast.Precondition,
    "senses": ast.Senses,
    "cost": ast.Cost,
    "after": ast.After,
    "param": ast.Parameter,
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
}
"""The rules whose parts are the fields of a node, in order."""

RULES: dict[str, Rule] = {
    **expression_rules.RULES,
    "start": _file,
    "header": _header,
    "declaration": _only,
    "import_": _import,
    "const": _named(ast.Const),
    "type_decl": _named(ast.TypeDecl),
    "static": _with_parameters(ast.Static),
    "extern": _extern,
    "fluent": _with_parameters(ast.Fluent),
    "define": _with_parameters(ast.Define),
    "proc": _with_parameters(ast.Proc),
    "invariant": _named(ast.Invariant),
    "goal": _named(ast.Goal),
    "prune": _named(ast.Prune),
    "prune_after": _named(ast.PruneAfter),
    "params": _params,
    "action": _action,
    "exog": _exog,
    "expected": _word("expected"),
    "sources": as_tuple,
    "causes": _causes,
    "for_all": as_tuple,
    "axiom": _axiom,
    "names": as_tuple,
    "otherwise": _word("otherwise"),
    "pattern": _pattern,
    "scenario": _scenario,
    "event_after": _event("after"),
    "event_when": _event("when"),
    "event_waiting": _event("waiting"),
    "events": as_tuple,
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
    "elif_": as_tuple,
    "choose": sequence_of(ast.Choose),
    "together": sequence_of(ast.Together),
    "prefer": sequence_of(ast.Prefer),
    "interrupts": sequence_of(ast.Interrupts),
    "on": _on,
    "search": _search,
    "first": _word("first"),
    "shortest": _word("shortest"),
    "cheapest": _word("cheapest"),
    "at_most": _tagged("at most"),
    "time_limit": _tagged("within"),
    "say": _said(ast.Say),
    "abort": _said(ast.Abort),
}
"""The other rules."""
