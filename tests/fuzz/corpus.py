"""The files that are mutated: every domain of the examples, the tests and the pages."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
FENCE = re.compile(r"^```golc.*\n((?:.*\n)*?)```$", re.MULTILINE)


@dataclass(frozen=True)
class Seed:
    """A text, and the folder whose other files it may name."""

    text: str
    folder: Path


def seeds() -> list[Seed]:
    """All domains in a fixed order; what a page shows of a domain counts if it begins one."""
    files = [
        path
        for folder in ("examples", "tests/programs", "tests/syntax/mistakes")
        for path in sorted((ROOT / folder).rglob("*.gl"))
    ]
    found = [Seed(path.read_text(encoding="utf-8"), path.parent) for path in files]
    for page in [
        ROOT / "README.md",
        *sorted((ROOT / "docs").rglob("*.md")),
        *sorted((ROOT / "golc/codes").glob("*.md")),
    ]:
        blocks = FENCE.findall(page.read_text(encoding="utf-8"))
        found += [Seed(block, page.parent) for block in blocks if re.search(r"^domain\b", block, re.MULTILINE)]
    return found
