"""Tasks, subs, loops and time: who runs when, and for how long."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.error import MachineError

if TYPE_CHECKING:
    from tests.machine.conftest import Robot

MakeRobot = Callable[..., "Robot"]
MakeImage = Callable[..., bytes]
BOTH = pytest.mark.parametrize("target", list(Target))
NOINIT = "#pragma noinit\n"


def message_times(robot: Robot) -> list[float]:
    return [round(time, 4) for time, _ in robot.ears.packets]


def test_an_op_code_takes_2_ms_with_firmware_1_and_2_8_with_2(robot: MakeRobot) -> None:
    text = NOINIT + "int a; task main() { a = 1; a = 2; a = 3; SendMessage(a); }"
    assert message_times(robot(text, Target.RCX).run(1)) == [0.006]
    assert message_times(robot(text, Target.RCX2).run(1)) == [0.0084]


def test_a_multiplication_takes_a_little_longer_and_a_ping_a_little_less(image_of: MakeImage, robot: MakeRobot) -> None:
    multiply, ping, send = bytes([0x54, 0, 2, 1, 0]), bytes([0x10]), bytes([0xB2, 2, 1])
    assert message_times(robot(image_of([(0, 0, multiply * 100 + send)], 0)).run(1)) == [0.206]
    assert message_times(robot(image_of([(0, 0, ping * 100 + send)], 0)).run(1)) == [0.188]


def test_the_time_of_an_op_code_can_be_set(robot: MakeRobot) -> None:
    text = NOINIT + "int a; task main() { a = 1; SendMessage(a); }"
    assert message_times(robot(text, op_time=1860).run(1)) == [0.0019]


@BOTH
def test_busy_tasks_share_the_time(robot: MakeRobot, target: Target) -> None:
    text = "int a, b; task other() { while (true) b += 1; } task main() { start other; while (true) a += 1; }"
    program = robot(text, target, op_time=2000).run(10)
    assert program.variable("a") == pytest.approx(1250, abs=3)  # 10 s / 2 ms / 2 tasks / 2 op codes
    assert program.variable("b") == pytest.approx(1250, abs=3)


def test_a_task_that_waits_takes_no_time(robot: MakeRobot) -> None:
    text = "int a; task other() { while (true) Wait(100); } task main() { start other; while (true) a += 1; }"
    assert robot(text).run(10).variable("a") == pytest.approx(2490, abs=15)


def test_tasks_take_turns_after_every_op_code(robot: MakeRobot) -> None:
    text = NOINIT + (
        "int a, b, c; task one() { a = 1; b = a; } task two() { c = b; c += b; }\n"
        "task main() { start one; start two; a = 5; b = 6; c = 7; }"
    )
    program = robot(text).run(1)
    # start one | a = 1 | start two | b = a | c = b | a = 5 | c += b | b = 6 | c = 7
    assert (program.variable("a"), program.variable("b"), program.variable("c")) == (5, 6, 7)
    assert [(r["name"], r["how"], r["t"]) for r in program.told("task")][1:] == [
        ("one", "started", 0.0),
        ("two", "started", 0.004),
        ("one", "ended", 0.012),
        ("two", "ended", 0.016),
        ("main", "ended", 0.018),
    ]


def test_a_wait_is_over_so_many_hundredths_after_it_began(robot: MakeRobot) -> None:
    text = NOINIT + "task main() { PlaySound(1); Wait(8); PlaySound(2); Wait(0); Wait(-5); PlaySound(3); }"
    assert [record["t"] for record in robot(text, op_time=1860).run(1).told("sound")] == [0.0, 0.08186, 0.08744]


def test_a_wait_may_end_with_a_tick_of_the_clock(robot: MakeRobot) -> None:
    text = NOINIT + "task main() { SendMessage(1); Wait(8); SendMessage(2); }"
    assert message_times(robot(text, waits_end_on_ticks=True).run(1)) == [0.0, 0.08]


@BOTH
def test_starting_a_task_again_begins_at_its_top(robot: MakeRobot, target: Target) -> None:
    text = (
        "int a; task other() { a += 1; Wait(1000); a += 100; }\n"
        "task main() { start other; Wait(10); start other; Wait(10); start other; }"
    )
    program = robot(text, target).run(9)
    assert program.variable("a") == 3
    assert program.run(3).variable("a") == 103


@BOTH
def test_stopping_tasks(robot: MakeRobot, target: Target) -> None:
    text = (
        "int a, b; task other() { while (true) { a += 1; Wait(1); } } task self() { b = 1; stop self; b = 2; }\n"
        "task main() { start other; start self; Wait(50); stop other; stop other; a = 1000; Wait(50); }"
    )
    program = robot(text, target).run(2)
    assert (program.variable("a"), program.variable("b")) == (1000, 1)


@BOTH
def test_stopping_everything_lets_motors_run_on(robot: MakeRobot, target: Target) -> None:
    text = (
        "int a; task other() { while (true) Wait(1); }\n"
        "task main() { start other; OnFwd(OUT_A); Wait(10); StopAllTasks(); a = 1; }"
    )
    program = robot(text, target).run(1)
    assert not program.machine.processor.running
    assert program.variable("a") == 0
    assert program.machine.outputs.now[0].mode.value == "on"


@BOTH
def test_a_sub_is_called_by_two_tasks_at_once(robot: MakeRobot, target: Target) -> None:
    text = (
        "int a; sub add() { a += 1; Wait(10); a += 1; }\n"
        "task other() { add(); a += 10; } task main() { start other; add(); a += 100; }"
    )
    assert robot(text, target).run(1).variable("a") == 114


def test_a_sub_called_by_a_sub_stops_everything_when_the_first_returns(image_of: MakeImage, robot: MakeRobot) -> None:
    def add(amount: int) -> bytes:
        return bytes([0x24, 0, 2, amount, 0])

    main, first, second = bytes([0x17, 0]) + add(100), bytes([0x17, 1]) + add(10), add(1)
    program = robot(image_of([(0, 0, main), (1, 0, first), (1, 1, second)], 0)).run(1)
    assert program.machine.variables[0] == 11
    assert not program.machine.processor.running


def test_tasks_and_subs_that_are_not_there_are_not_started(image_of: MakeImage, robot: MakeRobot) -> None:
    program = robot(image_of([(0, 0, bytes([0x71, 9, 0x71, 99, 0x17, 7, 0x81, 200, 0xB2, 2, 1]))], 0)).run(1)
    assert program.ears.messages == [1]


def test_a_return_in_the_middle_of_a_sub(image_of: MakeImage, robot: MakeRobot) -> None:
    sub = bytes([0xF6, 0xB2, 2, 1])
    program = robot(image_of([(0, 0, bytes([0x17, 0, 0xB2, 2, 2])), (1, 0, sub)], 0)).run(1)
    assert program.ears.messages == [2]


@BOTH
def test_loops_that_count(robot: MakeRobot, target: Target) -> None:
    text = (
        "int a, n; task main() { repeat (5) { a += 1; repeat (3) a += 10; } n = 4; repeat (n) a += 100;\n"
        "repeat (0) a += 1000; n = -3; repeat (n) a += 1000; }"
    )
    assert robot(text, target).run(5).variable("a") == 5 + 150 + 400


def test_of_more_than_four_loops_the_innermost_is_lost(image_of: MakeImage, robot: MakeRobot) -> None:
    push = b"".join(bytes([0x82, 2, count]) for count in (9, 8, 7, 6, 5))
    code = push + bytes([0x37, 8, 0x24, 0, 2, 1, 0, 0x27, 0x88])  # count; a += 1; again
    program = robot(image_of([(0, 0, code)], 0)).run(1)
    assert program.machine.variables[0] == 5


def test_counting_without_a_loop_is_an_error(image_of: MakeImage, robot: MakeRobot) -> None:
    program = robot(image_of([(0, 0, bytes([0x37, 1]))], 0))
    with pytest.raises(MachineError, match="task 0, address 0: no loop has begun"):
        program.run(1)


def test_tasks_have_variables_of_their_own_with_firmware_2(robot: MakeRobot) -> None:
    text = (
        "int a, b; sub twice() { int x; x = a; Wait(10); x += a; a = x; }\n"
        "task other() { int y; y = 7; Wait(20); b = y; } task main() { int z; start other; z = 9; a = z; twice(); }"
    )
    program = robot(text, Target.RCX2).run(1)
    assert (program.variable("a"), program.variable("b")) == (18, 7)


def test_arrays(robot: MakeRobot) -> None:
    text = (
        "int a[4], i, s; task main() { int b[3]; for (i = 0; i < 4; i++) a[i] = i * i; b[2] = a[3];\n"
        "for (i = 0; i < 4; i++) s += a[i]; s += b[2]; }"
    )
    assert robot(text, Target.RCX2).run(1).variable("s") == 14 + 9


def test_an_index_outside_the_variables_is_an_error(robot: MakeRobot) -> None:
    text = "int a[4], i; task main() { i = 200; a[i] = 1; }"
    with pytest.raises(MachineError, match=r"task 0 \(main\), address \d+: firmware 2.0 has no variable 200"):
        robot(text, Target.RCX2).run(1)


def test_variables_outlive_the_program_unless_an_option_says_no(robot: MakeRobot) -> None:
    text = "int a; task main() { a += 1; }"
    for options, expected in (({}, 2), ({"start_clears_variables": True}, 1)):
        program = robot(text, **options).run(1)
        program.machine.start(0)
        assert program.run(1).variable("a") == expected


@BOTH
def test_random_numbers_are_uniform_and_the_same_for_a_seed(robot: MakeRobot, target: Target) -> None:
    text = "int a, b, c, i; task main() { repeat (200) { i = Random(2); switch (i) { case 0: a++; break; case 1: b++;\n"
    text += "break; case 2: c++; } } }"

    def counts(seed: int) -> tuple[int, ...]:
        program = robot(text, target, seed=seed).finish()
        return tuple(program.variable(name) for name in "abc")

    assert sum(counts(1)) == 200
    assert min(counts(1)) > 45
    assert counts(1) == counts(1) != counts(2)


def test_the_random_seed_can_be_set_by_a_program(robot: MakeRobot) -> None:
    text = "int a, b; task main() { SetRandomSeed(5); a = Random(32000); SetRandomSeed(5); b = Random(32000); }"
    program = robot(text, Target.RCX2, seed=9).run(1)
    assert program.variable("a") == program.variable("b") > 0


def test_the_clock_stands_where_it_was_told_to(robot: MakeRobot) -> None:
    program = robot("task main() { Wait(100); }")
    program.machine.run(12_345)
    assert program.machine.now == 12_345


def test_the_same_program_does_the_same(robot: MakeRobot) -> None:
    text = "int a; task b() { while (true) { SendMessage(a); Wait(Random(20)); } } task main() { start b; "
    text += "while (true) { a += Random(5); PlaySound(0); Wait(7); } }"
    first, second = robot(text, seed=3).run(20), robot(text, seed=3).run(20)
    assert first.ears.packets == second.ears.packets
    assert first.records == second.records


def test_op_codes_are_counted_and_nothing_else(robot: MakeRobot) -> None:
    text = "#pragma noinit\nint a; sub s() { a += 1; } task main() { a = 5; Wait(100); s(); s(); }"
    machine = robot(text).finish().machine
    assert machine.steps == 6
    assert machine.looks > 300
