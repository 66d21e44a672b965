"""``golc fmt``: what is written, what is only shown, and what is left alone."""

from __future__ import annotations

import io
import os
import sys
from pathlib import Path

import pytest

from golc.cli import invoke

UGLY = "domain d   # a domain\nproc p :\n  a\n"
CANONICAL = "domain d  # a domain\nproc p:\n    a\n"
BROKEN = "domain d\nproc p:\n    if a\n        b\n"

ROOT = Path(__file__).parents[2]
WRITTEN = [*(ROOT / "examples").glob("*/*.gl"), *(ROOT / "tests" / "programs").glob("*.gl")]

Captured = pytest.CaptureFixture[str]


def test_the_files_of_the_project_are_in_canonical_layout(capsys: Captured) -> None:
    assert (invoke(["fmt", "--check", *map(str, WRITTEN)]), capsys.readouterr().out) == (0, "")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, the current one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_file_is_rewritten(folder: Path, capsys: Captured) -> None:
    path = folder / "a.gl"
    path.write_text(UGLY)

    assert invoke(["fmt", "a.gl"]) == 0
    assert path.read_text() == CANONICAL
    assert list(folder.iterdir()) == [path]
    assert tuple(capsys.readouterr()) == ("wrote a.gl\n", "1 file: 1 changed\n")


def test_what_is_canonical_is_not_written(folder: Path, capsys: Captured) -> None:
    path = folder / "a.gl"
    path.write_text(CANONICAL)
    before = path.stat()

    assert invoke(["fmt", "a.gl"]) == 0
    assert (path.stat().st_ino, path.stat().st_mtime_ns) == (before.st_ino, before.st_mtime_ns)
    assert tuple(capsys.readouterr()) == ("", "1 file: none changed\n")


def test_a_byte_order_mark_and_carriage_returns_go(folder: Path) -> None:
    path = folder / "a.gl"
    path.write_bytes(b"\xef\xbb\xbf" + CANONICAL.replace("\n", "\r\n").encode())

    assert invoke(["fmt", "a.gl"]) == 0
    assert path.read_bytes() == CANONICAL.encode()


def test_permissions_are_kept_and_a_link_stays_a_link(folder: Path) -> None:
    path, link = folder / "a.gl", folder / "link.gl"
    path.write_text(UGLY)
    path.chmod(0o640)
    link.symlink_to(path)

    assert invoke(["fmt", "link.gl"]) == 0
    assert link.is_symlink()
    assert path.read_text() == CANONICAL
    assert path.stat().st_mode & 0o777 == 0o640


def test_a_file_that_does_not_parse_is_left_as_it_is(folder: Path, capsys: Captured) -> None:
    (folder / "broken.gl").write_text(BROKEN)
    (folder / "ugly.gl").write_text(UGLY)

    assert invoke(["fmt", "broken.gl", "missing.gl", "ugly.gl"]) == 1
    assert (folder / "broken.gl").read_text() == BROKEN
    assert (folder / "ugly.gl").read_text() == CANONICAL
    out, err = capsys.readouterr()
    assert out == "wrote ugly.gl\n"
    assert [line for line in err.splitlines() if line.startswith("error")] == [
        "error[GL004]: the colon at the end of this `if` is missing",
        "error[GL001]: cannot read `missing.gl`: there is no such file",
    ]
    assert err.endswith("1 file: 1 changed, 2 left as they are\n")


def test_a_pipe_is_left_alone(folder: Path, capsys: Captured) -> None:
    os.mkfifo(folder / "pipe.gl")
    assert invoke(["fmt", "pipe.gl"]) == 1
    assert capsys.readouterr().err.splitlines() == [
        "error: `pipe.gl` is no file that could be written anew; `-` stands for standard input",
        "0 files: none changed, 1 left as it is",
    ]


def test_python_is_left_to_formatters_of_python(folder: Path, capsys: Captured) -> None:
    (folder / "theory.py").write_text("x =  1\n")

    assert invoke(["fmt", "theory.py"]) == 1
    assert (folder / "theory.py").read_text() == "x =  1\n"
    assert "`theory.py` is Python: use a formatter of Python" in capsys.readouterr().err


def test_check_lists_what_would_change(folder: Path, capsys: Captured) -> None:
    (folder / "a.gl").write_text(UGLY)
    (folder / "b.gl").write_text(CANONICAL)

    assert invoke(["fmt", "--check", "a.gl", "b.gl"]) == 1
    assert (folder / "a.gl").read_text() == UGLY
    assert tuple(capsys.readouterr()) == ("a.gl\n", "2 files: 1 would change\n")
    assert invoke(["fmt", "--check", "-q", "b.gl"]) == 0
    assert tuple(capsys.readouterr()) == ("", "")


def test_diff_shows_what_would_change(folder: Path, capsys: Captured) -> None:
    (folder / "a.gl").write_text(UGLY.rstrip("\n"))

    assert invoke(["fmt", "--diff", "-q", "a.gl"]) == 0
    assert (folder / "a.gl").read_text() == UGLY.rstrip("\n")
    assert capsys.readouterr().out.splitlines() == [
        "--- a.gl",
        "+++ a.gl (canonical)",
        "@@ -1,3 +1,3 @@",
        "-domain d   # a domain",
        "-proc p :",
        "-  a",
        r"\ No newline at end of file",
        "+domain d  # a domain",
        "+proc p:",
        "+    a",
    ]
    assert invoke(["fmt", "--diff", "--check", "-q", "a.gl"]) == 1


@pytest.mark.parametrize(
    ("arguments", "text", "code", "out"),
    [
        ([], UGLY, 0, CANONICAL),
        ([], CANONICAL, 0, CANONICAL),
        (["--check"], UGLY, 1, "<stdin>\n"),
        ([], BROKEN, 1, ""),
        ([], "", 1, ""),
    ],
    ids=["ugly", "canonical", "check", "broken", "empty"],
)
def test_a_hyphen_is_standard_input(
    arguments: list[str], text: str, code: int, out: str, monkeypatch: pytest.MonkeyPatch, capsys: Captured
) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text.encode())))

    assert invoke(["fmt", *arguments, "-"]) == code
    assert capsys.readouterr().out == out


def test_a_folder_that_may_not_be_written_is_said(
    folder: Path, capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "a.gl").write_text(UGLY)

    def refuse(self: Path, *args: object, **kwargs: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "replace", refuse)
    assert invoke(["fmt", "a.gl"]) == 1
    assert capsys.readouterr().err == (
        "error: `a.gl` cannot be written: Permission denied\n0 files: none changed, 1 left as it is\n"
    )
    assert [path.name for path in folder.iterdir()] == ["a.gl"]
    assert (folder / "a.gl").read_text() == UGLY
