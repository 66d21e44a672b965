"""How an online run is to be."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypedDict, get_args

SIMULATED = "sim"
"""The port that stands for a simulated brick."""
SLOWEST, FASTEST = 0.01, 1000.0
"""How many simulated seconds may pass in a real one."""

OnImpossible = Literal["apply", "drop", "stop"]
OnSurprise = Literal["apply", "stop"]
OnFailure = Literal["ask", "retry", "next", "stop"]


class Options(TypedDict, total=False):
    """What ``golc.run`` takes besides the program, the port and the callbacks; each is an option of ``golc run`` too.

    Durations are in simulated seconds. ``Settings`` has the defaults.
    """

    events: str | Path | Sequence[str] | None
    """The path of an events file, or its lines; without one a simulated brick lets things happen by chance."""
    listen: tuple[str, int] | None
    """Host and port where exogenous actions are taken over TCP; port 0 is any free one."""
    journal: str | Path | None
    """A new file for everything that happens."""
    stop_when_idle: float | None
    """End with success after waiting for so long; by default never."""
    on_impossible: OnImpossible
    """What becomes of an exogenous action that the theory thinks impossible; by default ``apply``."""
    on_surprise: OnSurprise
    """What is done where a device senses what the theory thinks impossible; by default ``apply``."""
    on_failure: OnFailure
    """What is done about an action that its device cannot do; by default ``stop``."""
    check_invariants: bool
    """End the run as failed in a state in which an invariant is false."""
    step: bool
    """Ask the operator before each action."""
    speed: float
    """How many simulated seconds pass in a real one; by default 1."""
    seed: int
    """Of what a simulated brick leaves to chance; by default 0."""
    world: str | Path | None
    """The file of the world of a simulated brick, or ``"none"``; by default the one beside the domain."""
    picture: str | Path | None
    """A file for a drawing of that world in the end."""


@dataclass(frozen=True)
class Settings:
    """The ``Options`` of one run, and the ``port`` of its bricks; raises ``ValueError`` for what makes no sense."""

    port: str | None = None
    events: str | Path | Sequence[str] | None = None
    listen: tuple[str, int] | None = None
    journal: str | Path | None = None
    stop_when_idle: float | None = None
    on_impossible: OnImpossible = "apply"
    on_surprise: OnSurprise = "apply"
    on_failure: OnFailure = "stop"
    check_invariants: bool = False
    step: bool = False
    speed: float = 1.0
    seed: int = 0
    world: str | Path | None = None
    picture: str | Path | None = None

    def __post_init__(self) -> None:
        if not SLOWEST <= self.speed <= FASTEST:
            raise ValueError(f"the speed is {self.speed:g}, and has to be from {SLOWEST:g} to {FASTEST:g}")
        if self.stop_when_idle is not None and not 0 <= self.stop_when_idle < math.inf:
            raise ValueError(f"stop_when_idle is {self.stop_when_idle:g}, and has to be a number of seconds from 0")
        if self.listen is not None and not 0 <= self.listen[1] <= 65535:
            raise ValueError(f"the port to listen at is {self.listen[1]}, and has to be from 0 to 65535")
        if self.port not in (None, SIMULATED) and (self.world is not None or self.picture is not None):
            raise ValueError("a world and a picture are for a simulated brick, not for one at a port")
        for name, choice in (("on_impossible", OnImpossible), ("on_surprise", OnSurprise), ("on_failure", OnFailure)):
            if (given := getattr(self, name)) not in get_args(choice):
                raise ValueError(f"{name} is {given!r}, and has to be one of {', '.join(get_args(choice))}")
