"""What is wrong with a text that does not follow the grammar, in the words of its writer.

Each hint recognises one kind of mistake by the token that does not fit, the terminals that would, the words before it
and the open brackets; the first that recognises its own speaks.
"""

from __future__ import annotations

from golc.diagnostics import Diagnostic
from golc.syntax.failure import Failure, Hint
from golc.syntax.hints import (
    blocks,
    brackets,
    choices,
    clauses,
    foreign,
    gaps,
    keywords,
    lines,
    quantifiers,
    signs,
    steps,
    trial,
)

HINTS: tuple[Hint, ...] = (
    keywords.no_declaration,
    trial.doubled,
    *lines.HINTS,
    quantifiers.missing_dot,
    *clauses.HINTS,
    *steps.HINTS,
    *foreign.NOTATION,
    *brackets.HINTS,
    foreign.braces,
    *blocks.HINTS,
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


def diagnose(failed: Failure) -> Diagnostic:
    """The finding for an error that the parser met."""
    return next(finding for hint in HINTS if (finding := hint(failed)) is not None)
