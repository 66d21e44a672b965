"""Programs as the bodies of Python functions."""

from __future__ import annotations

from collections.abc import Iterator

from golc.embed.names import python_name
from golc.embed.printing.functions import called, condition_call, loop, with_head
from golc.embed.printing.layout import INDENT, Doc, laid_out, laid_out_value
from golc.embed.printing.names import Names
from golc.embed.printing.strings import quoted
from golc.embed.printing.terms import call_doc, maybe, optional, program_doc, term_doc
from golc.syntax import tree as ast


def block(names: Names, body: ast.Block, indent: int) -> Iterator[str]:
    """The lines of a block, indented by so many spaces."""
    for statement in body.statements:
        yield from _statement(names, statement, indent)


def _statement(names: Names, statement: ast.Statement, indent: int) -> Iterator[str]:
    match statement:
        case ast.Call(target=target):
            yield from laid_out(program_doc(names, target), indent)
        case ast.Skip():
            yield " " * indent + "pass"
        case ast.If():
            yield from _conditional(names, statement, indent)
        case ast.While(condition=condition, body=body):
            yield from laid_out_value("while ", term_doc(names, condition), ":", indent)
            yield from block(names, body, indent + INDENT)
        case ast.Pick(binders=binders, where=where, body=body):
            yield from loop(names, "pick", binders, where, indent, block(names, body, indent + INDENT))
        case ast.For(binders=binders, where=where, body=body):
            yield from loop(names, "each", binders, where, indent, block(names, body, indent + INDENT))
        case ast.Choose(branches=branches):
            yield from _branches(names, "choose", branches, indent)
        case ast.Together(branches=branches):
            yield from _branches(names, "together", branches, indent)
        case ast.Prefer(branches=branches):
            yield from _branches(names, "prefer", branches, indent)
        case ast.Interrupts(handlers=handlers):
            yield from with_head(call_doc(names.word("interrupts")), indent)
            for handler in handlers:
                yield from _handler(names, handler, indent + INDENT)
        case ast.Let(name=name, value=value, body=body):
            head = call_doc(names.word("let"), term_doc(names, value))
            yield from with_head(head, indent, f" as {python_name(name.text)}:")
            with names.bound([name.text]):
                yield from block(names, body, indent + INDENT)
        case ast.Within(duration=duration, body=body, otherwise=otherwise):
            yield from _with(names, call_doc(names.word("within"), term_doc(names, duration)), body, indent)
            if otherwise is not None:
                yield from _with(names, call_doc(names.word("otherwise")), otherwise, indent)
        case _:
            yield from _other(names, statement, indent)


def _other(names: Names, statement: ast.Statement, indent: int) -> Iterator[str]:
    """A block under one word, or a word alone."""
    match statement:
        case ast.Star(limit=limit, body=body):
            yield from _with(
                names, call_doc(names.word("star"), *optional("at_most", maybe(names, limit))), body, indent
            )
        case ast.TogetherStar(body=body):
            yield from _with(names, call_doc(names.word("together_star")), body, indent)
        case ast.Guard(condition=condition, body=body):
            yield from _with(names, call_doc(names.word("guard"), term_doc(names, condition)), body, indent)
        case ast.Search(body=body):
            yield from _with(names, _search(names, statement), body, indent)
        case ast.Test(condition=condition):
            yield from condition_call(names, "test", condition, indent)
        case ast.Wait():
            yield from called(names.word("wait"), indent=indent)
        case ast.WaitUntil(condition=condition):
            until = optional("until", term_doc(names, condition))
            yield from called(names.word("wait"), *until, indent=indent)
        case ast.WaitTime(duration=duration):
            seconds = optional("seconds", term_doc(names, duration))
            yield from called(names.word("wait"), *seconds, indent=indent)
        case ast.Say(message=message):
            yield from condition_call(names, "say", message, indent)
        case ast.Abort(message=message):
            yield from condition_call(names, "abort", message, indent)
        case _:
            raise TypeError(f"{statement!r} is no statement")


def _conditional(names: Names, statement: ast.If, indent: int) -> Iterator[str]:
    word = "if "
    for condition, body in statement.branches:
        yield from laid_out_value(word, term_doc(names, condition), ":", indent)
        yield from block(names, body, indent + INDENT)
        word = "elif "
    if statement.otherwise is not None:
        yield " " * indent + "else:"
        yield from block(names, statement.otherwise, indent + INDENT)


def _branches(names: Names, word: str, branches: tuple[ast.Block, ...], indent: int) -> Iterator[str]:
    yield from with_head(call_doc(names.word(word)), indent)
    for branch in branches:
        yield from _with(names, call_doc(names.word("branch")), branch, indent + INDENT)


def _handler(names: Names, handler: ast.On, indent: int) -> Iterator[str]:
    if handler.binders:
        body = block(names, handler.body, indent + INDENT)
        yield from loop(names, "on", handler.binders, handler.condition, indent, body)
    else:
        yield from _with(names, call_doc(names.word("on"), term_doc(names, handler.condition)), handler.body, indent)


def _with(names: Names, head: Doc, body: ast.Block, indent: int) -> Iterator[str]:
    yield from with_head(head, indent)
    yield from block(names, body, indent + INDENT)


def _search(names: Names, search: ast.Search) -> Doc:
    mode = () if search.mode is None else (quoted(search.mode),)
    steps, seconds = maybe(names, search.at_most), maybe(names, search.within)
    return call_doc(names.word("search"), *mode, *optional("at_most", steps), *optional("within", seconds))
