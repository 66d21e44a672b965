"""Large domains, which the benchmarks measure, too."""

from __future__ import annotations

import runpy
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def shapes() -> Mapping[str, Callable[[int], str]]:
    """Domains of about so many lines with a great deal of one thing, by what it is."""
    shapes: Mapping[str, Callable[[int], str]] = runpy.run_path(str(Path(__file__).parents[1] / "bench/large.py"))[
        "SHAPES"
    ]
    return shapes
