"""The inputs of a seed, each of which can be made again by its number."""

from __future__ import annotations

import random
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from golc.loading import examine
from tests.fuzz.corpus import ROOT, Seed
from tests.fuzz.mutate import mutated
from tests.fuzz.stages import Clock

CAREFUL = 0.5
"""How many of the inputs are theories still, if the seed was one: only they reach the planner and what is behind it."""

TRIES = 6
"""How often a change is tried until what it leaves is a theory."""


@dataclass(frozen=True)
class Inputs:
    """Mutants of some domains, written to folders with the files that they may name."""

    seeds: Sequence[Seed]
    seed: int
    folder: Path

    def write(self, number: int, clock: Clock) -> Path:
        """The file of an input; what it raises is a fault, and the file then is what led to it."""
        rng = random.Random(f"{self.seed}:{number}")
        start = rng.choice(self.seeds)
        path = self._folder(start.folder) / "fuzz.gl"
        texts = [seed.text for seed in self.seeds]
        careful = rng.random() < CAREFUL
        text = start.text
        for _ in range(min(rng.randint(1, 10), rng.randint(1, 10), rng.randint(1, 10))):
            for _ in range(TRIES):
                mutant = mutated(text, texts, rng)
                path.write_bytes(_bytes(mutant))
                if not careful or self._is_theory(path, clock):
                    text = mutant
                    break
        path.write_bytes(_bytes(text) if careful else _disturbed(_bytes(text), rng))
        return path

    def _is_theory(self, path: Path, clock: Clock) -> bool:
        with clock.stage("try"):
            return examine(path).theory is not None

    def _folder(self, like: Path) -> Path:
        folder = self.folder / str(like.relative_to(ROOT)).replace("/", "-")
        if not folder.exists():
            folder.mkdir()
            for path in like.iterdir():
                if path.suffix in (".gl", ".nqc", ".py", ".nqh"):
                    shutil.copy(path, folder)
        return folder


def _bytes(text: str) -> bytes:
    return text.encode("utf-8", errors="surrogatepass")


def _disturbed(data: bytes, rng: random.Random) -> bytes:
    """One in fifty: other bytes altogether, or some put in."""
    roll = rng.random()
    if roll < 0.01:
        return rng.randbytes(rng.randint(0, 2000))
    if roll < 0.02:
        place = rng.randint(0, len(data))
        return data[:place] + rng.randbytes(rng.randint(0, 8)) + data[place + rng.randint(0, 4) :]
    return data
