"""Programs as the bodies of Python functions."""

from __future__ import annotations

from collections.abc import Iterator

from golc.embed.printing.functions import called, loop, with_head, word_call
from golc.embed.printing.layout import INDENT, Doc, laid_out, laid_out_value
from golc.embed.printing.names import Names
from golc.embed.printing.strings import quoted
from golc.embed.printing.terms import call_doc, keyword, maybe, optional, program_doc, term_doc
from golc.syntax import tree as ast
from golc.syntax.python_names import python_name


def block(names: Names, body: ast.Block, indent: int) -> Iterator[str]:
    """The lines of a block, indented by so many spaces."""
    for statement in body.statements:
        yield from _statement(names, statement, indent)


def _statement(names: Names, statement: ast.Statement, indent: int) -> Iterator[str]:
    match statement:
        case ast.If():
            yield from _conditional(names, statement, indent)
        case ast.While(condition=condition, body=body):
            yield from laid_out_value("while ", term_doc(names, condition), ":", indent)
            yield from block(names, body, indent + INDENT)
        case ast.Pick(binders=binders, where=where, body=body) | ast.For(binders=binders, where=where, body=body):
            word = "pick" if isinstance(statement, ast.Pick) else "each"
            yield from loop(names, word, binders, where, indent, block(names, body, indent + INDENT))
        case ast.Choose(branches=branches) | ast.Together(branches=branches) | ast.Prefer(branches=branches):
            yield from _branches(names, type(statement).__name__.lower(), branches, indent)
        case ast.Interrupts(handlers=handlers):
            yield from with_head(call_doc(names.word("interrupts")), indent)
            for handler in handlers:
                yield from _handler(names, handler, indent + INDENT)
        case ast.Let(name=name, value=value, body=body):
            head = call_doc(names.word("let"), term_doc(names, value))
            yield from with_head(head, indent, f" as {python_name(name.text)}:")
            with names.bound([name.text]):
                yield from block(names, body, indent + INDENT)
        case ast.Within(body=body, otherwise=otherwise):
            yield from _with(names, _head(names, statement), body, indent)
            if otherwise is not None:
                yield from _with(names, call_doc(names.word("otherwise")), otherwise, indent)
        case ast.Star() | ast.TogetherStar() | ast.Guard() | ast.Search():
            yield from _with(names, _head(names, statement), statement.body, indent)
        case _:
            yield from _line(names, statement, indent)


def _head(names: Names, statement: ast.Star | ast.TogetherStar | ast.Guard | ast.Search | ast.Within) -> Doc:
    """The word that a block stands under, with its arguments."""
    match statement:
        case ast.Star(limit=limit):
            return call_doc(names.word("star"), *optional("at_most", maybe(names, limit)))
        case ast.TogetherStar():
            return call_doc(names.word("together_star"))
        case ast.Guard(condition=condition):
            return call_doc(names.word("guard"), term_doc(names, condition))
        case ast.Search(mode=mode, at_most=at_most, within=within):
            limits = (*optional("at_most", maybe(names, at_most)), *optional("within", maybe(names, within)))
            return call_doc(names.word("search"), *(() if mode is None else (quoted(mode),)), *limits)
        case ast.Within(duration=duration):
            return call_doc(names.word("within"), term_doc(names, duration))


def _line(names: Names, statement: ast.Statement, indent: int) -> list[str]:
    """A statement that holds no others."""
    match statement:
        case ast.Call(target=target):
            return laid_out(program_doc(names, target), indent)
        case ast.Skip():
            return [" " * indent + "pass"]
        case ast.Test(condition=condition):
            return word_call(names, "test", condition, indent)
        case ast.Wait():
            return called(names.word("wait"), indent=indent)
        case ast.WaitUntil(condition=condition):
            return called(names.word("wait"), keyword("until", term_doc(names, condition)), indent=indent)
        case ast.WaitTime(duration=duration):
            return called(names.word("wait"), keyword("seconds", term_doc(names, duration)), indent=indent)
        case ast.Say(message=message) | ast.Abort(message=message):
            return word_call(names, type(statement).__name__.lower(), message, indent)
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
