"""Decorated functions and the heads of blocks, as lines."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from golc.embed.printing.layout import INDENT, Brackets, Doc, Joined, laid_out, laid_out_value
from golc.embed.printing.names import Names
from golc.embed.printing.strings import quoted
from golc.embed.printing.terms import call_doc, keyword, maybe, optional, source_doc, term_doc, type_doc
from golc.syntax import tree as ast
from golc.syntax.python_names import golc_name, python_name

ELLIPSIS = "..."
"""The body of a function that says nothing more, which stands in the line of its head."""


def function_lines(
    decorator: Doc, name: str, parameters: tuple[Doc, ...], returns: Doc | None, body: Iterable[str]
) -> list[str]:
    """A function under a decorator; ``pass`` is the body of one that has none."""
    lines = list(body) or [" " * INDENT + "pass"]
    colon = ":" if lines != [ELLIPSIS] else f": {ELLIPSIS}"
    arrow: Doc = colon if returns is None else Joined((" -> ", returns, colon))
    head = laid_out(Joined((f"def {name}", Brackets("(", parameters, ")", trailing=True), arrow)), 0)
    return [*laid_out(Joined(("@", decorator)), 0), *head, *(lines if lines != [ELLIPSIS] else [])]


def decorator_doc(kind: str, python: str, name: str, options: tuple[Doc, ...] = ()) -> Doc:
    """``theory.action``, with options and, where the function has another name, with that of what it declares."""
    if golc_name(python) != name:
        options = (*options, keyword("name", quoted(name)))
    return call_doc(f"theory.{kind}", *options) if options else f"theory.{kind}"


def parameter_docs(names: Names, parameters: Iterable[ast.Parameter]) -> tuple[Doc, ...]:
    """``n: station``."""
    return tuple(Joined((f"{python_name(each.name.text)}: ", type_doc(names, each.type))) for each in parameters)


def returned(value: Doc) -> list[str]:
    """The body of a function that only says a value."""
    return laid_out_value("return ", value, "", INDENT)


def called(word: Doc, *args: Doc, indent: int = INDENT) -> list[str]:
    """A line that is a call of a word of the language."""
    return laid_out(call_doc(word, *args), indent)


def loop(
    names: Names,
    word: str,
    binders: tuple[ast.Binder, ...],
    where: ast.Expr | None,
    indent: int,
    body: Iterator[str],
) -> Iterator[str]:
    """``for x, y in pick(t, l, where=φ):`` over a body that is written while the variables are bound."""
    with names.bound():
        sources: list[Doc] = []
        for binder in binders:
            sources.append(source_doc(names, binder))
            names.bind(binder.name.text)
        variables = ", ".join(python_name(binder.name.text) for binder in binders)
        if word == "each" and where is None and len(binders) == 1:
            yield from laid_out_value(f"for {variables} in ", sources[0], ":", indent)
        else:
            iterated = call_doc(names.word(word), *sources, *optional("where", maybe(names, where)))
            yield from laid_out(Joined((f"for {variables} in ", iterated, ":")), indent)
        yield from body


def with_head(call: Doc, indent: int, behind: str = ":") -> list[str]:
    """``with search("shortest"):``."""
    return laid_out(Joined(("with ", call, behind)), indent)


def word_call(names: Names, word: str, term: ast.Expr, indent: int = INDENT) -> list[str]:
    """A line that is a word of the language with one term or formula, as ``test(φ)``."""
    return called(names.word(word), term_doc(names, term), indent=indent)
