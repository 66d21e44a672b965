"""Each mistake in the files of ``mistakes`` is one finding, with the words written below it.

Below a line stand its findings, ``#! column+width code message`` and ``#! help: …``; ``#! label column+width text`` is
a second place that a finding mentions.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from golc.diagnostics import Findings, Span
from golc.syntax.parse import parse_file
from golc.syntax.text import read_source

FILES = sorted(Path(__file__).with_name("mistakes").glob("*.gl"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_each_mistake_is_one_finding(path: Path) -> None:
    source = read_source(path)
    findings = Findings()
    parse_file(source, findings)
    said = []
    for diagnostic in findings.diagnostics:
        said.append((diagnostic.span.line, f"{_place(diagnostic.span)} {diagnostic.code.code} {diagnostic.message}"))
        if diagnostic.help is not None:
            said.append((diagnostic.span.line, f"help: {diagnostic.help}"))
        said += [(label.span.line, f"label {_place(label.span)} {label.text}") for label in diagnostic.labels]

    assert sorted(said) == sorted(_expected(source.text))


def _place(span: Span) -> str:
    return f"{span.column}+{span.end - span.start}"


def _expected(text: str) -> list[tuple[int, str]]:
    expected, line = [], 0
    for number, content in enumerate(text.splitlines(), 1):
        if note := re.match("#! (.*)", content):
            expected.append((line, note.group(1)))
        else:
            line = number
    return expected
