"""What is remembered of a world that has run: where the robot was, and what happened there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import hypot
from typing import NamedTuple

from golc.runtime.rcxsim.world.geometry import Pose, needed

EVERY = 5.0
"""mm between the remembered points of a path."""
WITHIN = 1.0
"""mm by which a path is off at most when it has been simplified."""
MOST_POINTS = 20_000
MOST_HAPPENINGS = 5_000


class Step(NamedTuple):
    """Where the robot's middle was; seconds since the beginning."""

    time: float
    x: float
    y: float


@dataclass(frozen=True)
class Happening:
    """Something that happened at a place; ``what`` is as in the trace, ``text`` is for people."""

    time: float
    pose: Pose
    what: str
    text: str


@dataclass
class Record:
    """The robot's paths, a new one wherever people have put it, and what happened (the first few thousand things)."""

    paths: list[list[Step]] = field(default_factory=list)
    happenings: list[Happening] = field(default_factory=list)
    _last: Step | None = None
    _limit: int = MOST_POINTS

    def begin(self, time: float, pose: Pose) -> None:
        """The robot is put on the floor."""
        self.end()
        self._last = Step(time, pose.x, pose.y)
        self.paths.append([self._last])

    def move(self, time: float, pose: Pose) -> None:
        """The robot is somewhere else."""
        path = self.paths[-1]
        self._last = Step(time, pose.x, pose.y)
        if hypot(pose.x - path[-1].x, pose.y - path[-1].y) >= EVERY:
            path.append(self._last)
            if len(path) > self._limit:
                path[:] = simplified(path)
                self._limit = MOST_POINTS + len(path)

    def end(self) -> None:
        """Remember also the last few mm."""
        if self._last is not None and self.paths[-1][-1] != self._last:
            self.paths[-1].append(self._last)

    def happen(self, happening: Happening) -> None:
        if len(self.happenings) < MOST_HAPPENINGS:
            self.happenings.append(happening)


def simplified(path: Sequence[Step]) -> list[Step]:
    """A path with as few points as it needs."""
    return [path[place] for place in needed([(step.x, step.y) for step in path], WITHIN)]
