"""A page about a name: a title, and sections of formulas."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from golc.diagnostics import Span
from golc.explain import signs
from golc.explain.document import Document, Group, Line, Nest, Text, join
from golc.explain.pieces import infixed
from golc.theory.theory import Parameter


@dataclass(frozen=True)
class Section:
    """Formulas below a heading."""

    heading: str
    formulas: tuple[Document, ...]


@dataclass(frozen=True)
class Page:
    """``title`` says what it is; ``span`` is where its name is declared, if that is a declaration of its own."""

    title: str
    span: Span | None
    sections: tuple[Section, ...]


def head(kind: str, name: str, parameters: Sequence[Parameter]) -> str:
    """``action go(n: floor)``."""
    inside = ", ".join(f"{parameter.name}: {parameter.type}" for parameter in parameters)
    return f"{kind} {name}({inside})" if inside else f"{kind} {name}"


def says(left: Document, sign: Text, right: Document) -> Document:
    """``left ≡ right``, with the right side below the left one if there is no room beside it."""
    return Group(join(left, Text(f" {sign.plain.strip()}", f" {sign.tex.strip()}"), Nest(join(Line(), right))))


def implied(conditions: Sequence[Document], conclusion: Document) -> Document:
    """``φ ∧ ψ ⊃ χ``."""
    return infixed(signs.IMPLIES, [conjunction(conditions), conclusion]) if conditions else conclusion


def conjunction(parts: Sequence[Document]) -> Document:
    """``φ ∧ ψ``."""
    return infixed(signs.AND, parts) if len(parts) > 1 else parts[0]


def enclosed(body: Document) -> Document:
    return join(signs.sign("("), body, signs.sign(")"))


def called(name: str, *args: Document) -> Document:
    """``do(a, s)`` and the like."""
    return join(signs.words(name), signs.sign("("), _commas(args), signs.sign(")"))


def _commas(args: Iterable[Document]) -> Document:
    first, *others = args
    return join(first, *(join(signs.sign(", "), other) for other in others))
