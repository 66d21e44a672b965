"""Room for recursion: a theory is as deep as its text makes it, which is more than Python allows for at first."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

FRAMES = 200_000
"""Python frames that a pass over a theory may need; recursion of Python code alone costs memory, but no C stack."""


EVALUATION = 10_000
"""Frames that evaluating terms may need: recursive functions of a theory pass through builtins, which take C stack."""


@contextmanager
def deep_recursion(frames: int = FRAMES) -> Iterator[None]:
    """Let Python code call itself more deeply than usual; what goes deeper still raises ``RecursionError``."""
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(max(before, frames))
    try:
        yield
    finally:
        sys.setrecursionlimit(before)
