"""How long a search may go on."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from golc.diagnostics import LimitError

OFTEN = 64
"""Expanded pairs between two looks at whether the search is still wanted."""


class GivenUpSearchError(LimitError):
    """A search was given up because somebody wanted something else first."""


@dataclass(frozen=True)
class Limits:
    """Bounds of a search; none is no bound.

    ``steps``: primitive actions in a plan. ``nodes``: (program, state) pairs expanded. ``seconds``: wall-clock time.
    """

    steps: int | None = None
    nodes: int | None = None
    seconds: float | None = None


@dataclass
class Budget:
    """What is left of the limits while a search runs; ``spend`` raises ``LimitError`` when one is reached.

    ``given_up`` says whether the search is not wanted any more.
    """

    limits: Limits = field(default_factory=Limits)
    given_up: Callable[[], bool] = lambda: False
    expanded: int = 0
    cut: bool = False
    """Whether the bound on steps has cut off a branch, so that not finding a plan proves nothing."""
    _started: float = field(default_factory=time.monotonic)

    @property
    def elapsed(self) -> float:
        """Seconds since the search began."""
        return time.monotonic() - self._started

    def spend(self) -> None:
        """Count an expanded pair; ``GivenUpSearchError`` if the search is not wanted any more."""
        self.expanded += 1
        if self.limits.nodes is not None and self.expanded > self.limits.nodes:
            raise LimitError(f"gave up after {self.limits.nodes} expanded pairs of program and state")
        if self.expanded % OFTEN == 0 and self.given_up():
            raise GivenUpSearchError(f"given up ({self.expanded} pairs expanded)")
        if self.limits.seconds is not None and self.elapsed > self.limits.seconds:
            raise LimitError(f"gave up after {self.limits.seconds:g} s ({self.expanded} pairs expanded)")

    def allows(self, steps: int) -> bool:
        """Whether a plan may have this many primitive actions."""
        if self.limits.steps is None or steps <= self.limits.steps:
            return True
        self.cut = True
        return False
