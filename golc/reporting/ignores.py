"""Comments that leave out findings: ``# golc: ignore[GL027]`` at the end of a line, or alone above it."""

from __future__ import annotations

import io
import re
import tokenize
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

from golc.diagnostics import Code, Diagnostic, Edit, Fix, Severity, Source, Span
from golc.loading import Examined, by_place
from golc.reporting.selection import CODES
from golc.theory.suggest import did_you_mean

TEXT_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|(?P<comment>#[^\n]*)')
DIRECTIVE = re.compile(r"#\s*golc:\s*(?P<word>\w+)(?:\s*\[(?P<codes>[^\]\n]*)\]?)?")
WORD = "ignore"


@dataclass(frozen=True)
class Ignore:
    """A comment: its place, that of its word, the line (from 1) whose findings it leaves out, those of its codes.

    ``codes`` is None where it has no brackets: it is about all codes.
    """

    span: Span
    word: Span
    line: int
    codes: tuple[Span, ...] | None

    def covers(self, code: Code) -> bool:
        """Whether it is about a code."""
        about = self.codes is None or any(span.text == code.code for span in self.codes)
        return about and self.word.text == WORD


def heed(examined: Examined, proofs: bool) -> tuple[Diagnostic, ...]:
    """The findings about a file without those that comments leave out, in the order of their places.

    Comments of the file itself that cannot be meant are warned of; those that leave out nothing only if all was looked
    for: there is a theory, and with ``proofs`` all its situations were taken into account. Their fix is not offered if
    there may be a finding in another run: with other constants, in states that cannot be reached, with a solver.
    """
    comments = [comment for source in examined.sources for comment in ignores(source)]
    at: dict[tuple[int, int], list[Ignore]] = {}
    for comment in comments:
        at.setdefault((id(comment.span.source), comment.line), []).append(comment)
    kept, used = [], dict[Ignore, set[str]]()
    for finding in examined.findings:
        covering = [c for c in at.get((id(finding.span.source), finding.span.line), ()) if c.covers(finding.code)]
        for comment in covering:
            used.setdefault(comment, set()).add(finding.code.code)
        kept += [] if covering else [finding]
    complete = proofs and examined.theory is not None
    certain = not examined.constants and examined.scope is None and not _open(examined)
    for comment in comments:
        if comment.span.source is examined.sources[0]:
            kept += _misspelt(comment)
            idle = _idle(comment, used.get(comment, set())) if complete else ()
            kept += idle if certain else (replace(finding, fix=None) for finding in idle)
    return tuple(sorted(kept, key=by_place(examined.sources)))


def _open(examined: Examined) -> bool:
    """Whether something was not worked out, which elsewhere (with a solver, with ``--trust``) may be found."""
    return any(finding.severity is Severity.NOTE for finding in examined.findings)


def ignores(source: Source) -> Iterator[Ignore]:
    """The comments of a source, in its order; a ``#`` in a string begins none."""
    for start, end in _python_comments(source) if source.python else _comments(source):
        found = DIRECTIVE.search(source.text, start, end)
        if found is not None and (found["word"] == WORD or did_you_mean(found["word"], [WORD])):
            span, word = Span(source, *found.span()), Span(source, *found.span("word"))
            yield Ignore(span, word, _covered(source, span.line), _codes(source, found))


def _comments(source: Source) -> Iterator[tuple[int, int]]:
    for part in TEXT_OR_COMMENT.finditer(source.text):
        if part["comment"]:
            yield part.span()


def _python_comments(source: Source) -> Iterator[tuple[int, int]]:
    with suppress(tokenize.TokenError, SyntaxError):  # what Python cannot read is a finding of its own
        for token in tokenize.generate_tokens(io.StringIO(source.text).readline):
            if token.type == tokenize.COMMENT:
                start = source.line_starts[token.start[0] - 1] + token.start[1]
                yield start, start + len(token.string)


def _covered(source: Source, line: int) -> int:
    """The line itself if anything stands before the comment, otherwise the next one that is no comment."""
    last = len(source.line_starts)
    while line < last and source.line(line).lstrip().startswith("#"):
        line += 1
    return line


def _codes(source: Source, found: re.Match[str]) -> tuple[Span, ...] | None:
    if found["codes"] is None:
        return None
    start = found.start("codes")
    words = re.finditer(r"[^\s,]+", found["codes"])
    return tuple(Span(source, start + word.start(), start + word.end()) for word in words)


def _misspelt(comment: Ignore) -> Iterator[Diagnostic]:
    if comment.word.text != WORD:
        message = f"there is no comment `golc: {comment.word.text}`"
        fix = Fix(f"write `{WORD}` for `{comment.word.text}`", (Edit(comment.word, WORD),))
        yield _warning(message, comment.word, f"did you mean `{WORD}`?", fix)
    elif comment.codes == ():
        yield _warning("there is no code in the brackets", comment.span, "without brackets it is about all codes")
    for code in comment.codes or ():
        if code.text not in CODES:
            yield _warning(f"there is no code `{code.text}`", code, did_you_mean(code.text, CODES))


def _idle(comment: Ignore, covered: set[str]) -> Iterator[Diagnostic]:
    if comment.word.text != WORD:
        return
    if comment.codes is None and not covered:
        yield _warning("there is no finding to leave out here", comment.span, "remove the comment", _without(comment))
    codes = comment.codes or ()
    idle = [code for code in codes if code.text in CODES and code.text not in covered]
    for code in idle:
        fix = _without(comment) if len(idle) == len(codes) else _without_code(comment, code)
        yield _warning(f"there is no finding {code.text} to leave out here", code, "remove the code", fix)


def _without(comment: Ignore) -> Fix:
    """Remove a comment: with its line if nothing else stands there, without what else it says for the reader."""
    text, start, end = comment.span.source.text, comment.span.start, comment.span.end
    line = comment.span.source.line_starts[comment.span.line - 1]
    rest = re.compile(r"[^\r\n]*").match(text, end)
    reader = rest.group().strip() if rest else ""
    if reader and not reader.startswith("#"):
        return _removing(Span(comment.span.source, start + 1, end))
    blanks = len(text[line:start]) - len(text[line:start].rstrip())
    alone = not reader and blanks == start - line
    stop = (rest.end() if rest else end) if not reader else end
    newline = re.compile(r"\r?\n").match(text, stop) if alone else None
    return _removing(Span(comment.span.source, start - blanks * (not reader), newline.end() if newline else stop))


def _without_code(comment: Ignore, code: Span) -> Fix:
    """Remove a code with the comma behind it, or the one before it."""
    text = comment.span.source.text
    behind = re.compile(r"[\s,]+(?=[^\s,\]])").match(text, code.end)
    before = len(text[: code.start].rstrip(" ,")) if not behind else code.start
    return _removing(Span(code.source, before, behind.end() if behind else code.end))


def _removing(span: Span) -> Fix:
    return Fix(f"remove `{span.text.strip()}`", (Edit(span, ""),))


def _warning(message: str, span: Span, help_: str | None, fix: Fix | None = None) -> Diagnostic:
    return Diagnostic(Code.IDLE_IGNORE, message, span, Severity.WARNING, help=help_, fix=fix)
