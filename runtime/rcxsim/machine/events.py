"""Events of firmware 2.0: sixteen of them, each looks at a source and happens when it does something.

How the ranges, hysteresis and clicks work is from the NQC guide. Not known are the limits before a program sets them,
what calibration does to them, and whether an event happens if its source is in the range from the beginning: here
nothing is low or high before limits are set, calibration takes the given parts of the value that the source has 50 ms
later, and a source that was always low has not become low.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum

from golc.runtime.rcxsim.machine.arithmetic import LEAST, MOST, wrap
from golc.runtime.rcxsim.machine.clocks import HUNDREDTH
from golc.runtime.rcxsim.machine.error import MachineError

COUNT = 16
CLICK_TIME = 15
"""Hundredths of a second; not known."""
CALIBRATION = 50_000
"""Microseconds; said to be about that."""


class Kind(IntEnum):
    """What makes an event happen."""

    PRESSED = 0
    RELEASED = 1
    PULSE = 2
    EDGE = 3
    FAST_CHANGE = 7
    LOW = 8
    NORMAL = 9
    HIGH = 10
    CLICK = 11
    DOUBLE_CLICK = 12
    MESSAGE = 14
    CLEAR = 16


class State(IntEnum):
    """As a program reads it."""

    LOW = 0
    NORMAL = 1
    HIGH = 2
    UNDEFINED = 3
    CALIBRATING = 5


RANGES = {Kind.LOW: State.LOW, Kind.NORMAL: State.NORMAL, Kind.HIGH: State.HIGH}
SENSORS, TIMERS, MESSAGE, COUNTERS = range(3), range(3, 7), 7, range(8, 11)
"""The numbers of the sources that an event can look at."""
BOOLEAN = (Kind.PRESSED, Kind.RELEASED, Kind.PULSE, Kind.EDGE)
SENSOR_KINDS = (*BOOLEAN, Kind.FAST_CHANGE)


@dataclass(slots=True)
class Reading:
    """What a source is like at the moment; a boolean and a raw value only sensors have."""

    value: int
    boolean: bool = False
    raw: int = 0


@dataclass(slots=True)
class Event:
    """One of the sixteen; without a ``kind`` it is not configured."""

    kind: Kind | None = None
    source: int = 0
    lower: int = LEAST
    upper: int = MOST
    hysteresis: int = 0
    click_time: int = CLICK_TIME
    clicks: int = 0
    state: State = State.UNDEFINED
    _boolean: bool | None = None
    _raw: int | None = None
    _rose: int | None = None  # when it left the low range
    _peaked: bool = False  # whether it was high since
    _clicked: int | None = None
    _calibration: tuple[int, int, int, int] | None = None

    def configure(self, source: int, kind: Kind) -> None:
        """Look at a source; limits and the rest stay as they were set."""
        self.source, self.kind = source, kind
        self.state = State.UNDEFINED
        self._boolean = self._raw = self._rose = self._clicked = self._calibration = None

    def calibrate(self, upper: int, lower: int, hysteresis: int, now: int) -> None:
        """Take parts, in per cent, of what the source is like after a while."""
        self.state = State.CALIBRATING
        self._calibration = (now + CALIBRATION, upper, lower, hysteresis)

    def look(self, reading: Reading, now: int, fast_change: int) -> bool:
        """Whether it happens now."""
        if self._calibration is not None:
            self._calibrate(reading.value, now)
            return False
        boolean, raw = self._boolean, self._raw
        self._boolean, self._raw = reading.boolean, reading.raw
        if self.kind is Kind.FAST_CHANGE:
            return raw is not None and abs(reading.raw - raw) > fast_change
        if self.kind in BOOLEAN:
            return boolean is not None and boolean != reading.boolean and self._changed(reading.boolean)
        return self._moved(reading.value, now)

    def _changed(self, boolean: bool) -> bool:
        match self.kind:
            case Kind.PRESSED:
                return boolean
            case Kind.RELEASED | Kind.PULSE:
                return not boolean
            case _:
                return True

    def _moved(self, value: int, now: int) -> bool:
        before, self.state = self.state, self._range(value)
        if self.kind in (Kind.CLICK, Kind.DOUBLE_CLICK):
            return self._click(before, now)
        if before in (State.UNDEFINED, self.state):
            return False  # what it was before nobody knows, or nothing has changed
        return RANGES.get(self.kind or Kind.CLEAR) is self.state

    def _range(self, value: int) -> State:
        """It is a little harder to leave the low or the high range than to get into it."""
        if value < self.lower + self.hysteresis * (self.state is State.LOW):
            return State.LOW
        if value > self.upper - self.hysteresis * (self.state is State.HIGH):
            return State.HIGH
        return State.NORMAL

    def _click(self, before: State, now: int) -> bool:
        """From low to high and back to low, quickly; a double click is two, one quickly after the other."""
        limit = self.click_time * HUNDREDTH
        if before is State.LOW and self.state is not State.LOW:
            self._rose, self._peaked = now, False
        self._peaked |= self.state is State.HIGH
        if self.state is not State.LOW or self._rose is None:
            return False
        rose, self._rose = self._rose, None
        if not self._peaked or now - rose > limit:
            return False
        self.clicks = wrap(self.clicks + 1)
        double = self._clicked is not None and rose - self._clicked <= limit
        self._clicked = None if double else now
        return self.kind is Kind.CLICK or double

    def _calibrate(self, value: int, now: int) -> None:
        assert self._calibration is not None
        end, upper, lower, hysteresis = self._calibration
        if now >= end:
            self.upper = wrap(value + value * upper // 100)
            self.lower = wrap(value - value * lower // 100)
            self.hysteresis = wrap(value * hysteresis // 100)
            self.state, self._calibration = State.UNDEFINED, None


class Events:
    """All events; ``read`` says what a source is like, ``happen`` is told of what happens, a bit for each event."""

    def __init__(self, read: Callable[[int], Reading], happen: Callable[[int], None], fast_change: int) -> None:
        self._read = read
        self._happen = happen
        self._fast_change = fast_change
        self.all = [Event() for _ in range(COUNT)]
        self._looking: list[tuple[int, Event]] = []

    def configure(self, number: int, source: int, kind: int) -> None:
        """Let an event look at a source, or clear it."""
        event = self.one(number)
        if kind == Kind.CLEAR:
            self.all[number] = Event()
        elif kind not in list(Kind) or not _fits(source, Kind(kind)):
            raise MachineError(f"an event of type {kind} cannot look at source {source}")
        else:
            event.configure(source, Kind(kind))
        self._note()

    def clear(self) -> None:
        """Clear every event."""
        self.all[:] = [Event() for _ in range(COUNT)]
        self._note()

    def one(self, number: int) -> Event:
        """The event of a number."""
        if number >= COUNT:
            raise MachineError(f"there is no event {number}")
        return self.all[number]

    def look(self, now: int) -> None:
        """Let happen what happens at this moment."""
        happened = 0
        for number, event in self._looking:
            if event.look(self._read(event.source), now, self._fast_change):
                happened |= 1 << number
        if happened:
            self._happen(happened)

    def heard(self) -> None:
        """A message has come, perhaps the same as the last."""
        happened = sum(1 << number for number, event in enumerate(self.all) if event.kind is Kind.MESSAGE)
        if happened:
            self._happen(happened)

    def _note(self) -> None:
        """Keep those apart at which something is to be done at every look."""
        self._looking = [
            (number, event) for number, event in enumerate(self.all) if event.kind not in (None, Kind.MESSAGE)
        ]


def _fits(source: int, kind: Kind) -> bool:
    if kind is Kind.MESSAGE:
        return source == MESSAGE
    if kind in SENSOR_KINDS:
        return source in SENSORS
    return source in SENSORS or source in TIMERS or source in COUNTERS or source == MESSAGE
