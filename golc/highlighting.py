"""A Pygments lexer for golc files, which colours them in manuals, on slides and in the terminal.

It is offered as an entry point, so that whatever highlights with Pygments knows the language ``golc`` once golc is
installed: ``pygmentize lift.gl``, Sphinx, MkDocs, Jupyter. Pygments itself is no dependency of golc.
"""

from __future__ import annotations

from typing import ClassVar

from pygments.lexer import RegexLexer, default, include, words
from pygments.token import Comment, Keyword, Name, Number, Operator, Punctuation, String, Whitespace

from golc.syntax.words import BRANCHES, CLAUSES, DECLARATIONS, RESERVED
from golc.theory.declare import BUILTIN_TYPES, FUNCTIONS

_CONNECTIVES = ("and", "or", "not", "implies", "iff", "in")
_CONSTANTS = ("true", "false", "none", "unknown")
_LINE_STARTS = "|".join([*CLAUSES, *BRANCHES])


class GolcLexer(RegexLexer):
    """The tokens of a golc file. A word that is free for names is a keyword only where a line may begin with it."""

    name = "golc"
    aliases: ClassVar[list[str]] = ["golc"]
    filenames: ClassVar[list[str]] = ["*.gl"]

    tokens: ClassVar[dict[str, list[object]]] = {
        "root": [
            (rf"^(?:{'|'.join(DECLARATIONS)})\b", Keyword.Declaration, "declared"),
            (rf"^[ \t]+(?=(?:{_LINE_STARTS})[ \t:])", Whitespace, "clause"),
            include("expression"),
        ],
        "declared": [(r"[ \t]+", Whitespace), (r"[A-Za-z]\w*", Name.Function, "#pop"), default("#pop")],
        "clause": [(r"\w+", Keyword, "#pop")],
        "expression": [
            (r"\n+|[^\S\n]+", Whitespace),
            (r"#.*", Comment.Single),
            (r'"', String.Double, "message"),
            (words(_CONSTANTS, suffix=r"\b"), Keyword.Constant),
            (words(_CONNECTIVES, suffix=r"\b"), Operator.Word),
            (words(sorted(RESERVED), suffix=r"\b"), Keyword),
            (words(BUILTIN_TYPES, suffix=r"\b"), Keyword.Type),
            (words(FUNCTIONS, suffix=r"(?=\()"), Name.Builtin),
            (r"[A-Za-z]\w*", Name),
            (r"\d+\.\d+", Number.Float),
            (r"\d+", Number.Integer),
            (r":=|\.\.|!=|<=|>=|//|[-+*%=<>?]", Operator),
            (r"[()\[\]{},:.]", Punctuation),
        ],
        "message": [
            (r'"|\n', String.Double, "#pop"),
            (r"\\.|\{\{|\}\}", String.Escape),
            (r"\{", String.Interpol, "in braces"),
            (r'[^"\\{\n]', String.Double),
        ],
        "in braces": [
            (r"\}", String.Interpol, "#pop"),
            (r"\{", Punctuation, "set in braces"),
            include("expression"),
        ],
        "set in braces": [
            (r"\}", Punctuation, "#pop"),
            (r"\{", Punctuation, "#push"),
            include("expression"),
        ],
    }
