"""A part of a source, changed so that more of it can be read, that still knows where each character comes from."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from golc.diagnostics import Diagnostic, Edit, Fix, Span
from golc.edits import in_order


@dataclass(frozen=True)
class Draft:
    """``whole`` is the text as it is now; ``origin`` has for each of its places, its end included, the place in the
    source that it stands for; ``end`` is what the parser wants behind it. It begins as the part itself."""

    part: Span
    whole: Span
    origin: Sequence[int]
    end: str

    @classmethod
    def of(cls, part: Span, end: str) -> Draft:
        """A part of a source as it is; what is no file of the user's is edited only here."""
        whole = part if part.source.editable else replace(part, source=replace(part.source, editable=True))
        return cls(part, whole, range(part.start, part.end + 1), end)

    @property
    def text(self) -> str:
        """What the parser reads."""
        return self.whole.text + self.end

    def edited(self, edits: Iterable[Edit]) -> Draft:
        """With edits of its text carried out; those of other parts of the source are left out."""
        base, text, origin, place = self.whole.start, "", list[int](), 0
        old = self.whole.text
        for edit in in_order(edits):
            start, end = edit.span.start - base, edit.span.end - base
            if place <= start and end <= len(old):
                text += old[place:start] + edit.text
                origin += [*self.origin[place:start], *[self.origin[start]] * len(edit.text)]
                place = end
        text += old[place:]
        source = replace(self.whole.source, text=text)
        return Draft(self.part, Span(source, 0, len(text)), (*origin, *self.origin[place:]), self.end)

    def finding(self, finding: Diagnostic) -> Diagnostic:
        """A finding about the text as one about the source."""
        labels = tuple([replace(label, span=self.back(label.span)) for label in finding.labels])
        fix = finding.fix and Fix(finding.fix.does, tuple([self._edit(edit) for edit in finding.fix.edits]))
        return replace(finding, span=self.back(finding.span), labels=labels, fix=fix)

    def _edit(self, edit: Edit) -> Edit:
        return Edit(self.back(edit.span), edit.text)

    def back(self, span: Span) -> Span:
        """The place in the source of a place in the text; the end of the text is the limit."""
        if self.whole.source.text is self.part.source.text:
            return replace(span, source=self.part.source)
        last = len(self.origin) - 1
        return Span(self.part.source, self.origin[min(span.start, last)], self.origin[min(span.end, last)])
