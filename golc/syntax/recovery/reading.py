"""One attempt to parse a text: its parse tree, or where and how it fails."""

from __future__ import annotations

import re
from functools import cached_property

from lark import Token, Tree

from golc.diagnostics import Diagnostic, Span
from golc.syntax.failure import Failure, read
from golc.syntax.hints.blocks import wrong_layout
from golc.syntax.hints.diagnosis import diagnose
from golc.syntax.layout import LayoutError
from golc.syntax.recovery.draft import Draft

_CONTENT = re.compile(r"^[ \t]*[^\s#]", re.MULTILINE)


class Reading:
    """What the parser makes of a draft, read from a start symbol: a tree, or the error that it fails with; neither of
    nothing but comments."""

    def __init__(self, draft: Draft, start: str) -> None:
        self.draft = draft
        self.start = start
        self.parsed: Tree[Token] | None = None
        self.error: Failure | LayoutError | None = None
        if not _CONTENT.search(draft.text):
            return
        try:
            found = read(draft.whole, start, draft.text)
        except LayoutError as error:
            self.error = error
        else:
            if isinstance(found, Failure):
                self.error = found
            else:
                self.parsed = found

    @property
    def is_layout(self) -> bool:
        """Whether indentation is what it fails at."""
        return isinstance(self.error, LayoutError)

    @property
    def found(self) -> Span:
        """Where the mistake in a text that fails stands in the source."""
        return self.draft.back(self.diagnosis.span)

    @property
    def place(self) -> int:
        """Where a text that fails does so, as an offset in it."""
        match self.error:
            case LayoutError(start=place):
                return place
            case Failure(place=place):
                return place
        return len(self.draft.text)

    @cached_property
    def diagnosis(self) -> Diagnostic:
        """The mistake in a text that fails."""
        if isinstance(self.error, Failure):
            return diagnose(self.error)
        assert self.error is not None
        return wrong_layout(self.draft.whole, self.error)

    def placed(self, start: int, end: int) -> Span:
        """The place in the source of what stands between two offsets of the text."""
        whole = self.draft.whole
        return self.draft.back(Span(whole.source, whole.start + start, whole.start + end))
