"""What each op code does: builders that make an instruction ready to be executed again and again.

A builder looks at the operands once; what it gives back takes the task and does the rest. By then the task stands
behind the instruction.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from golc.bytecode.opcodes import Condition, Instruction
from golc.bytecode.sources import Source, Value
from golc.runtime.rcxsim.machine import devices
from golc.runtime.rcxsim.machine.arithmetic import ARITHMETIC, COMPARISONS, wrap
from golc.runtime.rcxsim.machine.clocks import HUNDREDTH
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.tasks import MOST_LOOPS, Handler, Task
from golc.runtime.rcxsim.machine.values import reader, variable_reader, variable_writer, writer

if TYPE_CHECKING:
    from golc.runtime.rcxsim.machine.machine import Machine

Run = Callable[[Task], object]
Builder = Callable[..., Run]
FIRST_NOT = (Source.RANDOM, Source.PROGRAM)
SECOND_NOT = (Source.CONSTANT, Source.RANDOM, Source.PROGRAM)
"""Sources that firmware 1.0 does not take in a comparison."""


def build(machine: Machine, instruction: Instruction) -> Run:
    """What an instruction does; raises a fault if the machine cannot do it."""
    op, major = instruction.op, machine.firmware.major
    builder = BUILDERS.get(op.code)
    if builder is None:
        raise MachineError(f"`{op.name}` is a request of the host, not an op code of programs")
    if op.firmware > major:
        raise MachineError(f"firmware {major}.0 has no op code `{op.name}`")
    if major == 1:
        _check_sources(instruction)
    return builder(machine, instruction, *instruction.operands)


def _check_sources(instruction: Instruction) -> None:
    """Firmware 1.0 takes fewer sources in some places than it has."""
    allowed = instruction.op.sources
    for operand in instruction.operands:
        refused = isinstance(operand, Value) and allowed is not None and operand.source not in allowed
        if isinstance(operand, Condition):
            refused = operand.first.source in FIRST_NOT or operand.second.source in SECOND_NOT
        if refused:
            raise MachineError(f"firmware 1.0 does not take this value in `{instruction.op.name}`")


def _setv(machine: Machine, instruction: Instruction, variable: int, value: Value) -> Run:
    read, write = reader(machine, value), variable_writer(machine, variable)
    return lambda task: write(task, read(task))


def _arithmetic(machine: Machine, instruction: Instruction, variable: int, value: Value) -> Run:
    compute = ARITHMETIC[instruction.op.name]
    before, read, write = variable_reader(machine, variable), reader(machine, value), variable_writer(machine, variable)
    return lambda task: write(task, compute(before(task), read(task)))


def _set(machine: Machine, instruction: Instruction, target: Value, value: Value) -> Run:
    read, write = reader(machine, value), writer(machine, target)
    return lambda task: write(task, read(task))


def _jump(machine: Machine, instruction: Instruction, target: int) -> Run:
    def run(task: Task) -> None:
        task.place = target

    return run


def _check(machine: Machine, instruction: Instruction, condition: Condition, target: int) -> Run:
    compare = COMPARISONS[condition.relation]
    first, second = reader(machine, condition.first), reader(machine, condition.second)

    def run(task: Task) -> None:
        if compare(first(task), second(task)):
            task.place = target

    return run


def _push_loop(machine: Machine, instruction: Instruction, value: Value) -> Run:
    read = reader(machine, value)

    def run(task: Task) -> None:
        if len(task.loops) == MOST_LOOPS:
            task.loops.pop()  # with four loops the stack is not pushed
        task.loops.append(read(task))

    return run


def _count_loop(machine: Machine, instruction: Instruction, target: int) -> Run:
    def run(task: Task) -> None:
        if not task.loops:
            raise MachineError("no loop has begun")
        task.loops[-1] -= 1
        if task.loops[-1] < 0:
            task.loops.pop()
            task.place = target

    return run


def _count_down(machine: Machine, instruction: Instruction, variable: int, target: int) -> Run:
    read, write = variable_reader(machine, variable), variable_writer(machine, variable)

    def run(task: Task) -> None:
        left = wrap(read(task) - 1)
        write(task, left)
        if left < 0:
            task.place = target

    return run


def _wait(machine: Machine, instruction: Instruction, value: Value) -> Run:
    read, ticks = reader(machine, value), machine.options.waits_end_on_ticks

    def run(task: Task) -> None:
        hundredths = read(task)
        if hundredths > 0:
            start = machine.now // HUNDREDTH * HUNDREDTH if ticks else machine.now
            task.wake = start + hundredths * HUNDREDTH

    return run


def _start(machine: Machine, instruction: Instruction, number: int) -> Run:
    return lambda task: machine.start(number)


def _stop(machine: Machine, instruction: Instruction, number: int) -> Run:
    return lambda task: machine.stop(number)


def _stop_all(machine: Machine, instruction: Instruction) -> Run:
    return lambda task: machine.stop_all()


def _call(machine: Machine, instruction: Instruction, number: int) -> Run:
    return lambda task: machine.call(task, number)


def _return(machine: Machine, instruction: Instruction) -> Run:
    return machine.processor.come_back


def _priority(machine: Machine, instruction: Instruction, priority: int) -> Run:
    def run(task: Task) -> None:
        task.priority = priority

    return run


def _monitor(machine: Machine, instruction: Instruction, mask: Value, target: int) -> Run:
    read = reader(machine, mask)

    def run(task: Task) -> None:
        assert task.code is not None
        task.triggered = 0
        task.monitor = Handler(read(task) & 0xFFFF, task.code, target, task.back)

    return run


def _end_monitor(machine: Machine, instruction: Instruction) -> Run:
    def run(task: Task) -> None:
        task.monitor = None

    return run


def _acquire(machine: Machine, instruction: Instruction, resources: int, target: int) -> Run:
    def run(task: Task) -> None:
        assert task.code is not None
        machine.acquire(task, Handler(resources, task.code, target, task.back))

    return run


def _release(machine: Machine, instruction: Instruction) -> Run:
    def run(task: Task) -> None:
        task.access = None

    return run


def _nothing(machine: Machine, instruction: Instruction, *operands: Any) -> Run:
    """What changes nothing that a program or the line could notice: the ping, the range of the transmitter."""
    return lambda task: None


BUILDERS: dict[int, Builder] = {
    0x14: _setv,
    **dict.fromkeys((0x24, 0x34, 0x44, 0x54, 0x64, 0x74, 0x84, 0x94), _arithmetic),
    0x05: _set,
    **dict.fromkeys((0x27, 0x72), _jump),
    **dict.fromkeys((0x85, 0x95), _check),
    0x82: _push_loop,
    **dict.fromkeys((0x37, 0x92), _count_loop),
    **dict.fromkeys((0xF2, 0xF3), _count_down),
    0x43: _wait,
    0x71: _start,
    0x81: _stop,
    0x50: _stop_all,
    0x17: _call,
    0xF6: _return,
    0xD7: _priority,
    **dict.fromkeys((0xB4, 0xB5), _monitor),
    0xB0: _end_monitor,
    0x73: _acquire,
    0xA0: _release,
    **dict.fromkeys((0x10, 0x31), _nothing),
    **devices.BUILDERS,
}
"""By op code."""
