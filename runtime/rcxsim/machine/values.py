"""What each source gives, and what becomes of it when a program writes to it.

``reader`` and ``writer`` look at the source once, when an instruction is made ready, and give back what is done each
time it is executed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from golc.bytecode.sources import Source, Value
from golc.runtime.rcxsim.machine.arithmetic import wrap
from golc.runtime.rcxsim.machine.clocks import HUNDREDTH, TENTH
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.machine.tasks import Task

if TYPE_CHECKING:
    from golc.runtime.rcxsim.machine.machine import Machine

Read = Callable[[Task], int]
Write = Callable[[Task, int], None]

VARIABLES = 32
"""Variables of the brick; numbers from here on are the task's own."""
CURRENT_TASK = 10
EVENT_FIELDS = {
    Source.EVENT_STATE: "state",
    Source.CLICK_COUNTER: "clicks",
    Source.UPPER_LIMIT: "upper",
    Source.LOWER_LIMIT: "lower",
    Source.HYSTERESIS: "hysteresis",
    Source.CLICK_TIME: "click_time",
}


def check(machine: Machine, value: Value) -> None:
    """Raise a fault if the machine does not know a source or an argument of it."""
    row = value.row
    if row is None or row.firmware > machine.firmware.major:
        raise MachineError(f"firmware {machine.firmware.major}.0 has no source {value.source}")
    if value.argument not in row.arguments:
        raise MachineError(f"{value} does not exist")


def reader(machine: Machine, value: Value) -> Read:
    """What gives the value, for the task that asks."""
    check(machine, value)
    number = value.argument
    match value.source:
        case Source.VARIABLE | Source.COUNTER:
            return variable_reader(machine, number)
        case Source.CONSTANT:
            return lambda task: number
        case Source.TIMER:
            timer = machine.timers[number]
            return lambda task: timer.read(machine.now, TENTH)
        case Source.FAST_TIMER:
            timer = machine.timers[number]
            return lambda task: timer.read(machine.now, HUNDREDTH)
        case Source.RANDOM:
            return lambda task: machine.random.randint(0, number)
        case Source.MESSAGE:
            return lambda task: machine.messages.buffer
        case Source.PROGRAM:
            return lambda task: machine.slot
        case Source.WATCH:
            return lambda task: machine.watch.read(machine.now)
        case Source.BATTERY:
            return lambda task: machine.options.battery
        case Source.FIRMWARE:
            return lambda task: machine.firmware.version
        case Source.INDIRECT:
            return _indirect_reader(machine, number)
        case Source.ACTIVE_EVENTS:
            return _active_events(machine, number)
        case Source.UART:
            return lambda task: machine.uart[number]
        case source if source in EVENT_FIELDS:
            events, field = machine.events.all, EVENT_FIELDS[Source(source)]
            return lambda task: int(getattr(events[number], field))
        case source if source >= Source.LOG_TYPE_INDIRECT:
            return _log_reader(machine, Source(source), number)
        case source:
            return _device_reader(machine, Source(source), number)


def _device_reader(machine: Machine, source: Source, number: int) -> Read:
    outputs = machine.outputs
    match source:
        case Source.OUTPUT:
            return lambda task: outputs.own.state(number)
        case Source.GLOBAL_OUTPUT:
            return lambda task: outputs.overall.state(number)
    sensor = machine.inputs[number]
    match source:
        case Source.SENSOR:
            return lambda task: sensor.value
        case Source.SENSOR_TYPE:
            return lambda task: sensor.type
        case Source.SENSOR_MODE:
            return lambda task: sensor.mode_byte
        case Source.SENSOR_RAW:
            return lambda task: sensor.raw
        case _:
            return lambda task: int(sensor.boolean)


def writer(machine: Machine, value: Value) -> Write:
    """What takes a new value for a source that can be written to."""
    check(machine, value)
    number = value.argument
    match value.source:
        case Source.VARIABLE | Source.COUNTER:
            return variable_writer(machine, number)
        case Source.INDIRECT:
            return _indirect_writer(machine, number)
        case Source.TIMER:
            return lambda task, new: machine.timers[number].set(new, machine.now, TENTH)
        case Source.FAST_TIMER:
            return lambda task, new: machine.timers[number].set(new, machine.now, HUNDREDTH)
        case Source.RANDOM:
            return lambda task, new: machine.random.seed(new)
        case Source.PROGRAM:
            return lambda task, new: machine.select(new & 0xFF, by_program=task is not machine.host)
        case Source.WATCH:
            return lambda task, new: machine.watch.set(new, machine.now)
        case Source.MESSAGE:
            return lambda task, new: machine.set_message(new & 0xFF)
        case Source.SENSOR_TYPE:
            return lambda task, new: machine.inputs[number].set_type(new & 0xFF)
        case Source.SENSOR_MODE:
            return lambda task, new: machine.inputs[number].set_mode(new & 0xFF)
        case Source.UART:
            return lambda task, new: machine.uart.__setitem__(number, new & 0xFF)
        case source if source in EVENT_FIELDS and source != Source.EVENT_STATE:
            events, field = machine.events.all, EVENT_FIELDS[Source(source)]
            return lambda task, new: setattr(events[number], field, new)
    raise MachineError(f"{value} cannot be written to")


def variable_reader(machine: Machine, number: int) -> Read:
    """What reads a variable, of the brick or of the task."""
    check_variable(machine, number)
    if number < VARIABLES:
        variables = machine.variables
        return lambda task: variables[number]
    place = number - VARIABLES
    return lambda task: task.own[place]


def variable_writer(machine: Machine, number: int) -> Write:
    """What writes a variable."""
    check_variable(machine, number)
    if number < VARIABLES:
        variables = machine.variables
        return lambda task, new: variables.__setitem__(number, new)
    place = number - VARIABLES
    return lambda task, new: task.own.__setitem__(place, new)


def check_variable(machine: Machine, number: int) -> None:
    """Raise a fault if there is no variable of this number."""
    if not 0 <= number < VARIABLES + machine.firmware.own_variables:
        raise MachineError(f"firmware {machine.firmware.major}.0 has no variable {number}")


def _cell(machine: Machine, task: Task, number: int) -> tuple[list[int], int]:
    check_variable(machine, number)
    return (machine.variables, number) if number < VARIABLES else (task.own, number - VARIABLES)


def _indirect_reader(machine: Machine, number: int) -> Read:
    """Variables hold the numbers of variables: so are arrays made."""
    pointer = variable_reader(machine, number)

    def read(task: Task) -> int:
        cells, place = _cell(machine, task, pointer(task))
        return cells[place]

    return read


def _indirect_writer(machine: Machine, number: int) -> Write:
    pointer = variable_reader(machine, number)

    def write(task: Task, new: int) -> None:
        cells, place = _cell(machine, task, pointer(task))
        cells[place] = new

    return write


def _active_events(machine: Machine, number: int) -> Read:
    if number == CURRENT_TASK:
        return lambda task: wrap(task.triggered)
    other = machine.processor.tasks[number]
    return lambda task: wrap(other.triggered)


def _log_reader(machine: Machine, source: Source, number: int) -> Read:
    """A part of an entry of the datalog, by its number or by that in a variable."""
    indirect = source in (Source.LOG_TYPE_INDIRECT, Source.LOG_VALUE_INDIRECT, Source.LOG_BYTE_INDIRECT)
    place: Read = variable_reader(machine, number) if indirect else lambda task: number

    def read(task: Task) -> int:
        entry = place(task)
        if source in (Source.LOG_BYTE, Source.LOG_BYTE_INDIRECT):
            return machine.datalog.byte(entry)
        type_, value = machine.datalog.entry(entry)
        return type_ if source in (Source.LOG_TYPE, Source.LOG_TYPE_INDIRECT) else value

    return read
