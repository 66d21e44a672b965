"""Laying out Python: what does not fit into a line is broken as ``ruff format`` breaks it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

INDENT = 4
WIDTH = 120


@dataclass(frozen=True)
class Joined:
    """Parts one behind the other."""

    parts: tuple[Doc, ...]


@dataclass(frozen=True)
class Chain:
    """Operands with operators of one level between them; a line may end before each operator."""

    level: int
    first: Doc
    rest: tuple[tuple[str, Doc], ...]


@dataclass(frozen=True)
class Brackets:
    """Items in brackets, which may stand in lines of their own.

    ``separator`` stands between them; ``packed``: they may share one line between those of the brackets; ``trailing``:
    the separator also follows on a single item, as it does on several.
    """

    opening: str
    items: tuple[Doc, ...]
    closing: str
    separator: str = ","
    packed: bool = True
    trailing: bool = False


Doc: TypeAlias = str | Joined | Chain | Brackets


@dataclass(frozen=True)
class _Break:
    """A line end, or the text that stands in its place if all is in one line."""

    flat: str


_Part: TypeAlias = Doc | _Break


def laid_out(doc: Doc, indent: int) -> list[str]:
    """The lines of a statement, which can be broken only inside its brackets."""
    return [" " * indent + line if line else line for line in _Layout(WIDTH - indent).run(_unbroken(doc))]


def laid_out_value(before: str, value: Doc, behind: str, indent: int) -> list[str]:
    """The lines of a statement with a value that may be put into parentheses, so that it can be broken anywhere."""
    whole = Joined((before, _unbroken(value), behind))
    lines = _Layout(WIDTH - indent).run(whole)
    too_long = len(lines[0]) > WIDTH - indent
    if too_long or (len(lines) > 1 and not _breaks_inside(value)):
        lines = _Layout(WIDTH - indent).run(Joined((before, Brackets("(", (value,), ")"), behind)))
    return [" " * indent + line for line in lines]


def one_line(doc: Doc) -> str:
    """The text without any line end."""
    return "\n".join(_Layout(1 << 60).run(doc))


class _Layout:
    """Writes a document into lines of a width; stacks instead of recursion, for it may be deep."""

    def __init__(self, width: int) -> None:
        self.width = width
        self.lines = [""]
        self.stack: list[tuple[_Part, int, bool]] = []

    def run(self, doc: Doc) -> list[str]:
        self.stack.append((doc, 0, False))
        while self.stack:
            part, indent, flat = self.stack.pop()
            match part:
                case str():
                    self.lines[-1] += part
                case _Break(flat=text):
                    if flat:
                        self.lines[-1] += text
                    else:
                        self.lines.append(" " * indent)
                case Joined(parts=parts):
                    self.push(parts, indent, flat)
                case Chain():
                    self.push(_operands(part), indent, flat or self.fits(part))
                case Brackets():
                    self.brackets(part, indent, flat)
        return self.lines

    def brackets(self, doc: Brackets, indent: int, flat: bool) -> None:
        if flat or not doc.items or self.fits(doc):
            self.push(_bracketed(doc), indent, True)
            return
        self.push((_Break(""), doc.closing), indent, False)
        items = _items(doc)
        inside = self.width - indent - INDENT
        if doc.packed and _fits(inside, [(item, True) for item in reversed(items)], []):
            self.push(items, indent + INDENT, True)
        else:
            many = doc.trailing or len(doc.items) > 1
            self.push((*items, doc.separator if many else ""), indent + INDENT, False)
        self.push((doc.opening, _Break("")), indent + INDENT, False)

    def push(self, parts: tuple[_Part, ...], indent: int, flat: bool) -> None:
        self.stack.extend((part, indent, flat) for part in reversed(parts))

    def fits(self, doc: Doc) -> bool:
        """Whether it fits into the line, with what follows up to the next place where the line may end."""
        return _fits(self.width - len(self.lines[-1]), [(doc, True)], self.stack)


def _fits(room: int, todo: list[tuple[_Part, bool]], behind: list[tuple[_Part, int, bool]]) -> bool:
    following = len(behind)
    while room >= 0:
        if not todo:
            if not following:
                return True
            following -= 1
            todo.append((behind[following][0], behind[following][2]))
        part, flat = todo.pop()
        match part:
            case str():
                room -= len(part)
            case _Break(flat=text):
                if not flat:
                    return True
                room -= len(text)
            case Joined(parts=parts):
                todo.extend((each, flat) for each in reversed(parts))
            case Chain():
                todo.extend((each, flat) for each in reversed(_operands(part)))
            case Brackets():
                todo.extend((each, flat) for each in reversed(_bracketed(part)))
    return False


def _operands(chain: Chain) -> tuple[_Part, ...]:
    parts: list[_Part] = [chain.first]
    for operator, operand in chain.rest:
        parts += [_Break(" "), f"{operator} ", operand]
    return tuple(parts)


def _bracketed(doc: Brackets) -> tuple[_Part, ...]:
    if not doc.items:
        return (doc.opening, doc.closing)
    return (doc.opening, _Break(""), *_items(doc), _Break(""), doc.closing)


def _items(doc: Brackets) -> tuple[_Part, ...]:
    parts: list[_Part] = [doc.items[0]]
    for item in doc.items[1:]:
        parts += [doc.separator, _Break(" "), item]
    return tuple(parts)


def _unbroken(doc: Doc) -> Doc:
    """The document without places for a line end but those inside brackets."""
    match doc:
        case Joined(parts=parts):
            return Joined(tuple(_unbroken(part) for part in parts))
        case Chain(first=first, rest=rest):
            flat = (part for operator, operand in rest for part in (f" {operator} ", _unbroken(operand)))
            return Joined((_unbroken(first), *flat))
    return doc


def _breaks_inside(doc: Doc) -> bool:
    """Whether a long value is broken in its first or last brackets, rather than at its operators in parentheses."""
    levels = sorted(_levels(doc))
    few = len(levels) < 2 or levels[0] < levels[1]
    return few and (not levels or _is_bracket(_end(doc, -1)) or _is_bracket(_end(doc, 0)))


def _levels(doc: Doc) -> Iterator[int]:
    """The level of each operator outside brackets."""
    match doc:
        case Joined(parts=parts):
            for part in parts:
                yield from _levels(part)
        case Chain(level=level, first=first, rest=rest):
            yield from _levels(first)
            for _, operand in rest:
                yield level
                yield from _levels(operand)


def _end(doc: Doc, place: int) -> Doc:
    """The first (0) or last (-1) part that is not made of others."""
    while True:
        match doc:
            case Joined(parts=parts):
                doc = parts[place]
            case Chain(first=first, rest=rest):
                doc = rest[-1][1] if place else first
            case _:
                return doc


def _is_bracket(doc: Doc) -> bool:
    return isinstance(doc, Brackets) and bool(doc.items)
