"""Programs that cannot be executed: the error names task and address, and nothing hangs or crashes."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from golc.bytecode.image import ChunkType, read_image
from golc.bytecode.opcodes import OPCODES, Operand
from golc.diagnostics import DeviceError
from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.surroundings import Button

if TYPE_CHECKING:
    from tests.machine.conftest import Robot

MakeRobot = Callable[..., "Robot"]
MakeImage = Callable[..., bytes]
PING = bytes([0x10])


@pytest.mark.parametrize(
    ("code", "target", "error"),
    [
        ([0x27, 0x20], 0, "task 0, address 1: `jmp 34`: it leads to 34, outside the code"),
        ([0x27, 0x90], 0, "task 0, address 1: `jmp -14`: it leads to -14, outside the code"),
        ([0x72, 0x00, 0x7F], 0, "task 0, address 1: `jmpl 16258`: it leads to 16258, outside the code"),
        ([0x14, 32, 2, 0, 0], 0, "task 0, address 1: `setv var[32], 0`: firmware 1.0 has no variable 32"),
        ([0x14, 48, 2, 0, 0], 3, "task 0, address 1: `setv var[48], 0`: firmware 2.0 has no variable 48"),
        ([0x14, 0, 1, 4, 0], 0, r"task 0, address 1: `setv var[0], Timer(4)`: Timer(4) does not exist"),
        ([0x14, 0, 5, 0, 0], 3, r"task 0, address 1: `setv var[0], %5(0)`: firmware 2.0 has no source 5"),
        ([0x14, 0, 26, 0, 0], 0, r"task 0, address 1: `setv var[0], FastTimer(0)`: firmware 1.0 has no source 26"),
        ([0x24, 0, 9, 0, 0], 0, "task 0, address 1: `sumv var[0], Input(0)`: firmware 1.0 does not take this value"),
        ([0x85, 2, 2, 0, 0, 0, 1], 0, "task 0, address 1: `chk 0 <= 0, 8`: firmware 1.0 does not take this value"),
        ([0xF2, 0, 1], 0, "task 0, address 1: `decvjn var[0], 4`: firmware 1.0 has no op code `decvjn`"),
        ([0x12, 0, 0], 0, "task 0, address 1: `poll var[0]`: `poll` is a request of the host"),
        ([0x32, 3, 1], 0, "task 0, address 1: `sent 3, Switch`: there is no sensor 3"),
        ([0x51, 6], 0, "task 0, address 1: there is no sound 6"),
        ([0x91, 5], 0, "task 0, address 1: there is no program 5"),
        ([0x05, 13, 0, 2, 0, 0], 3, "task 0, address 1: `set SensorBool(0), 0`: SensorBool(0) cannot be written to"),
    ],
)
def test_the_error_names_task_address_and_instruction(
    image_of: MakeImage, robot: MakeRobot, code: list[int], target: int, error: str
) -> None:
    program = robot(image_of([(0, 0, PING + bytes(code))], target))
    with pytest.raises(MachineError) as raised:
        program.run(1)
    assert str(raised.value).startswith(error)
    assert (raised.value.task, raised.value.address) == ("task 0", 1)
    [fault] = program.told("fault")
    assert (fault["task"], fault["address"]) == ("task 0", 1)


def test_after_an_error_everything_stops_and_the_brick_goes_on(image_of: MakeImage, robot: MakeRobot) -> None:
    other = bytes([0x24, 1, 2, 1, 0, 0x27, 0x86])
    program = robot(image_of([(0, 0, bytes([0x71, 1, 0x43, 2, 10, 0, 0x51, 9])), (0, 1, other)], 0))
    with pytest.raises(MachineError):
        program.run(1)
    counted = program.machine.variables[1]
    assert counted > 10
    program.run(1)
    assert program.machine.variables[1] == counted
    program.bench.buttons.append(Button.RUN)
    with pytest.raises(MachineError):
        program.run(1)


def test_the_error_names_the_task_as_the_program_does(robot: MakeRobot) -> None:
    text = "int a[2], i; task sweep() { i = -1; a[i] = 0; } task main() { start sweep; Wait(100); }"
    with pytest.raises(MachineError, match=r"^task 1 \(sweep\), address \d+: "):
        robot(text, Target.RCX2).run(1)


@pytest.mark.parametrize(
    ("chunks", "error"),
    [
        ([(0, 0, PING + b"\x07")], "task 0, address 1: unknown op code 07"),
        ([(0, 0, PING), (1, 2, b"\x14\x00\x02")], "sub 2, address 0: `setv` is cut off"),
        ([(0, 10, PING)], "the program has a task 10, but a brick has 10 tasks"),
        ([(1, 8, PING)], "the program has a sub 8, but a brick has 8 subs"),
        ([(0, 0, PING * 3000), (0, 1, PING * 3001)], "the program takes 6001 bytes, but the brick has room for 6000"),
    ],
)
def test_what_cannot_be_loaded(
    image_of: MakeImage, robot: MakeRobot, chunks: list[tuple[int, int, bytes]], error: str
) -> None:
    program = robot(image_of([(0, 0, PING)]))
    with pytest.raises(DeviceError) as raised:
        program.machine.load(read_image(image_of(chunks)))
    assert str(raised.value) == error


def test_other_slots_and_the_datalog_take_their_room(image_of: MakeImage, robot: MakeRobot) -> None:
    program = robot(image_of([(0, 0, PING * 2000)]))
    program.machine.resize_log(999)
    program.machine.load(read_image(image_of([(0, 0, PING * 1000)])), 1)
    with pytest.raises(DeviceError, match="takes 1 bytes, but the brick has room for 0"):
        program.machine.load(read_image(image_of([(0, 0, PING)])), 2)


def test_jumping_to_itself_takes_time(image_of: MakeImage, robot: MakeRobot) -> None:
    program = robot(image_of([(0, 0, bytes([0x27, 0x81]))])).run(60)
    assert program.machine.processor.running


def test_a_task_without_code_ends_at_once_however_often_it_is_started(image_of: MakeImage, robot: MakeRobot) -> None:
    program = robot(image_of([(0, 0, bytes([0x71, 1, 0x27, 0x83])), (0, 1, b"")]))
    assert program.run(5).machine.processor.running


def random_instruction(chance: random.Random, size: int) -> bytes:
    """An instruction with operands that often make sense."""
    op = chance.choice(list(OPCODES.values()))
    code = bytes([op.code])
    for operand in op.operands:
        match operand:
            case Operand.NEAR | Operand.FAR | Operand.AHEAD | Operand.FAR_AHEAD | Operand.OFFSET:
                near = chance.randrange(min(size, 60)) | chance.choice([0, 0x80]) * (operand is not Operand.AHEAD)
                code += bytes([near]) + bytes(operand.length - 1)
            case Operand.VALUE8 | Operand.VALUE16:
                code += bytes([chance.choice([0, 0, 1, 2, 2, 4, 9, 15, 36, chance.randrange(43)]), chance.randrange(4)])
                code += bytes(operand.length - 2)
            case _:
                code += bytes(chance.choice([0, 1, 2, 3, chance.randrange(256)]) for _ in range(operand.length))
    return code


@pytest.mark.parametrize("target", [0, 3])
def test_random_code_runs_or_is_an_error(image_of: MakeImage, robot: MakeRobot, target: int) -> None:
    """Random instructions, some of their bytes changed: whatever they are, time passes or an error says where."""
    errors = ran = 0
    for seed in range(400):
        chance = random.Random(seed)
        program = robot(image_of([(0, 0, PING)], target), start=False)
        for type_, most in ((ChunkType.TASK, 4), (ChunkType.SUB, 3)):
            for number in range(most):
                code = bytearray(b"".join(random_instruction(chance, 60) for _ in range(chance.randrange(25))))
                for _ in range(chance.choice([0, 0, 1, 3]) if code else 0):
                    code[chance.randrange(len(code))] = chance.randrange(256)
                program.machine.memory.store(0, type_, number, bytes(code))
        for _ in range(5):
            program.machine.start(0)
            try:
                program.run(0.5)
                ran += 1
            except MachineError as error:
                assert error.task is not None and error.address is not None
                errors += 1
            program.machine.hear(chance.randrange(256))
            program.bench.raw[:] = [chance.randrange(1024) for _ in range(3)]
    assert errors > 100
    assert ran > 100


@pytest.mark.parametrize("target", list(Target))
def test_a_damaged_image_is_refused_or_runs_or_is_an_error(
    nqc: Callable[[str, Target], bytes], robot: MakeRobot, random_program: Callable[..., str], target: Target
) -> None:
    outcomes = set()
    for seed in range(6):
        image = nqc(random_program(seed, target), target)
        for place in range(0, len(image), 3):
            damaged = bytearray(image)
            damaged[place] ^= 1 << random.Random(place).randrange(8)
            try:
                robot(bytes(damaged), target).run(0.3)
                outcomes.add("ran")
            except MachineError:
                outcomes.add("failed")
            except DeviceError:
                outcomes.add("refused")
    assert outcomes == {"ran", "failed", "refused"}


@pytest.mark.parametrize("target", list(Target))
def test_what_nqc_compiles_runs_without_a_fault(
    robot: MakeRobot, random_program: Callable[..., str], target: Target
) -> None:
    told: set[str] = set()
    for seed in range(60):
        chance = random.Random(seed)
        text = random_program(seed, target)
        program = robot(text, target, seed=seed)
        for _ in range(6):
            program.run(1)
            program.machine.hear(chance.randrange(1, 256))
            program.bench.raw[:] = [chance.randrange(1024) for _ in range(3)]
        assert 6.0 <= program.machine.seconds < 6.1 and not program.told("fault"), text
        told |= {record["what"] for record in program.records}
    assert told >= {"task", "motor", "sound", "sensor"}
