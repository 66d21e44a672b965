"""What a text with a mistake that nobody can put right is read on without: an expression, a line, the head of a block.

In the place of what is passed over stands a name that is used nowhere else, so that the rest keeps its form.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from golc.diagnostics import Edit, Span
from golc.syntax.failure import LAYOUT, Failure, wants
from golc.syntax.layout import CLOSING, INDENT, OPENING, LayoutError
from golc.syntax.recovery.draft import Draft
from golc.syntax.recovery.reading import Reading
from golc.syntax.spelling import meant_declaration
from golc.syntax.terminals import BRANCHING
from golc.syntax.tree import STAND_IN
from golc.syntax.words import BRANCHES, DECLARATIONS

HEADS = ("if {}", "on {}", "elif {}", "else", "or", "and", "over")
"""What a line with a block below it may be instead of what it is."""

_WORD = re.compile("[a-z]+")
_HEAD = re.compile(r":\s*(#.*)?$")
_COLON = re.compile(r":(?!=)")
_BRACKET = re.compile(r'"(?:\\[^\n]|[^"\\\n])*"?|#[^\n]*|([(\[{])|([)\]}])')


@dataclass(frozen=True)
class Omission:
    """A span of a draft that is passed over, and the edits that let the rest be read."""

    span: Span
    edits: tuple[Edit, ...]


def omissions(reading: Reading) -> Iterator[Omission]:
    """What could be passed over so that a reading comes further, the smallest first."""
    failed, text = reading.error, _Text(reading.draft)
    if isinstance(failed, LayoutError):
        yield from _other_indentation(text, failed)
    elif failed is not None:
        yield from _missing_indentation(text, failed)
        yield from _missing_blocks(text, failed)
        yield from _missing_branches(text, failed)
        yield from _needless_indentation(text, failed)
        yield from _expressions(text, failed)
        yield from _lines(text, failed)


class _Text:
    """The text of a draft by its offsets."""

    def __init__(self, draft: Draft) -> None:
        self.whole = draft.whole
        self.text = draft.whole.text
        self.name = STAND_IN
        while self.name in self.text or self.name in draft.part.source.text:
            self.name += "_"

    def omission(self, start: int, end: int, text: str) -> Omission:
        """Something else is written for what stands between two offsets, but for a carriage return at its end."""
        span = self.span(start, end - self.text[start:end].endswith("\r"))
        return Omission(span, (Edit(span, text),))

    def span(self, start: int, end: int) -> Span:
        return Span(self.whole.source, self.whole.start + start, self.whole.start + end)

    def line_start(self, place: int) -> int:
        return self.text.rfind("\n", 0, place) + 1

    def line_end(self, place: int) -> int:
        end = self.text.find("\n", place)
        return len(self.text) if end < 0 else end

    def lines(self, start: int, end: int) -> Iterator[int]:
        """Where the lines between two offsets begin that are not empty."""
        while start < end:
            if self.text[start : self.line_end(start)].strip():
                yield start
            start = self.line_end(start) + 1

    def indentation(self, start: int) -> str:
        """The blanks at the beginning of the line that begins at an offset."""
        line = self.text[start : self.line_end(start)]
        return line[: len(line) - len(line.lstrip(" "))]

    def statement(self, start: int) -> list[int]:
        """Where the lines of the statement begin that begins at an offset, with its branches; comments are left out."""
        margin = self.indentation(start)
        branch = re.compile(rf"{margin}(?:{'|'.join(BRANCHES)})\b.*:")
        end = self.block_end(start, self.line_end(start))
        while branch.match(self.text, end + 1):
            end = self.block_end(end + 1, self.line_end(end + 1))
        return [at for at in self.lines(start, end) if self.text[at:].lstrip(" ")[:1] != "#"]

    def goes_on(self, start: int, word: str) -> bool:
        """Whether, after the line that begins at an offset, one in its column begins with a word and a colon."""
        place = start + len(self.indentation(start))
        below = re.compile(f"^{self.indentation(start)}{word}[ \\t]*:", re.MULTILINE)
        return below.search(self.text, self.line_end(place)) is not None

    def block_end(self, start: int, end: int) -> int:
        """The end of the block that lies below the line ``start..end``, which is ``end`` if there is none."""
        width, last = len(self.indentation(start)), end
        while end < len(self.text):
            line = end + 1
            end = self.line_end(line)
            content = self.text[line:end].strip()
            if content and not content.startswith("#"):
                if len(self.indentation(line)) <= width:
                    break
                last = end
        return last


def _other_indentation(text: _Text, error: LayoutError) -> Iterator[Omission]:
    """A line between two levels, or with a tab, belongs to the one or the other, or begins a block."""
    start = text.line_start(error.start)
    width, line = len(text.text[start : error.end].expandtabs(4)), text.span(start, text.line_end(error.end))
    deeper = [error.levels[-1] + INDENT] if error.kind == "tab" else []
    for level in sorted([*error.levels, *deeper], key=lambda level: (abs(level - width), -level)):
        yield Omission(line, (Edit(text.span(start, error.end), " " * level),))


def _needless_indentation(text: _Text, failed: Failure) -> Iterator[Omission]:
    """Lines that are indented below one that begins no block."""
    if failed.kind == "_INDENT" and failed.previous is not None:
        start = text.line_start(failed.place)
        above = text.line_start(failed.previous.start_pos or 0)
        first, end = text.line_end(start), text.block_end(above, start)
        width = failed.place - start - len(text.indentation(above))
        lines = [place for place in text.lines(start, end) if text.text[place:].startswith(" " * width)]
        yield Omission(text.span(start, first), tuple([Edit(text.span(at, at + width), "") for at in lines]))


def _missing_indentation(text: _Text, failed: Failure) -> Iterator[Omission]:
    """A line that is the block of the one above it, or belongs to it, but is not indented; with what lies below it, if
    that has kept its distance."""
    start = text.line_start(failed.place)
    block = failed.accepts == {"_INDENT"} and ("interrupts" in failed.line_before) is (failed.bad == "on")
    lost = failed.begins_line() and (block or str(failed.bad) in BRANCHES)
    lost = lost or [str(token) for token in failed.line] == ["on"]
    lost = lost or any(
        failed.accepts == {terminal} and text.goes_on(start, word) for terminal, word in BRANCHING.items()
    )
    if lost:
        end = text.line_end(start)
        width = len(text.indentation(start)) + INDENT
        lines = text.statement(start)
        whole = lines[1:] and len(text.indentation(lines[1])) == width and _HEAD.search(text.text[start:end])
        places = lines if whole else [start]
        yield Omission(text.span(start, start), tuple([Edit(text.span(at, at), " " * INDENT) for at in places]))


def _missing_blocks(text: _Text, failed: Failure) -> Iterator[Omission]:
    if failed.accepts == {"_INDENT"} and failed.previous is not None:
        end = text.line_end(failed.previous.end_pos or 0)
        margin = "\n" + text.indentation(text.line_start(end)) + " " * INDENT
        name = text.name
        for block in (name, f"poss {name}", f"expect {name}", f"on {name}:{margin}{' ' * INDENT}skip"):
            yield text.omission(end, end, margin + block)


def _missing_branches(text: _Text, failed: Failure) -> Iterator[Omission]:
    """``choose`` with one branch: another one in one of the columns that lines above have."""
    for terminal, word in BRANCHING.items():
        if failed.accepts == {terminal} and failed.previous is not None:
            end = text.line_end(failed.previous.end_pos or 0)
            columns = {len(text.indentation(line)) for line in text.lines(0, end)}
            for margin in ("\n" + " " * column for column in sorted(columns, reverse=True)):
                yield text.omission(end, end, f"{margin}{word}:{margin}{' ' * INDENT}{text.name}")


def _expressions(text: _Text, failed: Failure) -> Iterator[Omission]:
    """From where in the line an expression could begin, outside of brackets, to its end."""
    for start in _beginnings(failed):
        behind = text.text[:start][-1:]
        name = f" {text.name}" if behind.isalnum() or behind == "_" else text.name
        for end in _ends(text, failed):
            if start <= end:
                yield text.omission(start, end, name)


def _beginnings(failed: Failure) -> Iterator[int]:
    read = list(zip(failed.line, failed.stacks, strict=False))
    if failed.bad is not None and failed.kind not in LAYOUT and len(read) == len(failed.line):
        read.append((failed.bad, failed.stack))
    depth = 0
    for word, stack in read:
        depth -= word.type in CLOSING
        if depth == 0 and wants(failed.start, stack, "TRUE"):
            yield word.start_pos or 0
        depth += word.type in OPENING


def _ends(text: _Text, failed: Failure) -> Iterator[int]:
    depth, place = len(failed.brackets), failed.place
    if depth and (first := text.line_end(failed.brackets[0].start_pos or 0)) < place:
        yield first
    for found in _BRACKET.finditer(text.text, place) if depth else ():
        depth += (found[1] is not None) - (found[2] is not None)
        if depth == 0:
            yield found.end()
            break
    colons = [found.start() for found in _COLON.finditer(text.text, place, text.line_end(place))]
    yield from dict.fromkeys(reversed(colons))
    yield text.block_end(text.line_start(place), text.line_end(place))


def _lines(text: _Text, failed: Failure) -> Iterator[Omission]:
    """The line, as a statement, a condition or a clause, with its block or without."""
    first = failed.place if failed.begins_line() or not failed.line else failed.line[0].start_pos or 0
    start = text.line_start(first)
    indentation, name = text.indentation(start), text.name
    for place in dict.fromkeys((first, failed.place)):
        end = text.line_end(place)
        if not text.text[start:end].strip():
            continue
        below = text.block_end(start, end)
        if start == 0:
            kind = _kind(text.text)
            if below > end and kind is not None:
                yield text.omission(0, end, f"{kind} {name}:")
            continue
        if below > end and _HEAD.search(text.text[start:end]):
            for head in (*_heads(text.text[start:end], name), *(head.format(name) for head in HEADS)):
                yield text.omission(start, end, f"{indentation}{head}:")
        for line in (name, "", f"poss {name}", f"expect {name}", "otherwise unchanged"):
            yield text.omission(start, below, indentation + line)


def _kind(text: str) -> str | None:
    """The word that begins a declaration, or the one that it probably means."""
    found = _WORD.match(text)
    word = "" if found is None else found[0]
    return word if word in DECLARATIONS else meant_declaration(word)


def _heads(line: str, name: str) -> Iterator[str]:
    """A line reduced to its first word, and to that and a condition."""
    word = _WORD.match(line.strip())
    if word is not None:
        yield from (word[0], f"{word[0]} {name}")
