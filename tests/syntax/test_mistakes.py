"""Each mistake in the files of ``mistakes`` is one finding, with the words written below it.

Below a line stand its findings, ``#! column+width code message`` and ``#! help: …``; ``#! label column+width text`` is
a second place that a finding mentions, and ``#! fix:`` stands before what its fix makes of the line.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.diagnostics import Diagnostic, Findings, Span
from golc.edits import applied, moved
from golc.syntax.parse import parse_file
from golc.syntax.text import read_domain
from tests.remarks import remarks

FILES = sorted(Path(__file__).with_name("mistakes").glob("*.gl"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_each_mistake_is_one_finding(path: Path) -> None:
    source = read_domain(path)
    findings = Findings()
    parse_file(source, findings)
    said = []
    for diagnostic in findings.diagnostics:
        said.append((diagnostic.span.line, f"{_place(diagnostic.span)} {diagnostic.code.code} {diagnostic.message}"))
        if diagnostic.help is not None:
            said.append((diagnostic.span.line, f"help: {diagnostic.help}"))
        said += [(label.span.line, f"label {_place(label.span)} {label.text}") for label in diagnostic.labels]
        said += [(diagnostic.span.line, f"fix: {line}") for line in _fixed(diagnostic)]

    assert sorted(said) == remarks(source.text)


def _fixed(diagnostic: Diagnostic) -> list[str]:
    """The lines that a fix writes anew."""
    if diagnostic.fix is None:
        return []
    source, edits = diagnostic.span.source, diagnostic.fix.edits
    text = applied(source.text, edits)
    start = text.rfind("\n", 0, edits[0].span.start) + 1
    end = text.find("\n", moved(edits[-1].span.end, edits))
    return text[start:end].split("\n")


def _place(span: Span) -> str:
    return f"{span.column}+{span.end - span.start}"
