"""Tables of a TOML file, read key by key: what is missing, wrong or unknown is a finding at its place.

Whoever reads gets something of the right kind in any case, and goes on: a file with findings is not used.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Collection, Iterator, Mapping
from typing import Any

from golc.diagnostics import Code, Diagnostic, Findings, Source, Span, UserError
from golc.runtime.rcxsim.world.geometry import Point
from golc.runtime.rcxsim.world.places import Path, Places
from golc.theory.suggest import did_you_mean

FURTHEST = 100_000.0
"""mm: nothing is further away."""
MOST_POINTS = 1000
SHOWN = 40
"""Characters of a wrong value that a message shows at most."""


class Table:
    """One table of a file; asking for a key makes it known, and ``finish`` tells of those that nobody has asked for."""

    def __init__(
        self, data: Mapping[str, Any], path: Path, places: Places, findings: Findings, absent: bool = False
    ) -> None:
        self._data = data
        self._absent = absent  # which has been told, and nothing is missing in it
        self._path = path
        self._places = places
        self.findings = findings
        self._asked: dict[str, None] = {}

    @property
    def name(self) -> str:
        """The last part of the table's name."""
        return str(self._path[-1])

    @property
    def title(self) -> str:
        names = [part for part in self._path if isinstance(part, str)]
        return f"`[{shown('.'.join(names))}]`" if names else "a world"

    @property
    def header(self) -> Span:
        """Where the table begins."""
        return self._places.key(self._path)

    def place(self, key: str, *within: int) -> Span:
        """Where the value of a key stands, or an element of it."""
        return self._places.value((*self._path, key, *within))

    def error(self, message: str, where: Span, help: str | None = None) -> None:
        self.findings.error(Code.WORLD, message, where, help=help)

    def has(self, key: str) -> bool:
        self._asked[key] = None
        return key in self._data

    def get(self, key: str, wanted: str) -> Any:
        """The value of a key that must be there, or None, and then a finding."""
        if self.has(key):
            return self._data[key]
        if not self._absent:
            self.error(f"`{key}` is missing in {self.title}", self.header, help=f"it is {wanted}")
        return None

    def number(self, key: str, least: float, most: float, default: float | None = None) -> float:
        """A number within bounds."""
        if default is not None and not self.has(key):
            return default
        value = self.get(key, f"a number from {least:g} to {most:g}")
        return least if value is None else self._number(key, value, least, most, self.place(key))

    def numbers(self, key: str, count: int, least: float, most: float) -> tuple[float, ...]:
        """An array of so many numbers."""
        value = self.get(key, f"an array of {count} numbers")
        return self._numbers(key, value, count, least, most)

    def point(self, key: str) -> Point:
        """``[x, y]``, in mm."""
        x, y = self._numbers(key, self.get(key, "a point `[x, y]`"), 2, -FURTHEST, FURTHEST)
        return x, y

    def points(self, key: str) -> list[Point]:
        """Two points at least, no two of them alike that follow each other; others if it is wrong."""
        wanted = "an array of two points at least: `[[0, 0], [500, 0]]`"
        value = self.get(key, wanted)
        if value is not None and (not isinstance(value, list) or len(value) < 2):
            self._wrong(key, value, wanted, self.place(key))
        if isinstance(value, list) and len(value) > MOST_POINTS:
            self.error(f"`{key}` has {len(value)} points, and can have {MOST_POINTS}", self.place(key))
        found: list[Point] = []
        for place, part in enumerate(value[:MOST_POINTS] if isinstance(value, list) else ()):
            x, y = self._numbers(key, part, 2, -FURTHEST, FURTHEST, place)
            if found and found[-1] == (x, y):
                self.error(f"a point of `{key}` is the same as the one before it", self.place(key, place))
            else:
                found.append((x, y))
        return found if len(found) > 1 else [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)]

    def word(self, key: str, words: Collection[str], default: str | None = None) -> str | None:
        """One of some words; None if it is wrong."""
        if default is not None and not self.has(key):
            return default
        listed = ", ".join(words)
        wanted = f"one of {listed}" if listed else f"a {key}, of which the file has none"
        value = self.get(key, wanted)
        if isinstance(value, int) and not isinstance(value, bool):
            value = shown(value)  # `station = 3` for `station = "3"`
        if value is not None and (not isinstance(value, str) or value not in words):
            help_ = did_you_mean(shown(value), words) or f"it is {wanted}"
            self.error(f"`{key}` cannot be `{shown(value)}`", self.place(key), help=help_)
            return None
        return value

    def text(self, key: str) -> str:
        """Any text of one line."""
        value = self.get(key, "a text in quotation marks")
        if not isinstance(value, str):
            self._wrong(key, value, "a text", self.place(key))
            return ""
        return value

    def words(self, key: str, words: Collection[str]) -> list[str]:
        """Some of some words, none if the key is missing."""
        found = []
        for text, where in self.texts(key):
            if text in words:
                found.append(text)
            else:
                self.error(f"`{key}` cannot have `{shown(text)}`", where, help=did_you_mean(text, words))
        return found

    def texts(self, key: str) -> Iterator[tuple[str, Span]]:
        """The texts in an array with their places; none if the key is missing."""
        value = self._data[key] if self.has(key) else []
        if not isinstance(value, list):
            self._wrong(key, value, "an array of texts", self.place(key))
            return
        for place, part in enumerate(value):
            if isinstance(part, str):
                yield part, self.place(key, place)
            else:
                self._wrong(key, part, "texts", self.place(key, place))

    def flag(self, key: str) -> bool:
        """A truth value, false if it is missing."""
        value = self._data[key] if self.has(key) else False
        if not isinstance(value, bool):
            self._wrong(key, value, "true or false", self.place(key))
        return value is True

    def table(self, key: str, needed: bool = False) -> Table:
        """The table of that name, empty if it is missing or wrong."""
        value = self.get(key, "a table") if needed else self._data[key] if self.has(key) else {}
        if isinstance(value, dict):
            return Table(value, (*self._path, key), self._places, self.findings)
        self._wrong(key, value, "a table", self.place(key))
        return Table({}, (*self._path, key), self._places, self.findings, absent=True)

    def tables(self, key: str) -> list[Table]:
        """The tables with names of their own in a table: ``[stations.3]``."""
        within = self.table(key)
        return [within.table(name) for name in within._data]

    def array(self, key: str) -> list[Table]:
        """The tables of an array of tables: ``[[walls]]``."""
        value = self._data[key] if self.has(key) else []
        if not isinstance(value, list) or not all(isinstance(part, dict) for part in value):
            self._wrong(key, value, f"an array of tables: `[[{key}]]`", self.place(key))
            value = []
        paths = ((*self._path, key, place) for place in range(len(value)))
        return [Table(part, path, self._places, self.findings) for part, path in zip(value, paths, strict=True)]

    def either(self, *keys: str) -> str | None:
        """Which one of some keys is there; None, and a finding, if it is none or several."""
        there = [key for key in keys if self.has(key)]
        if self._absent:
            return None
        if len(there) != 1:
            where = self._places.key((*self._path, there[1])) if there else self.header
            listed = " or ".join(f"`{key}`" for key in keys)
            self.error(f"{self.title} must have {listed}, and it has {'several' if there else 'none'}", where)
            return None
        return there[0]

    def finish(self) -> None:
        """Tell of the keys that mean nothing here."""
        for key in self._data:
            if key not in self._asked:
                help_ = did_you_mean(key, self._asked) or f"there can be {', '.join(self._asked)}"
                self.error(
                    f"`{shown(key)}` means nothing in {self.title}", self._places.key((*self._path, key)), help=help_
                )

    def _numbers(self, key: str, value: Any, count: int, least: float, most: float, *within: int) -> tuple[float, ...]:
        if isinstance(value, list) and len(value) == count:
            places = [self.place(key, *within, place) for place in range(count)]
            return tuple(self._number(key, part, least, most, at) for part, at in zip(value, places, strict=True))
        if value is not None:
            wanted = "a point `[x, y]`" if count == 2 else f"an array of {count} numbers"
            self._wrong(key, value, wanted, self.place(key, *within))
        return (least,) * count

    def _number(self, key: str, value: Any, least: float, most: float, where: Span) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float) or not least <= value <= most:
            self._wrong(key, value, f"a number from {least:g} to {most:g}", where)
            return least
        return float(value)

    def _wrong(self, key: str, value: Any, wanted: str, where: Span) -> None:
        if value is not None:
            self.error(f"`{key}` takes {wanted}, not `{shown(value)}`", where)


def shown(value: Any) -> str:
    """A value of a file, for a message."""
    match value:
        case bool():
            return str(value).lower()
        case dict():
            return "{…}"
        case list():
            return "[…]"
        case int() if abs(value) > FURTHEST:
            return "a large number"
    text = str(value) if str(value).isprintable() else repr(str(value))[1:-1]
    return text if len(text) <= SHOWN else text[: SHOWN - 1] + "…"


_AT = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")


def read_tables(source: Source, findings: Findings) -> Table:
    """The tables of a TOML text; raises UserError if it is none."""
    try:
        data = tomllib.loads(source.text)
        return Table(data, (), Places(source), findings)
    except tomllib.TOMLDecodeError as error:
        raise UserError(_not_toml(source, str(error))) from None
    except ValueError:
        where = Span(source, 0, 0)
        raise UserError(Diagnostic(Code.SYNTAX, "a number has thousands of digits", where)) from None
    except RecursionError:
        where = Span(source, 0, 0)
        raise UserError(Diagnostic(Code.NESTING, "the values are nested too deeply", where)) from None


def _not_toml(source: Source, problem: str) -> Diagnostic:
    match = _AT.search(problem)
    text = problem if match is None else problem[: match.start()]
    start = len(source.text)
    if match is not None and match[1]:
        start = min(start, source.line_starts[int(match[1]) - 1] + int(match[2]) - 1)
    help_ = "world files are written in TOML: tables `[robot]`, below them `key = value`, texts in quotation marks"
    return Diagnostic(
        Code.SYNTAX, f"this is not TOML: {text[:1].lower()}{text[1:]}", Span(source, start, start), help=help_
    )
