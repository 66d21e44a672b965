from __future__ import annotations

import json
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any

import pytest

from golc.diagnostics import DeviceError
from golc.loading import load
from golc.planning.planner import executable
from golc.runtime.clock import Clock
from golc.runtime.devices.base import Args, Device, Router
from golc.runtime.loop.executive import Executive, Outcome
from golc.runtime.loop.happenings import Begun, Happening, Said, TakenIn
from golc.runtime.loop.inbox import Inbox, Item, Report
from golc.runtime.loop.policy import Policy
from golc.theory.theory import Action, BasicActionTheory
from golc.theory.types import show_call
from tests.theories import theory_of

PATIENCE = 60.0
"""Seconds after which a process of a test is ended; nothing takes nearly as long."""

ROOT = Path(__file__).parent.parent.parent
DELIVERY = ROOT / "examples/delivery/delivery.gl"

Perform = Callable[[str, Args], Args]


class ScriptedDevice(Device):
    """Does every action by a function of the test and remembers what it was told."""

    def __init__(self, perform: Perform | None = None) -> None:
        super().__init__("world")
        self.told: list[str] = []
        self._perform = perform or (lambda action, args: ())

    def open(self) -> None:
        self.told.append("open")

    def handles(self, action: str, args: Args) -> bool:
        return True

    def perform(self, action: str, args: Args) -> Args:
        self.told.append(show_call(action, args))
        return self._perform(action, args)

    def abort(self) -> None:
        self.told.append("abort")

    def close(self) -> None:
        self.told.append("close")


@dataclass
class OpenSource:
    """A source that may report anything and never ends, unless a test says so."""

    name: str = "test"
    ended: bool = False

    def may_report(self, action: Action) -> bool:
        return action.exogenous

    def start(self) -> None:
        """The test puts the items into the inbox."""

    def close(self) -> None:
        self.ended = True


class ScriptedInbox(Inbox):
    """An inbox in which the next batch of a script arrives when the loop waits; when there is none, nothing does."""

    def __init__(self, batches: Sequence[Sequence[Item]] = ()) -> None:
        super().__init__()
        self.batches = [list(batch) for batch in batches]

    def wait(self, timeout: float | None = None) -> bool:
        if not self.items and self.batches:
            self.items.extend(self.batches.pop(0))
        return bool(self.items)


@dataclass
class Run:
    """An executive in a scripted world, and everything that happened in it."""

    executive: Executive
    device: ScriptedDevice
    inbox: ScriptedInbox
    happened: list[Happening] = field(default_factory=list)

    def run(self) -> Outcome:
        self.executive.observers.append(self.happened.append)
        return self.executive.run()

    def story(self) -> list[str]:
        """Actions as they begin, exogenous actions with ``<``, messages in quotes, in order."""
        lines = []
        for happening in self.happened:
            match happening:
                case Begun(action=action, args=args):
                    lines.append(show_call(action, args))
                case TakenIn(action=action, args=args):
                    lines.append("<" + show_call(action, args))
                case Said(text=text):
                    lines.append(f'"{text}"')
        return lines

    def only(self, kind: type[Happening]) -> list[Any]:
        """What happened of one kind."""
        return [happening for happening in self.happened if type(happening) is kind]

    def value(self, fluent: str, *args: Any) -> Any:
        return self.executive.dynamics.value(self.executive.state, fluent, args)


Starter = Callable[..., Run]


@pytest.fixture
def start() -> Starter:
    """Makes a run of a text or a theory, in which time stands still: ``start(text, batches, perform, policy)``."""

    def make(
        what: str | BasicActionTheory,
        batches: Sequence[Sequence[Item]] = (),
        perform: Perform | None = None,
        policy: Policy | None = None,
        source: OpenSource | None = None,
        procedure: str = "control",
    ) -> Run:
        theory = theory_of(what) if isinstance(what, str) else what
        device, inbox = ScriptedDevice(perform), ScriptedInbox(batches)
        policy = policy or Policy(stop_when_idle=0, retry_after=0)
        sources = [source or OpenSource()]
        made = executable(theory, procedure)
        frozen = Clock(lambda: 0.0, 0.0)
        return Run(Executive(made, Router([device], theory), inbox, sources, policy, frozen), device, inbox)

    return make


@pytest.fixture
def unchecked() -> Callable[[str], BasicActionTheory]:
    """The theory that a text declares, without the checks."""
    return theory_of


@pytest.fixture
def delivery() -> BasicActionTheory:
    return load(DELIVERY)


@pytest.fixture
def event() -> Callable[..., Report]:
    """An exogenous action that is reported: ``event("request_delivery", 2, 5)``."""
    return lambda action, *args: Report(action, args, "test")


@pytest.fixture
def failing() -> Callable[[int], Perform]:
    """A device that fails the first n times."""

    def make(times: int) -> Perform:
        left = [times]

        def perform(action: str, args: Args) -> Args:
            left[0] -= 1
            if left[0] >= 0:
                raise DeviceError(f"{show_call(action, args)} does not work", help="repair it")
            return ()

        return perform

    return make


@pytest.fixture
def case() -> Callable[[str], dict[str, Any]]:
    """A recorded case by its name."""
    return lambda name: json.loads((ROOT / f"tests/cases/{name}.json").read_text())


class Robot:
    """A brick process of a test: its port and what it has heard."""

    def __init__(self, mood: str) -> None:
        script = Path(__file__).with_name("legolog_robot.py")
        self.process = subprocess.Popen([sys.executable, str(script), mood], stdout=subprocess.PIPE, text=True)
        self._patience = threading.Timer(PATIENCE, self.process.kill)
        self._patience.start()
        assert self.process.stdout is not None
        self._out: IO[str] = self.process.stdout
        self.port = self._out.readline().strip()
        self.heard: list[int] = []

    def wait_for(self, number: int) -> None:
        """Read what it hears until it has heard this, after the abort at the beginning."""
        while number not in self.heard[1:]:
            line = self._out.readline()
            assert line, f"the robot has gone; it heard {self.heard}"
            self.heard.append(int(line))

    def everything(self) -> list[int]:
        """All that it has heard, when nobody speaks to it any more."""
        self.process.terminate()
        self.heard += [int(line) for line in self._out]
        return self.heard

    def close(self) -> None:
        self._patience.cancel()
        self.process.kill()
        self.process.wait()
        self._out.close()


@pytest.fixture
def robot() -> Iterator[Callable[[str], Robot]]:
    """Starts a delivery robot in some mood (``legolog_robot.py``)."""
    made: list[Robot] = []

    def make(mood: str) -> Robot:
        made.append(Robot(mood))
        return made[-1]

    yield make
    for each in made:
        each.close()
