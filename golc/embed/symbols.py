"""Strings where symbols are meant: what a table from a file has before its names are looked up."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from golc.diagnostics import Code, Span
from golc.embed.errors import refused
from golc.embed.terms import Named
from golc.embed.types import TypeHandle
from golc.syntax import tree


def no_strings(
    table: Mapping[Any, object],
    parameters: tuple[tree.Parameter, ...],
    returned: tree.Type | None,
    types: Mapping[str, object],
    span: Span,
) -> None:
    """Refuse a table for the first string in it where its types have symbols; ``types`` are those declared so far."""
    for key, value in table.items():
        parts = key if isinstance(key, tuple) else (key,)
        for part, parameter in zip(parts, parameters, strict=False):
            _no_string(part, parameter.type, types, span)
        if returned is not None:
            _no_string(value, returned, types, span)


def _no_string(value: object, node: tree.Type, types: Mapping[str, object], span: Span) -> None:
    name = node.name.text if isinstance(node, tree.TypeName) else ""
    handle = types.get(name)
    if isinstance(value, str) and isinstance(handle, TypeHandle) and isinstance(handle.value, tree.EnumType):
        found = [each.name for each in handle if isinstance(each, Named)]
        if not found:
            return
        message = f"the table has the string {value!r} where `{name}` has symbols"
        one = value if value in found else found[0]
        help_ = f"`symbol = {{str(each): each for each in {name}}}` finds them: `symbol[{one!r}]`"
        raise refused(Code.PYTHON_VALUE, message, span, help_)
