"""The behaviours of the delivery robot: compiled by nqc, executed op code by op code, driving on the floor."""

from __future__ import annotations

from math import cos, degrees
from typing import TYPE_CHECKING

import pytest

from golc.nqc.toolchain import Target

if TYPE_CHECKING:
    from tests.world.conftest import DeliveryRobot, MakeRobot

TURN, SIGNAL, GO = 0, 1, 2
ARRIVED, LOST, BUTTON = 3, 4, 5
NOBODY = (
    '"on sound up after 2 s: press go",\n    "on sound down after 4 s: put back",\n',
    "",
)
"""Takes the people away."""


def drive(robot: DeliveryRobot) -> str:
    """To the next station: where the robot is then."""
    robot.act(GO)
    assert robot.event(60) == ARRIVED
    return robot.world.whereabouts


@pytest.mark.parametrize("target", list(Target))
def test_from_station_to_station_and_back_again(delivery_robot: MakeRobot, target: Target) -> None:
    robot = delivery_robot(target=target)
    assert [drive(robot) for _ in range(3)] == [f"at station {n}" for n in (4, 5, 6)]
    robot.act(TURN)
    assert [drive(robot) for _ in range(5)] == [f"at station {n}" for n in (5, 4, 3, 2, 1)]
    robot.act(TURN)
    assert drive(robot) == "at station 2"


@pytest.mark.parametrize("delay", [0, 0.013, 0.04])
@pytest.mark.parametrize("noise", [0, 2])
def test_it_arrives_whatever_the_light_and_the_moment(delivery_robot: MakeRobot, noise: int, delay: float) -> None:
    robot = delivery_robot(("ahead = 60", f"ahead = 60\nnoise = {noise}"))
    robot.wait(delay)
    robot.act(TURN)
    assert [drive(robot) for _ in range(2)] == ["at station 2", "at station 1"]


def test_it_arrives_later_at_a_station_that_is_moved_in_the_file(delivery_robot: MakeRobot) -> None:
    def arrival(along: int) -> float:
        robot = delivery_robot(("along = 1900", f"along = {along}"))
        drive(robot)
        return robot.now

    assert 1.5 < arrival(2000) - arrival(1900) < 3.0  # 100 mm at some 40 to 60 mm/s


def test_a_turn_leads_back_to_the_line(delivery_robot: MakeRobot) -> None:
    robot = delivery_robot()
    before = robot.world.pose
    seconds = robot.act(TURN)
    after = robot.world.pose
    assert 1.0 < seconds < 3.0
    assert (after.x, after.y) == pytest.approx((before.x, before.y))
    assert cos(after.heading - before.heading) < -0.9  # turned round, to 25 degrees


def test_it_signals_and_the_person_at_the_station_presses_the_button(delivery_robot: MakeRobot) -> None:
    robot = delivery_robot()
    began = robot.now
    robot.act(SIGNAL)
    assert robot.told("plays") == ["up"]
    assert robot.event(10) == BUTTON
    assert robot.told("press") == ["go"]
    assert 2.0 < robot.now - began < 4.0
    assert robot.event(3) is None


def test_a_button_that_is_held_is_one_push(delivery_robot: MakeRobot) -> None:
    robot = delivery_robot((NOBODY[0], '"at 2 s: press go for 5 s"'))
    assert robot.event(10) == BUTTON
    assert robot.event(10) is None


def test_where_the_line_ends_the_robot_is_lost_and_says_so(delivery_robot: MakeRobot) -> None:
    cut = ("[650, 950], [300, 850], [150, 1100], [450, 1350], [900, 1300], [1200, 1150]]", "[800, 900]]")
    away = [(f"along = {along}", "along = 0") for along in (1900, 2500, 3100)]
    robot = delivery_robot(cut, *away, NOBODY)
    robot.act(GO)
    assert robot.event(60) == LOST
    assert robot.told("plays") == ["down"]
    x, y = robot.world.pose[:2]
    robot.wait(2)
    assert robot.world.pose[:2] == (x, y)
    assert robot.event(3) is None


def test_a_robot_that_was_lost_goes_on_when_it_is_back_on_the_line(delivery_robot: MakeRobot) -> None:
    people = ('"on sound up after 2 s: press go"', '"at 6 s: put at 500, 600 facing 90"')
    back = ("after 4 s: put back", "after 4 s: put at 800, 880 facing 160")
    robot = delivery_robot(people, back)
    robot.act(GO)
    assert robot.event(60) == LOST
    robot.wait(5)
    assert drive(robot) == "at station 4"
    assert 90 < degrees(robot.world.pose.heading) % 360 < 270
