"""The two forms of the language, golc's own and Python: how types, names and signs are written where somebody reads of
them. Phrases are in two forms where they are said (``Span.either``)."""

from __future__ import annotations

import re

from golc.diagnostics import Span
from golc.syntax import tree
from golc.syntax.python_names import python_name
from golc.theory.fitting import Either
from golc.theory.types import BOOL, Collection, Enumeration, Interval, Optional, Primitive, Type

PYTHON_TYPES = {"bool": "bool", "int": "int", "string": "str", "real": "float"}

SIGNS = {
    "and": ("and", "&"),
    "or": ("or", "|"),
    "not": ("not", "~"),
    "exists": ("any", "exists"),
    "forall": ("all", "forall"),
}
"""Operators and quantifiers that Python writes otherwise, or in several ways: as a function is translated, and as
Python computes a term."""

WORDS = {"true": "True", "false": "False", "none": "None", "skip": "pass", "wait": "wait()", "waiting": "waiting=True"}
"""Words of the language that Python writes otherwise."""

_SIGN = re.compile(r"\w+|[&|~]")


def describe(type_: Type, place: Span) -> str:
    """A type for a message: what it is called and, if the name hides them, its values."""
    match type_:
        case Optional(base=base):
            nothing = f"`{word('none', place)}`"
            return nothing if not base.kinds else f"{describe(base, place)} or {nothing}"
        case Interval(low=low, high=high, name=str(name)):
            return f"`{name}` ({low}..{high})"
        case Enumeration(name=str(name)) as enumeration:
            return f"`{name}` ({_some(enumeration)})"
        case _ if type_ == BOOL:
            return "`bool`"
        case _:
            return f"`{type_text(type_, place)}`"


def _some(enumeration: Enumeration) -> str:
    shown = [str(value) for value in enumeration.values[:5]]
    return ", ".join(shown + ["…"] * (len(enumeration.values) > 5))


def type_text(type_: Type, place: Span) -> str:
    """A type as it is written in the form of a place."""
    return _python_type(type_) if place.source.python else str(type_)


def _python_type(type_: Type) -> str:
    match type_:
        case Primitive(name=name):
            return PYTHON_TYPES[name]
        case Interval(name=None, low=low, high=high):
            return f"interval({low}, {high})"
        case Enumeration(name=None, values=values):
            elements = [str(value) if isinstance(value, int) else f'"{value}"' for value in values]
            return f"enum({', '.join(elements)})"
        case Optional(base=base):
            return f"{_python_type(base)} | None"
        case Collection(kind=kind, element=element) if element.kinds:
            return f"{kind}[{_python_type(element)}]"
        case Either(one=one, other=other):
            return f"{_python_type(one)} or {_python_type(other)}"
        case _:
            return str(type_)


def name_text(name: str, place: Span) -> str:
    """A declared name as it is written in the form of a place: Python needs some names for itself."""
    if not place.source.python:
        return name
    return PYTHON_TYPES[name] if name in PYTHON_TYPES else python_name(name)


def word(text: str, place: Span) -> str:
    """A word of the language as it is written in the form of a place."""
    return WORDS.get(text, text) if place.source.python else text


def sign(text: str, place: Span) -> str:
    """An operator or quantifier of the term at a place, as it is written there."""
    if not place.source.python or text not in SIGNS:
        return text
    there = _SIGN.findall(place.text)
    return next((each for each in SIGNS[text] if each in there), SIGNS[text][0])


def joined_tightly(place: Span) -> bool:
    """Whether Python's ``&``, ``|`` or ``~`` stands beside a term: they bind more tightly than comparisons."""
    text = place.source.text
    before, behind = text[: place.start].rstrip(), text[place.end :].lstrip()
    return place.source.python and (before.endswith(("&", "|", "~")) or behind.startswith(("&", "|")))


def is_call(name: Span) -> bool:
    """Whether Python declares something by a call, not by a function, whose name is the place of its name then."""
    return name.source.python and not name.text.isidentifier()


def typed_declaration(kind: str, name: tree.Ident, type_: Type, value: str = "…") -> str:
    """A declaration of a fluent or a static that says its type, in the form in which it is declared."""
    place, written = name.span, type_text(type_, name.span)
    if is_call(place):
        return f'theory.{kind}("{name.text}", {written}, {value})'
    python = f"def {name_text(name.text, place)}(…) -> {written}: …"
    return place.either(f"{kind} {name.text}: {written} = {value}", python)


def setting_text(name: str, value: object, place: Span) -> str:
    """A setting of a device, in the form of a place."""
    return place.either(f"set {name} {value}", f'setting("{name}", {value})')


def behaviour_text(kind: str, name: str, place: Span) -> str:
    """What carries out a binding: ``call`` or ``start``, and the name of the behaviour."""
    return place.either(f"by {kind} {name}", f'{kind}="{name}"')


def add_a_brick(place: Span) -> str:
    """What helps where a theory has no brick."""
    golc, python = 'device rcx "behaviours.nqc":', '@theory.device("rcx", file="behaviours.nqc")'
    return f"add a block `{place.either(golc, python)}` with the actions that the brick does"
