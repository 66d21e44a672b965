"""What every device is to the online loop, and which device performs which action."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from typing import TypeAlias

from golc.diagnostics import Code, DeviceError, Diagnostic, UserError
from golc.theory.theory import BasicActionTheory, Binding, Fixed
from golc.theory.types import Value, show_call

Args: TypeAlias = tuple[Value, ...]

_FREE = nullcontext()

_REMEMBERED = 10_000
"""How many ground actions the router remembers: arguments of type ``int`` are without end."""


class GivenUpError(DeviceError):
    """What a device did was given up because the operator wants something else first; it is no fault of the device."""


class Device:
    """Something that performs actions; every method raises ``DeviceError`` where the world is in the way.

    ``poll_interval`` is the time in seconds between two polls, or none if the device reports nothing. ``polling``:
    whether a poll is under way, so that something may be reported any moment.
    """

    poll_interval: float | None = None
    polling = False

    def __init__(self, name: str) -> None:
        self.name = name

    def open(self) -> None:
        """Get ready: reach the brick, load the functions."""

    def handles(self, action: str, args: Args) -> bool:
        """Whether this device performs the ground action."""
        raise NotImplementedError

    def label(self, action: str, args: Args) -> str:
        """How a trace names the device for this action, with its message number if it has one: ``rcx 2``."""
        return self.name

    def perform(self, action: str, args: Args) -> Args:
        """Have the action done; returns its sensing results, one for each ``senses``, when it is done."""
        raise NotImplementedError

    def free(self) -> AbstractContextManager[None]:
        """Wait until the device can begin an action, and keep it free of anything else until it has been done.

        Whatever it had to report until then has been reported. Raises ``GivenUpError`` if it is interrupted.
        """
        return _FREE

    def poll(self, report: Callable[[str, Args], None]) -> None:
        """Report the exogenous actions that have occurred since the last poll, in order, each as it is fetched."""

    def interrupt(self) -> None:
        """Make a ``perform`` under way raise ``GivenUpError`` soon; called from other threads."""

    def abort(self) -> None:
        """Stop whatever the device is doing."""

    def close(self) -> None:
        """Let go of the device."""


class Router:
    """Finds the device of a ground action in constant time."""

    def __init__(self, devices: Sequence[Device], theory: BasicActionTheory) -> None:
        self.devices = tuple(devices)
        self._routes: dict[tuple[str, Args], Device] = {}
        self._theory = theory

    def device(self, action: str, args: Args) -> Device:
        """The first device that handles it; a ``UserError`` if none does."""
        device = self._routes.get((action, args))
        if device is None:
            device = self._find(action, args)
            if len(self._routes) < _REMEMBERED:
                self._routes[action, args] = device
        return device

    def _find(self, action: str, args: Args) -> Device:
        for device in self.devices:
            if device.handles(action, args):
                return device
        span = self._theory.actions[action].span
        message = f"no device performs `{show_call(action, args)}`"
        raise UserError(Diagnostic(Code.NO_DEVICE, message, span, help="bind it in a device"))


class Bindings:
    """The bindings of one device block by action, first match first."""

    def __init__(self, bindings: Iterable[Binding]) -> None:
        self._of: dict[str, list[Binding]] = {}
        for binding in bindings:
            self._of.setdefault(binding.action, []).append(binding)

    def find(self, action: str, args: Args) -> Binding | None:
        """The binding that covers a ground action."""
        return next((binding for binding in self._of.get(action, ()) if covers(binding, args)), None)


def covers(binding: Binding, args: Args) -> bool:
    """Whether a binding is for these arguments: equal where it fixes them, of its types elsewhere."""
    return all(
        arg == slot.value if isinstance(slot, Fixed) else arg in slot.type
        for slot, arg in zip(binding.args, args, strict=True)
    )


def translated(binding: Binding, value: object) -> object:
    """A result through the binding's table, if it has one that knows the value."""
    table: Mapping[int, Value] | None = binding.table
    return table[value] if table is not None and isinstance(value, int) and value in table else value
