"""All rows, in the order of the table."""

from __future__ import annotations

import statistics
from collections.abc import Iterator

from tests.bench import checking, classic, knowledge, machine, online, programs, robots, startup
from tests.bench.measure import Row, seconds


def every_row() -> Iterator[Row]:
    """The rows of every module."""
    yield from startup.ROWS
    yield from checking.ROWS
    yield from online.ROWS
    yield from programs.ROWS
    yield from knowledge.ROWS
    yield from machine.ROWS
    yield from classic.ROWS
    yield from robots.ROWS


def calibrate() -> float:
    """How long this machine takes to count to ten million."""
    return statistics.median(seconds(_count) for _ in range(3))


def _count() -> None:
    for _ in range(10**7):
        pass
