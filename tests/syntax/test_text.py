"""Reading files: what cannot be text is said before anything else."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from golc.diagnostics import Code, Diagnostic, UserError
from golc.syntax.text import LARGEST, read_source


def refused(path: str | Path) -> Diagnostic:
    with pytest.raises(UserError) as error:
        read_source(path)
    (diagnostic,) = error.value.diagnostics
    assert diagnostic.code is Code.UNREADABLE
    return diagnostic


def test_a_byte_order_mark_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "a.gl"
    path.write_bytes(b"\xef\xbb\xbfdomain d\n")

    source = read_source(path)
    assert (source.name, source.text) == (str(path), "domain d\n")


def test_line_ends_are_left_as_they_are(tmp_path: Path) -> None:
    path = tmp_path / "a.gl"
    path.write_bytes(b"domain d\r\n")

    assert read_source(path).text == "domain d\r\n"


def test_a_missing_file() -> None:
    assert refused("nowhere/missing.gl").message == "cannot read `nowhere/missing.gl`: there is no such file"


def test_a_directory(tmp_path: Path) -> None:
    assert refused(tmp_path).message == f"cannot read `{tmp_path}`: it is a directory"


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_a_file_that_may_not_be_read(tmp_path: Path) -> None:
    path = tmp_path / "a.gl"
    path.write_text("domain d\n")
    path.chmod(0)

    assert refused(path).message == f"cannot read `{path}`: you may not read it"


def test_a_name_that_no_file_can_have() -> None:
    assert refused("a\0b").message == "cannot read `a\0b`: no file can have this name"


def test_a_name_that_is_too_long() -> None:
    assert refused("a" * 5000).message.endswith(": file name too long")


def test_an_empty_file(tmp_path: Path) -> None:
    path = tmp_path / "a.gl"
    path.write_bytes(b"")

    diagnostic = refused(path)
    assert diagnostic.message == f"cannot read `{path}`: it is empty"
    assert diagnostic.help == "a file begins with its domain line: `domain delivery`"


def test_a_binary_file(tmp_path: Path) -> None:
    path = tmp_path / "a.gl"
    path.write_bytes(b"\x7fELF\x00\x01")

    assert refused(path).message == f"cannot read `{path}`: it is binary, not text: byte 5 is zero"


def test_a_device_without_end() -> None:
    assert refused("/dev/zero").message == f"cannot read `/dev/zero`: it is larger than {LARGEST // 2**20} MiB"


def test_a_file_may_be_as_large_as_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("golc.syntax.text.LARGEST", 9)
    path = tmp_path / "a.gl"
    path.write_bytes(b"domain d\n")
    assert read_source(path).text == "domain d\n"

    path.write_bytes(b"domain d2\n")
    assert "it is larger than" in refused(path).message


def test_utf_16(tmp_path: Path) -> None:
    path = tmp_path / "a.gl"
    path.write_bytes("domain d\n".encode("utf-16"))

    diagnostic = refused(path)
    assert diagnostic.message == f"cannot read `{path}`: it is UTF-16, not UTF-8"
    assert diagnostic.help == "save it as UTF-8 in your editor"


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_latin_1_is_shown_where_it_stands(tmp_path: Path, mark: bytes) -> None:
    path = tmp_path / "a.gl"
    path.write_bytes(mark + "domain d\n# größer und ".encode() + b"gr\xf6\xdfer\n")

    diagnostic = refused(path)
    at = len(mark) + 27
    assert diagnostic.message == f"cannot read `{path}`: it is not UTF-8: byte {at} is 0xf6"
    assert (diagnostic.span.line, diagnostic.span.column) == (2, 16)
