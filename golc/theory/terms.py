"""Typed terms: what the elaborator makes of expressions.

A formula is a term of type ``bool``. Names are resolved: constants are literals, variables know their *level*, the
number of variables that are in scope around their binder (the parameters of an action or procedure are levels 0, 1, …).
Terms are compared by structure; spans and the names of variables take no part.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Literal as OneOf
from typing import TypeAlias

from golc.diagnostics import NOWHERE, Span
from golc.theory.types import Type, Value


@dataclass(frozen=True)
class Base:
    """The base of all terms."""

    type: Type = field(kw_only=True)
    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class Literal(Base):
    value: Value


@dataclass(frozen=True)
class Variable(Base):
    """A parameter or a bound variable; ``level`` counts the variables in scope outside its own binder."""

    level: int
    name: str = field(compare=False)
    bound: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)
    """Where it is bound."""


@dataclass(frozen=True)
class FluentTerm(Base):
    """The value of a fluent in the current situation."""

    fluent: str
    args: tuple[Term, ...]


@dataclass(frozen=True)
class StaticTerm(Base):
    static: str
    args: tuple[Term, ...]


@dataclass(frozen=True)
class DefinedTerm(Base):
    """A definition applied to its arguments."""

    definition: str
    args: tuple[Term, ...]


@dataclass(frozen=True)
class PossTerm(Base):
    """``poss(a(e, …))``: the action's precondition."""

    action: str
    args: tuple[Term, ...]


class Operator(Enum):
    """The operations, each with the token that writes it. All operands are evaluated but where it says otherwise."""

    ADD = "+"
    SUBTRACT = "-"
    MULTIPLY = "*"
    DIVIDE = "//"
    """Floors; a division by zero is an error."""
    MODULO = "%"
    """Takes the divisor's sign; a division by zero is an error."""
    NEGATE = "neg"
    ABSOLUTE = "abs"
    MINIMUM = "min"
    """Any number of operands."""
    MAXIMUM = "max"
    EQUAL = "="
    DIFFERENT = "!="
    LESS = "<"
    """Integers by value; symbols by their place in ``Operation.order``."""
    LESS_EQUAL = "<="
    GREATER = ">"
    GREATER_EQUAL = ">="
    NOT = "not"
    AND = "and"
    """From left to right, stops at the first false one. Any number of operands (at least two)."""
    OR = "or"
    """From left to right, stops at the first true one. Any number of operands (at least two)."""
    IMPLIES = "implies"
    """The right side is evaluated only if the left one holds."""
    IFF = "iff"
    UNION = "set +"
    DIFFERENCE = "set -"
    CONCATENATION = "list +"
    REMOVAL = "list -"
    """The elements of the left list that do not occur in the right one."""
    ELEMENT = "in"
    """Whether the left operand is an element of the right one, a collection."""
    INDEX = "[]"
    """An element of a list, counted from 0; an error outside of it."""
    LENGTH = "len"
    FIRST = "first"
    """Of a list; an error if it is empty, as is ``rest``."""
    REST = "rest"
    CONDITIONAL = "if"
    """Operands: then, condition, otherwise. The condition is evaluated first, then one of the two."""


@dataclass(frozen=True)
class Operation(Base):
    """An operator applied to its operands.

    ``order`` is given for comparisons of symbols by ``< <= > >=``: the values in the order that decides.
    """

    op: Operator
    args: tuple[Term, ...]
    order: tuple[Value, ...] | None = None


@dataclass(frozen=True)
class Membership(Base):
    """``x in t`` for a finite type (``not in`` is its negation)."""

    element: Term
    within: Type


@dataclass(frozen=True)
class Binder:
    """A variable that runs over the values of a finite type or, if ``within`` is given, over those of a collection.

    ``within`` is a term over the variables in scope outside this binder. A set is run through in the order of its
    elements' type, a list in its own order.
    """

    variable: Variable
    within: Term | None = None

    @property
    def values(self) -> tuple[Value, ...]:
        return tuple(self.variable.type.values)


@dataclass(frozen=True)
class Quantified(Base):
    """A quantifier or an aggregate. ``where`` restricts the bindings; an empty ``min`` or ``max`` is an error.

    ``exists`` and ``forall`` stop at the first binding that decides.
    """

    kind: OneOf["exists", "forall", "count", "sum", "min", "max"]
    binders: tuple[Binder, ...]
    where: Term | None
    body: Term


@dataclass(frozen=True)
class Display(Base):
    """``{a, b}`` or ``[a, b]``; the type says which."""

    elements: tuple[Term, ...]


@dataclass(frozen=True)
class Comprehension(Base):
    """``{e for x: t where φ}`` or ``[…]``; the type says which. A list has the order of the bindings."""

    binders: tuple[Binder, ...]
    where: Term | None
    element: Term


@dataclass(frozen=True)
class Text(Base):
    """A string: pieces of text and the texts of terms, put together."""

    parts: tuple[str | Term, ...]


@dataclass(frozen=True)
class Epistemic(Base):
    """What the agent knows now: ``knows(φ)``, ``possible(φ)``, or the known value of a term (``known(e)``: whether all
    possible worlds agree on it)."""

    kind: OneOf["known", "knows", "possible"]
    body: Term


@dataclass(frozen=True)
class Before(Base):
    """``before(e)``: what a term was in the situation before the last action; in a ``prune`` only."""

    body: Term


Term: TypeAlias = (
    Literal
    | Variable
    | FluentTerm
    | StaticTerm
    | DefinedTerm
    | PossTerm
    | Operation
    | Membership
    | Quantified
    | Display
    | Comprehension
    | Text
    | Epistemic
    | Before
)


@dataclass(frozen=True)
class Choice(Base):
    """``unknown`` or ``one of e``: afterwards any element of ``among`` is possible. A value of a fluent, not a term.

    ``among`` is a term whose type is a collection; for ``unknown`` the literal list of the fluent's values.
    """

    among: Term


def subterms(term: Term) -> Iterator[Term]:
    """The term and every term inside it, outermost first; no recursion, for the depth is the input's."""
    stack = [term]
    while stack:
        term = stack.pop()
        yield term
        stack.extend(reversed(children(term)))


def children(term: Term) -> tuple[Term, ...]:
    """The terms directly inside a term, in the order in which they are written."""
    match term:
        case (
            FluentTerm(args=args)
            | StaticTerm(args=args)
            | DefinedTerm(args=args)
            | PossTerm(args=args)
            | Operation(args=args)
        ):
            return args
        case Membership(element=element):
            return (element,)
        case (
            Quantified(binders=binders, where=where, body=body)
            | Comprehension(binders=binders, where=where, element=body)
        ):
            return (*ranges(binders), *(() if where is None else (where,)), body)
        case Display(elements=elements):
            return elements
        case Text(parts=parts):
            return tuple([part for part in parts if not isinstance(part, str)])
        case Epistemic(body=body) | Before(body=body):
            return (body,)
        case _:
            return ()


def ranges(binders: tuple[Binder, ...]) -> tuple[Term, ...]:
    """The collections that binders run over."""
    return tuple([binder.within for binder in binders if binder.within is not None])


def with_children(term: Term, inside: tuple[Term, ...]) -> Term:
    """The term with others in place of its ``children``."""
    match term:
        case FluentTerm() | StaticTerm() | DefinedTerm() | PossTerm() | Operation():
            return replace(term, args=inside)
        case Membership():
            return replace(term, element=inside[0])
        case Quantified(where=where):
            found = None if where is None else inside[-2]
            return replace(term, binders=_with_ranges(term.binders, inside), where=found, body=inside[-1])
        case Comprehension(where=where):
            found = None if where is None else inside[-2]
            return replace(term, binders=_with_ranges(term.binders, inside), where=found, element=inside[-1])
        case Display():
            return replace(term, elements=inside)
        case Text(parts=parts):
            rest = iter(inside)
            return replace(term, parts=tuple([part if isinstance(part, str) else next(rest) for part in parts]))
        case Epistemic() | Before():
            return replace(term, body=inside[0])
        case _:
            return term


def _with_ranges(binders: tuple[Binder, ...], within: tuple[Term, ...]) -> tuple[Binder, ...]:
    """Binders that run over other collections, the first ones of some terms."""
    rest = iter(within)
    return tuple([binder if binder.within is None else replace(binder, within=next(rest)) for binder in binders])
