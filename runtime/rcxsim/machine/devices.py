"""What the op codes do that move, sense, sound, show and send; the others are in ``execute``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from golc.bytecode.opcodes import Instruction
from golc.bytecode.sources import Source, Value
from golc.runtime.rcxsim.machine.arithmetic import wrap
from golc.runtime.rcxsim.machine.clocks import TENTH
from golc.runtime.rcxsim.machine.datalog import entry_type
from golc.runtime.rcxsim.machine.display import User
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.inputs import Input
from golc.runtime.rcxsim.machine.outputs import Setting
from golc.runtime.rcxsim.machine.tasks import Task
from golc.runtime.rcxsim.machine.values import reader, variable_reader
from golc.runtime.rcxsim.surroundings import INPUTS, Tone

if TYPE_CHECKING:
    from golc.runtime.rcxsim.machine.machine import Machine

Run = Callable[[Task], object]
TIMERS, COUNTERS = 4, 3
GLOBAL = {"gout", "gdir", "gpwr"}
"""The op codes that set what firmware 2.0 lets through."""


def _setting(machine: Machine, instruction: Instruction) -> Setting:
    """The setting that an op code changes."""
    return machine.outputs.overall if instruction.op.name in GLOBAL else machine.outputs.own


def _modes(machine: Machine, instruction: Instruction, bits: int) -> Run:
    setting, update = _setting(machine, instruction), machine.outputs.update

    def run(task: Task) -> None:
        setting.set_modes(bits)
        update()

    return run


def _directions(machine: Machine, instruction: Instruction, bits: int) -> Run:
    setting, update = _setting(machine, instruction), machine.outputs.update

    def run(task: Task) -> None:
        setting.set_directions(bits)
        update()

    return run


def _power(machine: Machine, instruction: Instruction, bits: int, value: Value) -> Run:
    setting, update, read = _setting(machine, instruction), machine.outputs.update, reader(machine, value)

    def run(task: Task) -> None:
        setting.set_power(bits, read(task))
        update()

    return run


def _sensor(machine: Machine, number: int) -> Input:
    if number >= INPUTS:
        raise MachineError(f"there is no sensor {number}")
    return machine.inputs[number]


def _sensor_type(machine: Machine, instruction: Instruction, number: int, type_: int) -> Run:
    sensor = _sensor(machine, number)
    return lambda task: sensor.set_type(type_)


def _sensor_mode(machine: Machine, instruction: Instruction, number: int, mode: int) -> Run:
    sensor = _sensor(machine, number)
    return lambda task: sensor.set_mode(mode)


def _clear_sensor(machine: Machine, instruction: Instruction, number: int) -> Run:
    sensor = _sensor(machine, number)
    return lambda task: sensor.clear()


def _clear_timer(machine: Machine, instruction: Instruction, number: int) -> Run:
    if number >= TIMERS:
        raise MachineError(f"there is no timer {number}")
    timer = machine.timers[number]
    return lambda task: timer.set(0, machine.now, TENTH)


COUNTING: dict[str, Callable[[int], int]] = {
    "cnti": lambda value: wrap(value + 1),
    "cntd": lambda value: wrap(value - 1),
    "cntz": lambda value: 0,
}


def _count(machine: Machine, instruction: Instruction, number: int) -> Run:
    """A counter is the variable of the same number."""
    if number >= COUNTERS:
        raise MachineError(f"there is no counter {number}")
    count = COUNTING[instruction.op.name]

    def run(task: Task) -> None:
        machine.variables[number] = count(machine.variables[number])

    return run


def _clear_message(machine: Machine, instruction: Instruction) -> Run:
    return lambda task: machine.set_message(0)


def _set_message(machine: Machine, instruction: Instruction, value: int) -> Run:
    return lambda task: machine.set_message(value)


def _send(machine: Machine, instruction: Instruction, value: Value) -> Run:
    read = reader(machine, value)
    return lambda task: machine.messages.send(read(task), machine.now)


def _send_serial(machine: Machine, instruction: Instruction, first: int, count: int) -> Run:
    if first + count > len(machine.uart) - 2:
        raise MachineError(f"the serial buffer has no bytes {first} to {first + count - 1}")
    return lambda task: machine.send_serial(first, count)


def _system_sound(machine: Machine, instruction: Instruction, number: int) -> Run:
    return lambda task: machine.sounds.system(number, machine.now)


def _tone(machine: Machine, instruction: Instruction, frequency: int, duration: int) -> Run:
    tones = [Tone(frequency & 0xFFFF, duration)]
    return lambda task: machine.sounds.tones(tones, machine.now)


def _variable_tone(machine: Machine, instruction: Instruction, variable: int, duration: int) -> Run:
    read = variable_reader(machine, variable)
    return lambda task: machine.sounds.tones([Tone(read(task) & 0xFFFF, duration)], machine.now)


def _clear_sounds(machine: Machine, instruction: Instruction) -> Run:
    return lambda task: machine.sounds.clear()


def _mute(machine: Machine, instruction: Instruction) -> Run:
    muted = instruction.op.name == "mute"

    def run(task: Task) -> None:
        machine.sounds.muted = muted

    return run


def _view(machine: Machine, instruction: Instruction, value: Value) -> Run:
    read = reader(machine, value)
    return lambda task: machine.display.select(read(task))


def _user_view(machine: Machine, instruction: Instruction, hidden: int, decimals: int, value: Value) -> Run:
    """The value is shown as it is at any time from now on, so it cannot be a task's own variable."""
    read = reader(machine, value)
    if value.source in (Source.VARIABLE, Source.INDIRECT) and value.argument >= len(machine.variables):
        raise MachineError("the display cannot show a task's own variable")
    user = User(lambda: read(machine.host), decimals)
    return lambda task: setattr(machine.display, "user", user)


def _log_size(machine: Machine, instruction: Instruction, size: int) -> Run:
    return lambda task: machine.resize_log(size & 0xFFFF)


def _log(machine: Machine, instruction: Instruction, value: Value) -> Run:
    read = reader(machine, value)
    entry_type(value)
    return lambda task: machine.datalog.add(value, read(task))


def _upload(machine: Machine, instruction: Instruction, first: int, count: int) -> Run:
    return lambda task: machine.upload(first & 0xFFFF, count & 0xFFFF)


def _set_watch(machine: Machine, instruction: Instruction, hours: int, minutes: int) -> Run:
    return lambda task: machine.watch.set(hours * 60 + minutes, machine.now)


def _power_down(machine: Machine, instruction: Instruction, minutes: int) -> Run:
    return lambda task: machine.set_power_down(minutes)


def _power_off(machine: Machine, instruction: Instruction) -> Run:
    return lambda task: machine.power_off()


def _program(machine: Machine, instruction: Instruction, slot: int) -> Run:
    return lambda task: machine.select(slot, by_program=task is not machine.host)


def _set_event(machine: Machine, instruction: Instruction, number: int, source: int, kind: int) -> Run:
    return lambda task: machine.events.configure(number, source, kind)


def _clear_events(machine: Machine, instruction: Instruction) -> Run:
    return lambda task: machine.events.clear()


def _calibrate(machine: Machine, instruction: Instruction, number: int, upper: int, lower: int, hysteresis: int) -> Run:
    machine.events.one(number)
    return lambda task: machine.events.one(number).calibrate(upper, lower, hysteresis, machine.now)


def _event(machine: Machine, instruction: Instruction, mask: Value) -> Run:
    read = reader(machine, mask)
    return lambda task: machine.happen(read(task) & 0xFFFF)


BUILDERS: dict[int, Callable[..., Run]] = {
    **dict.fromkeys((0x21, 0x67), _modes),
    **dict.fromkeys((0xE1, 0x77), _directions),
    **dict.fromkeys((0x13, 0xA3), _power),
    0x32: _sensor_type,
    0x42: _sensor_mode,
    0xD1: _clear_sensor,
    0xA1: _clear_timer,
    **dict.fromkeys((0x97, 0xA7, 0xB7), _count),
    0x90: _clear_message,
    0xF7: _set_message,
    0xB2: _send,
    0xC2: _send_serial,
    0x51: _system_sound,
    0x23: _tone,
    0x02: _variable_tone,
    0x80: _clear_sounds,
    **dict.fromkeys((0xD0, 0xE0), _mute),
    0x33: _view,
    0xE5: _user_view,
    0x52: _log_size,
    0x62: _log,
    0xA4: _upload,
    0x22: _set_watch,
    0xB1: _power_down,
    0x60: _power_off,
    0x91: _program,
    0x93: _set_event,
    0x06: _clear_events,
    0x04: _calibrate,
    0x03: _event,
}
"""By op code."""
