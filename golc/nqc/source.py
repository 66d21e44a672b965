"""What an NQC file defines: its tasks, subs, functions, variables and macros, read by tokens and not by patterns.

This is no compiler: conditional compilation is not followed (each branch counts), and a text that NQC would refuse is
read as far as it goes, for the compiler says better what is wrong with it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum

from golc.diagnostics import Source, Span

_TOKEN = re.compile(
    r"""
      (?P<space>[ \t\r\n\f\v]+|\\\r?\n)
    | (?P<comment>//[^\n]*|/\*.*?(?:\*/|\Z))
    | (?P<directive>\#)
    | (?P<word>[A-Za-z_]\w*)
    | (?P<number>0[xX][0-9A-Fa-f]+|\d+)
    | (?P<string>"(?:\\.|[^"\\\n])*"?)
    | (?P<mark>.)
    """,
    re.VERBOSE | re.DOTALL | re.ASCII,
)


@dataclass(frozen=True, slots=True)
class Token:
    """A word, number, string, mark, or (of kind ``directive``) a whole preprocessor line without its ``#``."""

    kind: str
    text: str
    start: int
    end: int


class Kind(Enum):
    TASK = "task"
    SUB = "sub"
    FUNCTION = "function"


@dataclass(frozen=True)
class Definition:
    """A task, sub or function; ``parameters`` is their number, ``body`` the tokens between its braces."""

    kind: Kind
    name: str
    parameters: int
    body: Sequence[Token] = field(repr=False, compare=False)
    span: Span = field(repr=False, compare=False)


@dataclass(frozen=True)
class NqcSource:
    """The names of an NQC file and of those that it includes."""

    sources: tuple[Source, ...]
    definitions: Mapping[str, Definition]
    variables: Mapping[str, Span]
    macros: Mapping[str, str]
    words: frozenset[str]
    """Every identifier outside comments and strings, macro bodies included."""
    includes: frozenset[str]
    """The names in ``#include``, as written."""

    def of(self, kind: Kind) -> list[Definition]:
        """The definitions of a kind, in order."""
        return [definition for definition in self.definitions.values() if definition.kind is kind]


EMPTY = NqcSource((), {}, {}, {}, frozenset(), frozenset())


def tokens(text: str) -> Iterator[Token]:
    """The tokens of a text without space and comments; never raises."""
    position = 0
    while position < len(text):
        match = _TOKEN.match(text, position)
        assert match is not None  # the last alternative takes any character
        kind = str(match.lastgroup)
        end = _end_of_line(text, match.end()) if kind == "directive" else match.end()
        if kind not in ("space", "comment"):
            start = match.end() if kind == "directive" else match.start()
            yield Token(kind, text[start:end], start, end)
        position = end


def _end_of_line(text: str, position: int) -> int:
    """Where a preprocessor line ends: at the first line end that no backslash continues, or before a comment."""
    while position < len(text) and text[position] != "\n":
        if text.startswith(("//", "/*"), position):
            return position
        if text[position] == '"':
            string = _TOKEN.match(text, position)
            position = string.end() if string else position + 1
            continue
        position += 2 if text.startswith("\\\n", position) else 3 if text.startswith("\\\r\n", position) else 1
    return min(position, len(text))


@dataclass
class _Reader:
    """Collects what the files define; a file is read once."""

    find: Callable[[str], Source | None]
    sources: list[Source] = field(default_factory=list)
    definitions: dict[str, Definition] = field(default_factory=dict)
    variables: dict[str, Span] = field(default_factory=dict)
    macros: dict[str, str] = field(default_factory=dict)
    words: set[str] = field(default_factory=set)
    includes: set[str] = field(default_factory=set)

    def read(self, source: Source) -> None:
        """Read a file and, one after the other, those that it includes."""
        waiting = [source]
        while waiting:
            source = waiting.pop()
            if any(source.name == known.name for known in self.sources):
                continue
            self.sources.append(source)
            code = []
            for token in tokens(source.text):
                if token.kind == "directive":
                    waiting += self._directive(token)
                else:
                    code.append(token)
                    if token.kind == "word":
                        self.words.add(token.text)
            self._top_level(source, code)

    def _directive(self, token: Token) -> list[Source]:
        match = re.match(r"\s*([A-Za-z]*)(.*)", token.text, re.DOTALL)
        assert match is not None  # both parts may be empty
        name, rest = match.groups()
        if name == "define" and (macro := re.match(r"\s*([A-Za-z_]\w*)(.*)", rest, re.DOTALL)):
            self.macros[macro[1]] = macro[2].strip()
            self.words |= {inner.text for inner in tokens(macro[2]) if inner.kind == "word"}
        elif name == "include" and (file := re.search(r'"([^"\n]+)"', rest)):
            self.includes.add(file[1])
            found = self.find(file[1])
            return [] if found is None else [found]
        return []

    def _top_level(self, source: Source, code: Sequence[Token]) -> None:
        """Walk over the declarations; a brace that is never closed takes the rest of the file."""
        place = 0
        while place < len(code):
            match [token.text for token in code[place : place + 3]]:
                case ["task" | "sub" | "void" as keyword, name, "("] if code[place + 1].kind == "word":
                    place = self._definition(source, code, place, keyword, name)
                case ["int", *_]:
                    place = self._variables(source, code, place + 1)
                case ["{", *_]:
                    place = _matching(code, place, "{", "}") + 1
                case _:
                    place += 1

    def _definition(self, source: Source, code: Sequence[Token], place: int, keyword: str, name: str) -> int:
        close = _matching(code, place + 2, "(", ")")
        if close + 1 >= len(code) or code[close + 1].text != "{":
            return close + 1
        end = _matching(code, close + 1, "{", "}")
        kind = {"task": Kind.TASK, "sub": Kind.SUB, "void": Kind.FUNCTION}[keyword]
        parameters = code[place + 3 : close]
        count = sum(token.text == "," for token in parameters) + 1 if parameters else 0
        span = Span(source, code[place + 1].start, code[place + 1].end)
        self.definitions.setdefault(name, Definition(kind, name, count, code[close + 2 : end], span))
        return end + 1

    def _variables(self, source: Source, code: Sequence[Token], place: int) -> int:
        """``int a, b = 2, c[3];``: the words that follow ``int`` or a comma."""
        before = ","
        while place < len(code) and code[place].text not in (";", "{"):
            token = code[place]
            if token.kind == "word" and before == ",":
                self.variables.setdefault(token.text, Span(source, token.start, token.end))
            before = token.text
            place += 1
        return place


def _matching(code: Sequence[Token], place: int, opening: str, closing: str) -> int:
    """The place of the bracket that closes the one at ``place``, or the end."""
    depth = 0
    for index in range(place, len(code)):
        depth += (code[index].text == opening) - (code[index].text == closing)
        if depth == 0:
            return index
    return len(code)


def scan(source: Source, find: Callable[[str], Source | None] = lambda name: None) -> NqcSource:
    """Read an NQC file; ``find`` brings the text of an included file, or None where it is not to be followed."""
    reader = _Reader(find)
    reader.read(source)
    return NqcSource(
        tuple(reader.sources),
        reader.definitions,
        reader.variables,
        reader.macros,
        frozenset(reader.words),
        frozenset(reader.includes),
    )
