"""What to say of a Python file that cannot be read, or that raises an exception when it is run."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType

from golc.diagnostics import Code, Diagnostic, Label, Source, Span, UserError
from golc.embed.cures import cure
from golc.embed.places import code_span, line_span, offset, source_of
from golc.theory.python_file import failure

HERE = str(Path(__file__).parent)


def syntax_error(error: SyntaxError, source: Source) -> Diagnostic:
    """What Python cannot read, at its place."""
    line, column = error.lineno or 1, error.offset or 0
    start = min(offset(source, line, 0) + max(0, column - 1), len(source.text))
    end = start + 1
    if error.end_lineno == line and (error.end_offset or 0) > column:
        end = offset(source, line, 0) + (error.end_offset or 0) - 1
    message = f"Python cannot read this: {error.msg}"
    return Diagnostic(Code.PYTHON_SYNTAX, message, Span(source, start, min(end, len(source.text))))


def raised(error: BaseException, source: Source) -> tuple[Diagnostic, ...]:
    """What to say of an exception that running a theory has raised."""
    if isinstance(error, UserError):
        return error.diagnostics
    places = list(_places(error.__traceback__))
    own = [place for place in places if place.source is source]
    place = own[-1] if own else (places[-1] if places else Span(source, 0, 0))
    labels = [Label(each, "called here") for each in own[:1] if each is not place]
    labels += [Label(each, "raised here") for each in places[-1:] if each is not place]
    if isinstance(error, SyntaxError):
        broken = source_of(error.filename or "")
        if broken.text:
            return (syntax_error(error, broken),)
    message = f"Python fails here with {failure(error)}"
    return (Diagnostic(Code.PYTHON_RAISED, message, place, labels=tuple(labels), help=cure(error, source.name)),)


def _places(where: TracebackType | None) -> Iterator[Span]:
    """The places of a traceback in files outside this package whose source is there."""
    for frame, line in traceback.walk_tb(where):
        code = frame.f_code
        if not code.co_filename.startswith((HERE, "<frozen")) and (source := source_of(code.co_filename)).text:
            instruction = where.tb_lasti if where is not None and where.tb_frame is frame else -1
            yield code_span(source, code, instruction, line) if instruction >= 0 else line_span(source, line)
        where = None if where is None else where.tb_next
