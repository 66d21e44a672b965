"""How the robot moves: arcs between walls, at every full step of 5 ms and at every moment between.

The way from one moment to the next is the arc that the two wheels make, without approximation; only whether a wall is
in the way is asked step by step. A wall takes away the movement into it and leaves the rest, and the wheels slip.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from golc.runtime.rcxsim.world.floor import pushed_out
from golc.runtime.rcxsim.world.geometry import Pose, Segment, arc, distance
from golc.runtime.rcxsim.world.robot import Robot, Wheel

STEP = 5_000
"""Microseconds."""


class Moment(NamedTuple):
    """The robot at a time: its pose, and what its wheels have rolled until then."""

    time: int
    pose: Pose
    left: float
    right: float
    room: float
    """How far the robot can go in any direction before it has to look for walls again."""
    held: bool = False
    """Whether a wall took some of the movement away."""


class Drive:
    """The robot's wheels and where they take it; the caller has the clock, in microseconds, which never goes back."""

    def __init__(self, robot: Robot, walls: Sequence[Segment]) -> None:
        self._robot = robot
        self._walls = walls
        self.left, self.right = Wheel(robot.coasts), Wheel(robot.coasts)
        self.lifted = False
        self._last = Moment(0, robot.start, 0.0, 0.0, self._room(robot.start))

    def at(self, now: int) -> Moment:
        """The robot now, which is not before the last moment that was settled."""
        last, left, right = self._last, self.left.rolled(now), self.right.rolled(now)
        if left == last.left and right == last.right:
            return last
        if self.lifted:
            return last._replace(time=now, left=left, right=right)
        pose = arc(last.pose, left - last.left, right - last.right, self._robot.wheel_base)
        way = abs(left - last.left + right - last.right) / 2
        if not self._walls or way < last.room:
            return Moment(now, pose, left, right, last.room - way)
        return self._among_walls(Moment(now, pose, left, right, 0.0), last.pose)

    def roll(self, to: int) -> Iterator[Moment]:
        """The moments at the full steps until then; nothing if the wheels stand."""
        while (full := (self._last.time // STEP + 1) * STEP) <= to:
            before = self._last
            if self.left.rolled(to) == before.left and self.right.rolled(to) == before.right:
                return
            self._last = self.at(full)
            yield self._last

    def settle(self, now: int) -> None:
        """Go on from this moment: a wheel is about to be told something."""
        self._last = self.at(now)._replace(time=now)

    def put(self, pose: Pose, now: int) -> bool:
        """Put the robot on the floor, beside a wall that is in the way; False if there is no room for it."""
        place = pushed_out(pose.x, pose.y, self._robot.radius, self._walls)
        if place is None:
            return False
        self.settle(now)
        self.lifted = False
        free = Pose(*place, pose.heading)
        self._last = self._last._replace(pose=free, room=self._room(free))
        return True

    def stands_from(self) -> int | None:
        """From when both wheels stand if nothing is changed; None if one turns."""
        left, right = self.left.stands_from(), self.right.stands_from()
        return None if left is None or right is None else max(left, right)

    def _among_walls(self, moment: Moment, before: Pose) -> Moment:
        pose = moment.pose
        place = pushed_out(pose.x, pose.y, self._robot.radius, self._walls) or (before.x, before.y)
        if place == (pose.x, pose.y):
            return moment._replace(room=self._room(pose))
        return moment._replace(pose=Pose(*place, pose.heading), held=True)

    def _room(self, pose: Pose) -> float:
        if not self._walls:
            return 0.0
        return max(0.0, min(distance(pose.x, pose.y, wall) for wall in self._walls) - self._robot.radius)
