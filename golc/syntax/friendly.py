"""What is wrong with a text that does not follow the grammar, in the words of its writer.

Each hint recognises one kind of mistake by the token that does not fit, the terminals that would, the words before it
and the open brackets; the first that recognises its own speaks.
"""

from __future__ import annotations

from dataclasses import replace

from lark import UnexpectedInput

from golc.diagnostics import Code, Diagnostic, Fix, Source, Span
from golc.edits import applied, moved
from golc.syntax import blocks, choices, clauses, foreign, gaps, keywords, lines, quantifiers, signs, steps
from golc.syntax.failure import Failure, Hint, failure
from golc.syntax.layout import LayoutError
from golc.syntax.parser import parser

HINTS: tuple[Hint, ...] = (
    keywords.no_declaration,
    *lines.HINTS,
    quantifiers.missing_dot,
    *clauses.HINTS,
    *steps.HINTS,
    *foreign.NOTATION,
    *blocks.BRACKETS,
    foreign.braces,
    *blocks.LINES,
    lines.second_on_line,
    *foreign.CHARACTERS,
    quantifiers.missing_quantifier,
    *choices.HINTS,
    quantifiers.chained,
    signs.wrong_sign,
    signs.late_not,
    keywords.misspelt,
    keywords.reserved,
    *signs.HINTS,
    *gaps.HINTS,
)


def diagnose(
    part: Span, start: str, text: str, error: UnexpectedInput | LayoutError
) -> tuple[Diagnostic, Failure | None]:
    """The finding for an error that the parser met in a part of a source, and how the parser failed if it did.

    Its fix, if it has one, lets the parser come further: none is proposed that only leads to another error there.
    """
    failed = None if isinstance(error, LayoutError) else failure(part, start, text)
    if isinstance(error, LayoutError):
        found = blocks.wrong_layout(part, error)
    elif failed is None:
        return Diagnostic(Code.SYNTAX, "this does not follow the grammar", part), None
    else:
        found = next(finding for hint in HINTS if (finding := hint(failed)) is not None)
    if found.fix is not None and not _leads_on(part, start, text, found, found.fix):
        found = replace(found, fix=None)
    return found, failed


def _leads_on(part: Span, start: str, text: str, found: Diagnostic, fix: Fix) -> bool:
    """Whether a part of a source can be read with a fix, at least to beyond the place of the finding.

    Once lines are indented rightly, what is found next may be what is missing in the line before.
    """
    edits = [edit for edit in fix.edits if part.start <= edit.span.start and edit.span.end <= part.end]
    fixed = Source(part.source.name, applied(text, edits, part.start))
    try:
        parser().parse(fixed.text, start=start)
    except (UnexpectedInput, LayoutError) as error:
        if found.code is Code.INDENTATION and not isinstance(error, LayoutError):
            return True
        whole = Span(fixed, 0, len(fixed.text) - (len(text) - len(part.text)))
        next_, _ = diagnose(whole, start, fixed.text, error)
        end = moved(found.span.end, edits) - part.start
        return next_.span.start > end or (next_.span.start == end < next_.span.end)
    return True
