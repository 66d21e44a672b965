"""The numbers of the classic protocol: which user message means what, and numbers as sequences of digits.

A number travels least significant digit first. A digit has two messages: one says that it is the last digit, the
other that more are to come; after the latter the receiver has to send *continue* before the next one is sent. (H.
Levesque and M. Pagnucco, *Legolog: Inexpensive Experiments in Cognitive Robotics*, 2000, the part on communication.)
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from golc.runtime.devices.rcx.errors import ParameterError

MAXIMUM = 32767
"""A variable of the brick has 16 bits with a sign, and this wire has no sign."""


@dataclass(frozen=True, slots=True)
class Digits:
    """One kind of number: its digits ``0..radix-1`` are ``base..base+radix-1``, with more to come ``radix`` higher."""

    base: int
    radix: int

    @property
    def last(self) -> range:
        """Messages of a digit after which the number is complete."""
        return range(self.base, self.base + self.radix)

    @property
    def more(self) -> range:
        """Messages of a digit with more to come."""
        return range(self.base + self.radix, self.base + 2 * self.radix)

    @property
    def all(self) -> range:
        """All messages of this kind."""
        return range(self.base, self.base + 2 * self.radix)

    def split(self, number: int) -> list[int]:
        """The messages that carry ``number``; ParameterError if it is negative or too big for the brick."""
        if not 0 <= number <= MAXIMUM:
            raise ParameterError(
                f"the number {number} cannot be sent to a brick", f"the classic protocol carries 0 to {MAXIMUM}"
            )
        messages = []
        while number >= self.radix:
            number, digit = divmod(number, self.radix)
            messages.append(self.more[digit])
        return [*messages, self.last[number]]

    def join(self, messages: Sequence[int]) -> int:
        """The number that the messages carry, the last of which is a last digit."""
        number = 0
        for message in reversed(messages):
            number = number * self.radix + (message - self.base) % self.radix
        return number


@dataclass(frozen=True, slots=True)
class ClassicParameters:
    """Which messages a brick uses; bricks that share a tower have ranges that do not overlap.

    The defaults are those of Legolog: actions 32..63 in base 16, values 64..79 in base 8, control 80..85.
    ParameterError if a range leaves 1..255 or two ranges overlap.
    """

    action_base: int = 32
    action_digits: int = 16
    value_base: int = 64
    value_digits: int = 8
    control_base: int = 80

    def __post_init__(self) -> None:
        if min(self.action_digits, self.value_digits) < 2:
            raise ParameterError("a number needs at least the digits 0 and 1")
        ranges = {"actions": self.actions.all, "values": self.values.all, "control": self.control}
        for name, numbers in ranges.items():
            if numbers.start < 1 or numbers.stop > 256:
                raise ParameterError(
                    f"the messages for {name}, {_shown(numbers)}, are not all user messages",
                    "use numbers from 1 to 255",
                )
        used: dict[int, str] = {}
        for name, numbers in ranges.items():
            for number in numbers:
                if number in used:
                    raise ParameterError(
                        f"message {number} is used for {used[number]} and for {name}",
                        ", ".join(f"{kind} {_shown(taken)}" for kind, taken in ranges.items()),
                    )
                used[number] = name

    @property
    def actions(self) -> Digits:
        """Numbers of actions, sent by the host, and of exogenous actions, sent by the brick."""
        return Digits(self.action_base, self.action_digits)

    @property
    def values(self) -> Digits:
        """Sensing values, sent by the brick."""
        return Digits(self.value_base, self.value_digits)

    @property
    def control(self) -> range:
        """The six control messages, in the order of the properties below."""
        return range(self.control_base, self.control_base + 6)

    @property
    def panic(self) -> int:
        """Brick: I was left alone in the middle of a number."""
        return self.control[0]

    @property
    def abort(self) -> int:
        """Host: stop all behaviours and start afresh."""
        return self.control[1]

    @property
    def proceed(self) -> int:
        """Either: I have the digit, go on. Host: I grant the time you asked for."""
        return self.control[2]

    @property
    def request(self) -> int:
        """Host: has an exogenous action occurred?"""
        return self.control[3]

    @property
    def none(self) -> int:
        """Brick: no exogenous action has occurred."""
        return self.control[4]

    @property
    def more_time(self) -> int:
        """Brick, instead of a sensing value: I need a further 3.5 s."""
        return self.control[5]


def _shown(numbers: range) -> str:
    return f"{numbers.start}..{numbers.stop - 1}"
