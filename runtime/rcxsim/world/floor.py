"""The floor: what lies and stands on it, and how light it is under a sensor.

Lengths are in mm; light is what the light sensor shows over a surface that fills all it sees, in percent.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import hypot, sqrt
from typing import Protocol, TypeAlias

from golc.runtime.rcxsim.world.geometry import (
    Point,
    Pose,
    Segment,
    distance,
    nearest,
    segments,
    share_of_band,
    share_of_disc,
)


@dataclass(frozen=True)
class Line:
    """A stripe of constant width along a polyline; a smooth curve has been made one of short pieces."""

    name: str
    points: tuple[Point, ...]
    width: float
    light: float

    @cached_property
    def pieces(self) -> list[Segment]:
        return segments(self.points)


@dataclass(frozen=True)
class Rectangle:
    """A patch around ``pose``: so long in the direction of its heading, so wide across."""

    pose: Pose
    length: float
    width: float
    light: float

    def share(self, x: float, y: float, radius: float) -> float:
        """The share of a disc that lies on it; a little too much where the disc covers a corner."""
        ahead, left = self.pose.seen_from(x, y)
        return share_of_band(ahead, self.length / 2, radius) * share_of_band(left, self.width / 2, radius)

    def contains(self, x: float, y: float) -> bool:
        reach = self.length + self.width
        if abs(x - self.pose.x) > reach or abs(y - self.pose.y) > reach:  # as most are, at each step of a robot
            return False
        ahead, left = self.pose.seen_from(x, y)
        return abs(ahead) <= self.length / 2 and abs(left) <= self.width / 2


@dataclass(frozen=True)
class Spot:
    """A round patch."""

    x: float
    y: float
    radius: float
    light: float

    def share(self, x: float, y: float, radius: float) -> float:
        """The share of a disc that lies on it."""
        return share_of_disc(hypot(x - self.x, y - self.y), self.radius, radius)


Patch: TypeAlias = Rectangle | Spot


@dataclass(frozen=True)
class Station:
    """A place with a name, which a mark on the floor shows; ``mark.pose`` looks along the line."""

    name: str
    mark: Rectangle


@dataclass(frozen=True)
class Floor:
    """Everything on the floor; stations lie on lines, lines on patches, and a later patch on an earlier one."""

    light: float
    patches: tuple[Patch, ...] = ()
    lines: Mapping[str, Line] = field(default_factory=dict)
    stations: Mapping[str, Station] = field(default_factory=dict)
    walls: tuple[Segment, ...] = ()


class _Layer(Protocol):
    @property
    def light(self) -> float:
        """What is seen where it covers everything."""

    def share(self, x: float, y: float, radius: float) -> float:
        """The share of a disc that the layer covers."""


class _Stretch:
    """The pieces of a line that come near to a cell."""

    def __init__(self, pieces: Iterable[Segment], half: float, light: float) -> None:
        self.light = light
        self._half = half
        directed = [(ax, ay, bx - ax, by - ay) for ax, ay, bx, by in pieces]
        squares = [(ax, ay, dx, dy, dx * dx + dy * dy) for ax, ay, dx, dy in directed]
        self._pieces = [piece for piece in squares if piece[4] > 0]

    def share(self, x: float, y: float, radius: float) -> float:
        """The share of a disc that lies on the line, as if that were straight near by."""
        least = most = (self._half + radius) ** 2
        # `geometry.distance` in the place where most of the time goes: no calls, and only the last root.
        for ax, ay, dx, dy, square in self._pieces:
            px, py = x - ax, y - ay
            part = (px * dx + py * dy) / square
            if part > 0:
                if part > 1:
                    part = 1
                px, py = px - part * dx, py - part * dy
            off = px * px + py * py
            if off < least:
                least = off
        return 0.0 if least == most else share_of_band(sqrt(least), self._half, radius)


CELL = 40.0
"""The side of the squares for each of which the floor remembers what is near."""
HALF_DIAGONAL = CELL * 0.71
MOST_CELLS = 50_000
"""More squares than this are not remembered: a robot may drive away and never come back."""


class Brightness:
    """Tells how light the floor is to sensors that see discs of a radius up to ``reach``."""

    def __init__(self, floor: Floor, reach: float) -> None:
        self._floor = floor
        self._reach = reach + HALF_DIAGONAL
        self._cells: dict[tuple[int, int], list[_Layer]] = {}

    def at(self, x: float, y: float, radius: float) -> float:
        """What a sensor over a point shows: every surface counts by its share of the disc."""
        cell = (int(x // CELL), int(y // CELL))
        layers = self._cells.get(cell)
        if layers is None:
            if len(self._cells) >= MOST_CELLS:
                self._cells.clear()
            layers = self._cells[cell] = self._layers((cell[0] + 0.5) * CELL, (cell[1] + 0.5) * CELL)
        light = self._floor.light
        for layer in layers:
            share = layer.share(x, y, radius)
            if share:
                light += share * (layer.light - light)
        return light

    def _layers(self, x: float, y: float) -> list[_Layer]:
        """What lies near a cell around a point, from the bottom to the top."""
        found: list[_Layer] = [patch for patch in self._floor.patches if patch.share(x, y, self._reach) > 0]
        for line in self._floor.lines.values():
            near = [piece for piece in line.pieces if distance(x, y, piece) <= line.width / 2 + self._reach]
            if near:
                found.append(_Stretch(near, line.width / 2, line.light))
        marks = [station.mark for station in self._floor.stations.values()]
        return found + [mark for mark in marks if mark.share(x, y, self._reach) > 0]


def nearest_on_lines(floor: Floor, x: float, y: float) -> tuple[float, Segment] | None:
    """The distance to the nearest line and the piece of it that is near; None without lines."""
    found = [(distance(x, y, piece), piece) for line in floor.lines.values() for piece in line.pieces]
    return min(found, default=None)


def pushed_out(x: float, y: float, radius: float, walls: Sequence[Segment]) -> Point | None:
    """Where a disc stands that has been pushed out of all walls, which it may have entered by less than its radius.

    None if there is no room: it would have to go through another wall.
    """
    for _ in range(MOST_PUSHES):
        deep = [(distance(x, y, wall), wall) for wall in walls]
        depth, wall = min(deep, default=(radius, None))
        if wall is None or depth >= radius - CONTACT:
            return x, y
        if depth == 0:
            return None
        nx, ny = nearest(x, y, wall)
        x, y = nx + (x - nx) * radius / depth, ny + (y - ny) * radius / depth
    return None


MOST_PUSHES = 8
"""Out of one wall into another and back: in a narrow corner it does not end."""
CONTACT = 1e-6
"""mm by which a disc that touches a wall may seem to be in it."""
