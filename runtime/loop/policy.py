"""What a run does where the world is not as the theory says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

from golc.diagnostics import DeviceError
from golc.program.labels import Act
from golc.runtime.loop.happenings import Remedy


class OnImpossible(Enum):
    """An exogenous action arrives whose precondition does not hold."""

    APPLY = "apply"
    """The world is right, the theory is wrong."""
    DROP = "drop"
    STOP = "stop"


def stop(label: Act, error: DeviceError) -> Remedy:
    """End the run when a device fails."""
    return Remedy.STOP


@dataclass(frozen=True)
class Policy:
    """Decisions that are made before the run, or by asking somebody during it.

    ``on_failure`` says what to do about an action that a device could not do; ``retry_after`` is how many real seconds
    pass before it is tried again. ``stop_when_idle`` is the real time in seconds after which a run that only waits
    ends. ``check_invariants`` is whether a state in which an invariant is false ends the run. ``confirm`` is asked
    before each action and returns when it may begin. ``interrupt`` makes these two give up.
    """

    on_impossible: OnImpossible = OnImpossible.APPLY
    on_failure: Callable[[Act, DeviceError], Remedy] = stop
    retry_after: float = 1.0
    stop_when_idle: float | None = None
    check_invariants: bool = False
    confirm: Callable[[Act], None] | None = None
    interrupt: Callable[[], None] = lambda: None
