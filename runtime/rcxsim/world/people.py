"""What people around the robot do and when: press its buttons, lift it, put it somewhere."""

from __future__ import annotations

import heapq
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True)
class Names:
    """What one can speak of to people: the buttons of the robot, and the stations."""

    buttons: Collection[str] = ()
    stations: Collection[str] = ()


@dataclass(frozen=True)
class Press:
    """Hold a button for a time."""

    button: str
    held: int
    """Microseconds."""


@dataclass(frozen=True)
class Lift:
    """Take the robot off the floor, until it is put somewhere."""


@dataclass(frozen=True)
class PutBack:
    """Put the robot on the nearest line, looking along it as it more or less did."""


@dataclass(frozen=True)
class PutAt:
    """Put the robot at a station, looking along its line, against it, or in a direction of its own (radians)."""

    station: str
    backward: bool = False
    facing: float | None = None


@dataclass(frozen=True)
class PutDown:
    """Put the robot anywhere."""

    x: float
    y: float
    facing: float


Deed: TypeAlias = Press | Lift | PutBack | PutAt | PutDown


@dataclass(frozen=True)
class At:
    """At a time from the beginning."""


@dataclass(frozen=True)
class OnSound:
    """When the robot has made a sound: that of a number, or any."""

    number: int | None


@dataclass(frozen=True)
class OnStop:
    """When the wheels have stopped and stood for the delay."""


@dataclass(frozen=True)
class Cue:
    """When what is done; ``delay`` in microseconds, ``nth`` (from 1) and ``station`` None for any."""

    trigger: At | OnSound | OnStop
    delay: int
    deed: Deed
    nth: int | None = None
    station: str | None = None


class People:
    """Does what a script says; the caller has the clock (microseconds) and says what the robot does."""

    def __init__(self, script: Sequence[Cue]) -> None:
        self._script = script
        self._seen = [0] * len(script)
        self._due: list[tuple[int, int, Cue, int | None]] = []
        self._order = 0
        self._starts = 0  # how often the robot has begun to move
        for cue in script:
            if isinstance(cue.trigger, At):
                self._push(cue.delay, cue, None)

    def heard(self, sound: int | None, station: str | None, now: int) -> None:
        """The robot has made a sound, at a station or not; None is no sound of the list."""
        for cue in self._brought_about(OnSound, station, sound):
            self._push(now + cue.delay, cue, None)

    def stopped(self, station: str | None, at: int) -> None:
        """The robot stands from a time on, unless it is told otherwise before."""
        for cue in self._brought_about(OnStop, station):
            self._push(at + cue.delay, cue, self._starts)

    def started(self) -> None:
        """The wheels turn: who waited until the robot had stood for a while waits in vain."""
        self._starts += 1

    @property
    def next(self) -> int | None:
        """When something may be done next."""
        return self._due[0][0] if self._due else None

    def take(self, now: int) -> Iterator[Deed]:
        """What is done by now, in its order."""
        while self._due and self._due[0][0] <= now:
            _, _, cue, starts = heapq.heappop(self._due)
            if starts in (None, self._starts):
                yield cue.deed

    def _brought_about(self, kind: type, station: str | None, sound: int | None = None) -> Iterator[Cue]:
        """The cues whose time it is when something has happened."""
        for place, cue in enumerate(self._script):
            trigger = cue.trigger
            if not isinstance(trigger, kind) or cue.station not in (None, station):
                continue
            if isinstance(trigger, OnSound) and trigger.number not in (None, sound):
                continue
            self._seen[place] += 1
            if cue.nth in (None, self._seen[place]):
                yield cue

    def _push(self, time: int, cue: Cue, starts: int | None) -> None:
        heapq.heappush(self._due, (time, self._order, cue, starts))
        self._order += 1
