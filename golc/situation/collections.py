"""Collections and texts to Python expressions, for ``compile``: what is known while compiling is made only once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from golc.situation import guards
from golc.theory.order import elements, sort_key
from golc.theory.terms import Binder, Comprehension, Display, Literal, Term, Text, Variable
from golc.theory.types import Collection, Optional, Value

if TYPE_CHECKING:
    from golc.situation.compile import Cells, Compiler


def made(compiler: Compiler, term: Display | Comprehension | Text, cells: Cells, depth: int) -> str:
    """An expression for a collection or a text that is put together."""
    known, value = known_value(term, cells)
    if known:
        return compiler.constant(value)
    match term:
        case Text():
            texts = [f"{_text(compiler, part, cells, depth)}, " for part in term.parts]
            return f"''.join(({''.join(texts)}))"
        case Display():
            texts = [f"{compiler.expression(part, cells, depth)}, " for part in term.elements]
            return f"frozenset(({''.join(texts)}))" if _is_set(term) else f"({''.join(texts)})"
        case Comprehension():
            inner, clauses = compiler.loops(term.binders, term.where, cells, depth)
            kind = "set" if _is_set(term) else "list"
            gathered = compiler.bind("gathered", guards.gathered(term, kind))
            return f"{gathered}({compiler.expression(term.element, inner, depth)} {clauses})"


def _is_set(term: Term) -> bool:
    return isinstance(term.type, Collection) and term.type.kind == "set"


def _text(compiler: Compiler, part: str | Term, cells: Cells, depth: int) -> str:
    if isinstance(part, str):
        return repr(part)
    return f"{compiler.bind('text', guards.text(part.type))}({compiler.expression(part, cells, depth)})"


def run_through(compiler: Compiler, binder: Binder, cells: Cells, depth: int) -> str:
    """An expression for the values that a binder runs over, in order."""
    values = listed(binder, cells)
    if values is not None:
        return compiler.bind("values", values)
    assert binder.within is not None
    found = compiler.some(binder.within, cells, depth, "a collection")
    type_ = binder.within.type
    whole = type_.base if isinstance(type_, Optional) else type_
    assert isinstance(whole, Collection)
    if whole.kind == "list":
        return found
    key = sort_key(whole.element)
    return f"sorted({found})" if key is None else f"sorted({found}, key={compiler.bind('key', key)})"


def listed(binder: Binder, cells: Cells) -> Sequence[Value] | None:
    """The values that a binder runs over if they are known while compiling."""
    if binder.within is None:
        return binder.variable.type.values
    known, value = known_value(binder.within, cells)
    return elements(value, binder.within.type) if known and value is not None else None


def known_value(term: Term, cells: Cells) -> tuple[bool, Any]:
    """Whether a term has a value that is known while compiling, and this value."""
    match term:
        case Literal(value=value):
            return True, value
        case Variable(level=level) if level < len(cells):
            return cells[level].known, cells[level].value
        case Display(elements=parts):
            values = []
            for part in parts:
                known, value = known_value(part, cells)
                if not known:
                    return False, None
                values.append(value)
            return True, frozenset(values) if _is_set(term) else tuple(values)
        case _:
            return False, None
