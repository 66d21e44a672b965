"""Findings as workflow commands of GitHub."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.cli import invoke
from golc.diagnostics import Code, Diagnostic, Severity, Source, Span
from golc.reporting.github import annotation

TEXT = Source("some,dir/a:b.gl", "domain d\nfluent f\n")


def test_a_place_within_a_line() -> None:
    finding = Diagnostic(
        Code.DUPLICATE, "100 % of `f`: twice, or more", Span(TEXT, 16, 17), notes=("one\r\ntwo",), help="drop it"
    )
    assert annotation(finding) == (
        "::error file=some%2Cdir/a%3Ab.gl,line=2,endLine=2,col=8,endColumn=9,title=GL011%3A a name is declared twice"
        "::100 %25 of `f`: twice, or more%0Anote: one%0D%0Atwo%0Ahelp: drop it"
    )


def test_a_place_of_several_lines_has_no_columns() -> None:
    finding = Diagnostic(Code.UNUSED, "unused", Span(TEXT, 7, 15), Severity.WARNING, marker="here")
    assert annotation(finding) == (
        "::warning file=some%2Cdir/a%3Ab.gl,line=1,endLine=2,title=GL027%3A a declaration is not used::unused (here)"
    )


def test_what_has_no_text_and_what_is_in_no_file() -> None:
    unread = Diagnostic(Code.UNREADABLE, "empty", Span(Source("a.gl", ""), 0, 0), Severity.NOTE)
    given = Diagnostic(Code.OVERRIDE, "no such const", Span(Source("-D x", "3"), 0, 1))
    assert annotation(unread) == "::notice file=a.gl,title=GL001%3A a file cannot be read as text or written::empty"
    assert annotation(given).startswith("::error title=GL024%3A ")


def test_the_command_writes_one_line_for_each(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "spare.gl"
    path.write_text("domain d\nconst spare = 3\nfluent also_spare = true\n")
    assert invoke(["check", "--format", "github", str(path)]) == 0
    out, err = capsys.readouterr()
    assert [line.split(" ")[0] for line in out.splitlines()] == ["::warning", "::warning"]
    assert err == "checked 1 file: 2 warnings\n"
