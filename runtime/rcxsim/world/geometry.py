"""Points, arcs and shares of a disc: the little geometry that a robot on a flat floor needs.

Lengths are in mm, angles in radians, counter-clockwise from the x axis.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import acos, atan2, cos, hypot, pi, sin, sqrt
from typing import NamedTuple, TypeAlias

Point: TypeAlias = tuple[float, float]
Segment: TypeAlias = tuple[float, float, float, float]
"""x and y of one end, x and y of the other."""
NEARLY_STRAIGHT = 1e-6
"""Radians of a turn below which the chord of an arc is as long as the arc."""


class Pose(NamedTuple):
    """Where something stands and whereto it looks."""

    x: float
    y: float
    heading: float

    def place(self, ahead: float, left: float) -> Point:
        """A point that is so far ahead and to the left."""
        c, s = cos(self.heading), sin(self.heading)
        return self.x + ahead * c - left * s, self.y + ahead * s + left * c

    def seen_from(self, x: float, y: float) -> Point:
        """How far ahead and to the left a point is."""
        c, s = cos(self.heading), sin(self.heading)
        dx, dy = x - self.x, y - self.y
        return dx * c + dy * s, dy * c - dx * s


def arc(pose: Pose, left: float, right: float, base: float) -> Pose:
    """Where two wheels, so far apart, get to that have rolled so far: an arc of a circle, not an approximation."""
    way, turn = (left + right) / 2, (right - left) / base
    half = turn / 2
    chord = way if abs(half) < NEARLY_STRAIGHT else way * sin(half) / half
    return Pose(
        pose.x + chord * cos(pose.heading + half), pose.y + chord * sin(pose.heading + half), pose.heading + turn
    )


def nearest(x: float, y: float, segment: Segment) -> Point:
    """The point of a segment that is nearest to a point."""
    ax, ay, bx, by = segment
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    if square == 0:
        return ax, ay
    part = min(1.0, max(0.0, ((x - ax) * dx + (y - ay) * dy) / square))
    return ax + part * dx, ay + part * dy


def distance(x: float, y: float, segment: Segment) -> float:
    """From a point to a segment."""
    nx, ny = nearest(x, y, segment)
    return hypot(x - nx, y - ny)


def apart(one: Segment, other: Segment) -> float:
    """The distance of two segments, 0 where they cross."""
    if _crosses(one, other) and _crosses(other, one):
        return 0.0
    return min(
        distance(one[0], one[1], other),
        distance(one[2], one[3], other),
        distance(other[0], other[1], one),
        distance(other[2], other[3], one),
    )


def _crosses(one: Segment, other: Segment) -> bool:
    """Whether the ends of one segment lie on different sides of the line through the other."""
    ax, ay, bx, by = other
    dx, dy = bx - ax, by - ay
    return (dx * (one[1] - ay) - dy * (one[0] - ax)) * (dx * (one[3] - ay) - dy * (one[2] - ax)) < 0


def share_before(x: float, radius: float) -> float:
    """The share of a disc around 0 that lies before a straight edge at ``x``; of a point, all or nothing."""
    if x >= radius:
        return 1.0
    if x <= -radius:
        return 0.0
    part = x / radius
    return 1 - (acos(part) - part * sqrt(1 - part * part)) / pi


def share_of_band(offset: float, half: float, radius: float) -> float:
    """The share of a disc in a straight band that reaches ``half`` to either side of its middle, ``offset`` away."""
    return share_before(half - offset, radius) - share_before(-half - offset, radius)


def share_of_disc(offset: float, large: float, radius: float) -> float:
    """The share of a disc that lies within another one, of radius ``large``, whose centre is ``offset`` away."""
    if offset >= large + radius:
        return 0.0
    if offset <= abs(large - radius):
        return 1.0 if radius <= large else (large / radius) ** 2
    # A lens: a segment of either circle, as far as their common chord.
    here = (offset * offset + radius * radius - large * large) / (2 * offset)
    there = offset - here
    area = pi * radius * radius * share_before(-here, radius) + pi * large * large * share_before(-there, large)
    return area / (pi * radius * radius)


CURVE_STEP = 5.0
"""mm between the points of a smooth curve, about."""
MOST_STEPS = 200
"""Points between two of the points that a smooth curve goes through."""


def smooth(points: Sequence[Point], closed: bool) -> list[Point]:
    """A smooth curve through points, as many points on it: a Catmull-Rom spline; neighbours must differ."""
    count = len(points)
    if closed:
        before, after = [points[-1], *points[:-1]], [*points[1:], points[0]]
        beyond = [*points[2:], points[0], points[1]] if count > 1 else [*points]
        pieces = zip(before, points, after, beyond, strict=True)
    else:
        first, last = _mirrored(points[1], points[0]), _mirrored(points[-2], points[-1])
        around = [first, *points, last]
        pieces = zip(around, around[1:], around[2:], around[3:], strict=False)
    curve: list[Point] = []
    for p0, p1, p2, p3 in pieces:
        steps = min(MOST_STEPS, 1 + int(hypot(p2[0] - p1[0], p2[1] - p1[1]) / CURVE_STEP))
        curve.extend(_on_spline(p0, p1, p2, p3, step / steps) for step in range(steps))
    return [*curve, curve[0] if closed else points[-1]]


def _mirrored(point: Point, centre: Point) -> Point:
    return 2 * centre[0] - point[0], 2 * centre[1] - point[1]


def _on_spline(p0: Point, p1: Point, p2: Point, p3: Point, t: float) -> Point:
    """A point between p1 (t = 0) and p2 (t = 1)."""
    a, b = (-t + 2 * t * t - t * t * t) / 2, (2 - 5 * t * t + 3 * t * t * t) / 2
    c, d = (t + 4 * t * t - 3 * t * t * t) / 2, (t * t * t - t * t) / 2
    return a * p0[0] + b * p1[0] + c * p2[0] + d * p3[0], a * p0[1] + b * p1[1] + c * p2[1] + d * p3[1]


def segments(points: Iterable[Point]) -> list[Segment]:
    """The segments of a polyline."""
    return [(*a, *b) for a, b in pairwise(points)]


def along(points: Sequence[Point], way: float) -> Pose:
    """Where one is, and whereto one looks, after having gone so far along a polyline; straight on at its end."""
    pieces = segments(points)
    for piece in pieces:
        length = hypot(piece[2] - piece[0], piece[3] - piece[1])
        if way <= length or piece is pieces[-1]:
            heading = atan2(piece[3] - piece[1], piece[2] - piece[0])
            return Pose(piece[0] + way * cos(heading), piece[1] + way * sin(heading), heading)
        way -= length
    raise ValueError("a polyline has two points at least")


def length_of(points: Iterable[Point]) -> float:
    """The length of a polyline."""
    return sum(hypot(bx - ax, by - ay) for ax, ay, bx, by in segments(points))


def needed(points: Sequence[Point], within: float) -> list[int]:
    """The places of those points of a polyline that are needed to stay so close to it (Douglas and Peucker 1973)."""
    kept = {0, len(points) - 1}
    todo = [(0, len(points) - 1)]
    while todo:
        first, last = todo.pop()
        chord = (*points[first], *points[last])
        furthest = max(range(first, last + 1), key=lambda place: distance(*points[place], chord))
        if distance(*points[furthest], chord) > within:
            kept.add(furthest)
            todo += [(first, furthest), (furthest, last)]
    return sorted(kept)
