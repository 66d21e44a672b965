"""World files: TOML tables that describe a floor, a robot, its sensors and people. ``docs/world.md`` has the format."""

from __future__ import annotations

import re
from collections.abc import Mapping
from math import radians
from pathlib import Path

from golc.diagnostics import Findings, Source, UserError
from golc.runtime.rcxsim.world.floor import Floor, Line, Patch, Rectangle, Spot, Station, pushed_out
from golc.runtime.rcxsim.world.geometry import Pose, Segment, along, length_of, needed, segments, smooth
from golc.runtime.rcxsim.world.people import Cue, Names, PutAt
from golc.runtime.rcxsim.world.robot import LEVELS, LightSensor, Robot, RotationSensor, Sensor, TouchSensor
from golc.runtime.rcxsim.world.scene import Scene, pose_at_station
from golc.runtime.rcxsim.world.script import BRICK_BUTTONS, read_line
from golc.runtime.rcxsim.world.tables import FURTHEST, Table, read_tables
from golc.syntax.text import read_source

OUTPUTS = ("A", "B", "C")
PORTS = ("1", "2", "3")
WAYS = ("forward", "backward")
LARGEST = 10_000.0
"""mm: no robot and no mark on the floor is larger."""
FASTEST = 1_000.0
"""mm/s; within 5 ms no robot goes further than a part of its radius."""
SOMEWHERE = [(0.0, 0.0), (1.0, 0.0)]
"""A line in the place of one that is wrong."""
CURVE_WITHIN = 0.25
"""mm by which the pieces of a smooth curve may be off."""
BRICK_BUTTONS_HELP = "the buttons of the brick itself are " + ", ".join(BRICK_BUTTONS)
_NAME = re.compile(r"\w[\w-]*")


def read_world(path: str | Path) -> Scene:
    """The scene of a world file; raises ``UserError`` with everything that is wrong with it."""
    return parse_world(read_source(path, empty="a world file has at least the tables `[floor]` and `[robot]`"))


def parse_world(source: Source) -> Scene:
    """The scene that a text describes; raises ``UserError`` with everything that is wrong with it."""
    findings = Findings()
    root = read_tables(source, findings)
    scene = _scene(root)
    root.finish()
    findings.diagnostics.sort(key=lambda finding: finding.span.start)
    if findings.has_errors:
        raise UserError(*findings.diagnostics)
    return scene


def _scene(root: Table) -> Scene:
    floor = _floor(root)
    sensors = {PORTS.index(table.name): _sensor(table) for table in _named(root, "sensors", PORTS)}
    robot = _robot(root.table("robot", needed=True), floor, sensors)
    names = Names(_buttons(root), floor.stations)
    return Scene(floor, robot, _script(root.table("people"), names), names)


def _floor(root: Table) -> Floor:
    ground = root.table("floor", needed=True)
    light = _light(ground)
    ground.finish()
    patches = tuple(_patch(table) for table in root.array("patches"))
    lines = {table.name: _line(table) for table in _named(root, "lines")}
    stations = {table.name: _station(table, lines) for table in _named(root, "stations")}
    walls: list[Segment] = []
    for table in root.array("walls"):
        walls += segments(table.points("points"))
        table.finish()
    return Floor(light, patches, lines, stations, tuple(walls))


def _named(root: Table, key: str, names: tuple[str, ...] = ()) -> list[Table]:
    """The tables with names of their own: some of the given ones, or any that a script can speak of."""
    found = []
    for table in root.tables(key):
        if names and table.name not in names:
            table.error(f"there is no {table.name} in `[{key}.…]`", table.header, help=f"there are {', '.join(names)}")
        elif not _NAME.fullmatch(table.name):
            table.error(f"`{table.name}` is no name", table.header, help="a name has letters, digits, `_` and `-`")
        else:
            found.append(table)
    return found


def _light(table: Table) -> float:
    return table.number("light", 0, 100)


def _patch(table: Table) -> Patch:
    (x, y), light = table.point("at"), _light(table)
    patch: Patch = Spot(x, y, 1.0, light)
    match table.either("size", "radius"):
        case "radius":
            patch = Spot(x, y, table.number("radius", 0.1, FURTHEST), light)
        case "size":
            length, width = table.numbers("size", 2, 0.1, FURTHEST)
            patch = Rectangle(Pose(x, y, _angle(table, "facing")), length, width, light)
        case None:
            return patch
    table.finish()
    return patch


def _line(table: Table) -> Line:
    kind = table.either("points", "curve")
    points = SOMEWHERE if kind is None else table.points(kind)
    closed = table.flag("closed")
    if closed and points[0] == points[-1]:
        points = points[:-1]
    if closed and len(points) < 3:
        table.error("a closed line has three points at least", table.place("closed"))
    elif kind == "curve":
        points = smooth(points, closed)
        points = [points[place] for place in needed(points, CURVE_WITHIN)]
    elif closed:
        points = [*points, points[0]]
    line = Line(table.name, tuple(points), table.number("width", 1, LARGEST), _light(table))
    table.finish()
    return line


def _station(table: Table, lines: Mapping[str, Line]) -> Station:
    length, light = table.number("length", 1, LARGEST, 50.0), _light(table)
    pose, width = Pose(0.0, 0.0, 0.0), 50.0
    match table.either("along", "at"):
        case "at":
            pose = Pose(*table.point("at"), _angle(table, "facing"))
            width = table.number("width", 1, LARGEST, 50.0)
        case "along":
            line = lines.get(table.word("on", lines, next(iter(lines)) if len(lines) == 1 else None) or "")
            points = SOMEWHERE if line is None else line.points
            on_line = along(points, table.number("along", 0, FURTHEST if line is None else length_of(points)))
            pose = Pose(*on_line.place(0.0, table.number("aside", -LARGEST, LARGEST, 0.0)), on_line.heading)
            width = table.number("width", 1, LARGEST, 50.0 if line is None else 2 * line.width)
    table.finish()
    return Station(table.name, Rectangle(pose, length, width, light))


def _angle(table: Table, key: str) -> float:
    return radians(table.number(key, -360, 360, 0.0))


def _robot(table: Table, floor: Floor, sensors: Mapping[int, Sensor]) -> Robot:
    radius = table.number("radius", 20, LARGEST, 90.0)
    left, right = table.word("left", OUTPUTS), table.word("right", OUTPUTS)
    robot = Robot(
        _start(table.table("start", needed=True), floor, radius),
        radius,
        table.number("wheel_base", 1, LARGEST, 120.0),
        table.number("wheel_diameter", 1, LARGEST, 56.0),
        _speeds(table),
        {"left": OUTPUTS.index(left or "A"), "right": OUTPUTS.index(right or "C")},
        frozenset(OUTPUTS.index(word) for word in table.words("reversed", OUTPUTS)),
        table.number("coasts", 0, 60, 0.2),
        sensors,
    )
    table.finish()
    return robot


def _speeds(table: Table) -> tuple[float, ...]:
    """The speeds of the power levels: each of them, or the highest, to which the others are in proportion."""
    if table.has("speeds"):
        return table.numbers("speeds", LEVELS, 0, FASTEST)
    full = table.number("speed", 1, FASTEST, 200.0)
    return tuple(full * (power + 1) / LEVELS for power in range(LEVELS))


def _start(table: Table, floor: Floor, radius: float) -> Pose:
    pose = Pose(0.0, 0.0, 0.0)
    match table.either("station", "at"):
        case "station":
            name = table.word("station", floor.stations)
            way = table.word("facing", WAYS, "forward")
            if name is None:
                return pose
            pose = pose_at_station(floor, PutAt(name, way == "backward"))
        case "at":
            pose = Pose(*table.point("at"), _angle(table, "facing"))
        case None:
            return pose
    if pushed_out(pose.x, pose.y, radius, floor.walls) != (pose.x, pose.y):
        table.error("the robot starts in a wall", table.header, help="it needs its radius all around")
    table.finish()
    return pose


def _sensor(table: Table) -> Sensor:
    sensor: Sensor = TouchSensor()
    match table.word("kind", ("light", "touch", "rotation")):
        case "light":
            ahead = table.number("ahead", -LARGEST, LARGEST)
            left = table.number("left", -LARGEST, LARGEST, 0.0)
            sensor = LightSensor(ahead, left, table.number("radius", 0, 100, 4.0), table.number("noise", 0, 50, 0.0))
        case "touch":
            sensor = _touch(table)
        case "rotation":
            wheel = table.word("wheel", ("left", "right"))
            sensor = RotationSensor(wheel or "left", table.number("gear", -100, 100, 1.0))
        case None:
            return sensor
    table.finish()
    return sensor


def _touch(table: Table) -> TouchSensor:
    """A button with a name, a bumper, or both."""
    name, bumper = None, None
    if table.has("name"):
        name = table.text("name")
        if not _NAME.fullmatch(name):
            table.error(f"`{name}` is no name", table.place("name"), help="a name has letters, digits, `_` and `-`")
    if table.has("bumper"):
        (ax, ay), (bx, by) = table.points("bumper")[:2]
        bumper = (ax, ay, bx, by)
    if name is None and bumper is None:
        help_ = "give it a `name` for people to press it, or a `bumper` for walls, or both"
        table.error("nothing can press this touch sensor", table.header, help=help_)
    return TouchSensor(name, bumper)


def _buttons(root: Table) -> list[str]:
    """The names of the touch sensors; each must be one button only."""
    found: list[str] = []
    for table in root.tables("sensors"):
        if table.has("name") and (name := table.text("name")):
            if name in (*found, *BRICK_BUTTONS):
                where = table.place("name")
                table.error(f"there is a button `{name}` already", where, help=BRICK_BUTTONS_HELP)
            found.append(name)
    return found


def _script(table: Table, names: Names) -> tuple[Cue, ...]:
    lines = [read_line(text, where, names, table.findings) for text, where in table.texts("script")]
    table.finish()
    return tuple(line for line in lines if line is not None)
