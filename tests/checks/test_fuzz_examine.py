"""No input makes the checker raise; every finding can be shown."""

from __future__ import annotations

import json
import random
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.loading import examine
from golc.rendering import render, to_json

ROOT = Path(__file__).parents[2]
TEXTS = [
    path.read_text() for folder in ("examples", "tests/programs") for path in sorted((ROOT / folder).rglob("*.gl"))
]
WORDS = sorted({word for text in TEXTS for word in text.split()})


@pytest.fixture(scope="module")
def path() -> Iterator[Path]:
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder) / "fuzz.gl"


def examined(path: Path, data: bytes) -> None:
    path.write_bytes(data)
    examined = examine(path, proofs=True)
    diagnostics = examined.findings
    assert examined.theory is not None or any(diagnostic.severity.value == "error" for diagnostic in diagnostics)
    for diagnostic in diagnostics:
        assert diagnostic.message in render(diagnostic) or not diagnostic.message.isprintable()
        json.dumps(to_json(diagnostic))


@given(st.binary(max_size=300))
def test_bytes(path: Path, data: bytes) -> None:
    examined(path, data)


@given(st.text(max_size=300))
def test_texts_after_a_domain_line(path: Path, text: str) -> None:
    examined(path, f"domain d\n{text}".encode("utf-8", errors="surrogatepass"))


@given(st.randoms(use_true_random=False))
def test_mutated_programs(path: Path, rng: random.Random) -> None:
    text = rng.choice(TEXTS)
    for _ in range(rng.randint(1, 6)):
        text = mutated(text, rng)
    examined(path, text.encode())


@given(st.lists(st.sampled_from(WORDS), max_size=40))
def test_words_of_programs(path: Path, words: list[str]) -> None:
    examined(path, f"domain d\n{' '.join(words)}\n".encode())


@pytest.mark.parametrize("seed", [1, 2])
def test_mutants_go_through_every_command(tmp_path: Path, seed: int) -> None:
    command = [sys.executable, str(ROOT / "tests/fuzz"), "--count", "25", "--seed", str(seed), "--keep", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout[:10]) == (0, "25 inputs "), done.stdout


def test_an_input_for_which_there_is_no_memory_is_kept(tmp_path: Path) -> None:
    command = [sys.executable, str(ROOT / "tests/fuzz"), "--count", "2", "--megabytes", "30", "--keep", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and ", 2 faults of 1 kinds" in done.stdout
    assert {path.suffix for path in tmp_path.iterdir()} == {".gl", ".txt"}


def mutated(text: str, rng: random.Random) -> str:
    """A text with one part of it left out, repeated, moved or replaced."""
    lines = text.splitlines(keepends=True)
    place, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    words = lines[place].split(" ")
    match rng.randrange(7):
        case 0:
            del lines[place]
        case 1:
            lines[place], lines[other] = lines[other], lines[place]
        case 2:
            lines.insert(place, lines[other])
        case 3:
            words[rng.randrange(len(words))] = rng.choice(WORDS)
            lines[place] = " ".join(words)
        case 4:
            del words[rng.randrange(len(words))]
            lines[place] = " ".join(words)
        case 5:
            column = rng.randrange(len(lines[place]) or 1)
            lines[place] = lines[place][:column] + rng.choice('(){}[]:,.="#+-*/ 0aΩ\n\t') + lines[place][column:]
        case _:
            column = rng.randrange(len(lines[place]) or 1)
            lines[place] = lines[place][:column] + lines[place][column + 1 :]
    return "".join(lines) or "\n"
