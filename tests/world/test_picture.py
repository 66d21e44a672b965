"""The picture from above: what a reader of SVG finds in it."""

from __future__ import annotations

import re
from itertools import pairwise
from math import hypot
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import pytest

from golc.diagnostics import Source
from golc.runtime.rcxsim.world.geometry import distance
from golc.runtime.rcxsim.world.picture import draw
from golc.runtime.rcxsim.world.worldfile import parse_world

if TYPE_CHECKING:
    from tests.world.conftest import Lab, MakeLab

SVG = "{http://www.w3.org/2000/svg}"
THINGS = """
[lines.track]
curve = [[0, 0], [300, 100], [600, 0]]
width = 20
light = 30

[stations.A_1]
along = 100
light = 70

[[patches]]
at = [300, 300]
radius = 40
light = 80

[[patches]]
at = [100, 300]
size = [50, 30]
light = 80

[[walls]]
points = [[700, -100], [700, 400], [500, 400]]

[people]
script = ["at 2 s: put at station A_1", "at 2.5 s: press run"]
"""
COLOURS = re.compile(r"hsl\((\d+),")


def drawn(robot: Lab) -> ElementTree.Element:
    return ElementTree.fromstring(draw(robot.world.scene, robot.world.record, robot.world.pose))


def path(svg: ElementTree.Element) -> list[list[tuple[float, float]]]:
    """The pieces of the robot's path, y upwards."""
    lines = [line for line in svg.iter(SVG + "polyline") if "hsl" in line.get("stroke", "")]
    return [[(float(x), -float(y)) for x, y in map(split, line.get("points", "").split())] for line in lines]


def split(point: str) -> tuple[str, str]:
    x, _, y = point.partition(",")
    return x, y


def texts(svg: ElementTree.Element) -> list[str]:
    return [text.text or "" for text in svg.iter(SVG + "text")]


def test_everything_on_the_floor_is_drawn(lab: MakeLab) -> None:
    svg = drawn(lab(THINGS))
    assert len(list(svg.iter(SVG + "circle"))) == 2  # a patch and the robot
    assert len(list(svg.iter(SVG + "polygon"))) == 3  # a patch, the station, and where the robot looks
    assert len(list(svg.iter(SVG + "polyline"))) == 3  # the line and two walls
    assert texts(svg) == ["A_1"]


def test_the_picture_shows_it_all(lab: MakeLab) -> None:
    robot = lab(THINGS)
    robot.drive(-8, -8)
    robot.wait(4)
    svg = drawn(robot)
    left, top, width, height = map(float, svg.get("viewBox", "").split())
    points = [point for piece in path(svg) for point in piece] + [(700, 400), (700, -100), (600, 0)]
    assert all(left < x < left + width and top < -y < top + height for x, y in points)


def test_the_path_is_the_way_of_the_robot_within_a_mm(lab: MakeLab) -> None:
    robot = lab(THINGS)
    robot.drive(4, 6)
    way = []
    for _ in range(190):
        robot.wait(0.01)
        way.append(robot.pose[:2])
    pieces = path(drawn(robot))
    segments = [(*a, *b) for piece in pieces for a, b in pairwise(piece)]
    assert max(min(distance(*point, segment) for segment in segments) for point in way) < 1.1
    assert sum(map(len, pieces)) < 60
    assert pieces[-1][-1] == pytest.approx(way[-1], abs=0.06)


def test_a_new_path_begins_where_the_robot_is_put(lab: MakeLab) -> None:
    robot = lab(THINGS)
    robot.drive(5, 5)
    robot.wait(4)
    pieces = path(drawn(robot))
    starts = [
        piece[0] for before, piece in zip([None, *pieces], pieces, strict=False) if not before or before[-1] != piece[0]
    ]
    assert len(starts) == 2
    # 1000 mm are said to be along the curve at the station: 100 mm from its beginning.
    assert hypot(*starts[1]) == pytest.approx(100, abs=2)


def test_the_path_goes_from_blue_to_red(lab: MakeLab) -> None:
    robot = lab()
    robot.drive(5, 5)
    robot.wait(20)
    lines = drawn(robot).iter(SVG + "polyline")
    hues = [int(match[1]) for line in lines if (match := COLOURS.match(line.get("stroke", "")))]
    assert hues[0] == 210
    assert hues[-1] == 0
    assert hues == sorted(hues, reverse=True)


def test_what_happened_is_marked_with_its_times(lab: MakeLab) -> None:
    robot = lab(THINGS)
    robot.wait(1)
    robot.hear((440, 10))
    robot.wait(0.5)
    robot.hear((440, 10))
    robot.wait(3)
    svg = drawn(robot)
    told = [title.text for text in svg.iter(SVG + "text") for title in text.iter(SVG + "title")]
    assert told == ["1.0 s: plays tone\n1.5 s: plays tone", "2.0 s: put at station A_1, facing 24", "2.5 s: press run"]


def test_names_of_any_language(lab: MakeLab) -> None:
    svg = drawn(lab("[stations.'é']\nat = [1, 1]\nlight = 3"))
    assert texts(svg) == ["é"]


@pytest.mark.parametrize(
    ("facing", "anchor"), [(0, "middle"), (90, "end"), (180, "middle"), (-90, "start"), (30, "end")]
)
def test_a_name_stands_at_the_left_of_its_mark_clear_of_it_and_in_the_picture(
    lab: MakeLab, facing: int, anchor: str
) -> None:
    svg = drawn(lab(f"[stations.The_post_office_of_the_village]\nat = [0, 0]\nfacing = {facing}\nlight = 60"))
    [name] = svg.iter(SVG + "text")
    assert name.get("text-anchor") == anchor
    size, x, y = float(svg.get("font-size", "")), float(name.get("x", "")), -float(name.get("y", ""))
    assert hypot(x, y) == pytest.approx(25 + size, abs=0.1)
    # An average letter of a bold sans serif is some 0.6 of its size wide.
    width = 0.6 * size * len("The_post_office_of_the_village")
    start = x - {"start": 0, "middle": width / 2, "end": width}[anchor]
    left, top, across, down = map(float, svg.get("viewBox", "").split())
    assert left < start < start + width < left + across
    assert top + size / 2 < -y < top + down - size / 2


def test_a_long_run_does_not_fill_the_memory(lab: MakeLab) -> None:
    robot = lab(speed="1000")
    robot.drive(8, 8)
    robot.wait(150)
    assert sum(map(len, robot.world.record.paths)) < 20_010
    assert len(draw(robot.world.scene, robot.world.record, robot.world.pose)) < 20_000


def test_a_robot_that_never_moved(lab: MakeLab) -> None:
    assert path(drawn(lab())) == []


def test_the_delivery_world_is_drawn(lab: MakeLab) -> None:
    delivery = Path(__file__).parent.parent.parent / "examples/delivery/delivery.toml"
    robot = lab()
    scene = parse_world(Source("delivery.toml", delivery.read_text()))
    svg = ElementTree.fromstring(draw(scene, robot.world.record, robot.world.pose))
    assert texts(svg) == ["1", "2", "3", "4", "5", "6"]
