"""Changes of a text: of its tokens, lines, characters and brackets, and splices of two texts."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence

TOKEN = re.compile(r"\w+|:=|!=|<=|>=|//|\.\.|[ \t]+|\n|.", re.DOTALL)
NAME = re.compile(r"[A-Za-z_]\w*")
NUMBER = re.compile(r"\d+")
DECLARATION = re.compile(r"^(?=[A-Za-z])", re.MULTILINE)

ODDITIES = [
    *("\ufeff", "\u200b", "\u2028", "\u0085", "\x00", "\x0c", "\x0b", "\x1a", "\x1b[31m", "\r", "\r\n", "\t", "\u00a0"),
    *("é", "ß", "İ", "ﬁ", "中", "🤖", "e\u0301", "\u202e", "\ud800", "\U0010ffff", "²", "٣", "—", "“", "≠", "∧"),
    *(
        '"',
        '"""',
        "'",
        "`",
        "\\",
        "\\n",
        "{",
        "}",
        "{{",
        "#",
        "# golc: ignore",
        "# golc: ignore[GL027, GL",
        "$",
        ";",
        "@",
    ),
]
NUMBERS = [
    *(
        "0",
        "1",
        "-1",
        "2",
        "7",
        "255",
        "32768",
        "65536",
        "99999",
        "10000000",
        "18446744073709551616",
        "9" * 40,
        "9" * 5000,
    ),
    *("0.1", "1e9", "1.5", "0x10", "1_000", "007", "1.0000000000000000000000001", "0" * 3000),
]
WORDS = [
    "domain",
    "import",
    "const",
    "type",
    "static",
    "fluent",
    "initially",
    "define",
    "action",
    "exog",
    "expected",
    "from",
    "operator",
    "poss",
    "causes",
    "senses",
    "cost",
    "axiom",
    "after",
    "otherwise",
    "unchanged",
    "invariant",
    "goal",
    "prune",
    "before",
    "scenario",
    "given",
    "run",
    "on",
    "until",
    "expect",
    "actions",
    "at",
    "least",
    "most",
    "exactly",
    "waiting",
    "proc",
    "skip",
    "if",
    "elif",
    "else",
    "while",
    "choose",
    "or",
    "pick",
    "where",
    "star",
    "for",
    "in",
    "let",
    "together",
    "and",
    "prefer",
    "over",
    "interrupts",
    "some",
    "guard",
    "search",
    "first",
    "shortest",
    "cheapest",
    "steps",
    "within",
    "wait",
    "s",
    "say",
    "abort",
    "test",
    "not",
    "implies",
    "iff",
    "exists",
    "forall",
    "count",
    "sum",
    "min",
    "max",
    "true",
    "false",
    "none",
    "unknown",
    "one",
    "of",
    "known",
    "knows",
    "possible",
    "abs",
    "len",
    "rest",
    "set",
    "list",
    "bool",
    "int",
    "real",
    "string",
    "device",
    "rcx",
    "host",
    "self",
    "by",
    "call",
    "start",
    "prompt",
    "timeout",
]
SIGNS = [
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ":",
    ",",
    ".",
    "..",
    ":=",
    "=",
    "!=",
    "<",
    "<=",
    ">",
    ">=",
    "+",
    "-",
    "*",
    "//",
    "%",
    "?",
    "|",
    "==",
    "=>",
    "->",
    ";",
    "\\+",
    ":-",
]
TERMS = [
    *(
        "true",
        "none",
        "unknown",
        "1 // 0",
        "[]",
        "{}",
        "first([])",
        "-(1)",
        "x",
        "5 % 0",
        "[1, 2][7]",
        "1 in {1}",
        '"a{1}"',
    ),
    *(
        "(1 if true else 2)",
        "exists q: 0..3. q = 1",
        "count q: 0..9, w: 0..9. q < w",
        "sum q in [1, 2]. q",
        "knows(true)",
    ),
    *(
        "{q for q: 0..20}",
        "set[0..12]",
        "list[0..3]",
        "0..1000000",
        "min q: 0..5. q * q",
        "known(1)",
        "poss(a)",
        "len([1])",
    ),
    *("9999999 * 9999999", "1 if 1 = 1 else none", "list[set[0..9]]", "(0..1)?", "{-1, 1}", "one of {1, 2}"),
]
DEEP = [
    ("(", ")"),
    ("not ", ""),
    ("-", ""),
    ("[", "]"),
    ("{", "}"),
    ("1 + ", ""),
    ("", " + 1"),
    ("abs(", ")"),
    ("true implies ", ""),
]

SPLICES = 0.12

Mutation = Callable[[str, random.Random], str]


def mutated(text: str, others: Sequence[str], rng: random.Random) -> str:
    """A text with one change, which may come from one of the others."""
    if rng.random() < SPLICES:
        return spliced(text, rng.choice(others), rng)
    kinds, weights = zip(*MUTATIONS, strict=True)
    mutation: Mutation = rng.choices(kinds, weights)[0]
    return mutation(text, rng)


def spliced(text: str, other: str, rng: random.Random) -> str:
    """Two files in one: the beginning of one and the end of the other, or a declaration or a line put in."""
    match rng.randrange(4):
        case 0:
            return text[: rng.randint(0, len(text))] + other[rng.randint(0, len(other)) :]
        case 1:
            return text + other.partition("\n")[2]
        case 2:
            return _inserted(
                text, rng.choice(DECLARATION.split(other)), [m.start() for m in DECLARATION.finditer(text)], rng
            )
        case _:
            places = [m.start() for m in re.finditer(r"^", text, re.MULTILINE)]
            return _inserted(text, rng.choice(other.splitlines() or [""]) + "\n", places, rng)


def _inserted(text: str, part: str, places: list[int], rng: random.Random) -> str:
    place = rng.choice([0, *places])
    return text[:place] + part + text[place:]


def _lines(text: str, rng: random.Random) -> str:
    lines = text.splitlines(keepends=True) or ["\n"]
    place, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(7):
        case 0:
            del lines[place]
        case 1:
            lines[place], lines[other] = lines[other], lines[place]
        case 2:
            lines.insert(place, lines[other])
        case 3:
            lines[place] = " " * rng.choice((1, 2, 4, 8)) + lines[place]
        case 4:
            lines[place] = lines[place].lstrip(" ")
        case 5:
            lines[place] = lines[place].rstrip("\r\n")
        case _:
            del lines[min(place, other) : max(place, other)]
    return "".join(lines)


def _tokens(text: str, rng: random.Random) -> str:
    tokens = TOKEN.findall(text)
    if not tokens:
        return rng.choice(WORDS)
    place, other = rng.randrange(len(tokens)), rng.randrange(len(tokens))
    match rng.randrange(6):
        case 0:
            del tokens[place]
        case 1:
            tokens[place], tokens[other] = tokens[other], tokens[place]
        case 2:
            tokens.insert(place, tokens[other])
        case 3:
            tokens[place] = f" {rng.choice(WORDS)} "
        case 4:
            tokens[place] = rng.choice(SIGNS)
        case _:
            tokens[place] = rng.choice(TERMS)
    return "".join(tokens)


def _same_kind(text: str, rng: random.Random) -> str:
    """A name for another name of the text, or a number for another one: what stays likely to be well formed."""
    pattern = rng.choice((NAME, NAME, NUMBER))
    found = list(pattern.finditer(text))
    if not found:
        return text
    place = rng.choice(found)
    new = rng.choice(found).group() if pattern is NAME else rng.choice([str(rng.randint(0, 9)), *NUMBERS])
    return text[: place.start()] + new + text[place.end() :]


def _term(text: str, rng: random.Random) -> str:
    """Another term behind a sign, or a further one."""
    places = list(
        re.finditer(r"(:=|=|!=|<|\(|\[|\{|,|\bin|\band|\bor|\bif|\bwhen|\btest|\bwhere|\bposs|\bsenses|:) ?", text)
    )
    if not places:
        return text
    place = rng.choice(places).end()
    term = rng.choice(TERMS)
    if rng.random() < 0.5:
        end = re.compile(r"[^,()\[\]{}\n:]*").match(text, place)
        return text[:place] + term + text[end.end() if end else place :]
    return text[:place] + term + rng.choice((" and ", " + ", " = ", " or ", " in ", ", ")) + text[place:]


def _characters(text: str, rng: random.Random) -> str:
    place = rng.randint(0, len(text))
    length = rng.choice((0, 0, 1, 1, 2, 5, 40))
    new = rng.choice(("", rng.choice(ODDITIES), chr(rng.randrange(1, 0x250)), rng.choice(SIGNS)))
    return text[:place] + new + text[place + length :]


def _groups(text: str, rng: random.Random) -> str:
    """A bracketed group for another one, twice, or none."""
    found = [m.span() for m in re.finditer(r"\([^()]*\)|\[[^\[\]]*\]|\{[^{}]*\}", text)]
    if not found:
        return text
    (start, end), (first, last) = rng.choice(found), rng.choice(found)
    return text[:start] + rng.choice(("", text[first:last], text[start:end] * 2)) + text[end:]


def _blocks(text: str, rng: random.Random) -> str:
    """A statement with what is indented below it, moved, repeated or deeper."""
    lines = text.splitlines(keepends=True) or ["\n"]
    start = rng.randrange(len(lines))
    indent = len(lines[start]) - len(lines[start].lstrip())
    end = start + 1
    while end < len(lines) and len(lines[end]) - len(lines[end].lstrip()) > indent:
        end += 1
    block = lines[start:end]
    match rng.randrange(4):
        case 0:
            del lines[start:end]
        case 1:
            lines[start:end] = block * rng.choice((2, 2, 3, 50))
        case 2:
            place = rng.randrange(len(lines))
            lines[place:place] = block
        case _:
            word = rng.choice(
                ("while true", "if true", "search", "star", "guard true", "interrupts", "for v: 1..3", "choose")
            )
            lines[start:end] = [f"{' ' * indent}{word}:\n", *(f"    {line}" for line in block)]
    return "".join(lines)


def _deep(text: str, rng: random.Random) -> str:
    """A term or a block far inside, or a great number of them."""
    times = rng.choice((10, 100, 490, 510, 3000, 20000))
    match rng.randrange(4):
        case 0:
            before, after = rng.choice(DEEP)
            place = rng.choice([0, *(m.end() for m in re.finditer(r"[=(] ?", text))])
            return text[:place] + before * times + "1" + after * times + text[place:]
        case 1:
            times = min(times, 600)
            word = rng.choice(
                ("while true", "if true", "search", "star", "guard true", "choose", "together", "let q = 1")
            )
            return (
                text + "proc deep:\n" + "".join(f"{' ' * n}{word}:\n" for n in range(1, times)) + " " * times + "skip\n"
            )
        case 2:
            line = rng.choice(text.splitlines() or [""])
            times = min(times, 400)
            first = re.compile(r"\d+|(?<=\w)\b")
            return text + "\n" + "\n".join(first.sub(str(number), line, count=1) for number in range(times))
        case _:
            times = min(times, 300)
            chain = "".join(
                f"define d{n} := d{n - 1} {rng.choice(('and', 'or', 'iff'))} d{n - 1}\n" for n in range(1, times)
            )
            return f"{text}\ndefine d0 := 1 = 1\n{chain}goal gd: d{times - 1}\n"


MUTATIONS: list[tuple[Mutation, int]] = [
    (_lines, 10),
    (_tokens, 16),
    (_same_kind, 24),
    (_term, 16),
    (_characters, 8),
    (_groups, 6),
    (_blocks, 8),
    (_deep, 2),
]
"""Each kind of change, and how often it is made."""
