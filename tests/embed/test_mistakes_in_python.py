"""Each mistake in the files of ``mistakes`` is one finding, with the words written below it.

Below a line stand its findings, ``#! column+width code message`` and ``#! help: …``.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.embed.modules import read_theory
from golc.rendering import render
from tests.notation import no_python
from tests.remarks import remarks

FILES = sorted(Path(__file__).with_name("mistakes").glob("*.py"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_each_mistake_is_one_finding_and_hides_none(path: Path) -> None:
    said = []
    for diagnostic in read_theory(path).findings.diagnostics:
        assert no_python(render(diagnostic)) == []
        span = diagnostic.span
        place = f"{span.column}+{span.end - span.start}"
        said.append((span.line, f"{place} {diagnostic.code.code} {diagnostic.message}"))
        if diagnostic.help is not None:
            said.append((span.line, f"help: {diagnostic.help}"))

    assert sorted(said) == remarks(path.read_text(encoding="utf-8"))
