"""No text makes the parser raise; a text that it refuses has a finding with its place."""

from __future__ import annotations

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Findings, Source
from golc.syntax.parse import parse_expression, parse_file
from golc.syntax.terminals import words
from golc.syntax.text import read_source
from golc.syntax.unparse import unparse

ROOT = Path(__file__).parents[2]
TEXTS = [
    read_source(path).text
    for path in [*sorted((ROOT / "examples").glob("*/*.gl")), ROOT / "tests/programs/everything.gl"]
]
PIECES = [
    *sorted(words()),
    *("(", ")", "[", "]", "{", "}", ":", ":=", "=", "!=", "<", ".", "..", ",", "+", "-", "*", "//", "%", "?"),
    *('"', '"{x}"', "\\", "#", "\t", "\r\n", "\n", "\n    ", "\n        ", "0", "1.5", "x", "f(x)", "é", "_", "\0"),
]


def accepted_or_explained(text: str) -> None:
    source = Source("t", text, editable=True)
    findings = Findings()
    file = parse_file(source, findings)

    assert file is not None or findings.has_errors
    for finding in findings.diagnostics:
        assert 0 <= finding.span.start <= finding.span.end <= len(text)
        assert finding.message and not finding.message.endswith(".")
    if file is not None and not findings.has_errors:
        assert parse_file(Source("t", unparse(file)), findings) == file


@st.composite
def mutated(draw: st.DrawFn) -> str:
    """A valid file with a few parts cut out, doubled, moved or replaced."""
    text = draw(st.sampled_from(TEXTS))
    start = draw(st.integers(0, len(text)))
    text = text[max(0, start - 1500) : start + 1500] if draw(st.booleans()) else text
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(text)))
        length = draw(st.integers(0, 12))
        piece = draw(st.sampled_from(["", text[at : at + length] * 2]) | st.sampled_from(PIECES))
        text = text[:at] + piece + text[at + length :]
    return text


@given(mutated())
def test_a_mutated_file(text: str) -> None:
    accepted_or_explained(text)


@given(st.lists(st.sampled_from(PIECES), max_size=30))
def test_words_and_signs_in_any_order(pieces: list[str]) -> None:
    accepted_or_explained("domain d\n" + " ".join(pieces))


@given(
    st.sampled_from(["fluent f = ", "proc p:\n    ", "action a:\n    ", "type t = "]), st.lists(st.sampled_from(PIECES))
)
def test_a_declaration_that_goes_on_with_anything(head: str, pieces: list[str]) -> None:
    accepted_or_explained(f"domain d\n{head}{' '.join(pieces)}")


@given(st.text())
def test_any_text(text: str) -> None:
    accepted_or_explained(text)


@given(st.binary())
def test_any_bytes(data: bytes) -> None:
    accepted_or_explained(data.decode("utf-8", errors="replace"))


@given(st.lists(st.sampled_from(PIECES), max_size=20))
def test_any_expression(pieces: list[str]) -> None:
    findings = Findings()
    text = " ".join(pieces)

    assert parse_expression(Source("t", text, editable=True), findings) is not None or findings.has_errors
    for finding in findings.diagnostics:
        assert 0 <= finding.span.start <= finding.span.end <= len(text)
