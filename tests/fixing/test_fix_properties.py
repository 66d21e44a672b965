"""Whatever slips of the fixable kinds come into a file, ``--fix`` leads back to its tree."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Findings, Source
from golc.fixing.rounds import Looked, fix
from golc.fixing.texts import Texts
from golc.syntax import tree as ast
from golc.syntax.parse import parse_file

TEXT = """\
domain lift

# How many floors there are.
const top = 4
type floor = 1..top

fluent at: floor = 1
fluent goal: floor? = none
fluent lit(f: floor) = f in {2, 4}  # the first and the last

action up:
    poss at != top and not lit(at)
    causes at := at + 1
    causes forall f: floor. lit(f) := false when f <= at

exog call(f: floor):
    poss at = f implies lit(f)
    causes goal := f

action off(f: floor):
    poss lit(f) or goal = f

axiom lit(f):
    after off(f) := false
    otherwise unchanged

invariant above: forall f: floor. lit(f) implies f >= 1

proc serve(f: floor):
    while at < f and not lit(f):
        up
    if lit(f):
        off(f)
    elif at = f:
        say "I am at {at} = {f}."
    else:
        test not lit(f)

proc control:
    interrupts:
        on exists f: floor. lit(f) and f > at:
            pick f: floor where lit(f):
                serve(f)
        on true:
            wait
"""

SLIPS = [
    (r"(?<= )=(?= )", "=="),
    (r"(?<= )=(?= )", "=:="),
    (r"(?<= )!=(?= )", "≠"),
    (r"(?<= )!=(?= )", r"\\="),
    (r"(?<= )<=(?= )", "=<"),
    (r" and ", " && "),
    (r" and ", " ∧ "),
    (r"^( *poss\b.*) and ", r"\1 adn "),
    (r"(?<=[\w)]) or (?=\w)", " || "),
    (r"(?<=[\w)]) or (?=\w)", "\xa0or "),
    (r"\bnot (?!in\b)", "!"),
    (r"\bnot (?!in\b)", r"\\+ "),
    (r"\bimplies\b", "→"),
    (r"\bexists ", "∃"),
    (r"\bforall(?= \w+: \w+\.)", "∀"),
    (r"(?<=\d)\.\.(?=\w)", "..."),
    (r"^( *(?:causes|after|define)\b[^=\n]*):=", r"\1="),
    (r"^( *causes\b[^=\n]*):=", r"\1=="),
    (r"^((?:const|type|fluent)\b[^={\n]*) = ", r"\1 := "),
    (r"^( *(?:if|elif|while|for|pick|on|choose|else|proc|action|exog|star|interrupts)\b.*):$", r"\1"),
    (r"^( *(?:if|elif)\b.*):$", r"\1 then"),
    (r"^( *while\b.*):$", r"\1 do"),
    (r"^( *)elif\b", r"\1else if"),
    (r"^( *)causes\b", r"\1cause"),
    (r"^( *)poss\b", r"\1pos"),
    (r"^( *)while\b", r"\1whlie"),
    (r"^( *)interrupts\b", r"\1interupts"),
    (r"^fluent\b", "Fluent"),
    (r"^action\b", "acton"),
    (r"^proc\b", "proc proc"),
    (r"^( *(?:test|poss|causes|fluent|const)\b[^#\n]*[\w)])$", r"\1."),
    (r"^( *(?:test|poss|causes|fluent|const)\b[^#\n]*[\w)])$", r"\1;"),
    (r"^( *)#", r"\1//"),
    (r"^( *(?:if|while|on)\b[^#\n]*:)\n +(?=\w+$)", r"\1 "),
    (r"(?<=\w)\)(?= )", ",)"),
    (r"\n +otherwise unchanged$", ""),
]
"""What is found in the text, and what somebody writes instead."""

IN_TEXT = re.compile(r'"[^"\n]*"|#[^\n]*')


def places(text: str, pattern: str) -> list[re.Match[str]]:
    """Where a slip can come in: not in comments (but for their beginning) and texts."""
    other = [found.span() for found in IN_TEXT.finditer(text)]
    found = re.finditer(pattern, text, re.MULTILINE)
    return [one for one in found if not any(start < one.end() - 1 and one.start() < end for start, end in other)]


KNOWN = [(one, other) for pattern, other in SLIPS for one in places(TEXT, pattern)]


@st.composite
def slips(draw: st.DrawFn) -> str:
    """The text with some slips, of which no two touch a line."""
    chosen = draw(st.lists(st.sampled_from(KNOWN), min_size=1, max_size=8))
    used: set[int] = set()
    text = TEXT
    for one, other in sorted(chosen, key=lambda each: -each[0].start()):
        lines = {text.count("\n", 0, place) + shift for place in one.span() for shift in (-1, 0, 1)}
        if used.isdisjoint(lines):
            used |= lines
            text = text[: one.start()] + one.expand(other) + text[one.end() :]
    if draw(st.booleans()):
        text = re.sub("^(?:    )+", lambda blanks: "\t" * (len(blanks.group()) // 4), text, flags=re.MULTILINE)
    return text.replace("\n", draw(st.sampled_from(["\n", "\r\n"])))


def looker(texts: Texts, path: Path) -> Callable[[], Looked]:
    """Finds what the parser finds."""

    def look() -> Looked:
        source, findings = texts.read(path), Findings()
        parse_file(source, findings)
        found = tuple(findings.diagnostics)
        return Looked(found, found)

    return look


def tree(text: str) -> ast.File | None:
    findings = Findings()
    file = parse_file(Source("fixed", text), findings)
    assert findings.diagnostics == [], "\n".join(f"{each.span}: {each.message}" for each in findings.diagnostics)
    return file


@given(slipped=slips())
def test_slips_are_fixed(slipped: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("slips") / "a.gl"
    path.write_bytes(slipped.encode())
    texts = Texts()
    look = looker(texts, path)
    outcome = fix(texts, look(), look)
    assert outcome.refused == []
    assert tree(texts.read(path).text) == tree(TEXT)


def test_every_slip_can_come_in() -> None:
    assert [slip for slip in SLIPS if not places(TEXT, slip[0])] == []
