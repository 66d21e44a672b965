"""How long the checker takes for large files, and how that grows with them, in processor time."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from golc.loading import examine
from tests.bench.large import SHAPES, building
from tests.bench.measure import Row, Unit

EXAMPLES = sorted((Path(__file__).parent.parent.parent / "examples").glob("*/*.gl"))
IMPORTS = 200


def _seconds(work: Callable[[], object]) -> float:
    """Processor time, which other programs on the machine change little."""
    started = time.process_time()
    work()
    return time.process_time() - started


def _examined(text: str, proofs: bool) -> float:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "large.gl"
        path.write_text(text, encoding="utf-8")
        return _seconds(lambda: examine(path, proofs=proofs))


def _slowest_example() -> float:
    return max(_seconds(partial(examine, path, proofs=True)) for path in EXAMPLES)


def _imports() -> float:
    """A file that imports a file that imports a file and so on."""
    with tempfile.TemporaryDirectory() as folder:
        for number in range(IMPORTS):
            use = f'import "d{number + 1}.gl"\n' if number + 1 < IMPORTS else ""
            define = f"fluent f{number}: 0..9 = 0\ngoal g{number}: f{number} = 1\n"
            text = f"domain d{number}\n{use}{define}action a{number}:\n    causes f{number} := 1\n"
            (Path(folder) / f"d{number}.gl").write_text(text, encoding="utf-8")
        return _seconds(lambda: examine(Path(folder) / "d0.gl", proofs=True))


def _growth() -> float:
    """Of all shapes the worst, named on the way; what takes a moment is measured often enough."""
    worst = {shape: _least(make(4000)) / _least(make(2000)) for shape, make in SHAPES.items()}
    shape, factor = max(worst.items(), key=lambda item: item[1])
    print(f"grows most: {shape} {factor:.2f}")
    return factor


def _least(text: str) -> float:
    return min(_examined(text, True) for _ in range(3))


ROWS = [
    *(
        Row(
            f"{'prove' if proofs else 'check'}-{lines}",
            f"a building of {lines:,} lines, {'with' if proofs else 'without'} proofs",
            lines / 1000 * (2 if proofs else 1),
            Unit.SECONDS,
            partial(_examined, building(lines), proofs),
        )
        for proofs in (False, True)
        for lines in (100, 1000, 4000)
    ),
    Row("prove-examples", "all proofs of the slowest example", 2.0, Unit.SECONDS, _slowest_example),
    Row("imports", f"a chain of {IMPORTS} imports, with proofs", 1.0, Unit.SECONDS, _imports),
    Row("growth", f"4,000 for 2,000 lines, worst of {len(SHAPES)} shapes", 3.0, Unit.FACTOR, _growth),
]
