"""The sensors: how a raw value becomes what a program reads."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from golc.runtime.rcxsim.machine.arithmetic import wrap
from golc.runtime.rcxsim.machine.error import MachineError
from golc.runtime.rcxsim.surroundings import OPEN, ROTATION_LEVELS


class SensorType(IntEnum):
    RAW = 0
    TOUCH = 1
    TEMPERATURE = 2
    LIGHT = 3
    ROTATION = 4


class SensorMode(IntEnum):
    RAW = 0
    BOOLEAN = 1
    EDGES = 2
    PULSES = 3
    PERCENT = 4
    CELSIUS = 5
    FAHRENHEIT = 6
    ANGLE = 7


DEFAULT_MODES = {
    SensorType.RAW: SensorMode.RAW,
    SensorType.TOUCH: SensorMode.BOOLEAN,
    SensorType.TEMPERATURE: SensorMode.CELSIUS,
    SensorType.LIGHT: SensorMode.PERCENT,
    SensorType.ROTATION: SensorMode.ANGLE,
}
POWERED = (SensorType.LIGHT, SensorType.ROTATION)
FALSE_ABOVE, TRUE_BELOW = 562, 460
"""Raw values beyond which a boolean becomes 0 or 1 if the slope is 0; between them it stays."""
COLDEST, WARMEST = 943, 229
"""Raw values at the ends of the temperature scale, -19.8 and 69.5 degrees Celsius."""


@dataclass
class Input:
    """One of the three inputs; ``light`` are a and b in the light value a - raw/b per cent."""

    light: tuple[int, int]
    type: SensorType = SensorType.RAW
    mode: SensorMode = SensorMode.RAW
    slope: int = 0
    raw: int = OPEN
    boolean: bool = False
    count: int = 0
    _level: int = 0

    @property
    def powered(self) -> bool:
        """Whether the brick feeds the sensor."""
        return self.type in POWERED

    @property
    def mode_byte(self) -> int:
        return self.mode << 5 | self.slope

    def set_type(self, number: int) -> None:
        """Configure the sensor, with the mode that goes with the type."""
        if number not in list(SensorType):
            raise MachineError(f"there is no sensor type {number}")
        self.type = SensorType(number)
        self.set_mode(DEFAULT_MODES[self.type] << 5)

    def set_mode(self, byte: int) -> None:
        """Mode and slope; counting begins anew."""
        self.mode, self.slope = SensorMode(byte >> 5 & 7), byte & 0x1F
        self._decide(0)
        self.clear()

    def clear(self) -> None:
        """Set the counter, or the angle, to 0."""
        self.count = 0
        self._level = _level(self.raw)

    def look(self, raw: int) -> None:
        """Take the raw value of this moment."""
        if raw == self.raw:
            return
        fall, self.raw = self.raw - raw, raw
        before = self.boolean
        self._decide(fall)
        if self.mode is SensorMode.ANGLE:
            self._turn()
        elif self.boolean != before and self.mode in (SensorMode.EDGES, SensorMode.PULSES):
            self.count += 1

    def _decide(self, fall: int) -> None:
        """Whether the boolean value is 1: low raw values are."""
        if self.slope:
            if abs(fall) > self.slope:
                self.boolean = fall > 0
        elif self.raw > FALSE_ABOVE:
            self.boolean = False
        elif self.raw < TRUE_BELOW:
            self.boolean = True

    def _turn(self) -> None:
        """The level next to the last one is a sixteenth of a turn; two levels on say nothing of the direction."""
        level = _level(self.raw)
        step = (level - self._level) % len(ROTATION_LEVELS)
        self.count += {1: 1, len(ROTATION_LEVELS) - 1: -1}.get(step, 0)
        self._level = level

    @property
    def value(self) -> int:
        """What a program reads."""
        match self.mode:
            case SensorMode.RAW:
                return self.raw
            case SensorMode.BOOLEAN:
                return int(self.boolean)
            case SensorMode.EDGES:
                return wrap(self.count)
            case SensorMode.PULSES:
                return wrap(self.count // 2)
            case SensorMode.PERCENT:
                return self._percent()
            case SensorMode.CELSIUS:
                return self._celsius()
            case SensorMode.FAHRENHEIT:
                return self._celsius() * 9 // 5 + 320
            case SensorMode.ANGLE:
                return wrap(self.count)

    def _percent(self) -> int:
        if self.type is SensorType.LIGHT:
            most, divisor = self.light
            return max(0, min(100, most - self.raw // divisor))
        return 100 * (OPEN - self.raw) // OPEN

    def _celsius(self) -> int:
        """Tenths of a degree."""
        raw = max(WARMEST, min(COLDEST, self.raw))
        return (785 - raw) * 10 // 8


def _level(raw: int) -> int:
    return min(range(len(ROTATION_LEVELS)), key=lambda place: abs(ROTATION_LEVELS[place] - raw))
