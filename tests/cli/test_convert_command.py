"""``golc convert``: what is written, what is refused, and what is left alone."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.cli import invoke

GOLC = """domain lamp

fluent lit = false

action switch:
    causes lit := not lit
"""

PYTHON = """from __future__ import annotations

from golc.embed import Theory, causes

theory = Theory("lamp")

lit = theory.fluent("lit", initial=False)


@theory.action
def switch():
    causes(lit, not lit)
"""

Captured = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, with a domain and a theory in Python."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lamp.gl").write_text(GOLC)
    (tmp_path / "light.py").write_text(PYTHON)
    return tmp_path


def test_a_domain_becomes_python(folder: Path, capsys: Captured) -> None:
    assert invoke(["convert", "lamp.gl", "new.py"]) == 0
    assert (folder / "new.py").read_text() == PYTHON
    assert tuple(capsys.readouterr()) == ("wrote new.py\n", "")


def test_python_becomes_a_domain(folder: Path, capsys: Captured) -> None:
    assert invoke(["convert", "light.py", "new.gl"]) == 0
    assert (folder / "new.gl").read_text() == GOLC
    assert tuple(capsys.readouterr()) == ("wrote new.gl\n", "executes light.py\n")


@pytest.mark.parametrize("arguments", [["lamp.gl"], ["lamp.gl", "-"]])
def test_without_a_target_the_text_is_printed(arguments: list[str], capsys: Captured) -> None:
    assert invoke(["convert", *arguments]) == 0
    assert tuple(capsys.readouterr()) == (PYTHON, "")


def test_a_file_is_not_overwritten_unless_told(folder: Path, capsys: Captured) -> None:
    (folder / "old.py").write_text("old")

    assert invoke(["convert", "lamp.gl", "old.py"]) == 1
    assert (folder / "old.py").read_text() == "old"
    assert "`old.py` exists already" in capsys.readouterr().err
    assert invoke(["convert", "--force", "lamp.gl", "old.py"]) == 0
    assert (folder / "old.py").read_text() == PYTHON


@pytest.mark.parametrize("pair", [["lamp.gl", "other.gl"], ["light.py", "other.py"]])
def test_two_files_of_one_kind_are_a_mistake(pair: list[str], folder: Path, capsys: Captured) -> None:
    assert invoke(["convert", *pair]) == 2
    assert "one has to end in `.py`, the other not" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("lamp.gl", "# what hangs there\n"),
        ("light.py", "# what hangs there\n"),
        ("light.py", '"""What hangs there."""\n'),
    ],
)
def test_comments_are_told_to_be_lost(name: str, line: str, folder: Path, capsys: Captured) -> None:
    path = folder / name
    path.write_text(line + path.read_text())

    assert invoke(["convert", name]) == 0
    assert capsys.readouterr().err.splitlines()[-1] == f"the comments of `{name}` are not carried over"


@pytest.mark.parametrize(
    ("text", "name", "said"),
    [
        ("domain d\nfluent = 3\n", "a.gl", "error[GL004]"),
        ("domain d\naction a(n: bool, n: bool)\n", "a.gl", "duplicate argument 'n'"),
        (f"{PYTHON}\n    causes(lit, bright)\n", "a.py", "error[GL012]"),
        (f"{PYTHON}\n    causes(lit, f'{{f\"{{lit}}\" if lit else 1}}')\n", "a.py", "a message inside a message"),
        ("print(", "a.py", "error[GL140]"),
    ],
)
def test_what_cannot_be_converted_is_refused_with_its_place(
    text: str, name: str, said: str, folder: Path, capsys: Captured
) -> None:
    (folder / name).write_text(text)
    target = "new.gl" if name.endswith(".py") else "new.py"

    assert invoke(["convert", name, target]) == 1
    assert not (folder / target).exists()
    found = capsys.readouterr().err
    assert said in found
    assert f"--> {name}:" in found


def test_a_file_that_is_missing_or_a_folder_that_is_not_there(capsys: Captured) -> None:
    assert invoke(["convert", "none.gl"]) == 1
    assert "`none.gl`" in capsys.readouterr().err
    assert invoke(["convert", "lamp.gl", "none/new.py"]) == 1
    assert "`none/new.py` cannot be written: No such file or directory" in capsys.readouterr().err


def test_an_import_stays_an_import(folder: Path, capsys: Captured) -> None:
    (folder / "hall.gl").write_text(
        'domain hall\nimport "lamp.gl"\naction leave:\n    poss not lit\n    causes lit := false\n'
    )

    assert invoke(["convert", "hall.gl", "hall.py"]) == 0
    assert 'theory.import_("lamp.gl")\n\nlit = names("lit")\n' in (folder / "hall.py").read_text()
    assert invoke(["convert", "hall.py"]) == 0
    assert 'import "lamp.gl"\n' in capsys.readouterr().out


def test_standard_output_of_a_theory_is_no_part_of_the_domain(folder: Path, capsys: Captured) -> None:
    (folder / "light.py").write_text(f'{PYTHON}\nprint("hello")\n')

    assert invoke(["convert", "light.py"]) == 0
    assert capsys.readouterr().out == GOLC


def test_files_are_named_from_the_folder_of_the_target(folder: Path) -> None:
    for name in ("lib", "out"):
        (folder / name).mkdir()
    (folder / "lib" / "base.gl").write_text("domain base\n\ntype floor = 1..3\n")
    (folder / "lib" / "parts.py").write_text(
        "from golc.embed import Theory\n"
        'theory = Theory("parts")\n'
        'theory.import_("base.gl")\n'
        '@theory.extern(file="far.py")\n'
        "def far() -> int: ...\n"
        '@theory.device("rcx", file="brick.nqc")\n'
        "def brick():\n    pass\n"
        '@theory.device("host", file="/tools/hands.py", name="h")\n'
        "def hands():\n    pass\n"
    )
    (folder / "whole.py").write_text(
        'from golc.embed import Theory\nfrom lib import parts\ntheory = Theory("whole")\ntheory.include(parts.theory)\n'
    )
    texts = []
    for source, target in (("whole.py", "new.gl"), ("whole.py", "out/new.gl"), ("out/new.gl", "lib/new.py")):
        assert invoke(["convert", "-q", source, target]) == 0
        texts.append((folder / target).read_text())

    assert texts[0] == (
        'domain whole\n\nimport "lib/base.gl"\n\nextern far: int from "lib/far.py"\n\n'
        'device rcx "lib/brick.nqc"\ndevice host h "/tools/hands.py"\n'
    )
    assert texts[1] == texts[0].replace('"lib/', '"../lib/')
    assert [name in texts[2] for name in ('_("base.gl")', 'file="far.py"', 'file="brick.nqc"')] == [True] * 3
