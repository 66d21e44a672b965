"""Hints for the notation of other languages: Prolog, C, Python, the Golog papers."""

from __future__ import annotations

import re
import unicodedata

from golc.diagnostics import Code, Diagnostic
from golc.syntax.failure import Failure, Hint

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


def foreign_sign(failure: Failure) -> Diagnostic | None:
    """A sign that the bad token or character is a part of."""
    found = _sign_at(failure)
    if found is None:
        return None
    start, sign = found
    span = failure.at(start, start + len(sign))
    if sign in SIGNS:
        meaning, ours = SIGNS[sign]
        return failure.finding(Code.FOREIGN, f"{meaning} is `{ours}`, not `{sign}`", span, f"write `{ours}`")
    message, help = PHRASES[sign]
    return failure.finding(Code.FOREIGN, message, span, help)


def _sign_at(failure: Failure) -> tuple[int, str] | None:
    """The longest sign that covers the bad place and begins with a token, and where it begins."""
    text, place = failure.text, failure.place
    width = 1 if failure.bad is None else max(1, len(failure.bad))
    starts = {place, *(token.start_pos or 0 for token in failure.tokens[-3:])}
    for sign in sorted((*SIGNS, *PHRASES), key=len, reverse=True):
        for start in range(place, place - len(sign), -1):
            if sign == "?" and failure.previous is None:
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
    return failure.finding(Code.FOREIGN, "a type stands behind `:`, not `->`", span, "write `:`")


def foreign_word(failure: Failure) -> Diagnostic | None:
    """``then``, ``mod`` and the like; ``else if``."""
    if failure.kind == "IF" and failure.previous is not None and failure.previous.type == "ELSE":
        span = failure.span(failure.previous).to(failure.here())
        return failure.finding(Code.FOREIGN, "“else if” is `elif`", span, "write `elif`")
    if failure.kind == "NAME" and str(failure.bad) in WORDS:
        message, help = WORDS[str(failure.bad)]
        return failure.finding(Code.FOREIGN, message, help=help)
    return None


def full_stop(failure: Failure) -> Diagnostic | None:
    """Prolog's full stop at the end of a line."""
    if not re.match(r"\.[ \t]*(#|$)", failure.rest):
        return None
    return failure.finding(Code.FOREIGN, "a line does not end in a full stop", help="leave it out")


def comment(failure: Failure) -> Diagnostic | None:
    """``//`` and ``%`` where an expression cannot go on: comments of other languages."""
    if failure.kind not in ("IDIV", "MOD"):
        return None
    sign = str(failure.bad)
    return failure.finding(Code.FOREIGN, f"a comment begins with `#`, not `{sign}`", help=f"write `#` for `{sign}`")


def braces(failure: Failure) -> Diagnostic | None:
    """A block in braces."""
    opens = failure.kind == "LBRACE" and (failure.rest[1:].strip() == "" or "COLON" in failure.accepts)
    opens = opens or (failure.kind == "LBRACE" and failure.begins_line())
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
    if found == "_":
        return failure.finding(Code.SYNTAX, "a name begins with a letter, not with `_`", help="write it without")
    name = unicodedata.name(found, "a control character").lower()
    shown = f"`{found}`" if found.isprintable() and not found.isspace() else f"U+{ord(found):04X}"
    return failure.finding(Code.SYNTAX, f"the character {shown} ({name}) has no meaning here", help="remove it")


NOTATION: tuple[Hint, ...] = (full_stop, result_arrow, foreign_sign, foreign_word)
CHARACTERS: tuple[Hint, ...] = (comment, character)
