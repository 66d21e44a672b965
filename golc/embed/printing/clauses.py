"""The bodies of actions, axioms, scenarios and devices."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby

from golc.embed.printing.functions import called, loop, word_call
from golc.embed.printing.layout import INDENT, Brackets, Doc, Joined
from golc.embed.printing.names import Names
from golc.embed.printing.strings import quoted
from golc.embed.printing.terms import (
    call_doc,
    keyword,
    maybe,
    optional,
    program_doc,
    term_doc,
    term_docs,
    type_doc,
)
from golc.syntax import tree as ast
from golc.syntax.python_names import python_name


def action_body(names: Names, clauses: Iterable[ast.Clause]) -> Iterator[str]:
    """The clauses of an action; effects of one kind of variables share a loop."""
    for (binders, where), group in groupby(clauses, _variables):
        if binders:
            body = (line for clause in group for line in _clause(names, clause, 2 * INDENT))
            yield from loop(names, "each", binders, where, INDENT, body)
        else:
            for clause in group:
                yield from _clause(names, clause, INDENT)


def _variables(clause: ast.Clause) -> tuple[tuple[ast.Binder, ...], ast.Expr | None]:
    return (clause.binders, clause.where) if isinstance(clause, ast.Effect) else ((), None)


def _clause(names: Names, clause: ast.Clause, indent: int) -> list[str]:
    match clause:
        case ast.Precondition(condition=condition):
            return word_call(names, "poss", condition, indent)
        case ast.Senses(value=value):
            return word_call(names, "senses", value, indent)
        case ast.Cost(value=value):
            return word_call(names, "cost", value, indent)
        case ast.Effect(target=target, value=changed, condition=when):
            change = (term_doc(names, target), term_doc(names, changed), *optional("when", maybe(names, when)))
            return called(names.word("causes"), *change, indent=indent)


def axiom_body(names: Names, axiom: ast.Axiom) -> Iterator[str]:
    """The lines ``after …`` of an axiom."""
    with names.bound(parameter.text for parameter in axiom.parameters):
        for case in axiom.cases:
            yield from after(names, case.pattern, case.value, case.condition)


def after(names: Names, pattern: ast.Pattern, value: ast.ValueExpr | None, condition: ast.Expr | None) -> list[str]:
    """``after(a(x, 3), v, when=φ)``; what the pattern binds is known in the rest."""
    action = call_doc(names.program(pattern.action.text), *(_argument(names, arg) for arg in pattern.args))
    fresh = [arg.text for arg in pattern.args if isinstance(arg, ast.Ident) and arg.text not in names.symbols]
    with names.bound(fresh):
        values = () if value is None else (term_doc(names, value),)
        return called(names.word("after"), action, *values, *optional("when", maybe(names, condition)))


def _argument(names: Names, arg: ast.Ident | ast.Number | ast.Truth | ast.Nothing) -> Doc:
    """A constant, or a variable of the head or of the pattern."""
    match arg:
        case ast.Ident(text=text) if text in names.symbols and not names.is_local(text):
            return names.symbols[text]
        case ast.Ident(text=text):
            return python_name(text)
        case _:
            return term_doc(names, arg)


def scenario_body(names: Names, items: Iterable[ast.ScenarioItem]) -> Iterator[str]:
    """The lines of a scenario."""
    for item in items:
        yield from _scenario_item(names, item)


def _scenario_item(names: Names, item: ast.ScenarioItem) -> list[str]:
    match item:
        case ast.Given(condition=condition):
            return word_call(names, "given", condition)
        case ast.Run(program=program):
            return called(names.word("run"), program_doc(names, program))
        case ast.OnEvents(events=events, trigger=trigger, argument=argument):
            moment = keyword(trigger, "True" if argument is None else term_doc(names, argument))
            return called(names.word("on"), *(program_doc(names, event) for event in events), moment)
        case ast.Until(condition=condition):
            return word_call(names, "until", condition)
        case ast.ExpectCount(action=action, relation=relation, count=count):
            number = keyword(relation.replace(" ", "_"), term_doc(names, count))
            return called(names.word("expect"), program_doc(names, action), number)
        case ast.ExpectActions(actions=actions):
            listed = Brackets("[", tuple(program_doc(names, action) for action in actions), "]", packed=False)
            return called(names.word("expect"), keyword("actions", listed))
        case ast.ExpectFormula(condition=condition):
            return word_call(names, "expect", condition)


def device_body(names: Names, items: Iterable[ast.Binding | ast.Setting]) -> Iterator[str]:
    """The bindings and settings of a device."""
    for item in items:
        match item:
            case ast.Setting(name=name, value=value, seconds=seconds):
                doc = term_doc(names, value)
                yield from called(names.word("setting"), quoted(name.text), keyword("seconds", doc) if seconds else doc)
            case ast.Binding():
                yield from called(names.word("bind"), _bound_action(names, item), *_binding(names, item))


def _bound_action(names: Names, binding: ast.Binding) -> Doc:
    action = names.program(binding.action.text)
    return action if binding.args is None else call_doc(action, *(_fixed(names, arg) for arg in binding.args))


def _fixed(names: Names, arg: ast.Parameter | ast.Ident | ast.Number | ast.Truth | ast.Nothing) -> Doc:
    match arg:
        case ast.Parameter(name=name, type=type_):
            return call_doc(names.word("var"), quoted(name.text), type_doc(names, type_))
        case ast.Ident(text=text):
            return names.term(text)
        case _:
            return term_doc(names, arg)


def _binding(names: Names, binding: ast.Binding) -> Iterator[Doc]:
    if binding.number is not None:
        yield keyword("first" if binding.ranged else "number", str(binding.number))
    match binding.behaviour:
        case ast.ByCall(function=function):
            yield keyword("call", quoted(function.text))
        case ast.ByStart(task=task):
            yield keyword("start", quoted(task.text))
        case ast.ByPrompt(message=message):
            with names.bound(_variables_of(names, binding)):
                yield keyword("prompt", term_doc(names, message))
    yield from optional("timeout", maybe(names, binding.timeout))
    if binding.table is not None:
        yield keyword("table", table_doc(names, binding.table))


def _variables_of(names: Names, binding: ast.Binding) -> Iterator[str]:
    """What the message to a person may name: the parameters of the action, by their names here or there."""
    yield from names.parameters.get(binding.action.text, ())
    yield from (arg.name.text for arg in binding.args or () if isinstance(arg, ast.Parameter))


def table_doc(names: Names, table: ast.Table) -> Doc:
    """``{a: b, (c, d): e}``."""
    entries = (Joined((_key(names, entry), ": ", term_doc(names, entry.value))) for entry in table.entries)
    return Brackets("{", tuple(entries), "}", packed=False)


def _key(names: Names, entry: ast.TableEntry) -> Doc:
    match entry.key:
        case (key,):
            return term_doc(names, key)
        case keys:
            return Brackets("(", term_docs(names, keys), ")", packed=False)
