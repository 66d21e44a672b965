"""Formulas on their way to the page: texts for a terminal and for LaTeX, and the places where a line may end."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TypeAlias

INDENT = 4


@dataclass(frozen=True)
class Text:
    """A piece of a line: in Unicode, and in LaTeX's mathematics."""

    plain: str
    tex: str


@dataclass(frozen=True)
class Line:
    """A place where a line may end: all those of a group do, or none. ``always``: it does in any case."""

    flat: Text = Text(" ", " ")
    always: bool = False


@dataclass(frozen=True)
class Join:
    parts: tuple[Document, ...]


@dataclass(frozen=True)
class Nest:
    """A part whose further lines are indented deeper."""

    body: Document


@dataclass(frozen=True)
class Group:
    """A part that stands in one line if there is room."""

    body: Document


Document: TypeAlias = Text | Line | Join | Nest | Group


@dataclass(frozen=True)
class Row:
    """A line of the page; ``indent`` counts columns."""

    indent: int
    texts: tuple[Text, ...]


def join(*parts: Document) -> Join:
    return Join(parts)


def separated(parts: Iterable[Document], *between: Document) -> Join:
    """The parts with the same things between each two of them."""
    rest = [(*between, part) for part in parts]
    return Join(tuple(chain(rest[0][len(between) :], *rest[1:]))) if rest else Join(())


_Waiting: TypeAlias = tuple[int, bool, Document]
"""What is still to be set: its indentation, and whether its lines may not end."""


def layout(document: Document, width: int) -> list[Row]:
    """The rows of a document; as wide as ``width`` columns where that is possible (Wadler's algorithm, made strict)."""
    rows: list[Row] = []
    texts: list[Text] = []
    begin = column = 0
    waiting: list[_Waiting] = [(0, False, document)]
    while waiting:
        indent, flat, part = waiting.pop()
        match part:
            case Text():
                texts.append(part)
                column += len(part.plain)
            case Line(flat=text, always=always) if flat and not always:
                texts.append(text)
                column += len(text.plain)
            case Line():
                rows.append(Row(begin, tuple(texts)))
                texts, begin, column = [], indent, indent
            case Group(body=body):
                fits = flat or _fits(width - column, (indent, True, body), waiting)
                waiting.append((indent, fits, body))
            case _:
                waiting.extend(_inside(indent, flat, part))
    return [*rows, Row(begin, tuple(texts))]


def _inside(indent: int, flat: bool, part: Join | Nest) -> Sequence[_Waiting]:
    """The parts of a part, the last one first."""
    if isinstance(part, Nest):
        return [(indent + INDENT, flat, part.body)]
    return [(indent, flat, each) for each in reversed(part.parts)]


def _fits(room: int, first: _Waiting, behind: Sequence[_Waiting]) -> bool:
    """Whether there is room for a part and what comes behind it, up to the next end of a line."""
    waiting, rest = [first], len(behind)
    while room >= 0 and (waiting or rest):
        if not waiting:
            rest -= 1
            waiting.append(behind[rest])
        indent, flat, part = waiting.pop()
        match part:
            case Text(plain=plain):
                room -= len(plain)
            case Line(flat=text, always=always):
                if not flat or always:
                    return not flat
                room -= len(text.plain)
            case Group(body=body):
                waiting.append((indent, flat, body))
            case _:
                waiting.extend(_inside(indent, flat, part))
    return room >= 0
