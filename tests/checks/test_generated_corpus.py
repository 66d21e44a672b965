"""How much of a generated corpus of theories is decided."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from golc.diagnostics import Code
from golc.loading import Examined, examine

SEEDS = range(10)


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
    assert min(examined.asked for examined in corpus) >= 5
    assert sum(examined.undecided for examined in corpus) <= 0.05 * sum(examined.asked for examined in corpus)


def test_without_a_solver_what_is_not_decided_says_that_it_would_help(
    tmp_path: Path, write_theory: Callable[[int], str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "golc.proofs.solver", None)
    corpus = proved(tmp_path, write_theory, SEEDS[:3])
    notes = [finding for examined in corpus for finding in examined.findings if finding.code is Code.NOT_DECIDED]
    assert notes
    assert {note.help for note in notes} == {"install `golc[smt]`, which brings a solver"}
    assert len(notes) == sum(examined.undecided for examined in corpus)
