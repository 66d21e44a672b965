"""What a run does where the world is not as the theory says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from golc.diagnostics import Code, DeviceError, Diagnostic, Label, ProgramError
from golc.program.labels import Act
from golc.runtime.loop.happenings import Remedy
from golc.situation.dynamics import Surprise
from golc.theory.types import show


class OnImpossible(Enum):
    """An exogenous action arrives whose precondition does not hold."""

    APPLY = "apply"
    """The world is right, the theory is wrong."""
    DROP = "drop"
    STOP = "stop"


class OnSurprise(Enum):
    """A device senses what the theory thinks impossible."""

    APPLY = "apply"
    """The device is right: a sensed fluent takes the value."""
    STOP = "stop"


def stop(label: Act, error: DeviceError) -> Remedy:
    """End the run when a device fails."""
    return Remedy.STOP


def surprising(label: Act, surprise: Surprise) -> ProgramError:
    """The error of a run that is to stop at a surprise."""
    message = f"`{label}` sensed {show(surprise.sensed)}, where {show(surprise.expected)} was expected"
    labels = (Label(surprise.span, "sensed here"),)
    return ProgramError(Diagnostic(Code.SURPRISE, message, label.span, labels=labels))


@dataclass(frozen=True)
class Policy:
    """Decisions that are made before the run, or by asking somebody during it.

    ``on_failure`` says what to do about an action that a device could not do; ``retry_after`` is how many real seconds
    pass before it is tried again. ``stop_when_idle`` is the time of the clock in seconds after which a run that only
    waits ends. ``check_invariants`` is whether a state in which an invariant is false ends the run. ``confirm`` is
    asked before each action and returns when it may begin. ``interrupt`` makes these two give up.
    """

    on_impossible: OnImpossible = OnImpossible.APPLY
    on_surprise: OnSurprise = OnSurprise.APPLY
    on_failure: Callable[[Act, DeviceError], Remedy] = stop
    retry_after: float = 1.0
    stop_when_idle: float | None = None
    check_invariants: bool = False
    confirm: Callable[[Act], None] | None = None
    interrupt: Callable[[], None] = lambda: None
