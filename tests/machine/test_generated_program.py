"""The program that golc generates for the delivery robot, as byte code, and golc's own link as its host.

In virtual time; what stands around the robot is what the test puts there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from golc.bytecode.image import Image
from golc.diagnostics import Findings
from golc.loading import load
from golc.nqc.generate import generate
from golc.nqc.numbering import number_device
from golc.nqc.toolchain import Target, compile_program
from golc.runtime.devices.bricks import Link, RcxDevice
from golc.runtime.devices.rcx.brick import Brick
from golc.runtime.devices.rcx.tower import Tower
from golc.runtime.rcxsim.line import LineOptions
from golc.runtime.rcxsim.machine.brick import MachineBrick
from golc.runtime.rcxsim.machine.options import FIRMWARES, Options
from golc.runtime.rcxsim.machine.simulator import build
from golc.runtime.rcxsim.surroundings import Bench, Mode
from golc.runtime.rcxsim.trace import Trace
from tests.rcxsim.virtual_port import VirtualPort

DELIVERY = Path(__file__).parents[2] / "examples" / "delivery" / "delivery.gl"
TURN, SIGNAL, START, ARRIVED, LOST, PUSHED = range(6)
BUTTON, EYE = 0, 2
FLOOR, LINE, STATION = [(146 - percent) * 7 for percent in (50, 30, 70)]
BOTH = pytest.mark.parametrize("target", list(Target))


@dataclass
class Robot:
    """The robot with its host."""

    brick: MachineBrick
    bench: Bench
    port: VirtualPort
    host: Brick
    records: list[dict[str, Any]]

    def wait(self, seconds: float) -> None:
        end = self.port.now() + seconds
        while self.port.now() < end:
            self.port.read(end)

    def see(self, raw: int) -> None:
        self.bench.raw[EYE] = raw

    def reported(self, within: float) -> int | None:
        """The first event that a host hears that polls four times a second."""
        end = self.port.now() + within
        while self.port.now() < end:
            if (number := self.host.poll()) is not None:
                return number
            self.wait(0.25)
        return None

    def motors(self) -> str:
        """What A, B and C do: forward, reverse or off."""
        return "".join(
            "-" if output.mode is not Mode.ON else "f" if output.forward else "r"
            for output in self.brick.machine.outputs.now
        )


@pytest.fixture(scope="module")
def images(tmp_path_factory: pytest.TempPathFactory) -> dict[Target, Image]:
    """The compiled program for both firmwares."""
    theory = load(DELIVERY)
    device = next(device for device in theory.devices if device.kind == "rcx")
    findings = Findings()
    actions = number_device(theory, device, findings)
    folder = tmp_path_factory.mktemp("build")
    generated = generate(theory, actions, folder, findings, False)
    assert generated is not None
    return {target: compile_program(generated.path, generated.folders, target, device.span).image for target in Target}


@pytest.fixture
def robot(images: dict[Target, Image]) -> Callable[..., Robot]:
    def make(target: Target = Target.RCX2, *, seed: int = 0, op_time: int | None = None, **line: Any) -> Robot:
        records: list[dict[str, Any]] = []
        trace = Trace(lambda record: records.append(dict(record)))
        bench = Bench()
        bench.raw[EYE] = LINE
        image = images[target]
        options = Options(seed=seed, op_time=op_time)
        end, brick = build(FIRMWARES[image.target], image, bench, options, LineOptions(**line), trace)
        port = VirtualPort(end)
        return Robot(brick, bench, port, Brick(Tower(port)), records)

    return make


@BOTH
def test_an_action_is_done_and_answered(robot: Callable[..., Robot], target: Target) -> None:
    there = robot(target)
    there.wait(1)
    there.records.clear()
    assert there.host.perform(SIGNAL) == 0
    motors = [(r["motor"], r["mode"], r["direction"]) for r in there.records if r["what"] == "motor"]
    assert motors == [("B", "off", "reverse"), ("B", "on", "reverse"), ("B", "off", "reverse")]
    assert [record["what"] for record in there.records].count("sound") == 1


@BOTH
def test_a_task_is_started_at_once_and_ends_with_an_event(robot: Callable[..., Robot], target: Target) -> None:
    there = robot(target)
    assert there.host.perform(START) == 0
    there.wait(0.5)
    assert there.motors() == "f--"  # on the line it steers to the left, off it
    assert there.reported(2) is None
    there.see(STATION)
    assert there.reported(2) == ARRIVED
    assert there.motors() == "---"
    assert there.host.poll() is None


@BOTH
def test_the_line_is_lost(robot: Callable[..., Robot], target: Target) -> None:
    there = robot(target)
    there.host.perform(START)
    there.wait(1)
    there.see(FLOOR)
    assert there.reported(8) == LOST
    assert there.motors() == "---"


@BOTH
def test_a_button_that_is_pressed_during_an_action_is_reported_after_it(
    robot: Callable[..., Robot], target: Target
) -> None:
    there = robot(target)
    there.see(FLOOR)
    there.bench.raw[BUTTON] = 30
    assert there.host.perform(TURN) == 0  # it asks for more time: the line does not come for four seconds
    assert there.reported(2) == PUSHED
    assert there.reported(2) is None


def test_both_firmwares_do_the_same_in_equal_time(robot: Callable[..., Robot]) -> None:
    def session(target: Target) -> list[Any]:
        there = robot(target, op_time=2000)
        heard: list[Any] = [there.host.perform(SIGNAL), there.host.perform(START)]
        there.wait(1)
        there.see(FLOOR)
        there.wait(0.5)
        there.see(LINE)
        there.wait(0.5)
        there.see(STATION)
        heard += [there.reported(3), there.host.perform(TURN), there.host.poll()]
        kinds = ("motor", "sound", "sent", "heard")
        return [heard, [{k: v for k, v in r.items() if k != "t"} for r in there.records if r["what"] in kinds]]

    assert session(Target.RCX) == session(Target.RCX2)


@pytest.mark.parametrize("seed", range(5))
def test_over_a_bad_line_every_action_is_answered(robot: Callable[..., Robot], seed: int) -> None:
    there = robot(seed=seed, loss=0.05, garble=0.05, late=0.05, noise=0.2)
    for action in (SIGNAL, START, SIGNAL, START):
        assert there.host.perform(action, 60.0) == 0
    there.see(STATION)
    assert there.reported(20) == ARRIVED


def test_a_brick_that_is_switched_off_and_on_again_begins_anew(robot: Callable[..., Robot]) -> None:
    there = robot(outages=((3.0, 4.0),))
    there.host.perform(START)
    there.wait(2.5)
    assert there.motors() == "f--"  # on the line it steers to the left, off it
    there.wait(1)
    assert there.motors() == "---"
    there.wait(1)
    assert there.host.perform(SIGNAL) == 0


@pytest.mark.parametrize(("target", "most"), [(Target.RCX, 0.19), (Target.RCX2, 0.23)])
def test_a_poll_takes_the_air_time_and_a_few_op_codes(robot: Callable[..., Robot], target: Target, most: float) -> None:
    there = robot(target)
    there.wait(1)
    times = []
    for _ in range(40):
        start = there.port.now()
        assert there.host.poll() is None
        times.append(there.port.now() - start)
        there.wait(0.037)
    assert 0.0825 < min(times) <= max(times) < most


@pytest.mark.parametrize("digits", [2, 6, 10, 16, 40])
def test_the_number_of_an_event_arrives_in_any_base(tmp_path: Path, digits: int) -> None:
    settings = f"    set action_digits {digits}\n    set action_base 86\n"
    domain = f'domain robot\naction ring\nexog rang\ndevice rcx "robot.nqc":\n    0 ring\n    1237 rang\n{settings}'
    (tmp_path / "robot.gl").write_text(domain)
    (tmp_path / "robot.nqc").write_text("void ring() { golc_report(EXOG_rang); }\n")
    theory = load(tmp_path / "robot.gl")
    actions = number_device(theory, theory.devices[0], Findings())
    generated = generate(theory, actions, tmp_path / "build", Findings(), False)
    assert generated is not None
    image = compile_program(generated.path, generated.folders, Target.RCX, theory.devices[0].span).image
    end, _ = build(FIRMWARES[image.target], image, Bench(), Options(), LineOptions(), Trace())
    device = RcxDevice(actions, Link("virtual", transport=VirtualPort(end)))
    device.open()
    device.perform("ring", ())
    reported: list[tuple[str, tuple[object, ...]]] = []
    for _ in range(5):
        device.poll(lambda action, args: reported.append((action, args)))
    assert reported == [("rang", ())]
