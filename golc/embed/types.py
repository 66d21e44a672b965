"""Types as Python objects: handles of declared types, and the forms of the language that need no name."""

from __future__ import annotations

import typing
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from types import UnionType
from typing import TYPE_CHECKING, Any

from golc.diagnostics import Code, Span
from golc.embed import asked
from golc.embed.errors import Refused, meaningless, refused
from golc.embed.names import new_name
from golc.embed.owners import owned
from golc.embed.places import argument, caller, each_argument
from golc.embed.terms import Named, Term
from golc.embed.values import Meaningful, described, expr
from golc.syntax import tree

if TYPE_CHECKING:
    from golc.embed.parts import Parts

BUILT_IN: dict[object, str] = {bool: "bool", int: "int", float: "real", str: "string"}
"""Python's types for those that are built into the language."""


class TypeObject:
    """What stands for a type, and can be joined with others."""

    __slots__ = ()

    def __or__(self, other: object) -> TypeForm:
        """``t | None`` is the optional type, ``t | u`` the union."""
        return joined((self, other), caller())

    def __ror__(self, other: object) -> TypeForm:
        return joined((other, self), caller())

    def __contains__(self, item: object) -> bool:
        raise asked.membership(caller())


class TypeForm(TypeObject):
    """A type without a name; its ``node`` is the tree."""

    __slots__ = ("node",)

    def __init__(self, node: tree.Type) -> None:
        self.node = node

    def __repr__(self) -> str:
        from golc.syntax.notation import type_text

        return type_text(self.node)


class TypeHandle(TypeObject, Meaningful):
    """A declared type. Going through it gives its symbols and integers in order; ``phase.moving`` is a symbol.

    ``value``: what it stands for, if that is known where Python runs; ``home``: the parts of the theory that declares
    it. All that is not a symbol begins with ``_``, for a symbol may have any other name.
    """

    __slots__ = ("_home", "_listed", "_name", "_value")

    def __init__(self, name: str, value: tree.Type | None = None, home: Parts | None = None) -> None:
        self._name = owned(name, home)
        self._value = value
        self._home = home
        self._listed: list[Sequence[Named | int]] | None = None

    def __repr__(self) -> str:
        return self._name

    def _tree_at(self, span: Span) -> tree.Expr:
        """The type's name as the list of its values."""
        return tree.Apply(tree.Ident(self._name, span=span), (), span=span)

    def __iter__(self) -> Iterator[Named | int]:
        return chain.from_iterable(self._pieces())

    def __len__(self) -> int:
        return sum(len(piece) for piece in self._pieces())

    def __getattr__(self, name: str) -> Named:
        if not name.startswith("_") and (symbol := symbols_of(self).get(name)) is not None:
            return symbol
        raise AttributeError(f"the type `{self}` has no symbol `{name}`", name=name, obj=self)

    def _pieces(self) -> list[Sequence[Named | int]]:
        # The same symbols every time: they may be keys of a dictionary.
        if self._listed is None:
            self._listed = self._values(self._value)
        return self._listed

    def _values(self, node: tree.Type | None) -> list[Sequence[Named | int]]:
        match node:
            case tree.EnumType(elements=elements):
                return [[e.value if isinstance(e, tree.Number) else self._symbol(e.text) for e in elements]]
            case tree.IntervalType(low=low, high=high):
                return [range(self._bound(low), self._bound(high) + 1)]
            case tree.UnionType(pieces=pieces):
                return [value for piece in pieces for value in self._values(piece)]
            case tree.TypeName(name=name) if self._home is not None and (other := self._home.type_of(name.text)):
                return other._pieces()
        raise meaningless(f"the values of `{self}` cannot be listed here", caller())

    def _symbol(self, name: str) -> Named:
        return Named(owned(name, self._home), "symbol")

    def _bound(self, node: tree.Expr) -> int:
        match node:
            case tree.Number(value=value):
                return value
            case tree.Unary(op="-", operand=tree.Number(value=value)):
                return -value
        help_ = "go through them in a translated function, or keep the bound as a number of Python"
        raise meaningless(f"the values of `{self}` are not known before its constants are", caller(), help_)


def symbols_of(handle: TypeHandle) -> dict[str, Named]:
    """The symbols of a type by their names; its integers, which may be very many, are not gone through.

    Raises ``Refused`` if they are not known where Python runs.
    """
    pieces = [piece for piece in handle._pieces() if not isinstance(piece, range)]
    return {value.name: value for value in chain.from_iterable(pieces) if isinstance(value, Named)}


def is_enumeration(handle: TypeHandle) -> bool:
    """Whether a type is declared as one of symbols and integers."""
    return isinstance(handle._value, tree.EnumType)


def interval(low: object, high: object) -> TypeForm:
    """``low .. high``: the integers from one bound to the other, both included; bounds may be terms of constants."""
    span = caller()
    first, last = argument(span, 0, "low"), argument(span, 1, "high")
    return TypeForm(tree.IntervalType(expr(low, first), expr(high, last), span=span))


def enum(*elements: object) -> TypeForm:
    """``{a, b}``: symbols, named by strings, or integers, in their order."""
    span = caller()
    return TypeForm(enumeration(tuple(map(element, elements, each_argument(span, len(elements)))), span))


def enumeration(elements: tuple[tree.Ident | tree.Number, ...], span: Span) -> tree.EnumType:
    """The tree of an enumeration. Raises ``Refused`` for one of nothing."""
    if not elements:
        raise meaningless("an enumeration has at least one element", span, 'write `enum("red", "green")`')
    return tree.EnumType(elements, span=span)


def element(value: object, span: Span) -> tree.Ident | tree.Number:
    """An element of an enumeration. Raises ``Refused``."""
    match value:
        case str():
            return new_name(value, span)
        # What an enumeration names is declared there, whoever else has it.
        case TypeHandle(_name=name):
            return tree.Ident(str(name), span=span)
        case Named(name=name, kind=kind) if kind != "variable":
            return tree.Ident(str(name), span=span)
        case int() if not isinstance(value, bool):
            return tree.Number(value, span=span)
    several = isinstance(value, (list, tuple, set, frozenset))
    help_ = "write `enum(*names)` for all that a list has" if several else "write a string"
    raise refused(Code.PYTHON_VALUE, f"{described(value)} is no element of an enumeration", span, help_)


def union(*pieces: object) -> TypeForm:
    """``a + b``: every value of several types; a string names a type that is declared further down."""
    return joined(pieces, caller())


def optional(base: object) -> TypeForm:
    """``t?``: a type and the value ``None``; a string names a type that is declared further down."""
    return joined((base, None), caller())


def symbols(*names: str) -> Any:
    """The symbols of enumerations that have no name: ``red, green = symbols("red", "green")``; of one name itself."""
    return _one_or_all(Named(new_name(name, span).text, "symbol") for name, span in _placed(names))


def names(*names: str) -> Any:
    """What an imported file declares, types apart: ``bed, water = names("bed", "water")``; of one name itself."""
    return _one_or_all(Named(new_name(name, span, used=True).text, "name") for name, span in _placed(names))


def types(*names: str) -> Any:
    """The types that an imported file declares: ``row, soil = types("row", "soil")``; of one name itself."""
    return _one_or_all(TypeHandle(new_name(name, span, used=True).text) for name, span in _placed(names))


def _placed(names: Sequence[str]) -> Iterator[tuple[str, Span]]:
    return zip(names, each_argument(caller(), len(names)), strict=True)


def _one_or_all(things: Iterable[object]) -> object:
    found = tuple(things)
    return found[0] if len(found) == 1 else found


def joined(parts: tuple[object, ...], span: Span) -> TypeForm:
    """The union of some types, with ``None`` among them the optional type of the others."""
    pieces = [type_node(part, span) for part in parts if part is not None]
    return TypeForm(join_nodes(pieces, len(pieces) < len(parts), span))


def join_nodes(parts: list[tree.Type], nothing: bool, span: Span) -> tree.Type:
    """The tree of a union, or of the optional type of one. Raises ``Refused`` where a part cannot be one."""
    pieces = [piece for part in parts for piece in (part.pieces if isinstance(part, tree.UnionType) else (part,))]
    if not pieces:
        help_ = 'write `station | None` or `station | enum("table")`'
        raise meaningless("there is no type to be joined", span, help_)
    inner: list[tree.TypeName | tree.IntervalType | tree.EnumType] = []
    for piece in pieces:
        if isinstance(piece, tree.OptionalType) and (len(pieces) > 1 or nothing):
            raise meaningless("`None` can stand only at the end of a union, once", span)
        if isinstance(piece, (tree.TypeName, tree.IntervalType, tree.EnumType)):
            inner.append(piece)
        elif len(pieces) > 1:
            raise meaningless("a set or a list cannot be joined with another type", span)
    whole: tree.Type = pieces[0] if len(pieces) == 1 else tree.UnionType(tuple(inner), span=span)
    return tree.OptionalType(whole, span=span) if nothing else whole


def type_node(value: object, span: Span) -> tree.Type:
    """The tree of a Python object that stands for a type; a string names one that is declared somewhere.

    Raises ``Refused`` for anything else.
    """
    match value:
        case TypeHandle(_name=name):
            return tree.TypeName(tree.Ident(name, span=span), span=span)
        case TypeForm(node=node):
            return node
        case str():
            return tree.TypeName(new_name(value, span), span=span)
        case range(start=start, stop=stop, step=1):
            return tree.IntervalType(expr(start, span), expr(stop - 1, span), span=span)
    if is_built_in(value):
        return tree.TypeName(tree.Ident(BUILT_IN[value], span=span), span=span)
    origin, args = typing.get_origin(value), typing.get_args(value)
    if origin in (typing.Union, UnionType):
        return joined(tuple(None if arg is type(None) else arg for arg in args), span).node
    if origin in (set, list) and len(args) == 1:
        return tree.CollectionType("set" if origin is set else "list", type_node(args[0], span), span=span)
    raise _no_type(value, span)


def is_built_in(value: object) -> bool:
    """Whether a value is a class of Python that is also a type of the language."""
    return any(value is each for each in BUILT_IN)


def _no_type(value: object, span: Span) -> Refused:
    if value is type(None):
        return meaningless("`None` alone is no type", span, "write `t | None` for a type and the value `None`")
    if value is set or value is list:
        return meaningless("a set or a list needs the type of its elements", span, "write `set[station]`")
    help_ = "`bool`, `int`, `str`, `float`, `interval(1, 6)`, `enum(…)` and declared types are types"
    if isinstance(value, Term):
        return refused(Code.MISUSED_NAME, f"`{value!r}` is no type", span, help_)
    if isinstance(value, (list, tuple, set, frozenset)):
        help_ = "write `enum(…)` around its elements, `enum(*names)` for all that a list has"
    what = described(value) if typing.get_origin(value) is None else f"`{value}`"
    return refused(Code.PYTHON_VALUE, f"{what} is no type of the language", span, help_)
