"""What a declaration that is a call has been given: a name, a type, a value, parameters; each as its tree."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike, fspath
from types import FunctionType
from typing import Any

from golc.diagnostics import Code, Span
from golc.embed import words
from golc.embed.errors import meaningless, refused
from golc.embed.names import new_name
from golc.embed.places import argument, caller
from golc.embed.terms import Term
from golc.embed.types import type_node
from golc.embed.values import described
from golc.syntax import tree

MISSING: Any = object()
"""Stands for an argument that is left out, where ``None`` is a value."""


def named(name: object, again: str | None = None) -> tuple[tree.Ident, Span]:
    """The name of what is declared, and the place of the call. Raises ``Refused`` if it is named ``again``."""
    span = caller()
    if again is not None:
        raise meaningless("this has its name already", argument(span, None, "name"), "`name=` is for decorators")
    return new_name(name, argument(span, 0, "name")), span


def left_to_the_function(**given: object) -> None:
    """Raise ``Refused`` for an argument of a decorator that says what its function says."""
    for name, value in given.items():
        if value is not MISSING and value is not None:
            help_ = "it has the parameters, the type behind `->` and the value in `return`"
            raise meaningless(f"`{name}` is what the function says", argument(caller(), None, name), help_)


def needed(value: object, span: Span) -> object:
    """A value that cannot be left out. Raises ``Refused`` if it is."""
    if value is MISSING:
        raise meaningless("a value is missing", span, "write it as the last argument")
    return value


def path_of(value: object, span: Span) -> str:
    """The path of a file that the theory names. Raises ``Refused`` for what is none."""
    if isinstance(value, (str, PathLike)) and isinstance(path := fspath(value), str):
        return path
    raise refused(Code.PYTHON_VALUE, f"{described(value)} is no path of a file", span, "write a string")


def typed(type_: object, span: Span) -> tree.Type | None:
    """The type of a fluent or static declared by a call, which has ``None`` if it is left out."""
    return None if type_ is None else type_node(type_, argument(span, 1, "type"))


def parameters_of(types: Mapping[str, object] | None, span: Span) -> tuple[tree.Parameter, ...]:
    """The parameters that a mapping from names to types stands for, in a declaration that is a call."""
    place = argument(span, None, "parameters")
    if types is not None and not isinstance(types, Mapping):
        raise refused(Code.PYTHON_VALUE, "parameters are a dictionary", place, 'write `parameters={"n": station}`')
    given = (types or {}).items()
    return tuple(tree.Parameter(new_name(name, place), type_node(type_, place), span=place) for name, type_ in given)


def applied(value: object, parameters: tuple[tree.Parameter, ...], span: Span) -> object:
    """A value, called with variables of the parameters' names if it is a function of them."""
    if not isinstance(value, FunctionType):
        return value
    variables = words.bound(value, len(parameters), span, [parameter.name.text for parameter in parameters])
    made = value(*variables)
    if isinstance(made, Term):
        words.of_variables(made.node, variables, span)
    return made
