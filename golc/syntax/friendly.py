"""What is wrong with a text that does not follow the grammar, in the words of its writer."""

from __future__ import annotations

from lark import Token, UnexpectedCharacters, UnexpectedInput

from golc.diagnostics import Code, Diagnostic, Span
from golc.syntax.layout import LayoutError


def diagnose(span: Span, start: str, error: UnexpectedInput | LayoutError) -> Diagnostic:
    """The finding for an error that the parser met in a part of a text."""
    match error:
        case LayoutError(start=first, end=last, kind=kind):
            place = Span(span.source, span.start + first, span.start + last)
            return Diagnostic(Code.INDENTATION, f"the indentation does not fit ({kind})", place)
        case UnexpectedCharacters(pos_in_stream=first):
            place = Span(span.source, span.start + first, span.start + first + 1)
            return Diagnostic(Code.SYNTAX, f"unexpected character {place.text!r}", place)
    token = getattr(error, "token", Token("$END", ""))
    first = span.start + (token.start_pos or 0)
    place = Span(span.source, first, first + len(token))
    return Diagnostic(Code.SYNTAX, f"unexpected {place.text!r}" if place.text else "something is missing here", place)
