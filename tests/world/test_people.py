"""What people do when their script says so."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from golc.runtime.rcxsim.machine.sounds import SYSTEM_SOUNDS
from golc.runtime.rcxsim.surroundings import OPEN, Button, Mode

if TYPE_CHECKING:
    from tests.world.conftest import Lab, MakeLab

THINGS = """
[lines.track]
points = [[0, 0], [1000, 0]]
width = 20
light = 30

[stations.1]
along = 0
light = 70

[stations.2]
along = 300
light = 70

[sensors.1]
kind = "touch"
name = "go"
"""
DOWN, UP = 2, 3


def script(*lines: str) -> str:
    return THINGS + "[people]\nscript = [" + ", ".join(f"'{line}'" for line in lines) + "]\n"


def play(robot: Lab, sound: int) -> None:
    robot.hear(*[(tone.frequency, tone.duration) for tone in SYSTEM_SOUNDS[sound]])


def presses(robot: Lab, seconds: float) -> list[float]:
    """When the button is found pressed, looking every 10 ms; each time it goes down."""
    found, before = [], False
    for _ in range(round(seconds * 100)):
        robot.wait(0.01)
        now = robot.raw(1) < 100
        if now and not before:
            found.append(robot.now / 1_000_000)
        before = now
    return found


def test_a_button_is_held_from_a_time_for_a_time(lab: MakeLab) -> None:
    robot = lab(script("at 1 s: press go for 0.5 s"))
    robot.wait(0.999)
    assert robot.raw(1) == OPEN
    robot.wait(0.001)
    assert robot.raw(1) < 100
    robot.wait(0.499)
    assert robot.raw(1) < 100
    robot.wait(0.001)
    assert robot.raw(1) == OPEN
    assert robot.told("press") == [(1.0, "go")]


def test_two_who_press_at_once_press_until_both_let_go(lab: MakeLab) -> None:
    robot = lab(script("at 1 s: press go for 1 s", "at 1.5 s: press go for 0.1 s"))
    assert presses(robot, 1.9) == [1.0]
    robot.wait(0.2)
    assert robot.raw(1) == OPEN


def test_on_a_sound_each_time_it_is_made(lab: MakeLab) -> None:
    robot = lab(script("on sound up after 0.5 s: press go"))
    play(robot, UP)
    assert presses(robot, 1) == [0.5]
    play(robot, DOWN)
    robot.hear((440, 10))
    assert presses(robot, 1) == []
    play(robot, UP)
    assert presses(robot, 1) == [2.5]
    assert robot.told("plays") == [(0.0, "up"), (1.0, "down"), (1.0, "tone"), (2.0, "up")]


@pytest.mark.parametrize(("which", "pressed"), [("", [0.5, 1.5, 2.5]), (" 2", [0.5]), (" low_beep", [])])
def test_on_any_sound_or_one_by_its_number_or_name(lab: MakeLab, which: str, pressed: list[float]) -> None:
    robot = lab(script(f"on sound{which} after 0.5 s: press go"))
    found: list[float] = []
    for sound in (DOWN, UP):
        play(robot, sound)
        found += presses(robot, 1)
    robot.hear((440, 10))
    assert found + presses(robot, 1) == pytest.approx(pressed)


def test_only_the_nth_time(lab: MakeLab) -> None:
    robot = lab(script("on 2nd sound up after 0 s: press go", "on 3rd sound up after 0.5 s: lift"))
    play(robot, UP)
    assert presses(robot, 1) == []
    play(robot, UP)
    assert presses(robot, 1) == [1.01]
    play(robot, UP)
    robot.wait(1)
    assert robot.told("lift") == [(2.5, "the robot")]


def test_only_at_a_station(lab: MakeLab) -> None:
    robot = lab(script("on sound up after 0 s at station 2: press go"))
    play(robot, UP)
    assert presses(robot, 1) == []
    robot.drive(5, 5)
    robot.wait(3)
    play(robot, UP)
    assert presses(robot, 0.5) == [4.01]


def test_when_the_wheels_have_stood_for_a_while(lab: MakeLab) -> None:
    robot = lab(script("on stop after 1 s: press go"))
    assert presses(robot, 2) == []  # it never moved
    robot.drive(5, 5)
    robot.wait(1)
    robot.drive(0, 0)
    robot.wait(0.9)
    robot.drive(5, 0)  # too soon
    robot.wait(1)
    robot.drive(0, 0)
    robot.wait(0.5)
    robot.drive(0, 0, Mode.FLOAT)  # still stands
    assert presses(robot, 2) == [pytest.approx(5.9, abs=0.011)]


def test_the_wheels_have_stopped_when_they_have_coasted_out(lab: MakeLab) -> None:
    robot = lab(script("on stop after 1 s: press go"), coasts="0.5")
    robot.drive(5, 5)
    robot.wait(1)
    robot.drive(0, 0, Mode.FLOAT)
    assert presses(robot, 3) == [pytest.approx(2.5, abs=0.011)]


def test_put_at_a_station(lab: MakeLab) -> None:
    robot = lab(
        script(
            "at 1 s: put at station 2",
            "at 2 s: put at station 2 facing backward",
            "at 3 s: put at station 2 facing 30",
            "at 4 s: put at -12.5, +40 facing -90",
        )
    )
    found = []
    for _ in range(4):
        robot.wait(1)
        found.append(robot.pose)
    assert found[0] == pytest.approx((300, 0, 0))
    assert found[1] == pytest.approx((300, 0, 180))
    assert found[2] == pytest.approx((300, 0, 30))
    assert found[3] == pytest.approx((-12.5, 40, -90))


@pytest.mark.parametrize(("facing", "heading"), [(60, 0), (120, 180), (-170, 180), (-80, 0)])
def test_put_back_on_the_nearest_line_the_way_it_looked(lab: MakeLab, facing: int, heading: int) -> None:
    robot = lab(script("at 1 s: put back"), start=f"{{ at = [200, 150], facing = {facing} }}")
    robot.wait(1)
    assert robot.pose[:2] == pytest.approx((200, 0))
    assert robot.pose[2] % 360 == pytest.approx(heading)


def test_a_robot_in_the_air_stays_where_it_is_whatever_its_wheels_do(lab: MakeLab) -> None:
    robot = lab(script("at 1 s: lift", "at 3 s: put at 500, 100 facing 0"))
    robot.drive(5, 5)
    robot.wait(2)
    assert robot.pose == pytest.approx((100, 0, 0))
    assert robot.world.whereabouts == "in the air"
    robot.wait(2)
    assert robot.pose == pytest.approx((600, 100, 0))


def test_nobody_puts_the_robot_where_it_has_no_room(lab: MakeLab) -> None:
    lane = "[[walls]]\npoints = [[500, 130], [700, 130]]\n[[walls]]\npoints = [[500, 70], [700, 70]]\n"
    robot = lab(lane + script("at 1 s: put at 600, 100 facing 0"))
    robot.wait(2)
    assert robot.pose == (0, 0, 0)
    assert [text for _, text in robot.told("no room")] == ["for the robot at (600, 100), 316 mm from station 2"]


def test_the_buttons_of_the_brick(lab: MakeLab) -> None:
    robot = lab(script("at 1 s: press run", "at 1.5 s: press on-off for 2 s"))
    assert robot.world.pressed(999_999) == ()
    assert robot.world.pressed(2_000_000) == [Button.RUN, Button.POWER]
    assert robot.world.pressed(9_000_000) == ()


def test_where_the_robot_is_for_people(lab: MakeLab) -> None:
    robot = lab(THINGS)
    assert robot.world.whereabouts == "at station 1"
    robot.drive(5, 5)
    robot.wait(2)
    assert robot.world.whereabouts == "at (200, 0), 100 mm from station 2"
