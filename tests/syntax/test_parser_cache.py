"""The parser kept in the cache directory: used if it is ours, ignored if it is anything else."""

from __future__ import annotations

import os
import pickle
import shutil
import stat
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from golc.diagnostics import Findings, Source
from golc.syntax.parse import parse_expression
from golc.syntax.parser import parser


@pytest.fixture
def empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A cache directory that is not there yet; the parser is loaded anew in the test and after it."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    parser.cache_clear()
    yield tmp_path / "golc"
    parser.cache_clear()


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache directory with the parser in it."""
    home = tmp_path_factory.mktemp("home")
    code = "from golc.syntax.parser import parser; parser()"
    subprocess.run([sys.executable, "-c", code], check=True, env={**os.environ, "XDG_CACHE_HOME": str(home)})
    return home / "golc"


@pytest.fixture
def cache(empty: Path, built: Path) -> Path:
    """A cache directory with the parser in it, for one test."""
    shutil.copytree(built, empty)
    return empty


def works() -> bool:
    parser.cache_clear()
    return parse_expression(Source("t", "1 + 2"), Findings()) is not None


def kept(cache: Path) -> Path:
    (file,) = cache.iterdir()
    return file


def test_the_parser_is_kept_for_this_user_alone(empty: Path) -> None:
    assert works()

    assert stat.S_IMODE(empty.stat().st_mode) == 0o700
    assert stat.S_IMODE(kept(empty).stat().st_mode) == 0o600


def test_what_was_kept_is_used(cache: Path) -> None:
    before = kept(cache).stat()
    assert works()

    assert kept(cache).stat().st_mtime_ns == before.st_mtime_ns
    assert parser().source_path == "<deserialized>"


@pytest.mark.parametrize(
    "content",
    [b"", b"garbage", pickle.dumps({"data": 1, "memo": {}}), pickle.dumps([]), b"\x80\x05."],
    ids=["empty", "garbage", "wrong", "list", "cut"],
)
def test_a_damaged_file_is_replaced(cache: Path, content: bytes) -> None:
    kept(cache).write_bytes(content)

    assert works()
    assert kept(cache).stat().st_size > 100_000


def test_a_file_cut_in_the_middle_is_replaced(cache: Path) -> None:
    whole = kept(cache).read_bytes()
    kept(cache).write_bytes(whole[: len(whole) // 2])

    assert works()
    assert kept(cache).stat().st_size > 0.9 * len(whole)


class Planted:
    """A pickle that runs a command when it is read as such."""

    def __init__(self, command: str) -> None:
        self.command = command

    def __reduce__(self) -> tuple[object, tuple[str]]:
        return os.system, (self.command,)


def test_a_planted_file_runs_nothing(cache: Path, tmp_path: Path) -> None:
    trace = tmp_path / "was here"
    kept(cache).write_bytes(pickle.dumps({"data": Planted(f"touch '{trace}'"), "memo": {}}))

    assert works()
    assert not trace.exists()


@pytest.mark.parametrize("mode", [0o666, 0o660, 0o602])
def test_a_file_that_others_may_write_is_not_read(cache: Path, mode: int) -> None:
    kept(cache).chmod(mode)

    assert works()
    assert parser().source_path != "<deserialized>"
    assert stat.S_IMODE(kept(cache).stat().st_mode) == 0o600


def test_a_link_in_place_of_the_file_is_not_followed(cache: Path, tmp_path: Path) -> None:
    target, elsewhere = kept(cache), tmp_path / "elsewhere"
    target.rename(elsewhere)
    target.symlink_to(elsewhere)

    assert works()
    assert parser().source_path != "<deserialized>"
    assert not target.is_symlink()


@pytest.mark.parametrize("mode", [0o777, 0o770, 0o702])
def test_a_directory_that_others_may_write_is_not_used(empty: Path, mode: int) -> None:
    empty.mkdir()
    empty.chmod(mode)

    assert works()
    assert list(empty.iterdir()) == []


def test_a_link_in_place_of_the_directory_is_not_used(empty: Path, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir(mode=0o700)
    empty.symlink_to(elsewhere)

    assert works()
    assert list(elsewhere.iterdir()) == []


def test_a_file_in_place_of_the_directory(empty: Path) -> None:
    empty.write_text("a file")

    assert works()


def test_a_cache_directory_that_cannot_be(empty: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", "/proc/nowhere")

    assert works()
    assert not empty.exists()


def test_a_relative_cache_home_is_ignored(empty: Path, monkeypatch: pytest.MonkeyPatch, built: Path) -> None:
    home = empty.parent / "home"
    shutil.copytree(built, home / ".cache/golc")
    monkeypatch.setenv("XDG_CACHE_HOME", "relative")
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.chdir(empty.parent)

    assert works()
    assert parser().source_path == "<deserialized>"
    assert not (empty.parent / "relative").exists()


def test_a_full_disk(empty: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: Path, target: Path) -> Path:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", refuse)

    assert works()
    assert list(empty.iterdir()) == []


def test_two_processes_at_once_leave_one_whole_file(empty: Path) -> None:
    code = "from golc.syntax.parser import parser; parser()"
    processes = [subprocess.Popen([sys.executable, "-c", code]) for _ in range(2)]

    assert [process.wait(timeout=60) for process in processes] == [0, 0]
    assert works()
    assert parser().source_path == "<deserialized>"
    kept(empty)
