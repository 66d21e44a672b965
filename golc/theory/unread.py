"""What could not be read of a file, and what is not said of the rest because of it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from golc.diagnostics import Diagnostic, Span
from golc.syntax.tree import STAND_IN
from golc.syntax.words import RESERVED
from golc.theory.complaints import WORD
from golc.theory.suggest import closest

_STAND_IN = re.compile(f"`({STAND_IN}_*)`")

_NAMELESS = re.compile(
    r"(?:import|(?:const|type|static|extern|fluent|define|action|exog|proc|goal|let|for|pick|on some)"
    r"[ \t]*(?:[^A-Za-z \t]|(?:from|in|where)\b))"
)
"""The beginning of an import, or of a declaration or line whose name is missing."""


def names_in(unread: Iterable[Span]) -> Iterator[str]:
    """The names that may be declared in what was not read: all words of it."""
    for span in unread:
        yield from WORD.findall(span.text)


def is_about(finding: Diagnostic, unread: Iterable[Span]) -> bool:
    """Whether a finding is about what has been passed over: it lies in that, or it is about something which holds a
    part of it, or it speaks of the name that stands for it."""
    span = finding.span
    named = _STAND_IN.search(finding.message)
    return (named is not None and named[1] not in span.source.text) or any(
        span.source is each.source
        and ((each.start <= span.start and span.end <= each.end) or (span.start <= each.start and each.end <= span.end))
        for each in unread
    )


def brings_a_name(unread: Span) -> bool:
    """Whether what was not read would bring a name that does not stand in it: it has none, or one that cannot be one,
    or it is an import."""
    text = unread.text.strip()
    first = WORD.match(text)
    return (
        unread.text in RESERVED
        or _NAMELESS.match(text) is not None
        or (first is not None and closest(first[0], ["import"]) is not None)
    )
