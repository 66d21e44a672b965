"""What can happen in an online run, as values for those who watch it (the trace, the journal, a page, a test).

An observer is any callable that takes one of these. They carry what is at hand (spans, states, errors); whoever wants
text makes it, so that a run that nobody watches costs nothing. ``time`` is in seconds since the run began.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import TypeAlias

from golc.diagnostics import DeviceError, Diagnostic, Span
from golc.program.blame import Blocked as Why
from golc.situation.dynamics import Surprise
from golc.situation.worlds import State
from golc.theory.types import Value


@dataclass(frozen=True, slots=True)
class Happening:
    """The base of everything that happens."""

    time: float


@dataclass(frozen=True, slots=True)
class Started(Happening):
    """The run begins, with the devices still to be opened."""

    state: State


@dataclass(frozen=True, slots=True)
class Stepped(Happening):
    """A step without an action."""

    span: Span


@dataclass(frozen=True, slots=True)
class Said(Happening):
    """``say``: a message to the operator."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Begun(Happening):
    """A device begins an action; ``device`` names it as in ``rcx 2``."""

    action: str
    args: tuple[Value, ...]
    device: str
    span: Span


@dataclass(frozen=True, slots=True)
class Done(Happening):
    """The device reported success after ``duration`` seconds; ``after`` has the effects and the sensing results."""

    action: str
    args: tuple[Value, ...]
    results: tuple[Value, ...]
    duration: float
    before: State
    after: State
    surprises: tuple[Surprise, ...]


class Remedy(Enum):
    """What is done about an action that a device could not do."""

    RETRY = "retry"
    NEXT = "next"
    STOP = "stop"


@dataclass(frozen=True, slots=True)
class Failed(Happening):
    """The device could not do the action, which had no effects."""

    action: str
    args: tuple[Value, ...]
    error: DeviceError


@dataclass(frozen=True, slots=True)
class Remedied(Happening):
    """What was decided about the failed action."""

    action: str
    args: tuple[Value, ...]
    remedy: Remedy


@dataclass(frozen=True, slots=True)
class TakenIn(Happening):
    """An exogenous action was applied; ``impossible`` if its precondition did not hold."""

    action: str
    args: tuple[Value, ...]
    source: str
    impossible: bool
    before: State
    after: State


@dataclass(frozen=True, slots=True)
class Dropped(Happening):
    """An exogenous action was reported and not applied; ``reason`` is a clause."""

    action: str
    args: tuple[Value, ...]
    source: str
    reason: str


@dataclass(frozen=True, slots=True)
class Refused(Happening):
    """A line that is no exogenous action that this source may report."""

    text: str
    source: str
    diagnostics: tuple[Diagnostic, ...]


@dataclass(frozen=True, slots=True)
class SourceEnded(Happening):
    """A source will report nothing any more."""

    source: str


@dataclass(frozen=True, slots=True)
class Waiting(Happening):
    """The program lets time pass until an exogenous action is taken in; ``span`` is the ``wait``."""

    span: Span


@dataclass(frozen=True, slots=True)
class Blocked(Happening):
    """No transition and not final; ``sources`` might still report something that helps."""

    reasons: tuple[Why, ...]
    sources: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Reset(Happening):
    """The operator had the devices stop what they do; the run goes on."""

    source: str


class End(Enum):
    """Why a run ended."""

    FINAL = "final"
    """The program is final."""
    IDLE = "idle"
    """It waited for longer than it was told to."""
    STOPPED = "stopped"
    """The operator said so."""
    ABORTED = "aborted"
    """The program says that it has failed."""
    FAILED = "failed"
    """The theory or the program failed: blocked for good, an error of evaluation, an impossible exogenous action."""
    DEVICE = "device"
    """A device or a link failed."""
    INTERRUPTED = "interrupted"
    """By a signal, or because nobody listens any more."""
    BUG = "bug"
    """golc itself failed, or a function that was told what happens."""


@dataclass(frozen=True, slots=True)
class Ended(Happening):
    """The run is over and the devices have been told to stop; ``unstopped`` are those that could not be told."""

    end: End
    message: str
    state: State
    actions: int
    exogenous: int
    unstopped: tuple[tuple[str, str], ...]


Observer: TypeAlias = Callable[[Happening], None]
