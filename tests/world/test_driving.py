"""Where two wheels take the robot, and how walls hold it: figures worked out by hand."""

from __future__ import annotations

from math import degrees, pi, sqrt
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import Source
from golc.runtime.rcxsim.surroundings import Mode, Output
from golc.runtime.rcxsim.trace import Trace
from golc.runtime.rcxsim.world.geometry import distance
from golc.runtime.rcxsim.world.world import World
from golc.runtime.rcxsim.world.worldfile import parse_world

if TYPE_CHECKING:
    from tests.world.conftest import MakeLab


def test_a_second_straight_on_at_power_level_4_is_100_mm(lab: MakeLab) -> None:
    robot = lab()
    robot.drive(5, 5)
    robot.wait(1)
    assert robot.pose == pytest.approx((100, 0, 0))


def test_backwards(lab: MakeLab) -> None:
    robot = lab()
    robot.drive(-8, -8)
    robot.wait(0.5)
    assert robot.pose == pytest.approx((-80, 0, 0))


def test_wheels_against_each_other_turn_in_place(lab: MakeLab) -> None:
    robot = lab()
    robot.drive(-5, 5)
    robot.wait(1)
    # 100 mm/s each, on a circle with a radius of half the wheel base.
    assert robot.pose == pytest.approx((0, 0, degrees(100 / 50)))


def test_one_wheel_alone_turns_about_the_other(lab: MakeLab) -> None:
    robot = lab()
    robot.drive(0, 5)
    robot.wait(pi / 2)
    # The right wheel rolls 50 pi mm on a circle of radius 100 about the left one at (0, 50): a quarter turn.
    assert robot.pose == pytest.approx((50, 50, 90), abs=1e-3)


def test_an_arc(lab: MakeLab) -> None:
    robot = lab()
    robot.drive(2, 6)
    robot.wait(pi / 0.8)
    # 40 and 120 mm/s: 80 mm/s about a point 100 mm to the left, with 0.8 rad/s: half a circle.
    assert robot.pose == pytest.approx((0, 200, 180), abs=1e-3)


def test_a_time_that_is_no_multiple_of_a_step_counts_in_full(lab: MakeLab) -> None:
    robot = lab()
    robot.wait(0.0012)
    robot.drive(5, 5)
    robot.wait(0.0134)
    assert robot.pose == pytest.approx((1.34, 0, 0))


def test_off_brakes_and_float_rolls_on(lab: MakeLab) -> None:
    robot = lab(coasts="0.4")
    robot.drive(5, 5)
    robot.wait(1)
    robot.drive(0, 0, Mode.FLOAT)
    robot.wait(0.2)
    assert robot.pose[0] == pytest.approx(100 + 15)  # 100 mm/s, half of it after 0.2 s
    robot.wait(5)
    assert robot.pose[0] == pytest.approx(100 + 20)
    robot.drive(5, 5)
    robot.wait(1)
    robot.drive(0, 0)
    robot.wait(1)
    assert robot.pose[0] == pytest.approx(100 + 20 + 100)


def test_a_motor_that_is_mounted_the_other_way_round(lab: MakeLab) -> None:
    robot = lab(reversed='["A", "C"]')
    robot.drive(5, 5)
    robot.wait(1)
    assert robot.pose == pytest.approx((-100, 0, 0))


def test_each_level_of_power_may_have_its_own_speed(lab: MakeLab) -> None:
    robot = lab(speed="", speeds="[0, 10, 50, 60, 70, 80, 90, 100]")
    robot.drive(1, 1)
    robot.wait(1)
    assert robot.pose[0] == 0
    robot.drive(3, 3)
    robot.wait(1)
    assert robot.pose[0] == pytest.approx(50)


WALL = "[[walls]]\npoints = [[300, -500], [300, 500]]\n"


def test_a_wall_stops_the_robot_at_its_radius(lab: MakeLab) -> None:
    robot = lab(WALL)
    robot.drive(8, 8)
    robot.wait(10)
    assert robot.pose == pytest.approx((250, 0, 0))
    [(time, _)] = robot.told("touches")
    assert time == pytest.approx(250 / 160, abs=0.006)


def test_the_robot_slides_along_a_wall_that_it_meets_at_an_angle(lab: MakeLab) -> None:
    robot = lab(WALL, start="{ at = [0, 0], facing = 30 }")
    robot.drive(5, 5)
    robot.wait(4)
    x, y, heading = robot.pose
    assert x == pytest.approx(250, abs=1e-3)
    assert heading == pytest.approx(30)
    # 400 mm on the wheels, of which a half is across; all of it remains.
    assert y == pytest.approx(200, abs=1e-3)


def test_the_robot_leaves_a_wall_without_delay(lab: MakeLab) -> None:
    robot = lab(WALL)
    robot.drive(8, 8)
    robot.wait(3)
    robot.drive(-8, -8)
    robot.wait(1)
    assert robot.pose == pytest.approx((90, 0, 0))


def test_the_end_of_a_wall_is_round_for_the_robot(lab: MakeLab) -> None:
    robot = lab("[[walls]]\npoints = [[300, 30], [300, 500]]\n")
    robot.drive(8, 8)
    robot.wait(10)
    # Pushed aside at the end of the wall, it goes on at a distance of 50 mm below it.
    assert robot.pose[1] == pytest.approx(-20, abs=0.01)
    assert robot.pose[0] > 350


def test_a_corner_holds_the_robot(lab: MakeLab) -> None:
    robot = lab("[[walls]]\npoints = [[200, -500], [200, 100], [-500, 100]]\n")
    robot.drive(7, 8)
    robot.wait(4)
    assert robot.pose[:2] == pytest.approx((150, 50), abs=1e-3)


@given(
    st.lists(st.tuples(st.integers(-8, 8), st.integers(-8, 8), st.floats(0, 2)), min_size=1, max_size=8),
    st.integers(-180, 180),
)
def test_no_way_leads_out_of_a_walled_yard(commands: list[tuple[int, int, float]], facing: int) -> None:
    yard = "[[walls]]\npoints = [[-120, -120], [120, -120], [150, 100], [0, 160], [-140, 90], [-120, -120]]\n"
    text = BASE.replace("at = [0, 0]", f"at = [0, 0], facing = {facing}").replace("speed = 160", "speed = 1000")
    scene = parse_world(Source("yard.toml", text + yard))
    world, now = World(scene, 0, Trace()), 0
    for left, right, seconds in commands:
        world.drive([command(left), Output(), command(right)], now)
        now += round(seconds * 1_000_000)
        world.advance(now)
        room = min(distance(world.pose.x, world.pose.y, wall) for wall in scene.floor.walls)
        assert room >= 50 - 1e-3
        assert abs(world.pose.x) < 150
        assert abs(world.pose.y) < 160


@given(
    st.lists(st.tuples(st.integers(-8, 8), st.integers(-8, 8), st.integers(0, 200_000)), min_size=1, max_size=5),
    st.lists(st.integers(1_000, 40_000), min_size=1, max_size=8),
)
def test_how_the_caller_slices_the_time_makes_no_difference(
    commands: list[tuple[int, int, int]], slices: list[int]
) -> None:
    sliced, whole = World(SCENE, 0, Trace()), World(SCENE, 0, Trace())
    now = turn = 0
    for left, right, duration in commands:
        outputs = [command(left), Output(), command(right)]
        for world in (sliced, whole):
            world.drive(outputs, now)
        end = now + duration
        while now < end:
            now = min(end, now + slices[turn % len(slices)])
            turn += 1
            sliced.sense((True, True, True), now)
        assert sliced.sense((True, True, True), now) == whole.sense((True, True, True), now)
        assert sliced.pose == whole.pose
    assert sliced.record.paths == whole.record.paths


def command(power: int) -> Output:
    return Output(Mode.ON, power > 0, abs(power) - 1) if power else Output(Mode.FLOAT)


def test_a_diagonal_is_as_long_as_pythagoras_says(lab: MakeLab) -> None:
    robot = lab(start="{ at = [10, 20], facing = -45 }")
    robot.drive(5, 5)
    robot.wait(2)
    assert robot.pose == pytest.approx((10 + 200 / sqrt(2), 20 - 200 / sqrt(2), -45))


BASE = """\
[floor]
light = 50

[robot]
left = "A"
right = "C"
radius = 50
wheel_base = 100
wheel_diameter = 50
speed = 160
coasts = 0
start = { at = [0, 0] }
"""
SCENE = parse_world(
    Source(
        "sliced.toml",
        BASE.replace("coasts = 0", "coasts = 0.3")
        + """\
[lines.track]
curve = [[0, 0], [150, 60], [220, -40]]
width = 20
light = 35

[[walls]]
points = [[100, -500], [200, 500]]

[sensors.1]
kind = "light"
ahead = 40
noise = 3

[sensors.2]
kind = "touch"
bumper = [[50, 20], [50, -20]]

[sensors.3]
kind = "rotation"
wheel = "left"

[people]
script = ["at 0.1003 s: put at 20, 10 facing 200", "at 0.2 s: lift", "at 0.3 s: put back"]
""",
    )
)
