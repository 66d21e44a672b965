"""A tree as a theory in Python: read again, it gives the same tree.

Terms become Python's own expressions, programs its statements; comments have no place in a tree. What Python computes
(``theory.fluent("location", station, 3)``) is written as a call, what may not be computed as a function.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator

from golc.diagnostics import Code, Diagnostic, UserError
from golc.embed.printing.declarations import Declarations, Part, assigned
from golc.embed.printing.layout import WIDTH, Brackets, Joined, laid_out
from golc.embed.printing.names import Names
from golc.embed.printing.strings import quoted
from golc.embed.printing.terms import call_doc
from golc.syntax import tree as ast
from golc.theory.recursion import deep_recursion


def python_text(file: ast.File) -> str:
    """The text of a module that makes the theory of a file.

    Raises ``UserError`` for a declaration that Python cannot hold (two parameters with one name, blocks nested too
    deeply), ``ValueError`` for a message inside a message, which golc cannot write either.
    """
    with deep_recursion():
        names = Names(file)
        parts = list(_parts(names, file))
        text = "\n".join([*_head(names), *_joined(parts)]) + "\n"
    if _refusal(text) is not None:
        _check(parts)
    return text


def _parts(names: Names, file: ast.File) -> Iterator[Part]:
    """The theory, its imports, what they bring, and everything else."""
    yield Part("theory", laid_out(call_doc("theory = Theory", quoted(file.domain.text)), 0))
    names.word("Theory")
    declarations = Declarations(names, file)
    printed = [part for place, node in enumerate(file.declarations) for part in declarations.parts(place, node)]
    leading = next((place for place, part in enumerate(printed) if part.kind != "import"), len(printed))
    yield from printed[:leading]
    for word, outside in (("names", names.outside), ("types", names.outside_types)):
        if outside:
            value = call_doc(names.word(word), *map(quoted, outside))
            yield Part("names", assigned(list(outside.values()), value))
    yield from printed[leading:]


def _head(names: Names) -> Iterator[str]:
    """The imports of the module."""
    yield from ("from __future__ import annotations", "")
    words = sorted(names.words, key=lambda word: (word.islower(), word))
    lines = laid_out(f"from golc.embed import {', '.join(words)}", 0)
    if len(lines[0]) > WIDTH:
        lines = laid_out(Joined(("from golc.embed import ", Brackets("(", tuple(words), ")", packed=False))), 0)
    yield from lines
    yield ""


def _joined(parts: list[Part]) -> Iterator[str]:
    """Two blank lines around a function, one between lines of different kinds."""
    before = None
    for part in parts:
        if before is not None and not (before.kind and part.kind):
            yield from ("", "")
        elif before is not None and before.kind != part.kind:
            yield ""
        yield from part.lines
        before = part


def _check(parts: list[Part]) -> None:
    """Find the declaration that Python cannot hold."""
    for part in parts:
        reason = _refusal("\n".join(part.lines))
        if reason is not None and part.declaration is not None:
            message = f"this declaration cannot be written in Python: {reason}"
            help_ = "give a part of it a name with `define`, or make a part of the program a procedure"
            if reason.startswith("duplicate"):
                help_ = "give each parameter a name of its own"
            raise UserError(Diagnostic(Code.PYTHON_MEANING, message, part.declaration.span, help=help_))


def _refusal(text: str) -> str | None:
    """Why Python does not compile a text."""
    try:
        with warnings.catch_warnings(action="ignore"):
            compile(text, "<theory>", "exec", dont_inherit=True)
    except SyntaxError as error:
        return error.msg
    except (RecursionError, MemoryError):
        return "it is nested too deeply"
    return None
