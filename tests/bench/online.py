"""The online loop on the delivery domain, in a world in memory. A cycle is one decision: an action or a wait."""

from __future__ import annotations

import tempfile
import time
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from golc.loading import load
from golc.planning.planner import executable
from golc.runtime.devices.base import Args, Device, Router
from golc.runtime.loop.executive import Executive
from golc.runtime.loop.inbox import Inbox, Report
from golc.runtime.loop.policy import Policy
from golc.runtime.observers.journal import Journal
from golc.theory.theory import Action, BasicActionTheory
from tests.bench.measure import Row, Unit
from tests.bench.startup import DELIVERY

ANSWERS = {
    "start_to_next_station": Report("arrive_at_station", (), "world"),
    "signal_arrival": Report("push_go_button", (), "world"),
}


@cache
def delivery() -> BasicActionTheory:
    return load(DELIVERY)


class Stations(Device):
    """Does every action at once; the robot arrives, and the button is pushed, at the next wait."""

    def __init__(self) -> None:
        super().__init__("world")
        self.next: Report | None = None

    def handles(self, action: str, args: Args) -> bool:
        return True

    def perform(self, action: str, args: Args) -> Args:
        self.next = ANSWERS.get(action)
        return ()


class Requests(Inbox):
    """When the loop waits: what the last action has brought about, or else the next of some requests for a delivery."""

    def __init__(self, world: Stations, requests: int) -> None:
        super().__init__()
        self.waits = 0
        self._world = world
        self._left = requests

    def wait(self, timeout: float | None = None) -> bool:
        self.waits += 1
        report, self._world.next = self._world.next, None
        if report is None and self._left:
            self._left -= 1
            origin = self._left % 6 + 1
            to = (origin + self._left // 6 % 5) % 6 + 1
            report = Report("request_delivery", (origin, to), "world")
        if report is not None:
            self.items.append(report)
        return report is not None


@dataclass
class Everything:
    """A source that is always open."""

    name: str = "world"
    ended: bool = False

    def may_report(self, action: Action) -> bool:
        return True

    def start(self) -> None:
        """The inbox has it all."""

    def close(self) -> None:
        """Nothing to close."""


@dataclass
class Deliveries:
    """A run with so many requests, one after the other."""

    executive: Executive
    inbox: Requests

    @property
    def cycles(self) -> int:
        return self.executive.actions + self.inbox.waits


def deliveries(requests: int) -> Deliveries:
    world = Stations()
    inbox = Requests(world, requests)
    made = executable(delivery(), "control")
    return Deliveries(
        Executive(made, Router([world], delivery()), inbox, [Everything()], Policy(stop_when_idle=0)), inbox
    )


def seconds_a_cycle(requests: int) -> float:
    run = deliveries(requests)
    started = time.perf_counter()
    run.executive.run()
    return (time.perf_counter() - started) / run.cycles


def with_journal(requests: int) -> float:
    """Cycles a second when each record is flushed to a file."""
    run = deliveries(requests)
    with tempfile.TemporaryDirectory() as folder:
        journal = Journal(Path(folder) / "journal", run.executive.dynamics, "control", ())
        run.executive.observers.append(journal)
        started = time.perf_counter()
        run.executive.run()
        took = time.perf_counter() - started
        journal.close()
    return run.cycles / took


def late_decision(length: int, measured: int = 200) -> float:
    """Seconds of one decision after so many actions and events."""
    run = deliveries(length)  # a request takes more than one step
    times: list[float] = []
    decide = run.executive.machine.decide

    def timed(*arguments: object) -> object:
        started = time.perf_counter()
        choice = decide(*arguments)  # type: ignore[arg-type]
        if run.executive.actions + run.executive.exogenous >= length and len(times) < measured:
            times.append(time.perf_counter() - started)
        return choice

    run.executive.machine.decide = timed  # type: ignore[method-assign, assignment]
    run.executive.run()
    return sum(times) / len(times)


ROWS = [
    Row("online-100", "online delivery, 100 requests", 30_000, Unit.RATE, lambda: 1 / seconds_a_cycle(100)),
    Row("online-1000", "online delivery, 1,000 requests", 30_000, Unit.RATE, lambda: 1 / seconds_a_cycle(1_000)),
    Row(
        "online-growth",
        "cost of a cycle at 1,000 requests : at 100",
        1.2,
        Unit.FACTOR,
        lambda: seconds_a_cycle(1_000) / seconds_a_cycle(100),
    ),
    Row("late-decision", "one decision at history length 1,000", 1e-4, Unit.SECONDS, lambda: late_decision(1_000)),
    Row(
        "online-journal", "online delivery, 100 requests, flushed journal", 3_000, Unit.RATE, lambda: with_journal(100)
    ),
]
