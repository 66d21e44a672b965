"""Cells of a notebook are run again and again: a declaration takes the place of the one before."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from linecache import cache

import pytest

from golc.embed import Theory
from golc.syntax.unparse import unparse

Cell = Callable[[str], None]


@pytest.fixture
def names() -> dict[str, object]:
    return {}


@pytest.fixture
def cell(names: dict[str, object]) -> Cell:
    """Run a text as IPython does: compiled under a name of its own, under which Python keeps the lines."""
    numbers = count(1)

    def run(text: str) -> None:
        name = f"<ipython-input-{next(numbers)}-test>"
        cache[name] = (len(text), None, text.splitlines(keepends=True), name)
        exec(compile(text, name, "exec"), names)

    return run


def test_a_cell_that_is_run_again_declares_anew(cell: Cell, names: dict[str, object]) -> None:
    cell("from golc.embed import *\ntheory = Theory('lift')\n")
    cell("at = theory.fluent('at', int, 1)\n")
    for floor in (6, 7):
        cell(f"@theory.action\ndef up():\n    poss(at < {floor})\n    causes(at, at + 1)\n")
        cell(f"@theory.axiom(at)\ndef rises():\n    after(up(), {floor})\n")
        cell(f"theory.goal('top', at == {floor})\n")
        cell(f"@theory.device('rcx')\ndef brick():\n    bind(up, number={floor})\n")
    theory = names["theory"]
    assert isinstance(theory, Theory)

    written = theory.written()

    assert written.findings.diagnostics == []
    assert unparse(written.file) == (
        "domain lift\n\nfluent at: int = 1\n\naction up:\n    poss at < 7\n    causes at := at + 1\n\n"
        "axiom at:\n    after up := 7\n    otherwise unchanged\n\ngoal top: at = 7\n\ndevice rcx:\n    7 up\n"
    )
    assert [source.name for source in written.sources][:2] == ["<ipython-input-1-test>", "<ipython-input-2-test>"]
