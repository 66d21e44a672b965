"""Events and access control of firmware 2.0, as the NQC guide describes them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.error import MachineError

if TYPE_CHECKING:
    from tests.machine.conftest import Robot

MakeRobot = Callable[..., "Robot"]


def watching(source: str, kind: str, more: str = "") -> str:
    """A program that counts how often an event happens."""
    return f"""
    int n, mask, clicks;
    task main() {{
        SetSensor(SENSOR_1, SENSOR_TOUCH);
        SetSensor(SENSOR_2, SENSOR_LIGHT);
        SetEvent(4, {source}, EVENT_TYPE_{kind});
        {more}
        while (true) {{
            monitor (EVENT_MASK(4)) {{ while (true) Wait(100); }}
            catch {{ n += 1; mask = CurrentEvents(); clicks = ClickCounter(4); }}
        }}
    }}"""


def fed(robot: MakeRobot, text: str, port: int, raws: list[int], seconds: float = 0.05) -> Robot:
    program = robot(text, Target.RCX2)
    program.bench.raw[port] = raws[0]
    program.run(0.2)
    for raw in raws[1:]:
        program.bench.raw[port] = raw
        program.run(seconds)
    return program


UP, DOWN = 1023, 50


@pytest.mark.parametrize(("kind", "times"), [("PRESSED", 2), ("RELEASED", 1), ("PULSE", 1), ("EDGE", 3)])
def test_a_touch_sensor(robot: MakeRobot, kind: str, times: int) -> None:
    program = fed(robot, watching("SENSOR_1", kind), 0, [UP, DOWN, UP, DOWN])
    assert (program.variable("n"), program.variable("mask")) == (times, 1 << 4)


def test_a_sensor_that_is_pressed_from_the_beginning_has_not_been_pressed(robot: MakeRobot) -> None:
    assert fed(robot, watching("SENSOR_1", "PRESSED"), 0, [DOWN, DOWN]).variable("n") == 0


def light(percent: int) -> int:
    return (146 - percent) * 7


LIMITS = "SetLowerLimit(4, 30); SetUpperLimit(4, 60); SetHysteresis(4, 5);"


@pytest.mark.parametrize(
    ("kind", "percents", "times"),
    [
        ("LOW", [45, 29, 32, 29, 36, 29], 2),
        ("HIGH", [45, 61, 57, 61, 50, 61], 2),
        ("NORMAL", [45, 70, 57, 54, 20, 34, 36], 2),
        ("LOW", [20, 20], 0),
        ("FASTCHANGE", [45, 47, 90, 88], 1),
    ],
)
def test_ranges_of_a_light_sensor(robot: MakeRobot, kind: str, percents: list[int], times: int) -> None:
    program = fed(robot, watching("SENSOR_2", kind, LIMITS), 1, [light(percent) for percent in percents])
    assert program.variable("n") == times


def test_without_limits_nothing_is_low_or_high(robot: MakeRobot) -> None:
    for kind in ("LOW", "HIGH"):
        assert fed(robot, watching("SENSOR_2", kind), 1, [light(p) for p in (0, 100, 0)]).variable("n") == 0


@pytest.mark.parametrize(
    ("kind", "percents", "seconds", "times"),
    [
        ("CLICK", [20, 70, 20, 45, 20, 45, 70, 45, 20], 0.05, 2),
        ("CLICK", [20, 70, 20, 70, 20], 0.4, 0),
        ("DOUBLECLICK", [20, 70, 20, 70, 20, 70, 20, 70, 20], 0.05, 2),
        ("DOUBLECLICK", [20, 70, 20], 0.05, 0),
    ],
)
def test_clicks(robot: MakeRobot, kind: str, percents: list[int], seconds: float, times: int) -> None:
    text = watching("SENSOR_2", kind, LIMITS + "SetClickTime(4, 20);")
    program = fed(robot, text, 1, [light(percent) for percent in percents], seconds)
    assert program.variable("n") == times
    assert program.variable("clicks") == times * (2 if kind == "DOUBLECLICK" else 1)


def test_timers_counters_and_messages(robot: MakeRobot) -> None:
    timer = robot(watching("Timer(1)", "HIGH", "SetUpperLimit(4, 5);"), Target.RCX2).run(0.5)
    assert timer.variable("n") == 0
    assert timer.run(0.5).variable("n") == 1
    counter = robot(watching("Counter(2)", "HIGH", "SetUpperLimit(4, 5); SetUpperLimit(4, 2);"), Target.RCX2).run(0.5)
    counter.machine.variables[2] = 3
    assert counter.run(0.5).told("task")[-1]["how"] == "started"
    assert counter.machine.processor.tasks[0].running


def test_every_message_counts_even_the_same_again(robot: MakeRobot) -> None:
    program = robot(watching("Message()", "MESSAGE"), Target.RCX2).run(0.2)
    for _ in range(3):
        program.machine.hear(9)
        program.run(0.2)
    assert program.variable("n") == 3


def test_an_event_by_hand_reaches_every_task_that_monitors_it(robot: MakeRobot) -> None:
    text = """
    int a, b, mask;
    task other() { monitor (EVENT_MASK(2) + EVENT_MASK(3)) { Wait(1000); } catch { a += 1; mask = CurrentEvents(); } }
    task third() { monitor (EVENT_MASK(5)) { Wait(1000); } catch { b += 1; } }
    task main() { start other; start third; Wait(20); Event(EVENT_MASK(3) + EVENT_MASK(7)); Wait(20); b += 10; }
    """
    program = robot(text, Target.RCX2).run(2)
    assert [program.variable(name) for name in ("a", "b", "mask")] == [1, 10, 1 << 3]


def test_catching_some_of_the_events(robot: MakeRobot) -> None:
    text = """
    int a;
    task other() {
        monitor (EVENT_MASK(2) + EVENT_MASK(3)) { Wait(1000); } catch (EVENT_MASK(3)) { a = 3; } catch { a = 9; }
    }
    task main() { start other; Wait(20); Event(EVENT_MASK(%d)); }
    """
    assert robot(text % 2, Target.RCX2).run(2).variable("a") == 9
    assert robot(text % 3, Target.RCX2).run(2).variable("a") == 3


def test_what_happens_after_the_body_is_not_monitored(robot: MakeRobot) -> None:
    text = "int a; task main() { monitor (EVENT_MASK(2)) { Wait(1); } catch { a = 1; } Event(EVENT_MASK(2)); a += 10; }"
    assert robot(text, Target.RCX2).run(2).variable("a") == 10


def test_the_state_of_an_event(robot: MakeRobot) -> None:
    text = (
        "int a, b, c; task main() { SetSensor(SENSOR_2, SENSOR_LIGHT); SetEvent(3, SENSOR_2, EVENT_TYPE_HIGH);"
        "SetUpperLimit(3, 60); SetLowerLimit(3, 30); a = EventState(9); Wait(5); b = EventState(3); Wait(20);"
        "c = EventState(3); }"
    )
    program = robot(text, Target.RCX2)
    program.bench.raw[1] = light(80)
    program.run(0.15)
    program.bench.raw[1] = light(20)
    program.run(1)
    assert [program.variable(name) for name in "abc"] == [3, 2, 0]


def test_calibration_takes_parts_of_the_value(robot: MakeRobot) -> None:
    text = (
        "int a, b, c, d; task main() { SetSensor(SENSOR_2, SENSOR_LIGHT); SetEvent(3, SENSOR_2, EVENT_TYPE_HIGH);"
        "CalibrateEvent(3, 50, 20, 10); a = EventState(3); Wait(10); b = UpperLimit(3); c = LowerLimit(3);"
        "d = Hysteresis(3); }"
    )
    program = robot(text, Target.RCX2)
    program.bench.raw[1] = light(40)
    program.run(1)
    assert [program.variable(name) for name in "abcd"] == [5, 48, 20, 4]


def test_events_that_are_cleared_do_not_happen(robot: MakeRobot) -> None:
    for clear in ("ClearEvent(4);", "ClearAllEvents();"):
        program = fed(robot, watching("SENSOR_1", "PRESSED", clear), 0, [UP, DOWN, UP, DOWN])
        assert program.variable("n") == 0


def test_an_event_cannot_look_at_anything(image_of: Callable[..., bytes], robot: MakeRobot) -> None:
    for bad in ([0x93, 16, 0, 0], [0x93, 0, 11, 10], [0x93, 0, 3, 0], [0x93, 0, 0, 5]):
        with pytest.raises(MachineError):
            robot(image_of([(0, 0, bytes(bad))])).run(1)


ACQUIRING = """
int a, b, c;
task other() {
    SetPriority(%d);
    acquire (ACQUIRE_OUT_A) { a = 1; Wait(50); a = 2; } catch { a += 10; }
}
task main() {
    SetPriority(%d);
    start other;
    Wait(10);
    acquire (ACQUIRE_OUT_A + ACQUIRE_USER_1) { b = 1; Wait(10); b = 2; } catch { b += 10; }
    c = 1;
}
"""


@pytest.mark.parametrize(
    ("other", "main", "a", "b"),
    [(5, 5, 11, 2), (5, 2, 11, 2), (2, 5, 2, 10)],
)
def test_a_resource_goes_to_the_more_important_or_later_task(
    robot: MakeRobot, other: int, main: int, a: int, b: int
) -> None:
    program = robot(ACQUIRING % (other, main), Target.RCX2).run(3)
    assert [program.variable(name) for name in "abc"] == [a, b, 1]


def test_different_resources_are_no_conflict(robot: MakeRobot) -> None:
    text = ACQUIRING.replace("ACQUIRE_OUT_A + ACQUIRE_USER_1", "ACQUIRE_OUT_B") % (5, 5)
    program = robot(text, Target.RCX2).run(3)
    assert [program.variable(name) for name in "abc"] == [2, 2, 1]


def test_a_resource_is_free_after_the_body_and_when_its_task_ends(robot: MakeRobot) -> None:
    text = """
    int a;
    task other() { SetPriority(0); acquire (ACQUIRE_SOUND) { Wait(%d); } }
    task main() { start other; Wait(20); %s acquire (ACQUIRE_SOUND) { a = 1; } catch { a = 2; } }
    """
    assert robot(text % (1000, ""), Target.RCX2).run(3).variable("a") == 2
    assert robot(text % (5, ""), Target.RCX2).run(3).variable("a") == 1
    assert robot(text % (1000, "stop other;"), Target.RCX2).run(3).variable("a") == 1
