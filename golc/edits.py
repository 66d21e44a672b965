"""Carrying out edits: texts with them, and where places come to lie."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from golc.diagnostics import Diagnostic, Edit


def applied(text: str, edits: Iterable[Edit], base: int = 0) -> str:
    """A text that begins at ``base`` of its source, with edits of which no two overlap."""
    parts, place = [], 0
    for edit in in_order(edits):
        parts += [text[place : edit.span.start - base], edit.text]
        place = edit.span.end - base
    return "".join((*parts, text[place:]))


def moved(place: int, edits: Iterable[Edit]) -> int:
    """Where an offset comes to lie: behind what is inserted there, and at the end of what is written over it."""
    shift = 0
    for edit in in_order(edits):
        start, end = edit.span.start, edit.span.end
        if end <= place:
            shift += len(edit.text) - (end - start)
        elif start < place:
            return start + shift + len(edit.text)
    return place + shift


def written(edits: Iterable[Edit]) -> Iterator[tuple[int, int]]:
    """Where in the new text begins and ends what each edit has written."""
    shift = 0
    for edit in in_order(edits):
        start = edit.span.start + shift
        yield start, start + len(edit.text)
        shift += len(edit.text) - (edit.span.end - edit.span.start)


def compatible(findings: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The findings that can be fixed at once: of fixes that would change the same place in two ways the first."""
    taken: set[Edit] = set()
    chosen = []
    for finding in findings:
        edits = finding.fix.edits if finding.fix else ()
        if edits and not any(_collide(edit, other) for edit in edits for other in taken):
            taken.update(edits)
            chosen.append(finding)
    return chosen


def edits_of(findings: Iterable[Diagnostic]) -> tuple[Edit, ...]:
    """The edits of all fixes, each once."""
    return tuple(dict.fromkeys(edit for finding in findings if finding.fix for edit in finding.fix.edits))


def in_order(edits: Iterable[Edit]) -> Sequence[Edit]:
    """Edits in the order of the text."""
    return sorted(edits, key=lambda edit: (edit.span.start, edit.span.end))


def _collide(one: Edit, other: Edit) -> bool:
    a, b = one.span, other.span
    if one == other or a.source is not b.source:
        return False
    return a.start == b.start or (a.start < b.end and b.start < a.end)
