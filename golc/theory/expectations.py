"""What a term has to be where it stands, and what to say if it is not."""

from __future__ import annotations

from golc.diagnostics import Code, Span
from golc.theory.blame import Matter, Suspect
from golc.theory.context import Context
from golc.theory.fitting import BROKEN, collection, may_be, overlap, strip_optional
from golc.theory.forms import describe, joined_tightly, type_text, word
from golc.theory.terms import (
    Comprehension,
    DefinedTerm,
    Display,
    FluentTerm,
    Literal,
    Operation,
    Operator,
    Quantified,
    StaticTerm,
    Term,
    Variable,
)
from golc.theory.types import BOOL, NONE, REAL, STRING, Optional, Type, show

AGGREGATES = ("`sum`", "`min`", "`max`")


def broken(span: Span) -> Term:
    """What stands for a term that could not be elaborated."""
    return Literal(None, type=BROKEN, span=span)


def fits(context: Context, found: Term, needed: Type, what: str, declared: Span | None = None) -> bool:
    """Whether a term may have a value of a type; otherwise a finding. Constants have to be values of it.

    ``what`` says for what it is needed, and ``declared`` is the place of the name that has the type, if there is one.
    """
    stack, good = [(found, needed, what)], True
    while stack:
        part, wanted, place = stack.pop()
        inside, wanted_inside = _inside(part, wanted)
        if inside:
            place = place if wanted_inside == wanted else f"an element of {place}"
            stack.extend([(each, wanted_inside, place) for each in reversed(inside)])
        elif not may_be(part.type, wanted):
            mismatch(context, part, describe(wanted, part.span), place, cure(part, wanted), declared)
            good = False
        elif isinstance(part, Literal) and part.type is not BROKEN and part.value not in wanted:
            value = "" if shown(part) == show(part.value) else f" is {show(part.value)}, which"
            type_ = describe(wanted, part.span)
            message = f"`{shown(part)}`{value} is outside {type_}"
            context.error(Code.OUTSIDE_TYPE, message, part.span, f"{place} needs {type_}")
            good = False
        else:
            context.complaints.clear(suspects(context, part, declared=declared))
    return good


def suspects(context: Context, *terms: Term, declared: Span | None = None) -> list[Suspect]:
    """The declarations that give some terms their types, and that of what needs one."""
    places = [place for found in terms if (place := _declared(context, found)) is not None]
    matter = Matter.NONE if any(found.type == NONE for found in terms) else Matter.TYPE
    return [Suspect(matter, place) for place in ([*places, declared] if declared is not None else places)]


def _declared(context: Context, found: Term) -> Span | None:
    match found:
        case Variable(bound=place) if place.end:
            return place
        case FluentTerm(fluent=name) | StaticTerm(static=name) | DefinedTerm(definition=name):
            return context.names.values.entries[name].span
        case _:
            return None


def _inside(found: Term, needed: Type) -> tuple[tuple[Term, ...], Type]:
    """The parts of a term of which its value is made, and the type that they need."""
    whole = collection(needed)
    if isinstance(found, Operation) and found.op is Operator.CONDITIONAL:
        return (found.args[0], found.args[2]), needed
    if whole is None or found.type.kinds != whole.kinds:
        return (), needed
    match found:
        case Operation(op=Operator.UNION | Operator.CONCATENATION, args=args):
            return args, needed
        case Operation(op=Operator.DIFFERENCE | Operator.REMOVAL, args=(left, _)):
            return (left,), needed
        case Display(elements=elements):
            return elements, whole.element
        case Comprehension(element=element):
            return (element,), whole.element
        case _:
            return (), needed


def as_number(context: Context, found: Term, what: str) -> Term:
    """A term, if it may be a number; ``what`` says for what one is needed."""
    if may_be(found.type, REAL):
        if found.type is not BROKEN:
            context.complaints.clear(suspects(context, found))
        return found
    help_ = cure(found, REAL)
    if found.type == STRING and what == "`+`":
        help_ = f'`{found.span.either("", "f")}"{{…}}{{…}}"` puts texts together'
    elif found.type == BOOL and what == "`sum`" and found.span.source.python:
        help_ = "`count(φ for n in station)` is how often something is true"
    elif isinstance(found, Operation) and found.type == BOOL and what in AGGREGATES and not found.span.source.python:
        help_ = parentheses(what.strip("`"))
    mismatch(context, found, "a number", what, help_)
    return broken(found.span)


def mismatch(
    context: Context, found: Term, needed: str, what: str, help: str | None = None, declared: Span | None = None
) -> None:
    """Report a term of the wrong type."""
    blamed = suspects(context, found, declared=declared)
    if found.type == NONE:
        none = word("none", found.span)
        message = f"{what} needs {needed}, and `{none}` is no such value"
        context.error(Code.TYPE_MISMATCH, message, found.span, f"never `{none}`", help, suspects=blamed)
    else:
        type_ = f"of type {describe(found.type, found.span)}"
        message = f"`{shown(found)}` is {type_}, but {what} needs {needed}"
        context.error(Code.TYPE_MISMATCH, message, found.span, f"this is {type_}", help, suspects=blamed)


def cure(found: Term, needed: Type) -> str | None:
    """What helps against a term of the wrong type, if that can be seen."""
    have, want = collection(found.type), collection(needed)
    place = found.span
    if isinstance(found, Literal) and needed == BOOL:
        return f"a truth value is `{word('true', place)}` or `{word('false', place)}`"
    if isinstance(found, Literal) and found.value is None:
        return f"the type `{type_text(Optional(needed), place)}` has the value `{word('none', place)}`, too"
    if needed == BOOL and isinstance(found, Quantified) and not place.source.python:
        return parentheses(found.kind)
    if needed == BOOL and have:
        empty = "[]" if have.kind == "list" else place.either("{}", "set()")
        text = shown(found)
        return f"compare it: `{text} != {empty}`; ask: `x in {text}`; `+` joins it with another"
    if needed == BOOL:
        compared = f"{shown(found)} {place.either('=', '==')} …"
        return f"compare it: `{f'({compared})' if joined_tightly(place) else compared}`"
    if have and want and have.kind != want.kind and not have.element.kinds:
        return f"the empty {want.kind} is `{place.either('{}', 'set()') if want.kind == 'set' else '[]'}`"
    if have and want and have.kind != want.kind:
        brackets = "{x for x in …}" if want.kind == "set" else "[x for x in …]"
        return f"`{brackets}` makes a {want.kind} of a {have.kind}"
    if want and not have and overlap(found.type, want.element):
        one = f"{{{shown(found)}}}" if want.kind == "set" else f"[{shown(found)}]"
        return f"`{one}` is a {want.kind} with one element"
    if found.type == REAL and "int" in needed.kinds:
        return f"`{shown(found)} // 1` is the integer below it"
    if found.type == STRING and not {"string", "int", "real"} & needed.kinds:
        return _without_quotes(found, needed)
    return None


def _without_quotes(found: Term, needed: Type) -> str:
    if not found.span.source.python:
        return "values of an enumeration stand without quotes"
    if not isinstance(found, Literal):
        return "a string of Python is no symbol"
    owner = str(strip_optional(needed))
    symbol = f"{owner}.{found.value}" if owner.isidentifier() else f'symbols("{found.value}")'
    return f"a string of Python is no symbol: write `{symbol}`"


def parentheses(kind: str, op: str = "=") -> str:
    """What helps against an aggregate that takes in the comparison it was to be a part of."""
    return f"write `({kind} …) {op} …`: without parentheses `{kind}` takes in everything to its right"


def shown(found: Term) -> str:
    """A term as it is written, for a message; a long one is cut off."""
    text = " ".join(found.span.text.split())
    return text if 0 < len(text) <= 40 else text[:39] + "…" if text else "this term"


def typed(found: Term) -> str:
    """A term with its type, for a message."""
    type_ = strip_optional(found.type)
    of_type = f", which is of type `{type_text(type_, found.span)}`,"
    return f"`{shown(found)}`" + ("" if found.type == NONE else of_type)


def both(left: Term, right: Term) -> str:
    """Two terms with their types, for a message."""
    return f"{typed(left)} and {typed(right)}"
