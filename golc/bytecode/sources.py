"""Where byte code gets its values from: a source and an argument."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class Source(IntEnum):
    """The sources that both firmwares or firmware 2.0 know, by number."""

    VARIABLE = 0
    TIMER = 1
    CONSTANT = 2
    OUTPUT = 3
    RANDOM = 4
    PROGRAM = 8
    SENSOR = 9
    SENSOR_TYPE = 10
    SENSOR_MODE = 11
    SENSOR_RAW = 12
    SENSOR_BOOLEAN = 13
    WATCH = 14
    MESSAGE = 15
    GLOBAL_OUTPUT = 17
    COUNTER = 21
    ACTIVE_EVENTS = 23
    EVENT_STATE = 25
    FAST_TIMER = 26
    CLICK_COUNTER = 27
    UPPER_LIMIT = 28
    LOWER_LIMIT = 29
    HYSTERESIS = 30
    CLICK_TIME = 31
    UART = 33
    BATTERY = 34
    FIRMWARE = 35
    INDIRECT = 36
    LOG_TYPE_INDIRECT = 37
    LOG_TYPE = 38
    LOG_VALUE_INDIRECT = 39
    LOG_VALUE = 40
    LOG_BYTE_INDIRECT = 41
    LOG_BYTE = 42


@dataclass(frozen=True, slots=True)
class Row:
    """How ``nqc -L`` writes a value of a source, the first firmware that has it, and the arguments that it takes."""

    listed: str
    firmware: int
    arguments: range


VARIABLES, WORDS, ONE = range(48), range(-0x8000, 0x8000), range(1)
SENSORS = MOTORS = COUNTERS = range(3)
TIMERS, EVENTS = range(4), range(16)
TASKS = range(11)
"""The ten tasks, and 10 for the one that asks."""

SOURCES: dict[int, Row] = {
    Source.VARIABLE: Row("var[{}]", 1, VARIABLES),
    Source.TIMER: Row("Timer({})", 1, TIMERS),
    Source.CONSTANT: Row("{}", 1, WORDS),
    Source.OUTPUT: Row("Output({})", 1, MOTORS),
    Source.RANDOM: Row("Random({})", 1, range(0x8000)),
    Source.PROGRAM: Row("Program({})", 1, ONE),
    Source.SENSOR: Row("Input({})", 1, SENSORS),
    Source.SENSOR_TYPE: Row("SensorType({})", 1, SENSORS),
    Source.SENSOR_MODE: Row("SensorMode({})", 1, SENSORS),
    Source.SENSOR_RAW: Row("SensorRaw({})", 1, SENSORS),
    Source.SENSOR_BOOLEAN: Row("SensorBool({})", 1, SENSORS),
    Source.WATCH: Row("Watch({})", 1, ONE),
    Source.MESSAGE: Row("Message({})", 1, ONE),
    Source.GLOBAL_OUTPUT: Row("GlobalOutput({})", 2, MOTORS),
    Source.COUNTER: Row("Counter({})", 2, COUNTERS),
    Source.ACTIVE_EVENTS: Row("ActiveEvents({})", 2, TASKS),
    Source.EVENT_STATE: Row("EventState({})", 2, EVENTS),
    Source.FAST_TIMER: Row("FastTimer({})", 2, TIMERS),
    Source.CLICK_COUNTER: Row("ClickCounter({})", 2, EVENTS),
    Source.UPPER_LIMIT: Row("UpperLimit({})", 2, EVENTS),
    Source.LOWER_LIMIT: Row("LowerLimit({})", 2, EVENTS),
    Source.HYSTERESIS: Row("Hysteresis({})", 2, EVENTS),
    Source.CLICK_TIME: Row("ClickTime({})", 2, EVENTS),
    Source.UART: Row("uart[{}]", 2, range(18)),
    Source.BATTERY: Row("BatteryLevel({})", 2, ONE),
    Source.FIRMWARE: Row("FirmwareVersion({})", 2, ONE),
    Source.INDIRECT: Row("*var[{}]", 2, VARIABLES),
    Source.LOG_TYPE_INDIRECT: Row("LogTypeInd({})", 2, VARIABLES),
    Source.LOG_TYPE: Row("LogTypeDir({})", 2, WORDS),
    Source.LOG_VALUE_INDIRECT: Row("LogValInd({})", 2, VARIABLES),
    Source.LOG_VALUE: Row("LogValDir({})", 2, WORDS),
    Source.LOG_BYTE_INDIRECT: Row("LogByteInd({})", 2, VARIABLES),
    Source.LOG_BYTE: Row("LogByteDir({})", 2, WORDS),
}

LAST = 42
"""The last number that ``nqc -L`` takes for that of a source, though it has names for some only."""


@dataclass(frozen=True, slots=True)
class Value:
    """What a source, perhaps an unknown one, gives for an argument."""

    source: int
    argument: int

    def __str__(self) -> str:
        """As ``nqc -L`` writes it."""
        row = self.row
        unnamed = f"%{self.source}({{}})" if self.source <= LAST else "?({})"
        return (unnamed if row is None else row.listed).format(self.argument)

    @property
    def row(self) -> Row | None:
        """What is known of its source; None if that is unknown."""
        return SOURCES.get(self.source)
