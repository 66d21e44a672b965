"""Cells of a notebook are run again and again: a declaration takes the place of the one before."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from linecache import cache
from pathlib import Path

import pytest

import golc
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


def test_files_that_a_cell_names_lie_in_the_folder_of_the_notebook(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "helpers.py").write_text("def price(n):\n    return 2 * n\n", encoding="utf-8")
    name = str(tmp_path / "kernel" / "1234.py")
    text = (
        "from golc.embed import Theory, interval\ntheory = Theory('shop')\n"
        "def cheap(n):\n    return price(n) < 4\n"
        "@theory.extern(file='helpers.py')\ndef price(n: interval(1, 3)) -> int: ...\n"
        "@theory.define\ndef bargain(n: interval(1, 3)):\n    return cheap(n)\n"
    )
    cache[name] = (len(text), None, text.splitlines(keepends=True), name)
    names: dict[str, object] = {}
    exec(compile(text, name, "exec"), names)
    theory = names["theory"]
    assert isinstance(theory, Theory)

    shop = golc.load(theory)

    assert [shop.value(shop.initial(), f"price({n})") for n in (1, 3)] == [2, 6]
    assert [source.name for source in theory.written().sources] == ["In [1234]"]
    assert [finding.span.source.name for finding in golc.check(theory).findings] == ["In [1234]"]


def test_an_error_shows_the_cell_and_what_it_says_without_the_inside_of_golc(cell: Cell) -> None:
    cell("import golc\nfrom golc.embed import *\ntheory = Theory('lift')\nat = theory.fluent('at', int, 1)\n")
    with pytest.raises(golc.UserError) as error:
        cell("def checked(φ):\n    return φ and True\n\ntheory.goal('top', checked(at == 3))\n")

    lines = error.value._render_traceback_()
    assert (
        lines[-9:]
        == [
            "<ipython-input-2-test>, line 4:",
            "    theory.goal('top', checked(at == 3))",
            "<ipython-input-2-test>, line 2:",
            "    return φ and True",
            "error[GL142]: `and` asks a term for its truth now, before there is a situation",
            " --> <ipython-input-2-test>:2:12",
            "  |",
            "2 |     return φ and True",
            "  |            ^^^^^^^^^^",
            "  = help: write `(…) & (…)`, or write it in a translated function",
        ][-9:]
    )
    assert not any("golc/embed" in line for line in lines)
