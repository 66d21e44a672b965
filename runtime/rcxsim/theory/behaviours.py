"""The behaviours of a brick that a theory drives: how long actions take, what they sense, what is reported."""

from __future__ import annotations

import random
from collections import deque
from dataclasses import dataclass

from golc.diagnostics import DeviceError, ProgramError
from golc.nqc.numbering import ActionMap, Entry
from golc.runtime.rcxsim.theory.events import Event, Events
from golc.runtime.rcxsim.theory.world import TheoryWorld
from golc.runtime.rcxsim.trace import Trace
from golc.situation.dynamics import Args
from golc.theory.theory import ByStart
from golc.theory.types import show, show_call

QUICK = (0.4, 2.0)
"""Seconds that most behaviours take."""
SLOW = (3.5, 6.0)
"""Seconds that a behaviour takes now and then, so that it needs more time than a first answer may take."""
SLOW_CHANCE = 0.08
OF_TIMEOUT = 0.8
"""No behaviour takes more than this part of the time that its binding grants."""


@dataclass(frozen=True)
class _Running:
    entry: Entry
    args: Args
    done: float


class TheoryBrick:
    """What the control program steers on a brick whose world is the theory."""

    def __init__(
        self, world: TheoryWorld, numbers: ActionMap, events: Events, durations: random.Random, trace: Trace
    ) -> None:
        self._world = world
        self._numbers = numbers
        self._events = events
        self._durations = durations
        self._trace = trace
        self._running: _Running | None = None
        self._value = 0
        self._queue: deque[tuple[int, Event]] = deque()

    def begin(self, number: int, now: float) -> None:
        self._running = None
        self._value = 0
        self._events.heard(now)
        decoded = self._numbers.decode(number)
        entry = None if decoded is None else self._numbers.entry(*decoded)
        if decoded is None or entry is None or entry.exogenous:
            self._trace.tell(now, "unknown", number=number)
            return
        action, args = decoded
        self._trace.tell(now, "began", action=show_call(action, args), number=number)
        self._world.catch_up_with(action, args, now)
        self._events.began(action, args, now)
        if isinstance(entry.behaviour, ByStart):
            self._finish(entry, args, now)
        else:
            self._running = _Running(entry, args, now + self._duration(entry))

    def busy(self) -> bool:
        return self._running is not None

    def value(self) -> int:
        return self._value

    def stop_all(self, now: float) -> None:
        if self._running is not None:
            self._trace.tell(now, "stopped", action=show_call(self._running.entry.action, self._running.args))
        self._running = None
        if self._queue:
            self._trace.tell(now, "forgot", events=[show_call(*event) for _, event in self._queue])
        self._queue.clear()
        self._events.stopped(now)

    def event(self, now: float) -> int | None:
        self._events.heard(now)
        return self._queue[0][0] if self._queue else None

    def reported(self, now: float) -> None:
        self._trace.tell(now, "reported", action=show_call(*self._queue.popleft()[1]))

    def tick(self, now: float) -> None:
        running = self._running
        if running is not None and running.done <= now:
            self._running = None
            self._finish(running.entry, running.args, now)
        # What happens while a behaviour runs or an event waits, the host takes in after it: to stay in step with what
        # the host can know, the world lets it happen after it too.
        if self._running is None and not self._queue:
            for event in self._events.take(now):
                self._world.happen(*event, now, "happened")
                self._queue.append((self._numbers.encode(*event), event))

    def due(self) -> float | None:
        if self._running is not None:
            return self._running.done
        return None if self._queue else self._events.due()

    def _duration(self, entry: Entry) -> float:
        slow = self._durations.random() < SLOW_CHANCE
        return min(self._durations.uniform(*(SLOW if slow else QUICK)), OF_TIMEOUT * entry.timeout)

    def _finish(self, entry: Entry, args: Args, now: float) -> None:
        """The behaviour is done (a task: started): its effects hold, and what it senses is sensed."""
        before = self._world.state
        started = isinstance(entry.behaviour, ByStart)
        self._world.happen(entry.action, args, now, "started" if started else "done")
        if entry.sensed is not None:
            self._value = self._sense(entry, args, now)
        self._events.ended(before, started, now)

    def _sense(self, entry: Entry, args: Args, now: float) -> int:
        action = entry.action
        try:
            answers = None if entry.table is None else list(entry.table.values())
            sensed = self._world.sense(action, args, answers)
            number = self._numbers.sensing_number(action, sensed, args)
        except (ProgramError, DeviceError) as error:
            problem = error.diagnostic.message if isinstance(error, ProgramError) else str(error)
            self._trace.tell(now, "senseless", action=show_call(action, args), problem=problem)
            return 0
        self._trace.tell(now, "sensed", action=show_call(action, args), value=show(sensed), number=number)
        return number
