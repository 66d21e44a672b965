"""Types as they are written, to types with values."""

from __future__ import annotations

import sys
from dataclasses import replace

from golc.diagnostics import Code, Span
from golc.syntax import tree
from golc.theory.context import Context
from golc.theory.declare import BUILTIN_TYPES
from golc.theory.fitting import BROKEN, members, size
from golc.theory.forms import describe, type_text
from golc.theory.scope import Entry, Kind
from golc.theory.theory import Parameter
from golc.theory.types import INT, REAL, Collection, Enumeration, Interval, Optional, Primitive, Type, Value

LARGEST = 1_000_000
"""How many values may have to be enumerated: the instances of a fluent, the values of a variable."""


def elaborate_type(context: Context, node: tree.Type) -> Type:
    """The type that is written; ``BROKEN``, and a finding, if it is none."""
    match node:
        case tree.TypeName(name=name):
            return named_type(context, name)
        case tree.IntervalType():
            return _interval(context, node)
        case tree.EnumType():
            return _enumeration(context, node)
        case tree.UnionType():
            return _union(context, node)
        case tree.OptionalType(base=base):
            type_ = elaborate_type(context, base)
            return type_ if type_ is BROKEN or isinstance(type_, Optional) else Optional(type_)
        case tree.CollectionType(kind=kind):
            element = elaborate_type(context, node.element)
            return element if element is BROKEN else Collection(kind, element)


def finite_type(context: Context, node: tree.Type, what: str) -> Type:
    """A type whose values can be enumerated; ``what`` names what has to be of such a type."""
    type_ = elaborate_type(context, node)
    if type_ is BROKEN:
        return type_
    if not type_.finite:
        number = not type_.kinds.isdisjoint(REAL.kinds)
        help_ = give_a_range(node.span) if number else None
        message = f"{what} has to be of a type that can be enumerated, and `{type_text(type_, node.span)}` cannot"
        context.error(Code.BAD_TYPE, message, node.span, "has no end" if number else "cannot be enumerated", help_)
        return BROKEN
    if size(type_) > LARGEST:
        context.error(Code.BAD_TYPE, f"{what} has more than {LARGEST} values", node.span, "too many to enumerate")
        return BROKEN
    return type_


def give_a_range(place: Span) -> str:
    """What helps where a type has to be enumerable."""
    return f"give a range, for example `{place.either('1..10', 'interval(1, 10)')}`, or a declared type"


def declared_type(context: Context, entry: Entry) -> Type | None:
    """The type that a ``type`` declaration names."""
    assert isinstance(entry.node, tree.TypeDecl)
    type_ = elaborate_type(context, entry.node.type)
    match type_:
        case Interval() | Enumeration():
            return replace(type_, name=entry.name)
        case _:
            return None if type_ is BROKEN else type_


def named_type(context: Context, name: tree.Ident) -> Type:
    """A declared or built-in type by its name."""
    if name.text in BUILTIN_TYPES:
        return Primitive(name.text)
    entry = context.names.values.get(name.text)
    if entry is None:
        unknown_type(context, name)
        return BROKEN
    if entry.kind is not Kind.TYPE:
        message = f"`{name.text}` is {entry.kind.phrase}, not a type"
        context.error(Code.MISUSED_NAME, message, name.span, "a type is needed here")
        return BROKEN
    return context.type(entry) or BROKEN


def unknown_type(context: Context, name: tree.Ident) -> None:
    """Report a type that is declared nowhere."""
    if context.names.assumes(name.text):
        return
    message = f"unknown type `{name.text}`"
    similar = context.names.similar(name.text, [Kind.TYPE], variables=BUILTIN_TYPES)
    if similar is None:
        declared = name.span.either(f"type {name.text} = …", f'{name.text} = theory.type("{name.text}", …)')
        context.complaints.missing(Code.UNKNOWN_TYPE, message, name.span, f"declare it: `{declared}`")
    else:
        context.complaints.misspelt(Code.UNKNOWN_TYPE, name, similar)


def home(context: Context, entry: Entry) -> Type:
    """The type whose declaration brings a symbol."""
    match entry.node:
        case tree.TypeDecl() as node:
            return context.type(context.declared.entry(node)) or BROKEN
        case tree.EnumType() as node:
            return context.inline_types.get(id(node)) or elaborate_type(context, node)
        case _:
            return BROKEN


def parameters(
    context: Context, nodes: tuple[tree.Parameter, ...], what: str, infinite: bool = False
) -> tuple[Parameter, ...]:
    """The parameters of a declaration; ``infinite`` if they may be of any type. ``what`` names its owner."""
    found: list[Parameter] = []
    for node in nodes:
        described = f"parameter `{node.name.text}` of {what}"
        type_ = elaborate_type(context, node.type) if infinite else finite_type(context, node.type, described)
        found.append(Parameter(node.name.text, type_, span=node.name.span))
    return tuple(found)


def _interval(context: Context, node: tree.IntervalType) -> Type:
    low, high = context.constants(context, node.low, INT), context.constants(context, node.high, INT)
    if low is None or high is None or not isinstance(low.value, int) or not isinstance(high.value, int):
        return BROKEN
    if low.value > high.value:
        message = f"the interval {low.value}..{high.value} is empty"
        context.error(Code.BAD_TYPE, message, node.span, "the lower bound comes first")
        return BROKEN
    if high.value - low.value >= sys.maxsize:
        message = f"the interval {low.value}..{high.value} has more values than golc can count"
        context.error(Code.BAD_TYPE, message, node.span, "too many values", "use `int`")
        return BROKEN
    return Interval(low.value, high.value)


def _enumeration(context: Context, node: tree.EnumType) -> Type:
    found: dict[Value, str] = {}
    declares = False
    for element in node.elements:
        if isinstance(element, tree.Number):
            found[element.value] = ""
            continue
        entry = context.names.values.get(element.text)
        if entry is None or entry.kind is not Kind.SYMBOL:
            return BROKEN  # reported where the names are collected
        found[element.text] = _owner(entry)
        declares = declares or entry.node is node
    type_ = Enumeration(tuple(found.items()))
    if declares:
        context.inline_types[id(node)] = type_
    return type_


def _owner(entry: Entry) -> str:
    match entry.node:
        case tree.TypeDecl(name=name):
            return name.text
        case tree.EnumType(elements=elements):
            # Only the first of the elements: a symbol has one owner, so that tells them apart, however long the list.
            return "{" + next((element.text for element in elements if isinstance(element, tree.Ident)), "") + ", …}"
        case _:
            return entry.name


def _union(context: Context, node: tree.UnionType) -> Type:
    found: dict[Value, str] = {}
    for piece in node.pieces:
        type_ = elaborate_type(context, piece)
        if type_ is BROKEN or not _joins_union(context, type_, piece.span):
            return BROKEN
        found.update({value: owner for value, owner in members(type_) if value not in found})
    return Enumeration(tuple(found.items()))


def _joins_union(context: Context, type_: Type, span: Span) -> bool:
    if isinstance(type_, (Interval, Enumeration)) and size(type_) <= LARGEST:
        return True
    what = (
        "has too many values" if type_.finite and size(type_) > LARGEST else "is neither an interval nor an enumeration"
    )
    context.error(Code.BAD_TYPE, f"{describe(type_, span)} {what}, so it cannot be part of a union", span, "not a part")
    return False
