"""Fixing, looking again, and fixing what is found then, until nothing more can be fixed."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Generic, TypeVar

from golc.diagnostics import Diagnostic, Edit, Severity, Source, Span
from golc.edits import compatible, edits_of, in_order, moved, written
from golc.fixing.texts import Texts
from golc.syntax.layout import split

MOST = 1000
"""Rounds: a fix in each declaration is a round."""

LAST_OF_SYNTAX = "GL009"


@dataclass(frozen=True)
class Looked:
    """All that is found in a file, and what of it is wanted, which is all that may be fixed."""

    found: tuple[Diagnostic, ...]
    wanted: tuple[Diagnostic, ...]


L = TypeVar("L", bound=Looked)


@dataclass(frozen=True)
class Refused:
    """A fix that has not been carried out, for it would lead to ``because``; None: its finding would not go."""

    finding: Diagnostic
    because: Diagnostic | None


@dataclass
class Outcome(Generic[L]):
    """What is found in the end, the findings that were fixed, and those whose fixes would have made things worse."""

    looked: L
    fixed: list[Diagnostic] = field(default_factory=list)
    refused: list[Refused] = field(default_factory=list)


def fix(texts: Texts, first: L, look: Callable[[], L]) -> Outcome[L]:
    """Carry out all fixes of what was found first, and of what ``look`` finds then in the changed texts."""
    outcome = Outcome(first)
    for _ in range(MOST):
        left = {_line(refused.finding) for refused in outcome.refused}
        able = compatible(found for found in outcome.looked.wanted if found.fix and _line(found) not in left)
        if not able:
            break
        _round(texts, look, outcome, able)
    return outcome


def _round(texts: Texts, look: Callable[[], L], outcome: Outcome[L], able: list[Diagnostic]) -> None:
    """Carry out some fixes at once; if that makes anything worse, the first that does not by itself."""
    before = texts.changed
    for some in (able, *([one] for one in able if len(able) > 1)):
        texts.change(edits_of(some))
        looked = look()
        worse, because = _worse(outcome.looked, some, looked)
        if not worse:
            outcome.looked = looked
            outcome.fixed += some
            return
        texts.changed = before
        if len(some) == 1:
            outcome.refused.append(Refused(some[0], because))


def _worse(before: Looked, fixed: list[Diagnostic], after: Looked) -> tuple[bool, Diagnostic | None]:
    """Whether a fixed finding is still there, or an error is new that no mistake has hidden until now.

    Hidden is what stands in a declaration that could not be read, or could not be understood without it; but nothing
    that begins in the text that a fix has written.
    """
    edits = edits_of(fixed)
    places = {_place(finding, _of(finding.span.source, edits)) for finding in fixed}
    known = {_place(finding, _of(finding.span.source, edits)) for finding in before.found}
    for finding in after.found:
        if _place(finding, ()) in places:
            return True, None
        if finding.severity is Severity.ERROR and _place(finding, ()) not in known:
            its = _of(finding.span.source, edits)
            syntax = finding.code.code <= LAST_OF_SYNTAX
            if _in_written(finding.span, its) or (syntax and not _in_same_declaration(finding.span, its)):
                return True, finding
    return False, None


def _of(source: Source, edits: Iterable[Edit]) -> tuple[Edit, ...]:
    """The edits of the text of a file."""
    return tuple(in_order(edit for edit in edits if edit.span.source.name == source.name))


def _place(finding: Diagnostic, edits: tuple[Edit, ...]) -> tuple[str, str, str, int]:
    """What tells a finding from others, where its place lies with edits."""
    return finding.code.code, finding.message, finding.span.source.name, moved(finding.span.start, edits)


def _line(finding: Diagnostic) -> tuple[str, str, str, str]:
    """What tells a finding from others as long as nobody changes its line."""
    span = finding.span
    return finding.code.code, finding.message, span.source.name, span.source.line(span.line)


def _in_written(span: Span, edits: tuple[Edit, ...]) -> bool:
    """Whether a span of the new text begins in what the edits have written."""
    return any(start <= span.start < end for start, end in written(edits))


def _in_same_declaration(span: Span, edits: tuple[Edit, ...]) -> bool:
    """Whether one of the edits stands in the declaration of a span of the new text."""
    chunks = [chunk for chunk in split(span.source.text) if chunk.start <= span.start <= chunk.end]
    return any(chunk.start <= end <= chunk.end for chunk in chunks for _, end in written(edits))
