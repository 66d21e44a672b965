"""One attempt to parse a text: its parse tree, or where and how it fails."""

from __future__ import annotations

import re
from functools import cached_property

from lark import Token, Tree, UnexpectedInput, UnexpectedToken

from golc.diagnostics import Diagnostic, Span
from golc.syntax.draft import Draft
from golc.syntax.failure import Failure
from golc.syntax.friendly import diagnose
from golc.syntax.layout import LayoutError
from golc.syntax.parser import parser


class Reading:
    """What the parser makes of a draft, read from a start symbol: ``parsed``, or None and the ``diagnosis``."""

    def __init__(self, draft: Draft, start: str) -> None:
        self.draft = draft
        self.start = start
        self.parsed: Tree[Token] | None = None
        try:
            self.parsed = parser().parse(draft.text, start=start)
        except (UnexpectedInput, LayoutError) as error:
            self.error: UnexpectedInput | LayoutError = error

    @property
    def is_layout(self) -> bool:
        """Whether indentation is what it fails at."""
        return self.parsed is None and isinstance(self.error, LayoutError)

    @property
    def has_content(self) -> bool:
        """Whether there is more to read than comments."""
        return re.search(r"^[ \t]*[^\s#]", self.draft.text, re.MULTILINE) is not None

    @property
    def place(self) -> int:
        """Where a text that fails does so, as an offset in it."""
        match self.error:
            case LayoutError(start=place):
                return place
            case UnexpectedToken(token=Token(type="$END")):
                return len(self.draft.text)
            case error:
                return error.pos_in_stream or 0

    @cached_property
    def diagnosis(self) -> tuple[Diagnostic, Failure | None]:
        """The mistake in a text that fails, and how the parser failed if it was the parser."""
        return diagnose(self.draft.whole, self.start, self.draft.text, self.error)

    def placed(self, start: int, end: int) -> Span:
        """The place in the source of what stands between two offsets of the text."""
        whole = self.draft.whole
        return self.draft.back(Span(whole.source, whole.start + start, whole.start + end))
