"""What the files of ``mistakes`` say of themselves: below a line stand its findings, each behind ``#!``."""

from __future__ import annotations

import re


def remarks(text: str) -> list[tuple[int, str]]:
    """The number of a line, and what is said below it, in order."""
    found, line = [], 0
    for number, content in enumerate(text.splitlines(), 1):
        if remark := re.match("#! (.*)", content):
            found.append((line, remark.group(1)))
        else:
            line = number
    return sorted(found)
