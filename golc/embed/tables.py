"""Dictionaries of Python as tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from golc.diagnostics import Code, Span
from golc.embed.errors import refused
from golc.embed.parts import Parts
from golc.embed.types import is_enumeration, symbols_of
from golc.embed.values import expr
from golc.syntax import tree


def table_of(value: Mapping[Any, object], span: Span) -> tree.Table:
    """A dictionary of Python as a table."""
    entries = []
    for key, each in value.items():
        parts = key if isinstance(key, tuple) else (key,)
        entries.append(tree.TableEntry(tuple(expr(part, span) for part in parts), expr(each, span), span=span))
    return tree.Table(tuple(entries), span=span)


def no_strings(
    table: Mapping[Any, object],
    parameters: tuple[tree.Parameter, ...],
    returned: tree.Type | None,
    home: Parts,
    span: Span,
) -> None:
    """Raise ``Refused`` for the first string in a table whose types have symbols there: the names of a file, most
    likely, that nobody has looked up. ``home`` knows the types.
    """
    for key, value in table.items():
        parts = key if isinstance(key, tuple) else (key,)
        for part, parameter in zip(parts, parameters, strict=False):
            _no_string(part, parameter.type, home, span)
        if returned is not None:
            _no_string(value, returned, home, span)


def _no_string(value: object, node: tree.Type, home: Parts, span: Span) -> None:
    if not isinstance(value, str) or not isinstance(node, tree.TypeName):
        return
    handle = home.type_of(node.name.text)
    found = list(symbols_of(handle)) if handle is not None and is_enumeration(handle) else []
    if found:
        message = f"the table has the string {value!r} where `{handle}` has symbols"
        one = value if value in found else found[0]
        help_ = f"`symbol = {{str(each): each for each in {handle}}}` finds them: `symbol[{one!r}]`"
        raise refused(Code.PYTHON_VALUE, message, span, help_)
