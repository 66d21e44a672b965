"""Looks for inputs that golc fails on: ``python tests/fuzz [--seed N] [--minutes M | --count N] [--keep DIR]``.

Each input is a mutant of a domain of the examples, the tests and the manual, or random bytes. It goes through the
checker with proofs, every form of findings, the formatter and, where it is a theory, the planner, the tests and the
generators.
An input that golc fails on is kept with what happened; ``--input N`` repeats the N-th of a seed.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.fuzz.corpus import ROOT
from tests.fuzz.process import Worker

SLOW = 10.0
"""Seconds of processor time that a stage may take for a file of up to 1,000 lines. Programs (``test``) may take longer:
a search gives up after a number of steps."""

LARGE = 1000
"""How many MB an input may take in addition to what those before it took, unless it is a search that keeps states."""


def main() -> int:
    parser = argparse.ArgumentParser(prog="tests/fuzz", description="Look for inputs that golc fails on.")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--minutes", type=float, default=None, help="how long, by the clock")
    parser.add_argument("--count", type=int, default=None, help="how many inputs (default 200 without --minutes)")
    parser.add_argument("--first", type=int, default=0, help="the number of the first input")
    parser.add_argument("--input", type=int, default=None, help="only this one")
    parser.add_argument("--megabytes", type=int, default=3000, help="address space of the process (default 3000)")
    parser.add_argument("--keep", type=Path, default=ROOT / "build/fuzz", help="where faults are kept")
    options = parser.parse_args()
    first = options.first if options.input is None else options.input
    last = first + 1 if options.input is not None else first + options.count if options.count else None
    if last is None and options.minutes is None:
        last = first + 200
    with tempfile.TemporaryDirectory() as folder:
        run = _Run(options.seed, Path(folder), options.keep, options.megabytes)
        number = first
        while (last is None or number < last) and (
            options.minutes is None or time.monotonic() - run.began < 60 * options.minutes
        ):
            run.one(number)
            number += 1
            if number % 200 == 0:
                print(run.summary(), flush=True)
        run.worker.close()
    print(run.summary())
    print(", ".join(f"{stage} {seconds:.0f} s" for stage, seconds in run.seconds.most_common()))
    for kind, count in run.kinds.most_common():
        print(f"{count:>6} × {kind}")
    return int(bool(run.kinds))


class _Run:
    """Puts inputs to a worker and counts what becomes of them."""

    def __init__(self, seed: int, folder: Path, keep: Path, megabytes: int) -> None:
        self.seed = seed
        self.folder = folder
        self.keep = keep
        self.worker = Worker(seed, folder, megabytes)
        self.began = time.monotonic()
        self.done = self.theories = self.asked = self.undecided = 0
        self.codes: set[str] = set()
        self.kinds: Counter[str] = Counter()
        self.seconds: Counter[str] = Counter()
        self.slowest: tuple[float, str] = (0.0, "")
        self.largest: tuple[int, str] = (0, "")

    def one(self, number: int) -> None:
        answer = self.worker.ask(number)
        written = max(self.folder.rglob("fuzz.gl"), key=lambda path: path.stat().st_mtime_ns)
        name = f"{self.seed}:{number}"
        times: dict[str, float] = answer.get("times", {})
        stage, seconds = max(times.items(), key=lambda item: item[1], default=("", 0.0))
        slow = max((seconds for stage, seconds in times.items() if stage != "test"), default=0) > SLOW
        if "fault" not in answer and slow and written.read_bytes().count(b"\n") <= 1000:
            answer |= {"fault": f"{times}", "kind": f"slow: {stage}"}
        if "fault" not in answer and answer["more"] > LARGE and stage not in ("plan", "test"):
            answer |= {"fault": f"{answer['more']} MB more, {times}", "kind": f"large: {stage}"}
        self.slowest = max(self.slowest, (round(seconds, 2), f"{name} {stage}"))
        self.largest = max(self.largest, (answer.get("megabytes", 0), name))
        self.seconds.update(times)
        self.done += 1
        self.theories += bool(answer.get("theory"))
        self.codes |= set(answer.get("codes", ()))
        self.asked += answer.get("asked", 0)
        self.undecided += answer.get("undecided", 0)
        if "fault" in answer:
            self._kept(name, answer["kind"], answer["fault"], written.read_bytes())

    def _kept(self, name: str, kind: str, fault: str, data: bytes) -> None:
        self.kinds[kind] += 1
        print(f"{name}: {kind}", flush=True)
        if self.kinds[kind] <= 8:
            self.keep.mkdir(parents=True, exist_ok=True)
            place = self.keep / name.replace(":", "-")
            place.with_suffix(".gl").write_bytes(data)
            place.with_suffix(".txt").write_text(f"{kind}\n{fault}", encoding="utf-8", errors="backslashreplace")

    def summary(self) -> str:
        minutes = (time.monotonic() - self.began) / 60
        return (
            f"{self.done} inputs in {minutes:.1f} min, {self.theories} of them theories, {len(self.codes)} codes, "
            f"{self.asked} questions, {self.undecided} undecided, slowest {self.slowest[0]} s ({self.slowest[1]}), "
            f"largest {self.largest[0]} MB ({self.largest[1]}), "
            f"{sum(self.kinds.values())} faults of {len(self.kinds)} kinds"
        )


if __name__ == "__main__":
    sys.exit(main())
