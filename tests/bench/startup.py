"""How long a user waits for the command line."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from tests.bench.measure import Row, Unit, seconds

DELIVERY = Path(__file__).parent.parent.parent / "examples/delivery/delivery.gl"


def _golc(*arguments: str) -> float:
    command = [sys.executable, "-m", "golc", *arguments]
    return seconds(lambda: subprocess.run(command, check=True, capture_output=True))


ROWS = [
    Row("help", "golc --help", 0.3, Unit.SECONDS, lambda: _golc("--help")),
    Row("check", "golc check examples/delivery/delivery.gl", 0.5, Unit.SECONDS, lambda: _golc("check", str(DELIVERY))),
]
