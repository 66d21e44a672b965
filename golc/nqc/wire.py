"""The numbers of the classic wire format: which user messages a brick and its host take for themselves."""

from __future__ import annotations

from dataclasses import dataclass

from golc.theory.theory import Device

DEFAULTS = {
    "action_base": 32,
    "action_digits": 16,
    "value_base": 64,
    "value_digits": 8,
    "control_base": 80,
}
"""The settings of a device that choose its messages, with the numbers of Legolog 2000 (``rcxMessageRange``)."""

RANGE_STEP = 64
"""``set range N`` moves every message by N times this: the ranges 0, 1 and 2 lie beside each other in 1..255."""

LAST_RANGE = 2
CONTROLS = 6


@dataclass(frozen=True)
class Wire:
    """The messages of one brick: two bases of digits and six control messages.

    An action's number goes over the wire in digits of base ``action_digits``: ``action_base + d`` is a last digit,
    ``action_base + action_digits + d`` one with more to come, the least significant first. Sensing values likewise.
    """

    action_base: int = DEFAULTS["action_base"]
    action_digits: int = DEFAULTS["action_digits"]
    value_base: int = DEFAULTS["value_base"]
    value_digits: int = DEFAULTS["value_digits"]
    control_base: int = DEFAULTS["control_base"]

    @property
    def panic(self) -> int:
        """Brick to host: you stopped acknowledging in the middle of a number; sent until aborted."""
        return self.control_base

    @property
    def abort(self) -> int:
        """Host to brick: stop all behaviours, back to the beginning."""
        return self.control_base + 1

    @property
    def proceed(self) -> int:
        """Either way: go on (*continue*); acknowledges a digit that has more to come, and grants more time."""
        return self.control_base + 2

    @property
    def request(self) -> int:
        """Host to brick: has an exogenous action occurred?"""
        return self.control_base + 3

    @property
    def none(self) -> int:
        """Brick to host: no exogenous action has occurred."""
        return self.control_base + 4

    @property
    def more_time(self) -> int:
        """Brick to host, instead of a sensing value: the action takes longer."""
        return self.control_base + 5

    def ranges(self) -> dict[str, range]:
        """The messages of each kind."""
        return {
            "action numbers": range(self.action_base, self.action_base + 2 * self.action_digits),
            "sensing values": range(self.value_base, self.value_base + 2 * self.value_digits),
            "control messages": range(self.control_base, self.control_base + CONTROLS),
        }


def wire_of(device: Device) -> Wire:
    """The messages that the settings of a device choose; ``checks.devices`` tells whether they make sense."""
    shift = _setting(device, "range", 0) * RANGE_STEP
    bases = {
        name: _setting(device, name, default + (shift if name.endswith("_base") else 0))
        for name, default in DEFAULTS.items()
    }
    return Wire(**bases)


def _setting(device: Device, name: str, default: int) -> int:
    return int(device.settings[name].value) if name in device.settings else default
