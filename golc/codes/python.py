"""Pages with their domains as theories in Python."""

from __future__ import annotations

import re

from golc.codes.pages import EXAMPLE, FENCE, Page
from golc.diagnostics import Findings, Source
from golc.embed.printing import python_text
from golc.syntax.comments import lines
from golc.syntax.parse import parse_file

PYTHON_EXAMPLE = "example.py"


def in_python(page: Page) -> Page | None:
    """The page with its domains as theories in Python; none if it is about the text or a comment of a ``.gl`` file."""
    try:
        return Page(page.code, FENCE.sub(_block, page.text), PYTHON_EXAMPLE)
    except _TextError:
        return None


class _TextError(Exception):
    """A block whose text itself is what the page is about."""


def _block(fence: re.Match[str]) -> str:
    match fence["language"]:
        case "golc" if fence["name"] in ("", EXAMPLE):
            return f"```python\n{_theory(fence['text'])}```"
        case "console":
            return fence[0].replace(EXAMPLE, PYTHON_EXAMPLE)
        case _:
            return fence[0]


def _theory(text: str) -> str:
    findings = Findings()
    file = parse_file(Source(EXAMPLE, text), findings)
    if file is None or findings.has_errors:
        raise _TextError
    if any(row.comment is not None for line in lines(text) for row in line.rows):
        raise _TextError
    return python_text(file)
