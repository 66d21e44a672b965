"""The motors: what a program says, and what firmware 2.0 lets through of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from golc.runtime.rcxsim.surroundings import OUTPUTS, Mode, Output

NAMES = "ABC"
MODE_BITS = {Mode.FLOAT: 0x00, Mode.OFF: 0x40, Mode.ON: 0x80}
FORWARD_BIT = 0x08
MOST_POWER = 7


def mode_of(bits: int) -> Mode:
    """Bit 7 is on, whatever bit 6 says, which is off; neither lets the motor run free."""
    return Mode.ON if bits & 0x80 else Mode.OFF if bits & 0x40 else Mode.FLOAT


class Setting:
    """Mode, direction and power of the three outputs, as op codes change them and sources report them."""

    def __init__(self, mode: Mode) -> None:
        self._first = mode
        self.reset()

    def reset(self) -> None:
        """As after switching the brick on."""
        self.modes = [self._first] * OUTPUTS
        self.forward = [True] * OUTPUTS
        self.power = [MOST_POWER] * OUTPUTS

    def set_modes(self, bits: int) -> None:
        """The low three bits are the motors, the high two the mode."""
        for motor in motors(bits):
            self.modes[motor] = mode_of(bits)

    def set_directions(self, bits: int) -> None:
        """Bit 6 flips, otherwise bit 7 is forward and neither is reverse."""
        for motor in motors(bits):
            self.forward[motor] = not self.forward[motor] if bits & 0x40 else bool(bits & 0x80)

    def set_power(self, bits: int, power: int) -> None:
        """From 0 to 7; a greater one acts as 7 (measured), and only eight bits count."""
        for motor in motors(bits):
            self.power[motor] = min(power & 0xFF, MOST_POWER)

    def state(self, motor: int) -> int:
        """As source 3 and 17 report it; bits 4 and 5 carry the motor's number, but not in every firmware."""
        return MODE_BITS[self.modes[motor]] | motor << 4 | FORWARD_BIT * self.forward[motor] | self.power[motor]


class Outputs:
    """What the motors do; ``changed`` is told of every change, with all three as they were and as they are."""

    def __init__(self, changed: Callable[[Sequence[Output], Sequence[Output]], None]) -> None:
        self._changed = changed
        self.own = Setting(Mode.OFF)
        self.overall = Setting(Mode.ON)
        self.now = self._effective()

    def reset(self) -> None:
        """As after switching the brick on."""
        self.own.reset()
        self.overall.reset()
        self.update()

    def off(self) -> None:
        """Stop every motor."""
        self.own.set_modes(0x47)
        self.update()

    def update(self) -> None:
        """Let the motors do what the settings say now."""
        before, self.now = self.now, self._effective()
        if self.now != before:
            self._changed(before, self.now)

    def _effective(self) -> tuple[Output, ...]:
        own, overall = self.own, self.overall
        return tuple(
            Output(
                own.modes[motor] if overall.modes[motor] is Mode.ON else overall.modes[motor],
                own.forward[motor] == overall.forward[motor],
                min(own.power[motor], overall.power[motor]),
            )
            for motor in range(OUTPUTS)
        )


def motors(bits: int) -> list[int]:
    """The motors that the low three bits name."""
    return [motor for motor in range(OUTPUTS) if bits >> motor & 1]
