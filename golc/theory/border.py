"""The border between golc and Python: arguments go out as plain values, results come in as values of a type."""

from __future__ import annotations

import reprlib
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from golc.diagnostics import Span
from golc.theory import errors
from golc.theory.foreign import golc_value
from golc.theory.forms import describe
from golc.theory.python_file import NotTrustedError, PythonError, PythonFile
from golc.theory.types import Value, show_call

if TYPE_CHECKING:
    from golc.theory.theory import Static

MOST_REMEMBERED = 100_000
"""How many values of one function are kept."""


@dataclass(frozen=True)
class PythonFunction:
    """The body of an ``extern``: the function of a Python file that has the same name; ``path`` is as written.

    ``values`` are the results so far, by arguments: the function is pure, which is the promise of its writer.
    """

    path: str
    file: PythonFile = field(compare=False, repr=False)
    values: dict[tuple[Value, ...], Value] = field(default_factory=dict, compare=False, repr=False)


def extern_value(static: Static, args: tuple[Value, ...], span: Span) -> Value:
    """What a Python function gives for arguments of its parameters' types; ``span`` is the call in the term.

    Raises ``ProgramError`` where the function fails, or gives what is not of its declared type, or is not trusted.
    """
    body = static.body
    assert isinstance(body, PythonFunction)
    try:
        return body.values[args]
    except KeyError:
        args = tuple([plain(arg) for arg in args])
        value = _computed(static, body.file, args, span)
        if len(body.values) >= MOST_REMEMBERED:
            body.values.clear()
        body.values[args] = value
        return value


def _computed(static: Static, file: PythonFile, args: tuple[Value, ...], span: Span) -> Value:
    what = f"`{show_call(static.name, args)}`"
    try:
        function = file.function(static.name)
        result = file.guarded(what, lambda: function(*args))
        value = file.guarded(what, lambda: golc_value(result, static.type))
        if value not in static.type:
            type_ = describe(static.type, static.span)
            reason = f"{what} is {reprlib.repr(result)} in {file.path}, which is not of type {type_}"
            raise PythonError(reason, file.definition(function))
    except NotTrustedError as error:
        raise errors.not_executed(span, static.name, str(error)) from None
    except PythonError as error:
        raise errors.extern_failed(span, str(error), error.labels, error.help) from error
    return value


def plain(value: Value) -> Value:
    """A value as Python code gets it: what only stands for an integer becomes that integer."""
    match value:
        case None | bool() | str() | Fraction():
            return value
        case int():
            return value if type(value) is int else int(value)
        case tuple():
            return tuple([plain(element) for element in value])
        case frozenset():
            return frozenset([plain(element) for element in value])
    return value
