"""The mistakes of the corpus: a sound domain, and what is changed in it and then said.

The files of ``corpus`` beside this one are the domain and lists of mistakes. Below ``== kind: sort of mistake`` stand
lines of the domain: kept with a space before them, taken out with ``-``, put in with ``+``; ``...`` is whatever lies
between. Below the line that has the finding stand ``! column+width code message`` and ``! help: …``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from golc.diagnostics import Diagnostic, Severity

CORPUS = Path(__file__).with_name("corpus")
DOMAIN = (CORPUS / "depot.gl").read_text(encoding="utf-8").splitlines()


@dataclass
class Mistake:
    """The domain with a mistake, and what is said of it; ``edits`` are the lines (from 0) that others replace."""

    title: str
    text: list[str] = field(default_factory=list)
    said: list[str] = field(default_factory=list)
    edits: list[tuple[int, int, list[str]]] = field(default_factory=list)


def mistakes() -> Iterator[Mistake]:
    for path in sorted(CORPUS.glob("*.slips")):
        for block in path.read_text(encoding="utf-8").removeprefix("== ").split("\n== "):
            title, *lines = block.rstrip("\n").split("\n")
            yield changed(title, lines)


def changed(title: str, lines: list[str]) -> Mistake:
    mistake, read = Mistake(title), 0
    parts = "\n".join(line for line in lines if line).split("\n...\n")
    for part in parts:
        marked = part.split("\n")
        old = [line[1:] for line in marked if line[0] in " -"]
        places = [place for place in range(len(DOMAIN)) if DOMAIN[place : place + len(old)] == old]
        assert len(places) == 1 and places[0] >= read, (title, old)
        mistake.text += DOMAIN[read : places[0]]
        mistake.edits.append(replaced(places[0], old, [line[1:] for line in marked if line[0] in " +"]))
        for line in marked:
            if line[0] in " +":
                mistake.text.append(line[1:])
            elif line[0] == "!":
                mistake.said.append(line[2:] if line.startswith("! help") else f"{len(mistake.text)}:{line[2:]}")
        read = places[0] + len(old)
    mistake.text += DOMAIN[read:]
    return mistake


def replaced(place: int, old: list[str], new: list[str]) -> tuple[int, int, list[str]]:
    """What of the lines from a place on becomes something else, without what is kept before it and behind it."""
    while old and new and old[0] == new[0]:
        place, old, new = place + 1, old[1:], new[1:]
    while old and new and old[-1] == new[-1]:
        old, new = old[:-1], new[:-1]
    return place, place + len(old), new


def said(finding: Diagnostic) -> list[str]:
    span = finding.span
    severity = "" if finding.severity is Severity.ERROR else f" {finding.severity.value}"
    place = f"{span.line}:{span.column}+{span.end - span.start}"
    head = f"{place} {finding.code.code}{severity} {finding.message}"
    return [head] if finding.help is None else [head, f"help: {finding.help}"]
