"""The numbers of a brick's actions, both ways: what the generated program, the link and the simulated brick go by."""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from golc.diagnostics import NOWHERE, DeviceError, Span
from golc.nqc.wire import Wire
from golc.theory.fitting import size
from golc.theory.theory import ByCall, ByPrompt, ByStart, Device, Fixed, Parameter
from golc.theory.types import Interval, Optional, Type, Value, show, show_call

PROTOCOL = 1
"""The version of the wire format, part of the fingerprint."""

DEFAULT_TIMEOUT = 15.0
"""Seconds that an action may take where its binding does not say."""

LARGEST = 32767
"""The largest number that fits the brick's variables and the classic wire, which has no sign."""


def value_number(type_: Type, value: Value) -> int | None:
    """The number that stands for a value on the brick: an integer itself, ``false`` 0, ``true`` 1, a symbol its index.

    None where the value has no number: ``none``, and whatever is neither integer, truth value nor symbol.
    """
    match value:
        case bool() | int():
            return int(value)
        case str() if type_.finite:
            return (type_.base if isinstance(type_, Optional) else type_).values.index(value)
        case _:
            return None


@dataclass(frozen=True)
class Entry:
    """A range of numbers for an action: ``first`` and one for each combination of its arguments, the last fastest.

    ``args`` are as in the binding; ``behaviour`` is None if and only if the action is exogenous.
    """

    first: int
    count: int
    action: str
    exogenous: bool
    behaviour: ByCall | ByStart | ByPrompt | None
    args: tuple[Parameter | Fixed, ...] = ()
    table: Mapping[int, Value] | None = field(default=None, compare=False)
    sensed: Type | None = None
    timeout: float = DEFAULT_TIMEOUT
    span: Span = field(default=NOWHERE, compare=False, repr=False)

    @property
    def last(self) -> int:
        return self.first + self.count - 1

    @property
    def numbers(self) -> range:
        return range(self.first, self.first + self.count)

    def index(self, args: Sequence[Value]) -> int | None:
        """The place of ground arguments in the range, or None if they are not among those of this entry."""
        index = 0
        for slot, value in zip(self.args, args, strict=True):
            match slot:
                case Fixed(value=fixed):
                    if not _same(fixed, value):
                        return None
                case Parameter(type=type_):
                    if value not in type_:
                        return None
                    index = index * size(type_) + type_.values.index(value)
        return index

    def arguments(self, index: int) -> tuple[Value, ...]:
        """The inverse of ``index``."""
        values: list[Value] = []
        for slot in reversed(self.args):
            match slot:
                case Fixed(value=fixed):
                    values.append(fixed)
                case Parameter(type=type_):
                    index, place = divmod(index, size(type_))
                    values.append(type_.values[place])
        return tuple(reversed(values))

    def ground(self) -> Iterator[tuple[int, tuple[Value, ...]]]:
        """Every number of the range with its arguments."""
        for index in range(self.count):
            yield self.first + index, self.arguments(index)


def _same(one: Value, other: Value) -> bool:
    """Equality of golc's values: ``true`` is not 1."""
    return one == other and isinstance(one, bool) == isinstance(other, bool)


@dataclass(frozen=True)
class ActionMap:
    """The numbers of one device, both ways."""

    device: Device
    entries: tuple[Entry, ...]
    wire: Wire

    @cached_property
    def _by_action(self) -> dict[str, list[Entry]]:
        found: dict[str, list[Entry]] = {}
        for entry in self.entries:
            found.setdefault(entry.action, []).append(entry)
        return found

    def entry(self, action: str, args: Sequence[Value]) -> Entry | None:
        """The entry that has a ground action."""
        for entry in self._by_action.get(action, ()):
            if len(entry.args) == len(args) and entry.index(args) is not None:
                return entry
        return None

    def handles(self, action: str, args: Sequence[Value] = ()) -> bool:
        """Whether the device does, or reports, this ground action."""
        return self.entry(action, args) is not None

    def encode(self, action: str, args: Sequence[Value] = ()) -> int:
        """The number of a ground action; raises DeviceError if the device does not have it."""
        entry = self.entry(action, args)
        index = None if entry is None else entry.index(args)
        if entry is None or index is None:
            raise DeviceError(f"device {self.device.name} has no number for {show_call(action, args)}")
        return entry.first + index

    def decode(self, number: int) -> tuple[str, tuple[Value, ...]] | None:
        """The ground action of a number, or None if the number has none."""
        for entry in self.entries:
            if number in entry.numbers:
                return entry.action, entry.arguments(number - entry.first)
        return None

    def sensed(self, action: str, number: int, args: Sequence[Value] | None = None) -> Value:
        """The sensing value that a number from the brick stands for; None for an action that senses nothing.

        Raises DeviceError when the number means nothing.
        """
        entry = self._entry_of(action, args)
        if entry.sensed is None:
            return None
        if entry.table is not None:
            if number in entry.table:
                return entry.table[number]
        elif (value := _value(entry.sensed, number)) is not None:
            return value
        raise DeviceError(
            f"the brick answered {number} to {action}, which means nothing",
            help=f"{_meanings(entry)}; correct the behaviour, or say in the binding what {number} means",
        )

    def sensing_number(self, action: str, value: Value, args: Sequence[Value] | None = None) -> int:
        """The number with which a brick answers a sensing value, the smallest if there are several.

        An action that senses nothing answers 0. Raises DeviceError for a value that has no number.
        """
        entry = self._entry_of(action, args)
        if entry.sensed is None:
            return 0
        if entry.table is not None:
            numbers = [number for number, meaning in entry.table.items() if _same(meaning, value)]
            if numbers:
                return min(numbers)
        elif value in entry.sensed and (number := value_number(entry.sensed, value)) is not None:
            return number
        raise DeviceError(f"no number of the brick stands for {show(value)} as a result of {action}")

    def timeout(self, action: str, args: Sequence[Value] | None = None) -> float:
        """The longest time in seconds that an action may take."""
        return self._entry_of(action, args).timeout

    def _entry_of(self, action: str, args: Sequence[Value] | None) -> Entry:
        found = self._by_action.get(action, []) if args is None else [self.entry(action, args)]
        if not found or found[0] is None:
            raise DeviceError(f"device {self.device.name} has no number for {show_call(action, args or ())}")
        return found[0]

    @cached_property
    def fingerprint(self) -> int:
        """15 bits that change when names, numbers, meanings, messages or the wire format do."""
        return zlib.crc32(json.dumps(self.facts(), sort_keys=True).encode()) & 0x7FFF

    def facts(self) -> dict[str, object]:
        """Everything that host and brick must agree on, as plain data."""
        return {
            "protocol": PROTOCOL,
            "wire": {name: [r.start, r.stop - 1] for name, r in self.wire.ranges().items()},
            "actions": [
                {
                    "first": entry.first,
                    "action": entry.action,
                    "exogenous": entry.exogenous,
                    "arguments": [_slot(slot) for slot in entry.args],
                    "results": results(entry),
                }
                for entry in self.entries
            ],
        }


def _slot(slot: Parameter | Fixed) -> str:
    match slot:
        case Fixed(value=value):
            return show(value)
        case Parameter(type=type_):
            return _spelt(type_)


def _spelt(type_: Type) -> str:
    """A type by its values, whatever it is called."""
    match type_:
        case Interval(low=low, high=high):
            return f"{low}..{high}"
        case Optional(base=base):
            return f"{_spelt(base)}?"
        case _ if type_.finite:
            return "{" + ", ".join(map(show, type_.values)) + "}"
        case _:
            return str(type_)


def results(entry: Entry) -> dict[str, str] | str | None:
    """What the numbers mean that an action answers: a table, a type, or nothing."""
    if entry.table is not None:
        return {str(number): show(value) for number, value in sorted(entry.table.items())}
    return None if entry.sensed is None else _spelt(entry.sensed)


def _value(type_: Type, number: int) -> Value:
    """The value of a type that a number stands for, or None."""
    if "int" in type_.kinds and number in type_:
        return number
    if type_.finite and type_.kinds != {"int"}:
        for value in type_.values:
            if value_number(type_, value) == number:
                return value
    return None


def _meanings(entry: Entry) -> str:
    if entry.table is not None:
        return "its table knows " + ", ".join(map(str, sorted(entry.table)))
    return f"it senses {entry.sensed}"
