"""The world from above as SVG: the floor, the names of the stations, the robot's path, and what happened on it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple
from xml.sax.saxutils import escape

from golc.diagnostics import DeviceError
from golc.runtime.rcxsim.world.floor import Floor, Rectangle
from golc.runtime.rcxsim.world.geometry import Point, Pose
from golc.runtime.rcxsim.world.record import Happening, Record, Step, simplified
from golc.runtime.rcxsim.world.robot import Robot
from golc.runtime.rcxsim.world.scene import Scene
from golc.syntax.text import unwritable

MARGIN = 60.0
"""mm around everything."""
WIDEST = 1000
"""Pixels of the longer side."""
LETTERS = 60
"""The longer side, in heights of letters."""
LETTER_WIDTH = 0.7
"""Of a bold letter, in its height, about."""
STEEP = 0.4
"""How far to the side a name stands that is no longer above or below its mark: the sine of the angle."""
PATH_COLOURS = 24
"""So many parts of the path have colours of their own, from the first to the last."""
FIRST_HUE, LAST_HUE = 210, 0
"""Blue in the beginning, red in the end."""
SHOWN = {"plays": "♪", "press": "●", "put": "✚", "lift": "↑", "touches": "✖"}
"""What happens with a mark, and the mark."""


class _Box(NamedTuple):
    left: float
    bottom: float
    right: float
    top: float


class _Name(NamedTuple):
    text: str
    x: float
    y: float
    anchor: str


@contextmanager
def drawing(path: Path, picture: Callable[[], str]) -> Iterator[None]:
    """Write a picture into a file in the end; the file is opened in the beginning.

    Raises UserError in the beginning, and DeviceError in the end, if the file cannot be written.
    """
    try:
        file = path.open("w", encoding="utf-8")
    except OSError as error:
        raise unwritable(path, error) from None
    try:
        yield
    finally:
        try:
            with file:
                file.write(picture())
        except OSError as error:
            raise DeviceError(f"cannot write the picture {path}: {error.strerror}") from None


def draw(scene: Scene, record: Record, pose: Pose) -> str:
    """The text of an SVG file; ``pose`` is where the robot is in the end."""
    record.end()
    paths = record.paths
    box = _box(scene, paths, pose)
    text = max(box.right - box.left, box.top - box.bottom) / LETTERS
    names = [*_names(scene.floor, text)]
    box = _with_names(box, names, text)
    width, height = box.right - box.left, box.top - box.bottom
    scale = WIDEST / max(width, height)
    size = f'width="{width * scale:.0f}" height="{height * scale:.0f}"'
    view = f'viewBox="{_n(box.left)} {_n(-box.top)} {_n(width)} {_n(height)}"'
    # One unit is a mm; y grows upwards in the world and downwards in SVG.
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" {size} {view} font-family="sans-serif" font-size="{_n(text)}">',
            f"<title>{escape(_title(record))}</title>",
            f'<rect x="{_n(box.left)}" y="{_n(-box.top)}" width="{_n(width)}" height="{_n(height)}"'
            f' fill="{_grey(scene.floor.light)}"/>',
            *_things(scene.floor),
            *_path(paths, text),
            *_robot(scene.robot, pose),
            # What is read lies on everything else, with a light border, for it may lie on something dark.
            f'<g paint-order="stroke" stroke="#fff" stroke-width="{_n(text / 5)}" stroke-linejoin="round">',
            *map(_written, names),
            *_marks(record.happenings, text),
            "</g>",
            "</svg>",
            "",
        ]
    )


def _box(scene: Scene, paths: Iterable[Sequence[Step]], pose: Pose) -> _Box:
    """What the picture shows: everything on the floor and the whole path, with a margin."""
    floor, radius = scene.floor, scene.robot.radius
    points = [(step.x, step.y) for path in paths for step in path]
    points += [point for line in floor.lines.values() for point in line.points]
    points += [point for ax, ay, bx, by in floor.walls for point in ((ax, ay), (bx, by))]
    points += [point for station in floor.stations.values() for point in _corners(station.mark)]
    for patch in floor.patches:
        match patch:
            case Rectangle():
                points += _corners(patch)
            case _:
                points += _around(patch.x, patch.y, patch.radius)
    points += [*_around(pose.x, pose.y, radius), *_around(scene.robot.start.x, scene.robot.start.y, radius)]
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return _Box(min(xs) - MARGIN, min(ys) - MARGIN, max(xs) + MARGIN, max(ys) + MARGIN)


def _around(x: float, y: float, radius: float) -> list[Point]:
    return [(x - radius, y - radius), (x + radius, y + radius)]


def _corners(patch: Rectangle) -> list[Point]:
    ahead, left = patch.length / 2, patch.width / 2
    return [patch.pose.place(a, b) for a, b in ((ahead, left), (-ahead, left), (-ahead, -left), (ahead, -left))]


def _things(floor: Floor) -> Iterator[str]:
    for patch in floor.patches:
        match patch:
            case Rectangle():
                yield f'<polygon points="{_points(_corners(patch))}" fill="{_grey(patch.light)}"/>'
            case _:
                radius, grey = _n(patch.radius), _grey(patch.light)
                yield f'<circle cx="{_n(patch.x)}" cy="{_n(-patch.y)}" r="{radius}" fill="{grey}"/>'
    for line in floor.lines.values():
        stroke = f'stroke="{_grey(line.light)}" stroke-width="{_n(line.width)}"'
        yield (
            f'<polyline points="{_points(line.points)}" fill="none" {stroke}'
            ' stroke-linecap="round" stroke-linejoin="round"/>'
        )
    for station in floor.stations.values():
        yield f'<polygon points="{_points(_corners(station.mark))}" fill="{_grey(station.mark.light)}"/>'
    for wall in floor.walls:
        points = _points([wall[:2], wall[2:]])
        yield f'<polyline points="{points}" stroke="#722" stroke-width="8" stroke-linecap="round"/>'


def _names(floor: Floor, text: float) -> Iterator[_Name]:
    """The names of the stations, each at the left of its mark and away from it."""
    for station in floor.stations.values():
        mark = station.mark
        x, y = mark.pose.place(0.0, mark.width / 2 + text)
        across = (x - mark.pose.x) / (mark.width / 2 + text)
        anchor = "middle" if abs(across) < STEEP else "end" if across < 0 else "start"
        yield _Name(station.name, x, y, anchor)


def _with_names(box: _Box, names: Sequence[_Name], text: float) -> _Box:
    """The box with room for the names."""
    left, bottom, right, top = box
    for name in names:
        width = len(name.text) * LETTER_WIDTH * text
        start = name.x - {"start": 0.0, "middle": width / 2, "end": width}[name.anchor]
        left, right = min(left, start - text), max(right, start + width + text)
        bottom, top = min(bottom, name.y - text), max(top, name.y + text)
    return _Box(left, bottom, right, top)


def _written(name: _Name) -> str:
    place = f'x="{_n(name.x)}" y="{_n(-name.y)}" {MIDDLE} text-anchor="{name.anchor}"'
    return f'<text {place} font-weight="bold">{escape(name.text)}</text>'


MIDDLE = 'dy=".35em"'
"""A text around its height, not above it; not every viewer knows ``dominant-baseline``."""


def _path(paths: Sequence[Sequence[Step]], text: float) -> Iterator[str]:
    """The paths, each part in the colour of its time."""
    steps = [step for path in paths for step in path]
    first, last = steps[0].time, steps[-1].time
    for path in paths:
        for part, colour in _parts(path, first, last):
            points = _points([(step.x, step.y) for step in simplified(part)])
            yield (
                f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="{_n(text / 6)}"'
                ' stroke-linejoin="round"/>'
            )


def _parts(path: Sequence[Step], first: float, last: float) -> Iterator[tuple[list[Step], str]]:
    """Pieces of a path with their colours; each begins where the one before ends."""

    def place(step: Step) -> int:
        return min(PATH_COLOURS - 1, int(PATH_COLOURS * (step.time - first) / ((last - first) or 1)))

    part = [path[0]]
    for step in path[1:]:
        part.append(step)
        if place(step) != place(part[0]):
            yield part, _colour(place(part[0]))
            part = [step]
    if len(part) > 1:
        yield part, _colour(place(part[0]))


def _colour(place: int) -> str:
    hue = FIRST_HUE + (LAST_HUE - FIRST_HUE) * place / (PATH_COLOURS - 1)
    return f"hsl({hue:.0f},85%,45%)"


def _marks(happenings: Sequence[Happening], text: float) -> Iterator[str]:
    """What happened, each with its time when a mouse is over it; the same thing at the same place is drawn once."""
    drawn: dict[tuple[str, int, int], list[Happening]] = {}
    for happening in happenings:
        if happening.what in SHOWN:
            pose = happening.pose
            key = (SHOWN[happening.what], round(pose.x / text), round(pose.y / text))
            drawn.setdefault(key, []).append(happening)
    for (sign, _, _), found in drawn.items():
        side = list(SHOWN.values()).index(sign) - len(SHOWN) / 2
        x, y = found[0].pose.x + side * text, found[0].pose.y - text
        told = "\n".join(f"{happening.time:.1f} s: {happening.what} {happening.text}" for happening in found)
        place = f'x="{_n(x)}" y="{_n(-y)}" {MIDDLE} text-anchor="middle"'
        yield f'<text {place} fill="#114">{sign}<title>{escape(told)}</title></text>'


def _robot(robot: Robot, pose: Pose) -> Iterator[str]:
    """Where the robot is in the end: its outline, and where its front is."""
    outline = 'fill="#fff" fill-opacity=".25" stroke="#111" stroke-width="3"'  # to be seen on a dark floor too
    x, y, radius = _n(pose.x), _n(-pose.y), _n(robot.radius)
    yield f'<circle cx="{x}" cy="{y}" r="{radius}" {outline}><title>the robot in the end</title></circle>'
    arrow = [(0.8, 0.0), (0.3, 0.3), (0.3, -0.3)]
    tip = [pose.place(ahead * robot.radius, left * robot.radius) for ahead, left in arrow]
    yield f'<polygon points="{_points(tip)}" {outline}/>'


def _title(record: Record) -> str:
    ends = [path[-1].time for path in record.paths]
    return f"The way of the robot in {max(ends):.0f} seconds, from blue to red"


def _grey(light: float) -> str:
    """The grey of a surface; the eye's range is small, and the picture's is not."""
    shade = round(255 * min(1.0, max(0.0, (light - DARKEST) / (BRIGHTEST - DARKEST))))
    return f"#{shade:02x}{shade:02x}{shade:02x}"


DARKEST, BRIGHTEST = 25.0, 65.0
"""What the eye shows over black and over white, about."""


def _points(points: Iterable[Point]) -> str:
    return " ".join(f"{_n(x)},{_n(-y)}" for x, y in points)


def _n(number: float) -> str:
    """A number with a tenth of a mm, as short as possible."""
    text = f"{number:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text
