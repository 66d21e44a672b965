"""Every code has a page; its wrong example has exactly this finding, its right one has none."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from textwrap import indent
from typing import TypeAlias

import pytest

from golc.cli import invoke
from golc.codes.pages import EXAMPLE, Example, page
from golc.codes.python import in_python
from golc.diagnostics import Code, Findings, Source
from golc.syntax.format import formatted
from tests.notation import no_python

GOLC_ONLY = {
    **dict.fromkeys([f"GL00{number}" for number in range(2, 10)], "it is about the text of a `.gl` file"),
    "GL032": "comments are not converted",
    "GL110": "it is about an events file",
}
"""The codes whose wrong example has no Python form, or another finding there, and why."""

FOUND = re.compile(r"^(?:error|warning|note)\[(GL\d{3})\]", re.MULTILINE)
Said: TypeAlias = Callable[[Example, Path], str]

QUICK = ("check", "plan", "test", "gen-nqc")
"""Commands without threads and signals, which are called in this process."""


@pytest.fixture
def said(monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Iterator[Said]:
    """What the command of an example says of its files, which are written into a folder."""

    def say(example: Example, folder: Path) -> str:
        folder.mkdir()
        for name, text in example.files.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        monkeypatch.chdir(folder)
        program, *arguments = shlex.split(example.command)
        if program == "golc" and arguments[0] in QUICK:
            code = invoke(arguments)
        else:
            command = [sys.executable, *(["-m", "golc"] if program == "golc" else []), *arguments]
            code = subprocess.run(command, stdin=subprocess.DEVNULL, timeout=120, check=False).returncode
        said = "".join(capfd.readouterr())
        assert code in (0, 1, 5), said
        return said

    before = sys.getrecursionlimit()
    yield say
    sys.setrecursionlimit(before)  # the command line raises it


def needs_nqc(example: Example) -> bool:
    return any(words in example.command for words in ("--compile", "sim robot.nqc", "--world"))


@pytest.mark.parametrize("code", Code, ids=lambda code: code.code)
def test_the_examples_are_what_they_are_for(code: Code, tmp_path: Path, said: Said) -> None:
    wrong, right = page(code).wrong, page(code).right
    if shutil.which("nqc") is None and (needs_nqc(wrong) or needs_nqc(right)):
        pytest.skip("nqc is missing")
    assert FOUND.findall(said(wrong, tmp_path / "wrong")) == [code.code]
    assert FOUND.findall(said(right, tmp_path / "right")) == []


@pytest.mark.parametrize("code", [code for code in Code if code.code not in GOLC_ONLY], ids=lambda code: code.code)
def test_a_finding_about_python_is_told_in_python(code: Code, tmp_path: Path, said: Said) -> None:
    shown = in_python(page(code))
    assert shown is not None
    if shutil.which("nqc") is None and (needs_nqc(shown.wrong) or needs_nqc(shown.right)):
        pytest.skip("nqc is missing")
    rendered = said(shown.wrong, tmp_path / "wrong")
    assert (FOUND.findall(rendered), no_python(rendered)) == ([code.code], [])
    assert FOUND.findall(said(shown.right, tmp_path / "right")) == []


@pytest.mark.parametrize("code", Code, ids=lambda code: code.code)
def test_golc_explain_shows_both_examples(code: Code, capsys: pytest.CaptureFixture[str]) -> None:
    assert invoke(["explain", code.code]) == 0
    shown = capsys.readouterr().out
    for example in (page(code).wrong, page(code).right):
        assert [text for text in example.files.values() if indent(text, "    ").rstrip() not in shown] == []


@pytest.mark.parametrize("code", Code, ids=lambda code: code.code)
def test_right_examples_are_laid_out_canonically(code: Code) -> None:
    text = page(code).right.files.get(EXAMPLE)
    assert text is None or formatted(Source(EXAMPLE, text), Findings()) == text
