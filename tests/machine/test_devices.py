"""Motors, sensors, timers, sounds, messages, display, datalog: what a program reads of them and does with them."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING

import pytest

from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.options import WhileSending
from golc.runtime.rcxsim.surroundings import ROTATION_LEVELS, Button, Mode, Output

if TYPE_CHECKING:
    from tests.machine.conftest import Robot

MakeRobot = Callable[..., "Robot"]
BOTH = pytest.mark.parametrize("target", list(Target))
IDLE = "task main() { Wait(1); }"


def outputs(robot: Robot) -> tuple[Output, ...]:
    return tuple(robot.machine.outputs.now)


def test_the_state_of_the_outputs_as_measured(robot: MakeRobot) -> None:
    """After power on, then A on forward with power 5, reverse, flipped, floating, off, and with power 9."""
    text = (
        "#pragma noinit\nint a[9]; task main() { a[0] = OutputStatus(0); a[1] = OutputStatus(1);"
        "a[2] = OutputStatus(2);"
        "On(OUT_A); Fwd(OUT_A); SetPower(OUT_A, 5); a[3] = OutputStatus(0); Rev(OUT_A); a[4] = OutputStatus(0);"
        "Toggle(OUT_A); a[5] = OutputStatus(0); Float(OUT_A); a[6] = OutputStatus(0); Off(OUT_A);"
        "a[7] = OutputStatus(0); SetPower(OUT_A, 9); a[8] = OutputStatus(0); }"
    )
    program = robot(text, Target.RCX2).run(1)
    assert program.machine.variables[:9] == [79, 95, 111, 141, 133, 141, 13, 77, 79]


@BOTH
def test_motors(robot: MakeRobot, target: Target) -> None:
    text = "task main() { SetPower(OUT_A + OUT_C, 3); OnFwd(OUT_A); OnRev(OUT_C); Float(OUT_B); }"
    program = robot(text, target).run(1)
    assert outputs(program) == (Output(Mode.ON, True, 3), Output(Mode.FLOAT), Output(Mode.ON, False, 3))


def test_power_from_a_variable_counts_eight_bits_up_to_7(robot: MakeRobot) -> None:
    for value, power in ((4, 4), (7, 7), (8, 7), (-1, 7), (256 + 2, 2)):
        text = f"int a; task main() {{ a = {value}; SetPower(OUT_A, a); On(OUT_A); }}"
        assert outputs(robot(text).run(1))[0].power == power


def test_what_firmware_2_lets_through(robot: MakeRobot) -> None:
    text = (
        "int a; task main() { OnFwd(OUT_A + OUT_B); SetGlobalOutput(OUT_A, OUT_OFF);"
        "SetGlobalDirection(OUT_B, OUT_REV);"
        "SetMaxPower(OUT_B, 4); a = GlobalOutputStatus(1); Wait(10); SetGlobalOutput(OUT_A, OUT_ON);"
        "SetGlobalDirection(OUT_B, OUT_TOGGLE); }"
    )
    program = robot(text, Target.RCX2).run(0.08)
    assert outputs(program)[:2] == (Output(Mode.OFF), Output(Mode.ON, False, 4))
    assert program.variable("a") == 0x80 | 0x10 | 4
    assert outputs(program.run(1))[:2] == (Output(Mode.ON), Output(Mode.ON, True, 4))


def test_the_trace_has_each_change_of_a_motor(robot: MakeRobot) -> None:
    program = robot("#pragma noinit\ntask main() { Rev(OUT_B); On(OUT_B); On(OUT_B); Wait(10); Off(OUT_B); }").run(1)
    assert [(r["t"], r["motor"], r["mode"], r["direction"]) for r in program.told("motor")] == [
        (0.0, "B", "off", "reverse"),
        (0.002, "B", "on", "reverse"),
        (0.106, "B", "off", "reverse"),
    ]


def reading(robot: MakeRobot, sensor: str, raw: int, target: Target = Target.RCX, **options: object) -> int:
    """What a program reads of input 2 when it is configured in some way and has a raw value."""
    program = robot(f"int a; task main() {{ {sensor} Wait(5); a = SENSOR_2; }}", target, **options)
    program.bench.raw[1] = raw
    return program.run(1).variable("a")


@BOTH
@pytest.mark.parametrize(
    ("sensor", "raw", "value"),
    [
        ("", 517, 517),
        ("SetSensor(SENSOR_2, SENSOR_TOUCH);", 1023, 0),
        ("SetSensor(SENSOR_2, SENSOR_TOUCH);", 50, 1),
        ("SetSensor(SENSOR_2, SENSOR_LIGHT);", 700, 46),
        ("SetSensor(SENSOR_2, SENSOR_LIGHT);", 0, 100),
        ("SetSensor(SENSOR_2, SENSOR_LIGHT);", 1023, 0),
        ("SetSensorMode(SENSOR_2, SENSOR_MODE_PERCENT);", 512, 49),
        ("SetSensor(SENSOR_2, SENSOR_CELSIUS);", 585, 250),
        ("SetSensor(SENSOR_2, SENSOR_CELSIUS);", 0, 695),
        ("SetSensor(SENSOR_2, SENSOR_CELSIUS);", 1023, -198),
        ("SetSensor(SENSOR_2, SENSOR_FAHRENHEIT);", 585, 770),
        ("SetSensorType(SENSOR_2, SENSOR_TYPE_LIGHT); SetSensorMode(SENSOR_2, SENSOR_MODE_RAW);", 700, 700),
    ],
)
def test_what_a_sensor_reads(robot: MakeRobot, target: Target, sensor: str, raw: int, value: int) -> None:
    assert reading(robot, sensor, raw, target) == value


def test_the_light_formula_is_an_option(robot: MakeRobot) -> None:
    assert reading(robot, "SetSensor(SENSOR_2, SENSOR_LIGHT);", 700, light=(150, 10)) == 80


def test_type_and_mode_can_be_read(robot: MakeRobot) -> None:
    text = (
        "int a, b, c, d; task main() { SetSensor(SENSOR_3, SENSOR_LIGHT); a = SensorType(S3); b = SensorMode(S3);"
        "SetSensorMode(SENSOR_3, SENSOR_MODE_PULSE + 9); c = SensorMode(S3); d = SensorType(S1); }"
    )
    program = robot(text).run(1)
    assert [program.variable(name) for name in "abcd"] == [3, 0x80, 0x69, 0]


def test_raw_and_boolean_values_whatever_the_mode(robot: MakeRobot) -> None:
    program = robot("int a, b; task main() { Wait(5); a = SensorValueRaw(S1); b = SensorValueBool(S1); }")
    program.bench.raw[0] = 120
    program.run(1)
    assert (program.variable("a"), program.variable("b")) == (120, 1)


def test_a_boolean_stays_between_the_thresholds(robot: MakeRobot) -> None:
    program = robot("task main() { SetSensor(SENSOR_1, SENSOR_TOUCH); }").run(0.1)
    seen = []
    for raw in (562, 459, 500, 562, 563, 500, 460, 459):
        program.bench.raw[0] = raw
        seen.append(program.run(0.01).machine.inputs[0].value)
    assert seen == [0, 1, 1, 1, 0, 0, 0, 1]


def test_with_a_slope_a_boolean_follows_quick_changes(robot: MakeRobot) -> None:
    program = robot(
        "task main() { SetSensor(SENSOR_1, SENSOR_TOUCH); SetSensorMode(SENSOR_1, SENSOR_MODE_BOOL + 10); }"
    )
    program.run(0.1)
    seen = []
    for raw in (1015, 1005, 994, 990, 985, 996, 1000):
        program.bench.raw[0] = raw
        seen.append(program.run(0.003).machine.inputs[0].value)
    assert seen == [0, 0, 1, 1, 1, 0, 0]


@pytest.mark.parametrize(("mode", "expected"), [("EDGE", 7), ("PULSE", 3)])
def test_presses_are_counted(robot: MakeRobot, mode: str, expected: int) -> None:
    text = f"int a, b; task main() {{ SetSensor(SENSOR_1, SENSOR_{mode}); Wait(200); a = SENSOR_1; "
    program = robot(text + "ClearSensor(SENSOR_1); b = SENSOR_1; }").run(0.1)
    for raw in (50, 1023, 50, 1023, 50, 1023, 50):
        program.bench.raw[0] = raw
        program.run(0.02)
    program.run(3)
    assert (program.variable("a"), program.variable("b")) == (expected, 0)


def turned(robot: MakeRobot, levels: list[int], seconds: float = 0.01) -> int:
    program = robot("task main() { SetSensor(SENSOR_1, SENSOR_ROTATION); }")
    program.bench.raw[0] = ROTATION_LEVELS[0]
    program.run(0.1)
    program.machine.inputs[0].clear()
    for level in levels:
        program.bench.raw[0] = ROTATION_LEVELS[level % 4] + 20
        program.run(seconds)
    return program.machine.inputs[0].value


def test_rotation_is_counted_both_ways(robot: MakeRobot) -> None:
    assert turned(robot, list(range(1, 33))) == 32
    assert turned(robot, list(range(-1, -17, -1))) == -16
    assert turned(robot, [1, 2, 3, 2, 1, 0, -1]) == -1


def test_rotation_that_is_too_fast_is_lost(robot: MakeRobot) -> None:
    assert turned(robot, list(range(1, 41)), 0.0015) < 40


def test_light_and_rotation_sensors_are_fed(robot: MakeRobot) -> None:
    text = "task main() { SetSensor(SENSOR_1, SENSOR_TOUCH); SetSensor(SENSOR_2, SENSOR_LIGHT);"
    program = robot(text + "SetSensor(SENSOR_3, SENSOR_ROTATION); }").run(1)
    assert [sensor.powered for sensor in program.machine.inputs] == [False, True, True]


def test_the_trace_has_each_change_of_a_sensor(robot: MakeRobot) -> None:
    program = robot("task main() { SetSensor(SENSOR_1, SENSOR_TOUCH); }").run(0.1)
    program.records.clear()
    program.bench.raw[0] = 10
    program.run(0.1)
    assert [(r["input"], r["value"], r["raw"]) for r in program.told("sensor")] == [(1, 1, 10)]


@BOTH
def test_timers_count_tenths_of_a_second_since_they_were_cleared(robot: MakeRobot, target: Target) -> None:
    text = "int a, b, c; task main() { ClearTimer(1); Wait(99); a = Timer(1); Wait(5); b = Timer(1); c = Timer(3); }"
    program = robot(text, target).run(4)
    assert (program.variable("a"), program.variable("b"), program.variable("c")) == (9, 10, 10)


def test_timers_may_tick_together(robot: MakeRobot) -> None:
    text = "int a; task main() { Wait(9); ClearTimer(1); Wait(2); a = Timer(1); }"
    assert robot(text).run(1).variable("a") == 0
    assert robot(text, timers_tick_together=True).run(1).variable("a") == 1


def test_fast_timers_and_setting_them(robot: MakeRobot) -> None:
    text = "int a, b; task main() { SetTimer(2, 100); Wait(50); a = Timer(2); b = FastTimer(2); }"
    program = robot(text, Target.RCX2).run(1)
    assert (program.variable("a"), program.variable("b")) == (105, 1050)


def test_a_timer_goes_from_32767_to_0(robot: MakeRobot) -> None:
    text = "int a; task main() { SetTimer(0, 32767); Wait(15); a = Timer(0); }"
    assert robot(text, Target.RCX2).run(1).variable("a") == 0


@BOTH
def test_the_watch_counts_minutes(robot: MakeRobot, target: Target) -> None:
    text = "int a, b; task main() { SetWatch(23, 59); a = Watch(); Wait(6100); b = Watch(); }"
    program = robot(text, target).run(70)
    assert (program.variable("a"), program.variable("b")) == (1439, 0)


def test_a_message_is_kept_until_another_comes_or_it_is_cleared(robot: MakeRobot) -> None:
    text = "int a, b, c; task main() { Wait(20); a = Message(); b = Message(); ClearMessage(); c = Message(); }"
    program = robot(text).run(0.1)
    program.machine.hear(7)
    program.machine.hear(255)
    program.run(1)
    assert [program.variable(name) for name in "abc"] == [255, 255, 0]


def test_a_program_may_set_its_own_message(robot: MakeRobot) -> None:
    assert robot("int a; task main() { SetMessage(33); a = Message(); }", Target.RCX2).run(1).variable("a") == 33


def test_the_low_byte_of_a_value_is_sent(robot: MakeRobot) -> None:
    text = "int a; task main() { a = 256 + 7; SendMessage(a); Wait(10); a = -1; SendMessage(a); }"
    assert robot(text).run(1).ears.messages == [7, 255]


SENDING = "#pragma noinit\ntask main() { SendMessage(1); SendMessage(2); SendMessage(3); Wait(20); SendMessage(4); }"


@pytest.mark.parametrize(
    ("policy", "sent", "lost"),
    [
        (WhileSending.DROP, [1, 4], 2),
        (WhileSending.REPLACE, [1, 3, 4], 1),
        (WhileSending.QUEUE, [1, 2, 3, 4], 0),
    ],
)
def test_sending_while_a_message_is_in_the_air(
    robot: MakeRobot, policy: WhileSending, sent: list[int], lost: int
) -> None:
    program = robot(SENDING, while_sending=policy).run(1)
    assert program.ears.messages == sent
    assert len(program.told("dropped")) == lost
    times = [time for time, _ in program.ears.packets]
    assert all(later - earlier >= 0.04125 for earlier, later in pairwise(times))


def test_sending_does_not_hold_up_the_task(robot: MakeRobot) -> None:
    adds = "a += 1; " * 10
    program = robot(f"#pragma noinit\nint a; task main() {{ while (true) {{ SendMessage(1); {adds} }} }}", op_time=1860)
    assert program.run(2.4).variable("a") == pytest.approx(1000, abs=80)  # measured: 25 ms a round


def test_serial_bytes_are_a_packet_if_they_are_to_be(robot: MakeRobot) -> None:
    text = (
        "task main() { SetSerialData(0, 0xf7); SetSerialData(1, 99); SetSerialPacket(SERIAL_PACKET_RCX);"
        "SendSerial(0, 2); Wait(10); SetSerialPacket(SERIAL_PACKET_DEFAULT); SendSerial(0, 2); }"
    )
    program = robot(text, Target.RCX2).run(1)
    assert program.ears.messages == [99]
    assert [record["bytes"] for record in program.told("serial")] == ["f7 63", "f7 63"]


def test_sounds_do_not_hold_up_the_task_and_wait_for_each_other(robot: MakeRobot) -> None:
    text = "task main() { repeat (5) PlayTone(440, 100); Wait(250); repeat (3) PlayTone(880, 10); }"
    program = robot(text, sounds=3).run(9)
    assert [record["tones"] for record in program.told("sound")] == [[[440, 100]]] * 3 + [[[880, 10]]] * 2
    assert len(program.told("dropped")) == 3


def test_the_six_sounds_of_the_system(robot: MakeRobot) -> None:
    text = "".join(f"PlaySound({number}); Wait(100); " for number in range(6))
    assert len(robot(f"task main() {{ {text} }}").run(9).told("sound")) == 6


def test_muting_and_tones_from_a_variable(robot: MakeRobot) -> None:
    text = "int a; task main() { a = 523; PlayTone(a, 9); MuteSound(); PlayTone(a, 9); UnmuteSound(); ClearSound();"
    program = robot(text + "PlayTone(600, 9); }", Target.RCX2).run(1)
    assert [record["tones"] for record in program.told("sound")] == [[[523, 9]], [[600, 9]]]


@BOTH
@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("SetWatch(9, 5);", "09.05"),
        ("SelectDisplay(DISPLAY_SENSOR_2);", "1023"),
        ("SetPower(OUT_B, 3); SelectDisplay(DISPLAY_OUT_B);", "3"),
    ],
)
def test_what_the_display_shows(robot: MakeRobot, target: Target, text: str, shown: str) -> None:
    assert robot(f"task main() {{ {text} }}", target).run(1).machine.display.text == shown


def test_a_program_shows_a_value_as_it_changes(robot: MakeRobot) -> None:
    text = "int a; task main() { a = 314; SetUserDisplay(a, 2); SelectDisplay(DISPLAY_USER); Wait(20); a = -5; }"
    program = robot(text, Target.RCX2).run(0.1)
    assert program.machine.display.text == "3.14"
    assert program.run(1).machine.display.text == "-0.05"


def test_firmware_1_has_no_user_view(robot: MakeRobot) -> None:
    with pytest.raises(MachineError, match="no view 7"):
        robot("task main() { SelectDisplay(7); }").run(1)


@BOTH
def test_the_datalog_says_where_values_are_from(robot: MakeRobot, target: Target) -> None:
    text = (
        "int a; task main() { SetSensor(SENSOR_3, SENSOR_TOUCH); SetWatch(1, 2); CreateDatalog(4); a = -3;"
        "AddToDatalog(a); AddToDatalog(Timer(2)); AddToDatalog(SENSOR_3); AddToDatalog(Watch()); AddToDatalog(a); }"
    )
    program = robot(text, target).run(1)
    assert list(program.machine.datalog.entries) == [(0xFF, 5), (0, -3), (0x22, 0), (0x42, 0), (0x80, 62)]


def test_firmware_2_reads_its_datalog(robot: MakeRobot) -> None:
    text = (
        "int a, b, c, d, i; task main() { CreateDatalog(4); a = 300; AddToDatalog(a); b = DatalogType(0);"
        "i = 1; c = DatalogValue(i); d = DatalogByte(4); }"
    )
    program = robot(text, Target.RCX2).run(1)
    assert (program.variable("b"), program.variable("c"), program.variable("d")) == (0xFF, 300, 300 & 0xFF)


def test_a_datalog_that_does_not_fit_is_not_made(robot: MakeRobot) -> None:
    program = robot("int a; task main() { CreateDatalog(2500); AddToDatalog(a); }").run(1)
    assert list(program.machine.datalog.entries) == [(0xFF, 1)]
    assert robot("task main() { CreateDatalog(1900); }").run(1).machine.datalog.size == 1900


def test_battery_and_firmware_can_be_read(robot: MakeRobot) -> None:
    program = robot("int a, b; task main() { a = BatteryLevel(); b = FirmwareVersion(); }", Target.RCX2, battery=7000)
    program.run(1)
    assert (program.variable("a"), program.variable("b")) == (7000, 332)


def test_the_run_button_starts_and_stops(robot: MakeRobot) -> None:
    program = robot("int a; task main() { OnFwd(OUT_A); while (true) { a += 1; Wait(10); } }", start=False).run(1)
    assert program.variable("a") == 0
    program.bench.buttons.append(Button.RUN)
    program.run(1)
    program.bench.buttons.append(Button.RUN)
    counted = program.run(1).variable("a")
    assert counted == 10
    assert outputs(program)[0].mode is Mode.OFF
    assert program.run(1).variable("a") == counted


def test_motors_may_run_on_when_the_run_button_stops_a_program(robot: MakeRobot) -> None:
    program = robot("task main() { OnFwd(OUT_A); Wait(1000); }", run_stops_motors=False).run(1)
    program.machine.press(Button.RUN)
    assert outputs(program.run(1))[0].mode is Mode.ON


def test_the_prgm_button_goes_through_the_five_slots(robot: MakeRobot) -> None:
    program = robot(IDLE)
    slots = []
    for _ in range(6):
        program.machine.press(Button.PROGRAM)
        slots.append(program.machine.slot)
    assert slots == [1, 2, 3, 4, 0, 1]


def test_the_view_button_goes_through_what_can_be_shown(robot: MakeRobot) -> None:
    program = robot(IDLE)
    views = []
    for _ in range(8):
        program.machine.press(Button.VIEW)
        views.append(program.machine.display.view)
    assert views == [1, 2, 3, 4, 5, 6, 0, 1]


def test_a_program_selects_another(robot: MakeRobot) -> None:
    text = "int a; task main() { SelectProgram(3); a = 1; }"
    program = robot(text, Target.RCX2).run(1)
    assert (program.machine.slot, program.variable("a")) == (3, 0)
    assert not program.machine.processor.running


def test_a_program_that_selects_another_may_start_it(robot: MakeRobot) -> None:
    first = robot("int a; task main() { a += 1; SelectProgram(3); }", Target.RCX2, select_starts=True, start=False)
    second = robot("int a; task main() { a += 100; }", Target.RCX2)
    first.machine.load(second.image, 3)
    first.machine.start(0)
    assert first.run(1).variable("a") == 101


def test_an_idle_brick_switches_itself_off(robot: MakeRobot) -> None:
    program = robot("task main() { SetSleepTime(2); Wait(9000); }").run(200)
    assert program.machine.on
    assert not program.run(20).machine.on
    assert [record["t"] for record in program.told("switched")] == [pytest.approx(210, abs=0.1)]


def test_a_brick_that_is_to_stay_on_stays_on(robot: MakeRobot) -> None:
    text = "task main() { SetSleepTime(0); SleepNow(); Wait(100); PlaySound(1); }"
    program = robot(text).run(20)
    assert program.machine.on
    assert len(program.told("sound")) == 1


def test_switched_off_and_on_it_keeps_programs_and_variables(robot: MakeRobot) -> None:
    program = robot("int a; task main() { a += 1; OnFwd(OUT_B); Wait(1000); }").run(1)
    program.machine.press(Button.POWER)
    program.machine.press(Button.RUN)
    assert not program.run(1).machine.processor.running
    assert outputs(program) == (Output(), Output(), Output())
    program.machine.press(Button.POWER)
    program.machine.press(Button.RUN)
    assert program.run(1).variable("a") == 2
