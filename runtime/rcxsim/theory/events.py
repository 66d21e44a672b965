"""What happens around the brick by itself: by a script, or by chance in the way of a plausible robot.

The caller has the clock, in seconds. Time begins when the host is first heard.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

from golc.nqc.numbering import ActionMap
from golc.runtime.rcxsim.theory.world import TheoryWorld
from golc.runtime.sources.schedule import Player
from golc.situation.dynamics import Args
from golc.situation.layout import World

Event = tuple[str, Args]
"""An exogenous action and its arguments."""
ROUNDING = 1e-9
"""What adding the start to a time and taking it away again may lose."""


class Events(Protocol):
    """Where a brick's exogenous actions come from."""

    def heard(self, now: float) -> None:
        """The host is there: time begins."""

    def began(self, action: str, args: Args, now: float) -> None:
        """An action of the host begins."""

    def ended(self, before: World, started: bool, now: float) -> None:
        """It has ended (if ``started``: its task goes on); ``before`` is the state without its effects."""

    def stopped(self, now: float) -> None:
        """The host has stopped everything."""

    def due(self) -> float | None:
        """When something may happen next."""

    def take(self, now: float) -> list[Event]:
        """What happens now."""


class Scripted:
    """Plays the lines of an events file; what they say happens whether the theory thinks it possible or not."""

    def __init__(self, player: Player) -> None:
        self._player = player
        self._start: float | None = None

    def heard(self, now: float) -> None:
        if self._start is None:
            self._start = now

    def began(self, action: str, args: Args, now: float) -> None:
        self._player.performed(action, args, now - (self._start or 0.0))

    def ended(self, before: World, started: bool, now: float) -> None:
        """Lines count from the beginning of an action."""

    def stopped(self, now: float) -> None:
        """A script goes on."""

    def due(self) -> float | None:
        time = self._player.next
        return None if time is None or self._start is None else self._start + time

    def take(self, now: float) -> list[Event]:
        if self._start is None:
            return []
        return [(call.action, call.args) for call in self._player.due(now - self._start + ROUNDING)]


TASK_TAKES = (1.5, 4.0)
"""Seconds from the start of a task to the event that ends it."""
USUAL_END = 0.95
"""How often the end is the first one in the order of the numbers, the usual outcome; otherwise any of the others."""
PERSON_REACTS = (1.5, 4.0)
"""Seconds that the robot stands before a person does something with it."""
PERSON_RETURNS = (12.0, 30.0)
"""Seconds until a person does something again with a robot that still stands, ..."""
PERSON_TIRES = 3.0
"""... which grow by this factor each time, so that a run that has nothing more to do comes to rest."""
WORLD_MOVES_EVERY = 12.0
"""Mean seconds between events that come by themselves and change something."""
WEIGHT_OF_CHANGE = 4
"""How much likelier an event that changes something is than one that changes nothing."""
MOST_GROUND = 400
"""How many ground events of one binding are looked at; of more, a sample."""


@dataclass
class _Task:
    """A task that was started: the events that may end it, and when."""

    end: float
    endings: list[Event]


@dataclass
class Chance:
    """Events by seeded chance, among those that the brick reports and that are possible in the world's state.

    A started task ends with an event that its start made possible. While the robot stands (no behaviour runs, no task
    is to end), a person does something with it. Now and then something happens by itself that changes the state.
    """

    world: TheoryWorld
    numbers: ActionMap
    random: random.Random
    _tasks: list[_Task] = field(default_factory=list)
    _busy: bool = False
    _person: float | None = None
    _tired: float = 1.0
    _world: float | None = None

    def heard(self, now: float) -> None:
        if self._world is None:
            self._world = now + self._interval()

    def began(self, action: str, args: Args, now: float) -> None:
        self._busy = True
        self._person = None

    def ended(self, before: World, started: bool, now: float) -> None:
        self._busy = False
        if started:
            matters = self.world.matters
            endings = [event for event in self._ground() if matters(*event) and not matters(*event, state=before)]
            if endings:
                self._tasks.append(_Task(now + self.random.uniform(*TASK_TAKES), endings))
        self._stands(now)

    def stopped(self, now: float) -> None:
        self._busy = False
        self._tasks.clear()
        self._person = None

    def due(self) -> float | None:
        times = [task.end for task in self._tasks]
        times += [time for time in (self._person, self._world) if time is not None and not self._busy]
        return min(times, default=None)

    def take(self, now: float) -> list[Event]:
        for task in self._tasks:
            if task.end <= now:
                self._tasks.remove(task)
                event = self._ending(task)
                self._stands(now)
                return [] if event is None else [event]
        if self._person is not None and self._person <= now:
            self._person = now + self.random.uniform(*PERSON_RETURNS) * self._tired
            self._tired *= PERSON_TIRES
            return self._choose([event for event in self._ground() if self.world.possible(*event)])
        if self._world is not None and self._world <= now:
            self._world = now + self._interval()
            awaited = [event for task in self._tasks for event in task.endings]
            return self._choose([e for e in self._ground() if e not in awaited and self.world.matters(*e)])
        return []

    def _ending(self, task: _Task) -> Event | None:
        possible = [event for event in task.endings if self.world.possible(*event)]
        if not possible:
            return None
        usual = [event for event in possible if event[0] == possible[0][0]]
        others = possible[len(usual) :]
        return self.random.choice(usual if not others or self.random.random() < USUAL_END else others)

    def _choose(self, events: Sequence[Event]) -> list[Event]:
        """One of some events that are possible, each action as likely as the next, whatever its arguments."""
        if not events:
            return []
        changing = [event for event in events if self.world.matters(*event)]
        names = {name: WEIGHT_OF_CHANGE if any(name == e[0] for e in changing) else 1 for name, _ in events}
        name = self.random.choices(list(names), list(names.values()))[0]
        return [self.random.choice([e for e in changing if e[0] == name] or [e for e in events if e[0] == name])]

    def _stands(self, now: float) -> None:
        if not self._busy and not self._tasks:
            self._person = now + self.random.uniform(*PERSON_REACTS)
            self._tired = 1.0

    def _interval(self) -> float:
        return 1.0 + self.random.expovariate(1 / WORLD_MOVES_EVERY)

    def _ground(self) -> list[Event]:
        found: list[Event] = []
        for entry in self.numbers.entries:
            if entry.exogenous:
                many = entry.count > MOST_GROUND
                places = self.random.sample(range(entry.count), MOST_GROUND) if many else range(entry.count)
                found.extend((entry.action, entry.arguments(place)) for place in places)
        return found
