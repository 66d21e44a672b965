"""Operations on sets and lists whose operands are elaborated already."""

from __future__ import annotations

from typing import Literal as OneOf
from typing import TypeAlias

from golc.diagnostics import Code, Span, counted
from golc.theory.context import Context
from golc.theory.expectations import both, broken, cure, fits, mismatch, shown
from golc.theory.fitting import BROKEN, NOTHING, Either, collection, includes, is_undetermined, join, may_be, overlap
from golc.theory.relations import common
from golc.theory.terms import Binder, Comprehension, Display, Literal, Operation, Operator, Term
from golc.theory.types import INT, Collection, Type

CollectionKind: TypeAlias = OneOf["set", "list"]

COMBINING = {
    ("set", "+"): Operator.UNION,
    ("set", "-"): Operator.DIFFERENCE,
    ("list", "+"): Operator.CONCATENATION,
    ("list", "-"): Operator.REMOVAL,
}


def of_elements(hint: Type | None) -> Type | None:
    """What is needed of the elements, if a set or list is needed."""
    whole = collection(hint)
    return hint if whole is None else whole.element  # the hint may be BROKEN, otherwise it is of no use


def display(context: Context, kind: CollectionKind, elements: list[Term], hint: Type | None, span: Span) -> Term:
    """``{a, b}`` or ``[a, b]``; of the type that is needed (``hint``) if all elements certainly fit there."""
    needed = _needed(kind, hint)
    if BROKEN in [hint, *[element.type for element in elements]]:
        return broken(span)
    if needed is not None and all(_is_certain(element, needed.element) for element in elements):
        return Display(tuple(elements), type=needed, span=span)
    if not _go_together(context, kind, elements, needed):
        return broken(span)
    return Display(tuple(elements), type=Collection(kind, common(elements)), span=span)


def comprehension(
    kind: CollectionKind,
    binders: tuple[Binder, ...],
    where: Term | None,
    element: Term,
    hint: Type | None,
    span: Span,
) -> Term:
    """``{e for … where φ}`` or ``[…]``; of the type that is needed if e certainly fits there."""
    if BROKEN in [element.type, *[binder.variable.type for binder in binders]]:
        return broken(span)
    needed = _needed(kind, hint)
    sure = needed is not None and _is_certain(element, needed.element)
    type_ = needed if needed is not None and sure else Collection(kind, element.type)
    return Comprehension(binders, where, element, type=type_, span=span)


def _needed(kind: CollectionKind, hint: Type | None) -> Collection | None:
    """The hint, if it says what the elements of such a collection have to be."""
    needed = collection(hint)
    return None if needed is None or needed.kind != kind or is_undetermined(needed) else needed


def _is_certain(element: Term, type_: Type) -> bool:
    if isinstance(element, Literal):
        return may_be(element.type, type_) and element.value in type_
    return includes(type_, element.type)


def _go_together(context: Context, kind: CollectionKind, elements: list[Term], needed: Collection | None) -> bool:
    """Whether elements may stand in one collection: they have a type in common, or all fit where they are needed."""
    found: Type = NOTHING
    for element in elements:
        joined = join(found, element.type)
        if joined is None and needed is not None:
            what = f"an element of this {kind}"
            return all([fits(context, each, needed.element, what) for each in elements])  # noqa: C419 (all findings)
        if joined is None:
            message = f"{both(elements[0], element)} cannot be in one {kind}"
            context.error(Code.TYPE_MISMATCH, message, element.span, "their types have nothing in common")
            return False
        found = joined
    return True


def determined(context: Context, found: Term) -> Term:
    """A term with whose type something is declared: an empty set or list has to say what its elements are."""
    if not is_undetermined(found.type):
        return found
    message = f"nothing says what the elements of `{shown(found)}` are"
    example = found.span.either("static nobody: set[int] = {}", 'nobody = theory.static("nobody", set[int], set())')
    help_ = f"write it where its type is known, for example `{example}`"
    context.error(Code.BAD_TYPE, message, found.span, "empty, of no type", help_)
    return broken(found.span)


def combined(context: Context, sign: str, left: Term, right: Term, hint: Type | None, span: Span) -> Term:
    """``+`` or ``-`` of a set or list and another of its kind."""
    one, other = collection(left.type), collection(right.type)
    assert one is not None
    if right.type is BROKEN:
        return broken(span)
    if other is None or other.kind != one.kind:
        mismatch(context, right, f"a {one.kind}", f"`{sign}` after a {one.kind}", cure(right, one))
        return broken(span)
    type_: Type | None = join(one, other) if sign == "+" else one if overlap(one, other) else None
    needed = _needed(one.kind, hint)
    if type_ is None and sign == "+" and needed and may_be(one, needed) and may_be(other, needed):
        type_ = Collection(one.kind, Either(one.element, other.element))
    if type_ is None:
        message = f"{both(left, right)} have no elements in common"
        context.error(Code.TYPE_MISMATCH, message, span, f"`{sign}` needs elements of one type")
        return broken(span)
    return Operation(COMBINING[one.kind, sign], (left, right), type=type_, span=span)


def length(context: Context, found: Term, span: Span) -> Term:
    """``len(c)``."""
    if found.type is BROKEN:
        return broken(span)
    if collection(found.type) is None:
        mismatch(context, found, "a set or a list", "`len`")
        return broken(span)
    return Operation(Operator.LENGTH, (found,), type=INT, span=span)


def end(context: Context, op: Operator, found: Term, span: Span) -> Term:
    """``first(l)`` or ``rest(l)``."""
    whole = _list(context, found, f"`{op.value}`")
    if whole is None:
        return broken(span)
    if _known_length(found) == 0:
        context.error(Code.NO_VALUE, f"`{op.value}` of an empty list has no value", span, "the list is empty")
        return broken(span)
    return Operation(op, (found,), type=whole.element if op is Operator.FIRST else whole, span=span)


def indexed(context: Context, found: Term, place: Term, span: Span) -> Term:
    """``l[i]``."""
    whole = _list(context, found, "`[…]`")
    if whole is None or not fits(context, place, INT, "a place in a list"):
        return broken(span)
    number = place.value if isinstance(place, Literal) and isinstance(place.value, int) else 0
    length = _known_length(found)
    if number < 0 or (length is not None and number >= length):
        size = "" if length is None else f" of {counted(length, 'element')}"
        help_ = f"the last one is `{shown(found)}[len({shown(found)}) - 1]`" if number < 0 else None
        context.error(
            Code.NO_VALUE, f"place {number} is outside a list{size}", place.span, "places are counted from 0", help_
        )
        return broken(span)
    return Operation(Operator.INDEX, (found, place), type=whole.element, span=span)


def _list(context: Context, found: Term, what: str) -> Collection | None:
    """The type of a term that has to be a list; of any other one a finding."""
    whole = collection(found.type)
    if whole is not None and whole.kind == "list":
        return whole
    if found.type is not BROKEN:
        help_ = None if whole is None else "a set has no order; `[x for x in …]` makes a list of it"
        mismatch(context, found, "a list", what, help_)
    return None


def _known_length(found: Term) -> int | None:
    match found:
        case Display(elements=elements):
            return len(elements)
        case Literal(value=tuple() as value):
            return len(value)
        case _:
            return None
