"""``golc check --fix``: what becomes of files."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, TypeAlias

import pytest

from golc.cli import invoke

Captured: TypeAlias = "pytest.CaptureFixture[str]"

SLIPS = """\
domain d  # the first line
fluent f: 1..2 == 1
// a comment
action go
    poss f == 1 && !(f = 2)
    causes f = 2.
"""
RIGHT = """\
domain d  # the first line
fluent f: 1..2 = 1
# a comment
action go:
    poss f = 1 and not (f = 2)
    causes f := 2
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_everything_is_fixed_that_can_be_and_told(folder: Path, capsys: Captured) -> None:
    (folder / "a.gl").write_text(SLIPS)
    assert invoke(["check", "--fix", "a.gl"]) == 0
    assert (folder / "a.gl").read_text() == RIGHT
    out, err = capsys.readouterr()
    assert out == ""
    assert err.splitlines() == [
        "fixed a.gl:2:16 GL005: equality is `=`, not `==`",
        "fixed a.gl:3:1 GL005: a comment begins with `#`, not `//`",
        "fixed a.gl:4:10 GL004: the colon at the end of this `action` is missing",
        "fixed a.gl:5:12 GL005: equality is `=`, not `==`",
        "fixed a.gl:5:17 GL005: conjunction is `and`, not `&&`",
        "fixed a.gl:6:14 GL005: `=` tests, `:=` changes: an effect is written with `:=`",
        "fixed a.gl:6:17 GL005: a line does not end in a full stop",
        "fixed a.gl:5:20 GL005: negation is `not`, not `!`",
        "checked 1 file: 8 findings fixed, nothing left",
    ]
    assert [path.name for path in folder.iterdir()] == ["a.gl"]


def test_without_the_option_the_summary_offers_it(folder: Path, capsys: Captured) -> None:
    (folder / "a.gl").write_text(SLIPS)
    assert invoke(["check", "a.gl"]) == 1
    assert capsys.readouterr().err == "checked 1 file: 7 errors; --fix would fix 7 of them\n"
    assert (folder / "a.gl").read_text() == SLIPS


def test_what_a_mistake_had_hidden_is_shown(folder: Path, capsys: Captured) -> None:
    (folder / "a.gl").write_text("domain d\nfluent f = true\naction go:\n    poss f == true and q\n")
    assert invoke(["check", "--fix", "a.gl"]) == 1
    out, err = capsys.readouterr()
    assert out.splitlines()[0] == "error[GL012]: unknown name `q`"
    assert err.splitlines()[-1] == "checked 1 file: 1 finding fixed, 1 error"
    assert (folder / "a.gl").read_text() == "domain d\nfluent f = true\naction go:\n    poss f = true and q\n"


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"], ids=["plain", "with a mark"])
@pytest.mark.parametrize("end", ["\n", "\r\n"], ids=["lf", "crlf"])
@pytest.mark.parametrize("final", [True, False], ids=["final newline", "none"])
def test_every_other_byte_stays(folder: Path, mark: bytes, end: str, final: bool) -> None:
    before = (
        "domain d\n\n\n# é  \naxiom f:  \n  after go := false # why\nfluent f == true\naction go\nproc p:\n  if f: go"
    )
    after = (
        "domain d\n\n\n# é  \naxiom f:  \n  after go := false # why\n  otherwise unchanged\n"
        "fluent f = true\naction go\nproc p:\n  if f:\n      go"
    )
    before, after = ((text + "\n" * final).replace("\n", end) for text in (before, after))
    (folder / "a.gl").write_bytes(mark + before.encode())
    assert invoke(["check", "--fix", "-q", "a.gl"]) == 0
    assert (folder / "a.gl").read_bytes() == mark + after.encode()


def test_permissions_and_links_stay(folder: Path) -> None:
    (folder / "real.gl").write_text(SLIPS)
    (folder / "real.gl").chmod(0o640)
    (folder / "a.gl").symlink_to("real.gl")
    assert invoke(["check", "--fix", "-q", "a.gl"]) == 0
    assert (folder / "a.gl").is_symlink()
    assert (folder / "real.gl").read_text() == RIGHT
    assert (folder / "real.gl").stat().st_mode & 0o777 == 0o640


def test_an_imported_file_is_fixed(folder: Path, capsys: Captured) -> None:
    (folder / "parts").mkdir()
    (folder / "parts" / "b.gl").write_text("domain b\nfluent f := true\n")
    (folder / "a.gl").write_text('domain a\nimport "parts/b.gl"\naction go:\n    causes f = false\n')
    assert invoke(["check", "--fix", "a.gl", "parts/b.gl"]) == 0
    assert (folder / "parts" / "b.gl").read_text() == "domain b\nfluent f = true\n"
    assert (folder / "a.gl").read_text().endswith("causes f := false\n")
    assert "fixed parts/b.gl:2:10 GL005" in capsys.readouterr().err


def test_a_patch_shows_what_would_change(folder: Path, capsys: Captured) -> None:
    (folder / "b.gl").write_text("domain b\nfluent f := true")
    (folder / "a.gl").write_text('domain a\nimport "b.gl"\naction go:\n    causes f = false\n')
    assert invoke(["check", "--diff", "a.gl", "b.gl"]) == 1
    out, err = capsys.readouterr()
    assert out.splitlines() == [
        "--- a.gl",
        "+++ a.gl (fixed)",
        "@@ -1,4 +1,4 @@",
        " domain a",
        ' import "b.gl"',
        " action go:",
        "-    causes f = false",
        "+    causes f := false",
        "--- b.gl",
        "+++ b.gl (fixed)",
        "@@ -1,2 +1,2 @@",
        " domain b",
        "-fluent f := true",
        r"\ No newline at end of file",
        "+fluent f = true",
        r"\ No newline at end of file",
    ]
    assert err.splitlines()[-1] == "checked 2 files: 2 errors, 1 warning; --fix would fix 2"
    assert (folder / "b.gl").read_text() == "domain b\nfluent f := true"
    assert invoke(["check", "--diff", "--format", "json", "a.gl"]) == 2


def test_only_wanted_findings_are_fixed(folder: Path) -> None:
    text = "domain d\nfluent f == true # golc: ignore\nfluent g == true\ngoal h = f\naction go:\n    causes g := f\n"
    (folder / "a.gl").write_text(text)
    assert invoke(["check", "--fix", "-q", "--select", "GL001", "a.gl"]) == 0
    assert (folder / "a.gl").read_text() == text
    invoke(["check", "--fix", "-q", "--ignore", "GL027", "a.gl"])
    assert (folder / "a.gl").read_text() == text.replace("g ==", "g =").replace("h =", "h:")


def test_json_counts_what_was_fixed(folder: Path, capsys: Captured) -> None:
    (folder / "a.gl").write_text(SLIPS.replace("go", "go(x)"))
    assert invoke(["check", "--fix", "-q", "--format", "json", "a.gl"]) == 1
    said: Any = json.loads(capsys.readouterr().out)
    assert (said["fixed"], said["errors"], [each["code"] for each in said["findings"]]) == (7, 1, ["GL004"])
    assert said["findings"][0]["fix"] is None


def test_json_says_what_a_fix_does(folder: Path, capsys: Captured) -> None:
    (folder / "a.gl").write_text("domain d\nfluent f == true\n")
    invoke(["check", "-q", "--format", "json", "a.gl"])
    (finding,) = json.loads(capsys.readouterr().out)["findings"]
    span = {"file": "a.gl", "line": 2, "column": 10, "end_line": 2, "end_column": 12}
    assert finding["fix"] == {"does": "write `=` for `==`", "edits": [{"span": span, "text": "="}]}


def test_what_may_not_be_written_is_told(folder: Path, capsys: Captured, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "a.gl").write_text(SLIPS)
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    assert invoke(["check", "--fix", "-q", "a.gl"]) == 1
    assert capsys.readouterr().err == "error: `a.gl` cannot be written: you may not write it\n"
    assert (folder / "a.gl").read_text() == SLIPS


def test_a_file_that_changes_meanwhile_is_left_alone(
    folder: Path, capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "a.gl").write_text(SLIPS)

    def save(path: Path, mode: int) -> bool:
        (folder / "a.gl").write_text(SLIPS + "# more\n")
        return True

    monkeypatch.setattr(os, "access", save)
    assert invoke(["check", "--fix", "-q", "a.gl"]) == 1
    assert capsys.readouterr().err == "error: `a.gl` cannot be written: it has changed meanwhile\n"
    assert (folder / "a.gl").read_text() == SLIPS + "# more\n"


def test_a_pipe_is_left_alone(folder: Path, capsys: Captured) -> None:
    reader, writer = os.pipe()
    os.write(writer, SLIPS.encode())
    os.close(writer)
    assert invoke(["check", "--fix", "-q", f"/dev/fd/{reader}"]) == 1
    assert capsys.readouterr().err == f"error: `/dev/fd/{reader}` cannot be written: it is no file\n"


def test_what_may_have_been_meant_otherwise_is_not_fixed(folder: Path) -> None:
    text = "domain d\nfluent f = true\naction rest\nproc control:\n    rest rest\n"
    text += "    search at most 2  f steps:\n        rest\n"
    (folder / "a.gl").write_text(text)
    assert invoke(["check", "--fix", "-q", "a.gl"]) == 1
    assert (folder / "a.gl").read_text() == text
