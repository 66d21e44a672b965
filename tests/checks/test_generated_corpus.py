"""How much of a generated corpus of theories is decided."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from golc.loading import Examined, examine

SEEDS = range(24)


def proved(folder: Path, write_theory: Callable[[int], str], seeds: range) -> list[Examined]:
    found = []
    for seed in seeds:
        path = folder / f"corpus{seed}.gl"
        path.write_text(write_theory(seed))
        found.append(examine(path, proofs=True))
    return found


def test_at_most_5_percent_of_the_questions_about_a_corpus_are_not_decided(
    tmp_path: Path, write_theory: Callable[[int], str]
) -> None:
    corpus = proved(tmp_path, write_theory, SEEDS)
    assert all(examined.asked > 10 for examined in corpus)
    assert sum(examined.undecided for examined in corpus) <= 0.05 * sum(examined.asked for examined in corpus)
