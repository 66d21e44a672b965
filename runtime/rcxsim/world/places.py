"""Where in a TOML text its keys and values stand, which ``tomllib`` does not tell.

The text has been read by ``tomllib`` before: only what is correct TOML comes here, and so nothing has to be checked.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Sequence
from typing import TypeAlias

from golc.diagnostics import Source, Span

Path: TypeAlias = tuple[str | int, ...]
"""The way to a value: keys of tables and places in arrays."""

_BLANK = re.compile(r"[ \t]*")
_GAP = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
_STRING = re.compile(
    r'"""(?:[^\\]|\\.)*?"{3,5}(?!")' r"|'''.*?'{3,5}(?!')" r'|"(?:[^"\\\n]|\\.)*"' r"|'[^'\n]*'", re.DOTALL
)
_BARE = re.compile(r"[A-Za-z0-9_-]+")
_SCALAR = re.compile(r"[^,\]}#\n]*[^,\]}#\s]")
DEEPEST = 32
"""Nested values further inside than this have the place of what they are in."""


class Places:
    """The places of what a TOML text says."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._text = source.text
        self._keys: dict[Path, Span] = {}
        self._values: dict[Path, Span] = {}
        self._lengths: dict[Path, int] = {}  # of arrays of tables
        self._at = 0
        self._table: Path = ()
        while self._skip(_GAP) < len(self._text):
            self._header() if self._next("[") else self._pair(self._table, 0)

    def key(self, path: Path) -> Span:
        """Where a key stands, or the header of a table; what was never written is at the beginning of the file."""
        return self._up(self._keys, path)

    def value(self, path: Path) -> Span:
        """Where a value stands; of a table with a header, that."""
        return self._up(self._values, path)

    def _up(self, found: dict[Path, Span], path: Path) -> Span:
        for place in (found, self._keys):
            if path in place:
                return place[path]
        return self._up(found, path[:-1]) if path else Span(self._source, 0, 0)

    def _header(self) -> None:
        start = self._at
        many = self._text.startswith("[[", start)
        self._at += 1 + many
        *parents, (name, _) = self._key()
        table = (*self._into(parents), name)
        if many:
            count = self._lengths[table] = self._lengths.get(table, 0) + 1
            self._keys.setdefault(table, self._span(start))
            table += (count - 1,)
        self._skip(_BLANK)
        self._at += 1 + many
        self._table = table
        self._keys[table] = self._span(start)

    def _into(self, names: Sequence[tuple[str, Span]]) -> Path:
        """The table of that name: of an array of tables, the last one."""
        path: Path = ()
        for name, span in names:
            path += (name,)
            self._keys.setdefault(path, span)
            if path in self._lengths:
                path += (self._lengths[path] - 1,)
        return path

    def _pair(self, table: Path, depth: int) -> None:
        path = table
        for name, span in self._key():
            path += (name,)
            self._keys.setdefault(path, span)
        self._skip(_BLANK)
        self._at += 1  # the equals sign
        self._value(path, depth)

    def _key(self) -> list[tuple[str, Span]]:
        parts: list[tuple[str, Span]] = []
        while not parts or self._next("."):
            self._at += bool(parts)
            start = self._skip(_BLANK)
            quoted = self._next('"', "'")
            self._skip(_STRING if quoted else _BARE)
            span = self._span(start)
            parts.append((next(iter(tomllib.loads(f"{span.text} = 0"))) if quoted else span.text, span))
            self._skip(_BLANK)
        return parts

    def _value(self, path: Path, depth: int) -> None:
        start = self._skip(_GAP)
        if self._next("["):
            for place in self._items("]"):
                self._value((*path, place) if depth < DEEPEST else path, depth + 1)
        elif self._next("{"):
            for _ in self._items("}"):
                self._pair(path, depth + 1)
        else:
            self._skip(_STRING if self._next('"', "'") else _SCALAR)
        self._values[path] = self._span(start)

    def _items(self, end: str) -> Iterator[int]:
        """Go from item to item of an array or an inline table, and behind its end."""
        self._at += 1
        place = 0
        while self._skip(_GAP) < len(self._text) and not self._next(end):
            yield place
            place += 1
            self._skip(_GAP)
            self._at += self._next(",")
        self._at += 1

    def _next(self, *texts: str) -> bool:
        return self._text.startswith(texts, self._at)

    def _skip(self, what: re.Pattern[str]) -> int:
        """Go behind what stands here, which may be nothing; the place behind it."""
        match = what.match(self._text, self._at)
        self._at = self._at if match is None else match.end()
        return self._at

    def _span(self, start: int) -> Span:
        return Span(self._source, start, self._at)
