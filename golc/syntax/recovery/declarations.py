"""Reading a file with errors, declaration by declaration, so that one mistake never hides the next."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import pairwise

from golc.diagnostics import Code, Findings, Label, Source, Span
from golc.syntax import tree as ast
from golc.syntax.failure import Failure
from golc.syntax.hints.keywords import CALL
from golc.syntax.layout import split
from golc.syntax.recovery.pieces import Piece, parse_piece
from golc.syntax.spelling import closest
from golc.syntax.words import CLAUSES, DECLARATIONS, STATEMENTS

_CONTENT = re.compile(r"^[ \t]*([A-Za-z]\w*|[^\s#])", re.MULTILINE)

_EMPTY = re.compile(r"(?:\s|#[^\n]*)*")
"""Nothing but blanks and comments."""


def recover(source: Source, findings: Findings) -> ast.File | None:
    """What can be read of a file, with a finding for each declaration that cannot; None if there is nothing at all."""
    read = list(_pieces(source))
    pieces = [piece for piece, _ in read]
    if not pieces:
        _nothing(source, findings)
        return None
    if _is_foreign(pieces):
        message = "the domain line is missing, and nothing in the file begins as a declaration does"
        help = "is this a file of golc? Such a file begins with a line such as `domain delivery`"
        findings.error(Code.DOMAIN, message, _word_span(pieces[0]), help=help)
        return None
    _merge(read[1:] if _check_domain(pieces, findings) else read, findings)
    nodes = [piece.node for piece in pieces if piece.node is not None]
    domain = next((node for node in nodes if isinstance(node, ast.Ident)), None)
    declarations = tuple(node for node in nodes if not isinstance(node, ast.Ident))
    if domain is None and not declarations:
        return None
    start = pieces[0].part.start
    here = Span(source, start, start)
    unread = tuple(span for piece in pieces for span in piece.unread)
    return ast.File(domain or ast.Ident("", span=here), declarations, unread=unread, span=here.to(pieces[-1].part))


def _pieces(source: Source) -> Iterable[tuple[Piece, Findings]]:
    for chunk in split(source.text):
        part = Span(source, chunk.start, chunk.end)
        if not _first_word(part):
            continue
        found = Findings()
        start = "header" if _first_word(part) == "domain" else "declaration"
        yield parse_piece(part, start, chunk.too_deep, found), found


def _first_word(part: Span) -> str:
    content = _CONTENT.search(part.text)
    return "" if content is None else content.group(1)


def _nothing(source: Source, findings: Findings) -> None:
    what = "the file holds nothing but comments" if source.text.strip() else "the file is empty"
    help = "begin it with its domain line: `domain delivery`"
    findings.error(Code.DOMAIN, what, Span(source, 0, 0), help=help)


def _check_domain(pieces: list[Piece], findings: Findings) -> bool:
    """The domain line is there, the first, and the only one; true if all is said of a first line in its place."""
    headers = [piece for piece in pieces if _first_word(piece.part) == "domain"]
    first = pieces[0]
    if not headers:
        if closest(_first_word(first.part), ["domain"]) is None:
            example = _only_name(first) or "delivery"
            help = f"begin the file with a line such as `domain {example}`"
            findings.error(Code.DOMAIN, "the domain line is missing", _word_span(first), help=help)
            word = _first_word(first.part)
            return word not in (*DECLARATIONS, *CLAUSES, *STATEMENTS) and closest(word, DECLARATIONS) is None
        return False
    if headers[0] is not first:
        message = "the domain line is not the first"
        findings.error(Code.DOMAIN, message, _word_span(headers[0]), help="move it to the beginning of the file")
    for second in headers[1:]:
        findings.error(
            Code.DOMAIN,
            "there is a second domain line",
            _word_span(second),
            help="a file describes one domain: remove the line, or `import` another file",
            labels=(Label(_word_span(headers[0]), "the first one"),),
        )
    return False


def _is_foreign(pieces: list[Piece]) -> bool:
    """Whether a text of some length has nothing of a file of golc."""
    words = [_first_word(piece.part) for piece in pieces]
    known = [*DECLARATIONS, "domain"]
    return len(words) > 2 and not any(word in known or closest(word, known) for word in words)


def _only_name(piece: Piece) -> str | None:
    """The name that is all of a piece: a domain line without its word."""
    text = re.sub("#.*", "", piece.part.text).strip()
    return text if re.fullmatch("[A-Za-z][A-Za-z0-9_]*", text) and text not in DECLARATIONS else None


def _word_span(piece: Piece) -> Span:
    content = _CONTENT.search(piece.part.text)
    start, end = (0, 0) if content is None else content.span(1)
    return Span(piece.part.source, piece.part.start + start, piece.part.start + end)


def _merge(read: list[tuple[Piece, Findings]], findings: Findings) -> None:
    """The findings of all pieces, without those that only repeat a mistake made elsewhere."""
    misused = {
        diagnostic.span.text
        for piece, built in read
        for diagnostic in built.diagnostics
        if diagnostic.code is Code.RESERVED
    }
    tabs, said = False, _said_of_next([piece for piece, _ in read])
    for piece, built in read:
        findings.diagnostics += built.diagnostics
        for diagnostic, failure in piece.mistakes:
            tab = diagnostic.code is Code.INDENTATION and "\t" in diagnostic.span.text
            if not (tab and tabs) and not _uses(failure, misused) and id(diagnostic) not in said:
                findings.add(diagnostic)
            tabs = tabs or tab


def _said_of_next(pieces: list[Piece]) -> set[int]:
    """Of the findings about a line in the first column, which belongs below the one before it, those that another one
    says already: that something is missing there, and the same of further lines below it."""
    said = set()
    for piece, below in pairwise(pieces):
        if not (_is_lost(below) or _is_call(below)) or re.search(r"\n[ \t]*\r?\n", piece.part.text):
            continue
        last = piece.mistakes[-1][0] if piece.mistakes else None
        if (
            last is not None
            and last.code is Code.MISSING
            and _EMPTY.fullmatch(last.span.source.text, last.span.end, piece.part.end)
        ):
            said.add(id(last if _is_lost(below) else below.mistakes[0][0]))
        if _is_lost(piece) and _is_lost(below) and piece.mistakes[1:] == []:
            said.add(id(below.mistakes[0][0]))
    return said


def _is_call(piece: Piece) -> bool:
    """Whether a piece is no declaration, but may be a line of a block."""
    first = piece.mistakes[0][0] if piece.mistakes else None
    if first is None or first.span != _word_span(piece):
        return False
    return re.match(CALL + r"[ \t]*(#|$)", first.span.source.line(first.span.line)) is not None


def _is_lost(piece: Piece) -> bool:
    """Whether a piece is no declaration, but a line that is not indented."""
    first = piece.mistakes[0][0] if piece.mistakes else None
    return first is not None and first.code is Code.INDENTATION and first.span == _word_span(piece)


def _uses(failure: Failure | None, misused: set[str]) -> bool:
    """Whether a line cannot be read that uses a reserved word which another piece declares as a name."""
    return failure is not None and any(str(token) in misused for token in failure.line)
