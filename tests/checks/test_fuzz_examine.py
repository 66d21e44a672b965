"""Every input is a theory or has an error; every finding is shown at its place in the text."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.loading import examine
from tests.fuzz.stages import show

ROOT = Path(__file__).parents[2]
TEXTS = [
    path.read_text() for folder in ("examples", "tests/programs") for path in sorted((ROOT / folder).rglob("*.gl"))
]
WORDS = sorted({word for text in TEXTS for word in text.split()})


@pytest.fixture(scope="module")
def path() -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder) / "fuzz.gl"


def accepted_or_explained(path: Path, data: bytes) -> None:
    path.write_bytes(data)
    show(examine(path, proofs=True))


@given(st.binary(max_size=300))
def test_bytes(path: Path, data: bytes) -> None:
    accepted_or_explained(path, data)


@given(st.text(max_size=300))
def test_texts_after_a_domain_line(path: Path, text: str) -> None:
    accepted_or_explained(path, f"domain d\n{text}".encode("utf-8", errors="surrogatepass"))


@given(st.lists(st.sampled_from(WORDS), max_size=40))
def test_words_of_programs(path: Path, words: list[str]) -> None:
    accepted_or_explained(path, f"domain d\n{' '.join(words)}\n".encode())


def test_mutants_go_through_every_command(tmp_path: Path) -> None:
    command = [sys.executable, str(ROOT / "tests/fuzz"), "--count", "100", "--keep", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    said = re.match(r"100 inputs in .* min, (\d+) of them theories, (\d+) codes, (\d+) questions", done.stdout)
    assert done.returncode == 0 and said is not None, done.stdout
    theories, codes, questions = map(int, said.groups())
    assert 20 <= theories <= 80 and codes >= 20 and questions >= 100, done.stdout


def test_an_input_for_which_there_is_no_memory_is_kept(tmp_path: Path) -> None:
    command = [sys.executable, str(ROOT / "tests/fuzz"), "--count", "2", "--megabytes", "30", "--keep", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and ", 2 faults of 1 kinds" in done.stdout
    assert {path.suffix for path in tmp_path.iterdir()} == {".gl", ".txt"}
