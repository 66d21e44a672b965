"""The recorded deliveries once more, with a robot that drives: the host decides, the compiled program does it.

Everything is real but the time: it passes only while the host waits, as fast as it can be simulated.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from golc.bytecode.image import Image
from golc.diagnostics import Findings, Source, Span
from golc.loading import load
from golc.nqc.numbering import number_device
from golc.nqc.toolchain import Target
from golc.planning.planner import executable
from golc.runtime.clock import Clock
from golc.runtime.devices.base import Args, Device, Router
from golc.runtime.devices.bricks import Link, RcxDevice
from golc.runtime.devices.rcx.transport import Transport
from golc.runtime.loop.executive import Executive
from golc.runtime.loop.happenings import Begun, End, Happening, TakenIn
from golc.runtime.loop.inbox import Inbox, Report
from golc.runtime.loop.policy import Policy
from golc.runtime.rcxsim.line import LineOptions
from golc.runtime.rcxsim.machine.options import Firmware, Options
from golc.runtime.rcxsim.machine.simulator import build
from golc.runtime.rcxsim.trace import Trace
from golc.runtime.rcxsim.world.world import World
from golc.runtime.rcxsim.world.worldfile import parse_world
from golc.theory.ground import read_exogenous
from golc.theory.theory import Action, BasicActionTheory
from golc.theory.types import show_call
from tests.rcxsim.virtual_port import VirtualPort

if TYPE_CHECKING:
    from collections.abc import Sequence

ROOT = Path(__file__).parent.parent.parent
DELIVERY = ROOT / "examples/delivery"
ON_THE_BRICK = ("arrive_at_station", "stop_abnormally", "push_go_button")
LONGEST_WAY = 60.0
"""Simulated seconds within which everything happens that is waited for."""


class Recording:
    """What happened in a case, in order: actions, and what came from people or from the robot while it waited."""

    def __init__(self, theory: BasicActionTheory, trace: Sequence[dict[str, Any]]) -> None:
        self.theory = theory
        self.story: list[str] = []
        self.after: list[list[Report]] = []
        """What people report right after each action."""
        self.waits: list[Report | str] = []
        """What ends each wait: what people report, or the name of what the brick does."""
        for entry in trace:
            if "exogenous" not in entry:
                self.story.append(entry.get("action", "reposition_robot"))
                self.after.append([])
                continue
            for text in entry["exogenous"]:
                self.story.append("<" + text.replace(",", ", "))
                if entry["when"] == "immediate":
                    self.after[-1].append(self._report(text))
                else:
                    self.waits.append(text if text in ON_THE_BRICK else self._report(text))

    def _report(self, text: str) -> Report:
        call = read_exogenous(self.theory, Span(Source("case", text), 0, len(text)), Findings())
        assert call is not None
        return Report(call.action, call.args, "people")


class Operator(Device):
    """Puts the robot back when asked to, which takes a while."""

    def __init__(self, transport: Transport) -> None:
        super().__init__("operator")
        self._transport = transport

    def handles(self, action: str, args: Args) -> bool:
        return action == "reposition_robot"

    def perform(self, action: str, args: Args) -> Args:
        self._transport.read(self._transport.now() + 6.0)
        return ()


class RecordedInbox(Inbox):
    """While the loop waits, people report what they did in the recording, or the brick is asked until it tells."""

    def __init__(self, recording: Recording, brick: RcxDevice, transport: Transport) -> None:
        super().__init__()
        self._waits: Iterator[Report | str] = iter(recording.waits)
        self._brick = brick
        self._transport = transport

    def wait(self, timeout: float | None = None) -> bool:
        if not self.items:
            match next(self._waits, None):
                case Report() as report:
                    self.items.append(report)
                case str():
                    self._ask()
        return bool(self.items)

    def _ask(self) -> None:
        end = self._transport.now() + LONGEST_WAY
        while not self.items and self._transport.now() < end:
            self._transport.read(self._transport.now() + 0.25)
            self._brick.poll(lambda action, args: self.items.append(Report(action, args, "rcx")))


class Listening:
    """A source that may report anything."""

    name = "test"
    ended = False

    def may_report(self, action: Action) -> bool:
        return action.exogenous

    def start(self) -> None:
        """The inbox has what there is."""

    def close(self) -> None:
        """Nothing is open."""


CASES: dict[str, tuple[tuple[str, str], ...]] = {
    "delivery-01-initial": (),
    "delivery-02-request-mid-move": (),
    # On the way from 4 to 5 somebody takes the robot off the line; an operator puts it back there.
    "delivery-03-lost-and-recovered": (
        ("script = [", 'script = [\n    "on 1st sound up after 9 s: put at 500, 600 facing 90",'),
        ("on sound down after 4 s: put back", "on sound down after 4 s: put at 160, 1000 facing 100"),
    ),
    "delivery-04-request-then-cancel": (),
    # Where the robot signals twice, as something new was asked for meanwhile, the person just goes on pressing.
    "delivery-05-nine-requests": (("press go", "press go for 2 s"),),
}


@pytest.mark.parametrize("name", CASES)
def test_the_robot_does_what_was_recorded(name: str, program: Callable[[Target], Image]) -> None:
    recorded = json.loads((ROOT / "tests/cases" / f"{name}.json").read_text())
    theory = load(DELIVERY / "delivery.gl")
    recording = Recording(theory, recorded["trace"])
    text = (DELIVERY / "delivery.toml").read_text()
    for old, new in CASES[name]:
        assert old in text
        text = text.replace(old, new)
    world = World(parse_world(Source("delivery.toml", text)), 0, Trace())
    line, _ = build(Firmware.V2, program(Target.RCX2), world, Options(), LineOptions(), Trace())
    transport = VirtualPort(line)
    brick = RcxDevice(number_device(theory, theory.devices[0], Findings()), Link("virtual", transport=transport))
    inbox = RecordedInbox(recording, brick, transport)
    happened: list[Happening] = []
    after = iter(recording.after)

    def observe(happening: Happening) -> None:
        happened.append(happening)
        if isinstance(happening, Begun):
            inbox.items.extend(next(after, []))

    executive = Executive(
        executable(theory, "control"),
        Router([brick, Operator(transport)], theory),
        inbox,
        [Listening()],
        Policy(stop_when_idle=0, retry_after=0),
        Clock(lambda: 0.0, 0.0),
    )
    executive.observers.append(observe)

    assert executive.run().end is End.IDLE

    assert list(told(happened)) == recording.story
    final = {fluent: value or 0 for fluent, value in executive.dynamics.show(executive.state).items()}
    assert final == recorded["final_fluents"]
    assert world.whereabouts == f"at station {final['location']}"


def told(happened: list[Happening]) -> Iterator[str]:
    for happening in happened:
        match happening:
            case Begun(action=action, args=args):
                yield show_call(action, args)
            case TakenIn(action=action, args=args):
                yield "<" + show_call(action, args)
