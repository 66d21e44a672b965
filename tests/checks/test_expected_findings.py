"""The findings of every program in ``tests/programs`` stand in comments at their lines.

``# GL012 error 10, GL028 warning 3``: codes, severities and columns of what is found in that line. A program without
such a comment belongs to another test.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from golc.loading import examine

PROGRAMS = Path(__file__).parents[1] / "programs"
COMMENT = re.compile(r"# (GL\d{3} \w+ \d+(?:, GL\d{3} \w+ \d+)*)$", re.MULTILINE)


def expected(text: str) -> list[tuple[int, str]]:
    """Line and finding, as the comments of a text say."""
    return [
        (number, finding)
        for number, line in enumerate(text.splitlines(), start=1)
        for comment in COMMENT.findall(line)
        for finding in comment.split(", ")
    ]


@pytest.mark.parametrize(
    "path", [path for path in sorted(PROGRAMS.glob("*.gl")) if expected(path.read_text())], ids=lambda path: path.stem
)
def test_the_findings_are_those_in_the_comments(path: Path) -> None:
    diagnostics = examine(path).findings
    found = [(d.span.line, f"{d.code.code} {d.severity.value} {d.span.column}") for d in diagnostics]
    assert found == sorted(found, key=lambda finding: finding[0]), "findings come in the order of the text"
    assert sorted(found) == sorted(expected(path.read_text()))
