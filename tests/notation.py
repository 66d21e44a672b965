"""What is said about a theory in Python, and written as only a `.gl` file has it."""

from __future__ import annotations

import ast
import keyword
import re

GOLC = re.compile(
    r"""
    .+:=
    | (abort|action|after|axiom|by|causes|const|cost|define|device|domain|exog|expect|extern|fluent|given|goal
      |guard|import|initially|invariant|let|on|one|pick|poss|proc|prune|run|say|scenario|search|senses|set|star|static
      |test|type|until|wait|within)[ ]
    | from[ ](?!golc)
    | (true|false|none|skip|exists|forall|one[ ]of)$
    | .*[\w\]}]\?$                   # t?
    | .*\w\.\.[-\w]                  # 1..6
    | \{[a-z]\w*(,[ ]\w+)+\}$        # {a, b} as a type
    | .*[ ](=[ ]…|implies|iff)
    | \w+(\(.*\))?:$                 # the head of a block
    """,
    re.VERBOSE,
)
"""Code that only golc's own form of the language has."""

SOURCE_LINE = re.compile(r"\s*\d+ \||\s*(-->|:::) ")


def no_python(rendered: str) -> list[str]:
    """What rendered findings about a theory in Python quote in another form: golc's notation, and code in a help that
    Python cannot read. The lines of the theory that they show do not count."""
    lines = [line for line in rendered.splitlines() if not SOURCE_LINE.match(line)]
    quoted = [(piece, "= help: " in line) for line in lines for piece in re.findall("`([^`]+)`", line)]
    return [piece for piece, proposed in quoted if GOLC.match(piece) or (proposed and not _reads(piece))]


def _reads(piece: str) -> bool:
    """Whether Python can read a piece of code with holes; options, signs and NQC it need not read."""
    if piece.startswith(("--", "void ", "task ")) or keyword.iskeyword(piece) or re.fullmatch(r"\W+", piece):
        return True
    for hole in ("...", "_", ""):
        try:
            ast.parse(_whole(piece).replace("…", hole))
        except SyntaxError:
            continue
        return True
    return False


def _whole(piece: str) -> str:
    """A piece of code and what it lacks: a decorator its function, a head its block, a generator its brackets."""
    match piece.split()[0], piece[-1]:
        case _, ":" | "=":
            return piece + " ..."
        case "def", _ if "(" not in piece:
            return piece + "(): ..."
        case "for", _:
            return f"[0 {piece}]"
        case "…", _ if " for " in piece:
            return f"[{piece}]"
        case _:
            return piece + "\ndef f(): ..." * piece.startswith("@")
