"""Reading on after a mistake, so that it does not hide the next one in the same declaration."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace

from golc.diagnostics import Code, Diagnostic, Span
from golc.edits import moved
from golc.syntax.failure import Failure
from golc.syntax.layout import CLOSING, OPENING, LayoutError, unclosed
from golc.syntax.recovery.draft import Draft
from golc.syntax.recovery.omissions import omissions
from golc.syntax.recovery.reading import Reading
from golc.syntax.tree import STAND_IN

PATIENCE = 600_000
"""Characters that are read of a part, mistake by mistake, before the rest of it is left alone."""

TRIALS = 2_000_000
"""Characters that are read to find what one mistake can be passed over with."""

VAGUE = frozenset({Code.SYNTAX, Code.MISSING})
"""What is said where something does not fit: after it has been put right in one way, more may not fit in the line."""

_STAND_IN = re.compile(rf"\b{STAND_IN}_*\b")

_OPENING_OF = dict(zip(CLOSING.values(), OPENING.values(), strict=True))


@dataclass
class Mended:
    """A part of a source as far as it can be read.

    ``reading`` is the last one; ``mistakes`` were met on the way to it, in the order of the text, each with how the
    parser failed if it did; ``unread`` was passed over.
    """

    reading: Reading
    mistakes: list[tuple[Diagnostic, Failure | None]] = field(default_factory=list)
    unread: list[Span] = field(default_factory=list)


def mended(part: Span, start: str, end: str) -> Mended:
    """Read a part of a source from a start symbol, with ``end`` behind it, from mistake to mistake.

    What is wrong is put right where a fix does that, which is what the writer obviously meant; elsewhere it is passed
    over, and to the end of that line no fix is proposed. The reading fails if neither leads on.
    """
    result = Mended(Reading(Draft.of(part, end), start))
    patience, passed = PATIENCE, 0
    while (failed := result.reading).error is not None and patience > 0:
        patience -= failed.place
        finding, fix = failed.draft.finding(failed.diagnosis), failed.diagnosis.fix
        following = _with_fix(failed)
        if following is None or finding.span.line == passed:
            finding = replace(finding, fix=None)
        if not _follows(result, finding) and not _names_a_stand_in(finding):
            result.mistakes.append((finding, failed.error if isinstance(failed.error, Failure) else None))
        if following is None and (shorter := _without(failed)) is not None:
            following, omitted = shorter
            result.unread.append(omitted)
            passed = Span(part.source, omitted.end, omitted.end).line
        elif fix is not None and not any(edit.text for edit in fix.edits):
            # What a fix removes may have been meant as something: a declaration that others miss, or an argument.
            result.unread.append(_line(finding.span) if _is_inside(failed.error) else finding.span)
        if following is None:
            break
        result.reading = following
    return result


def _line(span: Span) -> Span:
    """The line in which a span begins."""
    start = span.source.line_starts[span.line - 1]
    return Span(span.source, start, start + len(span.source.line(span.line)))


def _is_inside(error: Failure | LayoutError | None) -> bool:
    """Whether a text fails inside brackets."""
    return isinstance(error, Failure) and bool(error.brackets)


def _follows(before: Mended, finding: Diagnostic) -> bool:
    """Whether a mistake is only a consequence of one before it: it stands right behind that, or in the same
    line without saying what it is; it is a bracket whose opening one was passed over; or it is the next line that is
    indented as wrongly."""
    if not before.mistakes:
        return False
    if {finding.code, before.mistakes[-1][0].code} <= VAGUE and finding.span.line == before.mistakes[-1][0].span.line:
        return True
    text, start, last = finding.span.source.text, finding.span.start, before.mistakes[-1][0].span.end
    if finding.code is Code.INDENTATION and finding.message == before.mistakes[-1][0].message:
        return before.unread[-1:] != [] and text.count("\n", before.unread[-1].end, start) <= 1
    if finding.span.text in _OPENING_OF:
        return _OPENING_OF[finding.span.text] in unclosed(text[before.reading.draft.part.start : start])
    return last <= start and not text[last:start].strip(" ")


def _names_a_stand_in(finding: Diagnostic) -> bool:
    """Whether a mistake is said of what was passed over: it speaks of a name that is nowhere in the file."""
    edits = finding.fix.edits if finding.fix else ()
    said = (finding.message, finding.help or "", *[label.text for label in finding.labels], *[e.text for e in edits])
    found = [name for text in said for name in _STAND_IN.findall(text)]
    return any(name not in finding.span.source.text for name in found)


def _with_fix(failed: Reading) -> Reading | None:
    """The reading of a text with the fix of its mistake, if it has one that does not only lead to another error there.

    Once lines are indented rightly, what is found next may be what is missing in the line before.
    """
    finding, whole = failed.diagnosis, failed.draft.whole
    if finding.fix is None:
        return None
    fixed = Reading(failed.draft.edited(finding.fix.edits), failed.start)
    if fixed.error is None or (failed.is_layout and not fixed.is_layout):
        return fixed
    end = moved(finding.span.end, [edit for edit in finding.fix.edits if edit.span.end <= whole.end]) - whole.start
    found = fixed.diagnosis.span
    return fixed if found.start > end or (found.start == end < found.end) else None


def _without(failed: Reading) -> tuple[Reading, Span] | None:
    """The reading of a text of which as little as possible is passed over, if that leads on, and what that is."""
    patience = TRIALS
    for omission in omissions(failed):
        if patience <= 0:
            break
        tried = Reading(failed.draft.edited(omission.edits), failed.start)
        behind = moved(omission.span.end, omission.edits) - failed.draft.whole.start
        if tried.error is None or (tried.place > behind and tried.found.start > failed.found.start):
            return tried, failed.draft.back(omission.span)
        patience -= tried.place
    return None
