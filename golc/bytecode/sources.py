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


LISTED = {
    Source.VARIABLE: "var[{}]",
    Source.TIMER: "Timer({})",
    Source.CONSTANT: "{}",
    Source.OUTPUT: "Output({})",
    Source.RANDOM: "Random({})",
    Source.PROGRAM: "Program({})",
    Source.SENSOR: "Input({})",
    Source.SENSOR_TYPE: "SensorType({})",
    Source.SENSOR_MODE: "SensorMode({})",
    Source.SENSOR_RAW: "SensorRaw({})",
    Source.SENSOR_BOOLEAN: "SensorBool({})",
    Source.WATCH: "Watch({})",
    Source.MESSAGE: "Message({})",
    Source.GLOBAL_OUTPUT: "GlobalOutput({})",
    Source.COUNTER: "Counter({})",
    Source.ACTIVE_EVENTS: "ActiveEvents({})",
    Source.EVENT_STATE: "EventState({})",
    Source.FAST_TIMER: "FastTimer({})",
    Source.CLICK_COUNTER: "ClickCounter({})",
    Source.UPPER_LIMIT: "UpperLimit({})",
    Source.LOWER_LIMIT: "LowerLimit({})",
    Source.HYSTERESIS: "Hysteresis({})",
    Source.CLICK_TIME: "ClickTime({})",
    Source.UART: "uart[{}]",
    Source.BATTERY: "BatteryLevel({})",
    Source.FIRMWARE: "FirmwareVersion({})",
    Source.INDIRECT: "*var[{}]",
    Source.LOG_TYPE_INDIRECT: "LogTypeInd({})",
    Source.LOG_TYPE: "LogTypeDir({})",
    Source.LOG_VALUE_INDIRECT: "LogValInd({})",
    Source.LOG_VALUE: "LogValDir({})",
    Source.LOG_BYTE_INDIRECT: "LogByteInd({})",
    Source.LOG_BYTE: "LogByteDir({})",
}
"""How ``nqc -L`` writes a value of each source."""

LAST = 42
"""The last number that ``nqc -L`` takes for that of a source, though it has names for some only."""


@dataclass(frozen=True, slots=True)
class Value:
    """What a source, perhaps an unknown one, gives for an argument."""

    source: int
    argument: int

    def __str__(self) -> str:
        """As ``nqc -L`` writes it."""
        unnamed = f"%{self.source}({{}})" if self.source <= LAST else "?({})"
        return LISTED.get(self.source, unnamed).format(self.argument)  # type: ignore[call-overload, no-any-return]
