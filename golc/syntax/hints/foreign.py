"""Hints for the notation of other languages: Prolog, C, Python, the Golog papers."""

from __future__ import annotations

import re
import unicodedata

from golc.diagnostics import Code, Diagnostic, Edit, Fix, Span
from golc.syntax.failure import Failure, Hint
from golc.syntax.hints.fixes import ends_line, instead, removal, sign_at
from golc.syntax.terminals import words

SIGNS = {
    "==": ("equality", "="),
    "===": ("equality", "="),
    "=:=": ("equality", "="),
    "≡": ("equivalence", "iff"),
    "!==": ("inequality", "!="),
    "=\\=": ("inequality", "!="),
    "\\==": ("inequality", "!="),
    "\\=": ("inequality", "!="),
    "=/=": ("inequality", "!="),
    "/=": ("inequality", "!="),
    "<>": ("inequality", "!="),
    "~=": ("inequality", "!="),
    "≠": ("inequality", "!="),
    "=<": ("“at most”", "<="),
    "≤": ("“at most”", "<="),
    "≥": ("“at least”", ">="),
    "&": ("conjunction", "and"),
    "&&": ("conjunction", "and"),
    "/\\": ("conjunction", "and"),
    "∧": ("conjunction", "and"),
    "|": ("disjunction", "or"),
    "||": ("disjunction", "or"),
    "\\/": ("disjunction", "or"),
    "∨": ("disjunction", "or"),
    "!": ("negation", "not"),
    "~": ("negation", "not"),
    "\\+": ("negation", "not"),
    "¬": ("negation", "not"),
    "->": ("implication", "implies"),
    "=>": ("implication", "implies"),
    "-->": ("implication", "implies"),
    "==>": ("implication", "implies"),
    "→": ("implication", "implies"),
    "⊃": ("implication", "implies"),
    "<->": ("equivalence", "iff"),
    "<=>": ("equivalence", "iff"),
    "<==>": ("equivalence", "iff"),
    "↔": ("equivalence", "iff"),
    "∃": ("“there is”", "exists"),
    "∀": ("“for all”", "forall"),
    "∈": ("membership", "in"),
    "∉": ("non-membership", "not in"),
    "/": ("division", "//"),
    "−": ("minus", "-"),
    "×": ("multiplication", "*"),
    "…": ("an interval", ".."),
    "...": ("an interval", ".."),
    "“": ("a quotation mark", '"'),
    "”": ("a quotation mark", '"'),
    "'": ("a quotation mark", '"'),
}
"""Signs of other languages: what they mean there, and what that is here."""

QUOTES = {"“": "”", "”": "”", "'": "'"}
"""What a text begins with elsewhere, and what it ends with there."""

UNCERTAIN = frozenset({"/", "=>"})
"""Signs that may have been meant otherwise: a division without rounding, ``>=``."""

PHRASES = {
    ";": ("`;` does not join or end statements", "write them one below the other, each on a line of its own"),
    ":-": (
        "`:-` is Prolog's: here clauses are named declarations",
        "a condition with a name is `define p(x: t) := …`, a program `proc p(x: t):` with a block",
    ),
    "?-": ("`?-` is Prolog's", "a query is the `--goal` of `golc plan`"),
    "?": ("a test is not written with `?`", "write `test` before the condition"),
    "**": ("there is no power", "multiply, or write a recursive `static`"),
    "^": ("there is no power", "multiply, or write a recursive `static`"),
    "++": ("`++` changes nothing here", "write `causes n := n + 1` in an action"),
    "+=": ("`+=` does not exist", "write `n := n + e`"),
    "-=": ("`-=` does not exist", "write `n := n - e`"),
    "/*": ("a comment begins with `#`", "write `#` before each of its lines"),
    "*/": ("a comment begins with `#` and ends with the line", "write `#` before each of its lines"),
}
"""Signs without a counterpart: the message and the help."""

WORDS = {
    "then": ("`then` is written as a colon", "end the line with `:` and indent what follows"),
    "do": ("`do` is written as a colon", "end the line with `:` and indent what follows"),
    "begin": ("a block begins with a colon", "end the line with `:` and indent what follows"),
    "end": ("a block ends with its indentation", "leave `end` out"),
    "endif": ("a block ends with its indentation", "leave `endif` out"),
    "endwhile": ("a block ends with its indentation", "leave `endwhile` out"),
    "fi": ("a block ends with its indentation", "leave `fi` out"),
    "od": ("a block ends with its indentation", "leave `od` out"),
    "elseif": ("“else if” is `elif`, not `elseif`", "write `elif`"),
    "elsif": ("“else if” is `elif`, not `elsif`", "write `elif`"),
    "mod": ("the remainder is `%`, not `mod`", "write `a % b`"),
    "div": ("division is `//`, not `div`", "write `a // b`"),
    "is": ("equality is `=`, not `is`", "write `=`"),
    "xor": ("“either … or” is `!=` of two formulas", "write `(a) != (b)`"),
    "unless": ("there is no `unless`", "write `if not …`"),
    "such": ("a restriction of a variable is written `where`", "write `where`"),
}
"""Words of other languages that came where no name can."""


TRANSLATED = {"elseif": "elif", "elsif": "elif", "mod": "%", "div": "//", "is": "="}
"""Words that have one counterpart."""


def foreign_sign(failure: Failure) -> Diagnostic | None:
    """A sign that the bad token or character is a part of."""
    found = _sign_at(failure)
    if found is None:
        return None
    start, sign = found
    span = failure.at(start, start + len(sign))
    if sign in SIGNS:
        meaning, ours = SIGNS[sign]
        if ours == "=" and "ASSIGN" in failure.accepts:
            meaning, ours = "a change", ":="
        fix = _quoted(failure, span) if sign in QUOTES else instead(span, ours) if _fits(failure, span, ours) else None
        return failure.finding(Code.FOREIGN, f"{meaning} is `{ours}`, not `{sign}`", span, f"write `{ours}`", fix=fix)
    message, help = PHRASES[sign]
    return failure.finding(Code.FOREIGN, message, span, help, fix=_phrase(failure, span))


def _fits(failure: Failure, span: Span, ours: str) -> bool:
    """Whether our sign must be what is meant, and can stand there."""
    word = words().get(ours.split()[0])
    return span.text not in UNCERTAIN and (
        word is None or span.start != failure.here().start or word in failure.accepts
    )


def _quoted(failure: Failure, span: Span) -> Fix | None:
    """Quotation marks at both ends of what stands between two others, where only a text can stand."""
    inner = re.match(r"(.)([^\"“”'{}\\]*)(.)", failure.rest)
    if inner is None or inner[3] != QUOTES[span.text] or failure.rest.count(inner[3]) > 1 + (inner[1] == inner[3]):
        return None
    if "STRING" not in failure.accepts or "INT" in failure.accepts or span != failure.here():
        return None
    end = Span(span.source, span.start + inner.end() - 1, span.start + inner.end())
    return Fix('write `"` around the text', (Edit(span, '"'), Edit(end, '"')))


def _phrase(failure: Failure, span: Span) -> Fix | None:
    """What is put right at the end of a line outside of brackets: a semicolon, a question mark behind a call."""
    if failure.brackets or not ends_line(span):
        return None
    if span.text == ";":
        return removal(span)
    if span.text == "?" and failure.line and failure.line[0].type == "NAME":
        start = failure.span(failure.line[0]).start
        return Fix("write `test` before it", (Edit(Span(span.source, start, start), "test "), Edit(span, "")))
    return None


def _sign_at(failure: Failure) -> tuple[int, str] | None:
    """The longest sign that covers the bad place and begins with a token, and where it begins."""
    text, place = failure.text, failure.place
    width = 1 if failure.bad is None else max(1, len(failure.bad))
    starts = {place, *(token.start_pos or 0 for token in failure.tokens[-3:])}
    for sign in sorted((*SIGNS, *PHRASES), key=len, reverse=True):
        for start in range(place, place - len(sign), -1):
            if sign == "?" and (failure.previous is None or failure.wants_type):
                continue
            if start in starts and text.startswith(sign, start) and start + len(sign) >= place + width:
                return start, sign
    return None


def result_arrow(failure: Failure) -> Diagnostic | None:
    """``static f(a: t) -> u``."""
    found = _sign_at(failure)
    typed = ("static", "extern", "fluent")
    if found is None or found[1] != "->" or "COLON" not in failure.accepts or str(failure.line[0]) not in typed:
        return None
    span = failure.at(found[0], found[0] + 2)
    fix = instead(failure.gap().to(span), ":")
    return failure.finding(Code.FOREIGN, "a type stands behind `:`, not `->`", span, "write `:`", fix=fix)


def foreign_word(failure: Failure) -> Diagnostic | None:
    """``then``, ``mod`` and the like; ``else if``."""
    if failure.kind == "IF" and failure.previous is not None and failure.previous.type == "ELSE":
        span = failure.span(failure.previous).to(failure.here())
        return failure.finding(Code.FOREIGN, "“else if” is `elif`", span, "write `elif`", fix=instead(span, "elif"))
    if failure.kind == "NAME" and str(failure.bad) in WORDS:
        message, help = WORDS[str(failure.bad)]
        return failure.finding(Code.FOREIGN, message, help=help, fix=_translated(failure))
    return None


def _translated(failure: Failure) -> Fix | None:
    """The sign for a word that stands for it; for a word at the beginning of a block if the block begins below it."""
    here = failure.here()
    if here.text in ("then", "do", "begin"):
        return sign_at(here, ":") if ends_line(here) else None
    differs = re.match(r"is\s+not\b", failure.rest)
    if differs:
        return instead(failure.at(failure.place, failure.place + differs.end()), "!=")
    ours = TRANSLATED.get(here.text)
    return None if ours is None else instead(here, ours)


def full_stop(failure: Failure) -> Diagnostic | None:
    """Prolog's full stop at the end of a line."""
    if not re.match(r"\.[ \t]*(#|$)", failure.rest):
        return None
    here = failure.here()
    return failure.finding(Code.FOREIGN, "a line does not end in a full stop", help="leave it out", fix=removal(here))


def comment(failure: Failure) -> Diagnostic | None:
    """``//`` and ``%`` where an expression cannot go on: comments of other languages."""
    if failure.kind not in ("IDIV", "MOD"):
        return None
    sign = str(failure.bad)
    message, help = f"a comment begins with `#`, not `{sign}`", f"write `#` for `{sign}`"
    return failure.finding(Code.FOREIGN, message, help=help, fix=instead(failure.here(), "#"))


def braces(failure: Failure) -> Diagnostic | None:
    """A block in braces."""
    opens = failure.kind == "LBRACE" and (failure.rest[1:].strip() == "" or "COLON" in failure.accepts)
    opens = opens or (failure.kind == "LBRACE" and failure.begins_line())
    opens = opens and str(failure.line[:1] and failure.line[0]) not in ("fluent", "static", "extern")
    closes = failure.kind == "RBRACE" and not failure.brackets
    if not opens and not closes:
        return None
    return failure.finding(
        Code.FOREIGN,
        "blocks are made by indentation, not by braces",
        help="end the line before the block with `:`, indent the block by four spaces, and leave the braces out",
    )


def character(failure: Failure) -> Diagnostic | None:
    """A character that begins nothing."""
    if failure.bad is not None:
        return None
    found = failure.text[failure.place]
    if found == '"':
        return failure.finding(
            Code.STRING,
            "this string has no end",
            failure.at(failure.place, failure.place + len(failure.rest)),
            'close it with `"` on the same line; a quotation mark inside it is written `\\"`',
        )
    if found.isalpha() or (found.isalnum() and not found.isdigit()):
        message, help = f"a name has no letters but those from a to z, and `{found}` is none", "write another name"
        return failure.finding(Code.SYNTAX, message, help=help)
    if found == "_":
        return failure.finding(Code.SYNTAX, "a name begins with a letter, not with `_`", help="write it without")
    name = unicodedata.name(found, "a control character").lower()
    shown = f"`{found}`" if found.isprintable() and not found.isspace() else f"U+{ord(found):04X}"
    message = f"the character {shown} ({name}) has no meaning here"
    return failure.finding(Code.SYNTAX, message, help="remove it", fix=_invisible(failure))


def _invisible(failure: Failure) -> Fix | None:
    """Spaces for those of other kinds, and nothing for characters without width."""
    kind = unicodedata.category(failure.rest[0])
    if kind not in ("Zs", "Cf"):
        return None
    width = next((i for i, found in enumerate(failure.rest) if unicodedata.category(found) != kind), len(failure.rest))
    span = failure.at(failure.place, failure.place + width)
    return (
        Fix("write plain spaces", (Edit(span, " " * width),)) if kind == "Zs" else Fix("remove it", (Edit(span, ""),))
    )


NOTATION: tuple[Hint, ...] = (full_stop, result_arrow, foreign_sign, foreign_word)
CHARACTERS: tuple[Hint, ...] = (comment, character)
