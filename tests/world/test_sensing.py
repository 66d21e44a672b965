"""What the sensors measure at the places where the robot stands: areas, distances and turns worked out by hand."""

from __future__ import annotations

from math import acos, pi, sqrt
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.runtime.rcxsim.surroundings import OPEN, ROTATION_LEVELS
from golc.runtime.rcxsim.world.geometry import share_before, share_of_band, share_of_disc

if TYPE_CHECKING:
    from tests.world.conftest import Lab, MakeLab

LIGHT = """
[sensors.3]
kind = "light"
ahead = 0
radius = 5
"""
SHARP = LIGHT.replace("radius = 5", "radius = 0")
TRACK = """
[lines.track]
points = [[-1000, 0], [1000, 0]]
width = 20
light = 30
"""


def seen(lab: MakeLab, things: str, x: float, y: float, sensor: str = LIGHT) -> float:
    """What the eye sees over a point."""
    return lab(things + sensor, start=f"{{ at = [{x}, {y}] }}").light(3)


def test_the_raw_value_is_the_inverse_of_the_percentage_that_the_brick_shows(lab: MakeLab) -> None:
    assert lab(LIGHT).raw(3) == 672  # 146 - 672 / 7 = 50


@pytest.mark.parametrize(
    ("y", "light"),
    [
        (0, 30),  # on the line
        (4.9, 30),  # the disc reaches to 9.9
        (10, 40),  # half and half
        (-10, 40),
        (15.1, 50),  # beside it
        (500, 50),
    ],
)
def test_a_line_under_the_eye(lab: MakeLab, y: float, light: float) -> None:
    assert seen(lab, TRACK, 3, y) == pytest.approx(light, abs=0.08)


def test_a_quarter_of_the_radius_over_the_edge(lab: MakeLab) -> None:
    # The eye is 2.5 mm, half its radius, outside: a segment of a third of a turn less a triangle is on the line.
    share = 1 / 3 - sqrt(3) / (4 * pi)
    assert seen(lab, TRACK, 0, 12.5) == pytest.approx(50 - 20 * share, abs=0.08)


def test_an_eye_without_extent_sees_either_the_line_or_the_floor(lab: MakeLab) -> None:
    assert seen(lab, TRACK, 0, 9.99, SHARP) == pytest.approx(30, abs=0.08)
    assert seen(lab, TRACK, 0, 10.01, SHARP) == pytest.approx(50, abs=0.08)


def test_a_line_that_is_narrower_than_the_eye(lab: MakeLab) -> None:
    # A band of 5 mm through the middle of a disc with a radius of 5 mm.
    share = 2 / pi * (pi / 2 - acos(0.5) + 0.5 * sqrt(0.75))
    thin = TRACK.replace("width = 20", "width = 5")
    assert seen(lab, thin, 0, 0) == pytest.approx(50 - 20 * share, abs=0.08)


def test_the_end_of_a_line_is_round(lab: MakeLab) -> None:
    assert seen(lab, TRACK, 1009, 0, SHARP) == pytest.approx(30, abs=0.08)
    assert seen(lab, TRACK, 1009, 9, SHARP) == pytest.approx(50, abs=0.08)


def test_a_patch_with_its_corners(lab: MakeLab) -> None:
    patch = "[[patches]]\nat = [100, 0]\nsize = [40, 20]\nfacing = 90\nlight = 90\n"
    assert seen(lab, patch, 100, 0) == pytest.approx(90, abs=0.08)
    assert seen(lab, patch, 109, 19, SHARP) == pytest.approx(90, abs=0.08)  # 20 mm up and 10 mm to the right
    assert seen(lab, patch, 111, 0, SHARP) == pytest.approx(50, abs=0.08)
    assert seen(lab, patch, 100, 20) == pytest.approx(70, abs=0.08)
    assert seen(lab, patch, 110, 20) == pytest.approx(60, abs=0.08)  # a quarter of the disc


def test_a_round_patch_that_is_smaller_than_what_the_eye_sees(lab: MakeLab) -> None:
    dot = "[[patches]]\nat = [0, 0]\nradius = 2\nlight = 0\n"
    assert seen(lab, dot, 0, 0) == pytest.approx(50 * (1 - 4 / 25), abs=0.08)
    assert seen(lab, dot, 3, 0) == pytest.approx(50 * (1 - 4 / 25), abs=0.08)
    assert seen(lab, dot, 7.1, 0) == pytest.approx(50, abs=0.08)


def test_what_lies_on_top_is_seen(lab: MakeLab) -> None:
    things = TRACK + "[[patches]]\nat = [0, 0]\nradius = 100\nlight = 80\n"
    assert seen(lab, things, 0, 0) == pytest.approx(30, abs=0.08)
    assert seen(lab, things, 0, 40) == pytest.approx(80, abs=0.08)
    things += (
        "[[patches]]\nat = [0, 50]\nradius = 30\nlight = 0\n[stations.a]\non = 'track'\nalong = 1000\nlight = 99\n"
    )
    assert seen(lab, things, 0, 40) == pytest.approx(0, abs=0.08)
    assert seen(lab, things, 0, 0) == pytest.approx(99, abs=0.08)


def test_a_smooth_curve_goes_through_its_points_and_not_straight_between_them(lab: MakeLab) -> None:
    curve = TRACK.replace(
        "points = [[-1000, 0], [1000, 0]]", "curve = [[0, 100], [100, 0], [0, -100], [-100, 0]]\nclosed = true"
    )
    for x, y in ((0, 100), (100, 0), (0, -100), (-100, 0)):
        assert seen(lab, curve, x, y) == pytest.approx(30, abs=0.08)
    assert seen(lab, curve, 62.5, 62.5) == pytest.approx(30, abs=0.08)  # (-p0 + 9 p1 + 9 p2 - p3) / 16
    assert seen(lab, curve, 50, 50) == pytest.approx(50, abs=0.08)


def test_the_eye_is_ahead_of_the_robot_and_beside_its_middle(lab: MakeLab) -> None:
    patch = "[[patches]]\nat = [-30, 60]\nradius = 10\nlight = 90\n"
    eye = LIGHT.replace("ahead = 0", "ahead = 60\nleft = 30")
    assert lab(patch + eye, start="{ at = [0, 0], facing = 90 }").light(3) == pytest.approx(90, abs=0.08)


def test_a_station_passes_under_the_eye_when_it_should(lab: MakeLab) -> None:
    station = "[stations.first]\nalong = 1100\nlength = 30\nlight = 70\n"
    robot = lab(TRACK + station + LIGHT.replace("ahead = 0", "ahead = 60"))
    robot.drive(5, 5)
    # The patch is from x = 85 to 115; the eye sees from 5 mm before it, at x = 25 + 60, to 5 mm behind.
    lights = []
    for _ in range(70):
        robot.wait(0.01)
        lights.append(robot.light(3))
    assert [place for place, light in enumerate(lights, 1) if light > 30.1] == list(range(21, 60))
    assert [place for place, light in enumerate(lights, 1) if light > 69.9] == list(range(30, 51))
    [(time, station)] = robot.told("reaches")
    assert time == pytest.approx(0.25, abs=0.006)
    assert station == "station first"


def test_a_station_that_is_moved_in_the_file_is_reached_later(lab: MakeLab) -> None:
    def arrival(along: int) -> float:
        robot = lab(TRACK + f"[stations.x]\nalong = {along}\nlength = 40\nlight = 70\n" + LIGHT)
        robot.drive(5, 5)
        for _ in range(1000):
            robot.wait(0.005)
            if robot.light(3) > 50:
                return robot.now / 1_000_000
        raise AssertionError

    assert arrival(1200) - arrival(1150) == pytest.approx(0.5, abs=0.006)


def test_in_the_air_an_eye_sees_nothing(lab: MakeLab) -> None:
    robot = lab(LIGHT + "[people]\nscript = ['at 1 s: lift']")
    robot.wait(1)
    assert robot.light(3) == pytest.approx(0, abs=0.08)


def test_a_light_sensor_without_power_says_nothing(lab: MakeLab) -> None:
    robot = lab(LIGHT)
    assert robot.world.sense((True, True, False), 0) == [OPEN, OPEN, OPEN]


def test_noise_is_the_same_for_the_same_seed_and_new_at_each_step(lab: MakeLab) -> None:
    def values(seed: int) -> list[int]:
        robot = lab(LIGHT + "noise = 2\n", seed=seed)
        found = []
        for _ in range(1000):
            robot.wait(0.005)
            found.append(robot.raw(3))
        return found

    one = values(1)
    assert one == values(1)
    assert one != values(2)
    mean = sum(one) / len(one)
    assert mean == pytest.approx(672, abs=2)
    assert sqrt(sum((value - mean) ** 2 for value in one) / len(one)) == pytest.approx(14, abs=1)


WALL = "[[walls]]\npoints = [[200, -500], [200, 500]]\n"
BUMPER = "[sensors.1]\nkind = 'touch'\nbumper = [[60, 30], [60, -30]]\n"


def test_a_bumper_is_pressed_as_soon_as_it_touches_the_wall(lab: MakeLab) -> None:
    robot = lab(WALL + BUMPER)
    robot.drive(5, 5)
    robot.wait(1.38)  # at x = 138, the bumper at 198
    assert robot.raw(1) == OPEN
    robot.wait(0.02)
    assert robot.raw(1) < 100
    robot.wait(5)
    assert robot.pose[0] == pytest.approx(150)
    assert robot.raw(1) < 100


def test_a_bumper_meets_a_corner_of_a_wall_with_its_side(lab: MakeLab) -> None:
    corner = "[[walls]]\npoints = [[60, 25], [500, 25]]\n"
    free = lab(corner + BUMPER.replace("[60, 30]", "[59, 20]"), start="{ at = [-40, 0] }")
    assert free.raw(1) == OPEN
    crossing = lab(corner + BUMPER, start="{ at = [5, -26] }")
    assert crossing.raw(1) == OPEN
    crossing = lab(corner + BUMPER.replace("[60, 30]", "[60, 60]"), start="{ at = [5, -26] }")
    assert crossing.raw(1) < 100


def test_a_bumper_in_the_air_is_free(lab: MakeLab) -> None:
    robot = lab(WALL + BUMPER + "[people]\nscript = ['at 5 s: lift']")
    robot.drive(5, 5)
    robot.wait(4)
    assert robot.raw(1) < 100
    robot.wait(1)
    assert robot.raw(1) == OPEN


ROTATION = "[sensors.2]\nkind = 'rotation'\nwheel = 'left'\n"


def counted(robot: Lab, seconds: float) -> int:
    """Counts the changes of level as a brick does: one for each, forward or backward."""
    total = 0
    level = ROTATION_LEVELS.index(robot.raw(2))
    for _ in range(round(seconds / 0.003)):
        robot.wait(0.003)
        new = ROTATION_LEVELS.index(robot.raw(2))
        total += (new - level + 1) % 4 - 1
        level = new
    return total


def test_sixteen_counts_a_turn(lab: MakeLab) -> None:
    robot = lab(ROTATION)
    robot.drive(8, 5)
    # 160 mm/s on a wheel with a circumference of 50 pi mm, for 3 s: 3.0558 turns.
    assert counted(robot, 3) == 48
    robot.drive(-8, 5)
    assert counted(robot, 2.4) == 9 - 48  # back to 96 mm, which are 0.61 turns


def test_a_gear_and_the_other_wheel(lab: MakeLab) -> None:
    robot = lab(ROTATION.replace("left", "right") + "gear = -3\n")
    robot.drive(0, 5)
    assert counted(robot, 1) == -31  # 0.6366 turns, three times as many, the other way: -30.56 counts, floored


def test_wheels_turn_on_at_a_wall(lab: MakeLab) -> None:
    robot = lab(WALL + ROTATION)
    robot.drive(8, 8)
    assert counted(robot, 3) == 48


def test_an_input_with_nothing_on_it(lab: MakeLab) -> None:
    assert lab().world.sense((True, False, True), 7) == [OPEN, OPEN, OPEN]


@given(st.floats(-20, 20), st.floats(0.5, 20), st.floats(0.5, 10))
def test_shares_of_a_disc_add_up(offset: float, half: float, radius: float) -> None:
    below, within = share_before(offset, radius), share_of_band(offset, half, radius)
    assert 0 <= below <= 1
    assert -1e-12 <= within <= 1
    assert share_before(-offset, radius) == pytest.approx(1 - below)
    assert share_before(-half - offset, radius) + within == pytest.approx(share_before(half - offset, radius))


@given(st.floats(0, 30), st.floats(1, 20), st.floats(1, 10))
def test_the_share_of_a_round_patch_is_what_counting_points_gives(offset: float, large: float, radius: float) -> None:
    steps = 40
    grid = [radius * (2 * step + 1 - steps) / steps for step in range(steps)]
    inside = [(x, y) for x in grid for y in grid if x * x + y * y <= radius * radius]
    covered = sum((x - offset) ** 2 + y * y <= large * large for x, y in inside)
    assert share_of_disc(offset, large, radius) == pytest.approx(covered / len(inside), abs=0.03)
