"""Plans as they are shown, and what a search for them came to."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

from golc.program.blame import Blocked
from golc.program.labels import Act, Expect
from golc.theory.types import Value

Step: TypeAlias = Act | Expect
"""A step of a plan: something to be done, or something that is expected to happen."""


@dataclass(frozen=True)
class Plan:
    """What executes a program to its end: steps, the last of which may sense what decides how to go on.

    ``senses`` names what the last action senses, where there are ``cases``. ``cost`` is the sum of the actions' costs,
    in the dearest case, of the cheapest plan only.
    """

    steps: tuple[Step, ...]
    senses: tuple[str, ...] = ()
    cases: tuple[Case, ...] = ()
    cost: int | None = None

    @property
    def actions(self) -> tuple[Act, ...]:
        """The steps that are actions."""
        return tuple([step for step in self.steps if isinstance(step, Act)])


@dataclass(frozen=True)
class Case:
    """How a plan goes on after some results of sensing."""

    results: tuple[Value, ...]
    plan: Plan


@dataclass
class Outcome:
    """What a search for plans came to.

    ``stuck`` and ``reasons`` say, where no plan was found, how far the longest way came and what failed there;
    ``gave_up`` is the limit that ended the search, if one did; ``proof`` is what is proven without plan and limit.
    """

    plans: int = 0
    gave_up: str | None = None
    stuck: tuple[str, ...] = ()
    reasons: list[Blocked] = field(default_factory=list)
    expanded: int = 0
    seconds: float = 0.0
    proof: str = "it cannot be executed to its end"
