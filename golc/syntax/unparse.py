"""A tree as text in canonical layout: it parses to the same tree."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from golc.syntax import tree as ast
from golc.syntax.layout import INDENT
from golc.syntax.notation import (
    binders,
    commas,
    condition,
    constant,
    message,
    string,
    type_text,
    unparse_expression,
)

__all__ = ["unparse", "unparse_declaration", "unparse_expression", "unparse_statement"]

DEEPER = " " * INDENT

AFTER, ACTIONS, UNTIL, WAITING = r"after\b", r"actions *\[", r"until\b", r"waiting$"
"""How a text begins that, in one place of the grammar each, is read as a word of the language."""


def unparse(file: ast.File) -> str:
    """The text of a file: blank lines between declarations, except between lines of one kind."""
    lines = [f"domain {file.domain.text}"]
    for declaration in file.declarations:
        text = unparse_declaration(declaration)
        if text.split(None, 1)[0] != lines[-1].split(None, 1)[0] or "\n" in text or "\n" in lines[-1]:
            lines.append("")
        lines.append(text)
    return "\n".join(lines) + "\n"


def unparse_declaration(declaration: ast.Declaration) -> str:
    """The text of a declaration, without a line end at its end."""
    return "\n".join(_declaration(declaration))


def unparse_statement(statement: ast.Statement) -> str:
    """The text of a statement, without a line end at its end."""
    return "\n".join(_statement(statement))


def _declaration(declaration: ast.Declaration) -> Iterator[str]:
    match declaration:
        case ast.Action(clauses=clauses):
            yield from _with_block(f"action {_head(declaration)}", clauses)
        case ast.Exog(clauses=clauses):
            yield from _with_block(f"exog {_head(declaration)}{_reported(declaration)}", clauses)
        case ast.Axiom():
            yield from _axiom(declaration)
        case ast.Scenario(name=name, items=items):
            yield from _with_block(f"scenario {name.text}", items)
        case ast.Proc(body=body):
            yield f"proc {_head(declaration)}:"
            yield from _block(body)
        case ast.Device(items=items):
            yield from _with_block(_device(declaration), items)
        case _:
            yield _line(declaration)


def _line(declaration: ast.Declaration) -> str:
    """A declaration that is one line."""
    match declaration:
        case ast.Import(path=path):
            return f"import {string(path)}"
        case ast.Const(name=name, value=value):
            return f"const {name.text} = {unparse_expression(value)}"
        case ast.TypeDecl(name=name, type=type_):
            return f"type {name.text} = {type_text(type_)}"
        case ast.Static(type=type_, value=value):
            text = _table(value) if isinstance(value, ast.Table) else unparse_expression(value)
            return f"static {_head(declaration)}{_of_type(type_)} = {text}"
        case ast.Extern(type=type_, path=path):
            return f"extern {_head(declaration)}{_of_type(type_)} from {string(path)}"
        case ast.Fluent(type=type_, initial=initial):
            text = "" if initial is None else f" = {unparse_expression(initial)}"
            return f"fluent {_head(declaration)}{_of_type(type_)}{text}"
        case ast.Initially(condition=formula):
            return f"initially {unparse_expression(formula)}"
        case ast.Define(body=body):
            return f"define {_head(declaration)} := {unparse_expression(body)}"
        case ast.Invariant(name=name, condition=formula):
            return f"invariant {name.text}: {unparse_expression(formula)}"
        case ast.Goal(name=name, condition=formula):
            return f"goal {name.text}: {unparse_expression(formula)}"
        case ast.Prune(name=name, condition=formula):
            return f"prune {name.text}: {_unless_word(formula, AFTER)}"
        case ast.PruneAfter(name=name, pattern=pattern, condition=when):
            return f"prune {name.text}: after {_pattern(pattern)}{condition('when', when)}"
        case _:
            raise TypeError(f"{declaration!r} is no declaration")


def _head(declaration: ast.Static | ast.Extern | ast.Fluent | ast.Define | ast.Action | ast.Exog | ast.Proc) -> str:
    parameters = declaration.parameters
    return declaration.name.text + (f"({', '.join(map(_parameter, parameters))})" if parameters else "")


def _parameter(parameter: ast.Parameter) -> str:
    return f"{parameter.name.text}: {type_text(parameter.type)}"


def _of_type(type_: ast.Type | None) -> str:
    return "" if type_ is None else f": {type_text(type_)}"


def _table(table: ast.Table) -> str:
    return f"{{{', '.join(f'{_key(entry.key)}: {unparse_expression(entry.value)}' for entry in table.entries)}}}"


def _key(key: tuple[ast.Expr, ...]) -> str:
    return commas(key) if len(key) == 1 else f"({commas(key)})"


def _with_block(head: str, items: Iterable[ast.Node]) -> Iterator[str]:
    """A head, and its items in a block if there are any."""
    lines = [DEEPER + _item(item) for item in items]
    yield f"{head}:" if lines else head
    yield from lines


def _reported(exog: ast.Exog) -> str:
    sources = ", ".join(source.text for source in exog.sources)
    return (" expected" if exog.expected else "") + (f" from {sources}" if sources else "")


def _axiom(axiom: ast.Axiom) -> Iterator[str]:
    parameters = ", ".join(parameter.text for parameter in axiom.parameters)
    yield f"axiom {axiom.fluent.text}" + (f"({parameters}):" if parameters else ":")
    for case in axiom.cases:
        value = unparse_expression(case.value)
        yield f"{DEEPER}after {_pattern(case.pattern)} := {value}{condition('when', case.condition)}"
    yield f"{DEEPER}otherwise unchanged"


def _pattern(pattern: ast.Pattern) -> str:
    args = ", ".join(constant(arg) for arg in pattern.args)
    return pattern.action.text + (f"({args})" if args else "")


def _device(device: ast.Device) -> str:
    name = "" if device.name is None else f" {device.name.text}"
    file = "" if device.file is None else f" {string(device.file)}"
    return f"device {device.kind.text}{name}{file}"


def _item(item: ast.Node) -> str:
    """A line in the block of an action, a scenario or a device."""
    match item:
        case ast.Precondition(condition=formula):
            return f"poss {unparse_expression(formula)}"
        case ast.Effect():
            return _effect(item)
        case ast.Senses(value=value):
            return f"senses {unparse_expression(value)}"
        case ast.Cost(value=value):
            return f"cost {unparse_expression(value)}"
        case ast.Binding():
            return _binding(item)
        case ast.Setting(name=name, value=value, seconds=seconds):
            return f"set {name.text} {unparse_expression(value)}{' s' if seconds else ''}"
        case _:
            return _scenario_item(item)


def _effect(effect: ast.Effect) -> str:
    head = f"forall {binders(effect.binders, effect.where)}. " if effect.binders else ""
    change = f"{unparse_expression(effect.target)} := {unparse_expression(effect.value)}"
    return f"causes {head}{change}{condition('when', effect.condition)}"


def _scenario_item(item: ast.Node) -> str:
    match item:
        case ast.Given(condition=formula):
            return f"given {unparse_expression(formula)}"
        case ast.Run(program=program):
            return f"run {unparse_expression(program)}"
        case ast.OnEvents(events=events, trigger=trigger, argument=argument):
            return f"on {commas(events)} {_trigger(trigger, argument)}"
        case ast.Until(condition=formula):
            return f"until {unparse_expression(formula)}"
        case ast.ExpectCount(action=action, relation=relation, count=count):
            return f"expect {unparse_expression(action)} {relation} {unparse_expression(count)}"
        case ast.ExpectActions(actions=actions):
            return f"expect actions [{commas(actions)}]"
        case ast.ExpectFormula(condition=formula):
            return f"expect {_unless_word(formula, ACTIONS)}"
        case _:
            raise TypeError(f"{item!r} is no part of a declaration")


def _trigger(trigger: str, argument: ast.Expr | None) -> str:
    if argument is None:
        return "when waiting"
    return f"{trigger} {_unless_word(argument, WAITING) if trigger == 'when' else unparse_expression(argument)}"


def _unless_word(expr: ast.Expr, word: str) -> str:
    """The expression, in parentheses if it would be read as a word of the language where it stands."""
    text = unparse_expression(expr)
    return f"({text})" if re.match(word, text) else text


def _binding(binding: ast.Binding) -> str:
    parts = [] if binding.number is None else [str(binding.number)]
    if binding.ranged:
        parts.append("..")
    args = "" if binding.args is None else f"({', '.join(_binding_arg(arg) for arg in binding.args)})"
    parts.append(binding.action.text + args)
    match binding.behaviour:
        case ast.ByCall(function=name):
            parts.append(f"by call {name.text}")
        case ast.ByStart(task=name):
            parts.append(f"by start {name.text}")
        case ast.ByPrompt(message=text):
            parts.append(f"by prompt {message(text)}")
    if binding.timeout is not None:
        parts.append(f"timeout {unparse_expression(binding.timeout)} s")
    if binding.table is not None:
        parts.append(_table(binding.table))
    return " ".join(parts)


def _binding_arg(arg: ast.Parameter | ast.Ident | ast.Number | ast.Truth | ast.Nothing) -> str:
    return _parameter(arg) if isinstance(arg, ast.Parameter) else constant(arg)


def _block(block: ast.Block) -> Iterator[str]:
    for statement in block.statements:
        for line in _statement(statement):
            yield DEEPER + line


def _statement(statement: ast.Statement) -> Iterator[str]:
    parts = _compound(statement)
    if parts is None:
        yield _simple(statement)
        return
    for head, block in parts:
        yield f"{head}:"
        if isinstance(block, ast.Block):
            yield from _block(block)
        else:
            for handler in block:
                yield f"{DEEPER}{_on(handler)}:"
                yield from (DEEPER + line for line in _block(handler.body))


def _simple(statement: ast.Statement) -> str:
    match statement:
        case ast.Call(target=target):
            return unparse_expression(target)
        case ast.Test(condition=formula):
            return f"test {unparse_expression(formula)}"
        case ast.Skip():
            return "skip"
        case ast.Wait():
            return "wait"
        case ast.WaitUntil(condition=formula):
            return f"wait until {unparse_expression(formula)}"
        case ast.WaitTime(duration=duration):
            return f"wait {_unless_word(duration, UNTIL)} s"
        case ast.Say(message=text):
            return f"say {message(text)}"
        case ast.Abort(message=text):
            return f"abort {message(text)}"
        case _:
            raise TypeError(f"{statement!r} is no statement")


def _compound(statement: ast.Statement) -> list[tuple[str, ast.Block | tuple[ast.On, ...]]] | None:
    """The heads of a statement with their blocks; None if it is one line."""
    match statement:
        case ast.If(branches=branches, otherwise=otherwise):
            words = ["if", *["elif"] * (len(branches) - 1)]
            heads = [f"{word} {unparse_expression(test)}" for word, (test, _) in zip(words, branches, strict=True)]
            return [*zip(heads, (block for _, block in branches), strict=True), *_else(otherwise)]
        case ast.Choose(branches=blocks):
            return _joined("choose", "or", blocks)
        case ast.Together(branches=blocks):
            return _joined("together", "and", blocks)
        case ast.Prefer(branches=blocks):
            return _joined("prefer", "over", blocks)
        case ast.Within(duration=duration, body=body, otherwise=otherwise):
            return [(f"within {unparse_expression(duration)} s", body), *_else(otherwise)]
        case ast.Interrupts(handlers=handlers):
            return [("interrupts", handlers)]
        case _:
            head = _single_head(statement)
            return None if head is None else [head]


def _single_head(statement: ast.Statement) -> tuple[str, ast.Block] | None:
    match statement:
        case ast.While(condition=formula, body=body):
            return f"while {unparse_expression(formula)}", body
        case ast.Pick(binders=bound, where=where, body=body):
            return f"pick {binders(bound, where)}", body
        case ast.For(binders=bound, where=where, body=body):
            return f"for {binders(bound, where)}", body
        case ast.Star(limit=limit, body=body):
            return "star" if limit is None else f"star at most {unparse_expression(limit)}", body
        case ast.Let(name=name, value=value, body=body):
            return f"let {name.text} = {unparse_expression(value)}", body
        case ast.TogetherStar(body=body):
            return "together star", body
        case ast.Guard(condition=formula, body=body):
            return f"guard {unparse_expression(formula)}", body
        case ast.Search(body=body):
            return _search(statement), body
        case _:
            return None


def _joined(first: str, next_: str, blocks: tuple[ast.Block, ...]) -> list[tuple[str, ast.Block | tuple[ast.On, ...]]]:
    return list(zip([first, *[next_] * (len(blocks) - 1)], blocks, strict=True))


def _else(block: ast.Block | None) -> list[tuple[str, ast.Block | tuple[ast.On, ...]]]:
    return [] if block is None else [("else", block)]


def _on(handler: ast.On) -> str:
    if handler.binders:
        return f"on some {binders(handler.binders, handler.condition)}"
    return f"on {unparse_expression(handler.condition)}"


def _search(search: ast.Search) -> str:
    mode = "" if search.mode is None else f" {search.mode}"
    steps = "" if search.at_most is None else f" at most {unparse_expression(search.at_most)} steps"
    seconds = "" if search.within is None else f" within {unparse_expression(search.within)} s"
    return f"search{mode}{steps}{seconds}"
