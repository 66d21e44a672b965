"""What the classic protocol costs the delivery robot, on the simulated machine: the same on every computer.

The aims are the figures of the program with which Legolog came: its size, and the op codes that it can execute, at 2 ms
each, in the 68 ms that it takes from a poll to the answer.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable
from functools import cache

from golc.nqc.toolchain import Target
from golc.runtime.devices.rcx.brick import Brick
from golc.runtime.devices.rcx.tower import Tower
from golc.runtime.rcxsim.line import LineOptions
from golc.runtime.rcxsim.machine.options import FIRMWARES, Options
from golc.runtime.rcxsim.machine.simulator import build
from golc.runtime.rcxsim.surroundings import Bench
from golc.runtime.rcxsim.trace import Record, Trace
from tests.bench.machine import program
from tests.bench.measure import Row, Unit
from tests.rcxsim.virtual_port import VirtualPort

START = 2
"""The number of an action that is answered as soon as its task has been started."""
SAMPLES, READY = 41, 1.0
"""The host speaks at so many moments of the brick's 100 ms timer tick and event loop, first when it is ready."""
LEGOLOG_SIZE, LEGOLOG_OP_CODES = 1491, 34
ACTION, POLL = 0.21, 0.15
"""Simulated seconds."""


@cache
def _median(target: Target, exchange: Callable[[Brick], object]) -> tuple[float, float]:
    """The simulated seconds of an exchange on an idle brick, the op codes from the message heard to the one sent."""
    samples = [_sample(target, exchange, READY + number * 0.1 / SAMPLES) for number in range(SAMPLES)]
    seconds, op_codes = zip(*samples, strict=True)
    return statistics.median(seconds), statistics.median(op_codes)


def _sample(target: Target, exchange: Callable[[Brick], object], at: float) -> tuple[float, int]:
    steps: dict[str, int] = {}

    def read(record: Record) -> None:
        if record["what"] in ("heard", "sent"):
            steps[record["what"]] = brick.machine.steps

    image = program(target)
    line, brick = build(FIRMWARES[image.target], image, Bench(), Options(), LineOptions(), Trace(read))
    port = VirtualPort(line)
    host = Brick(Tower(port))
    port.read(READY / 2)
    host.poll()  # opens the line
    port.read(at)
    exchange(host)
    return port.now() - at, steps["sent"] - steps["heard"]


def _poll(host: Brick) -> None:
    assert host.poll() is None


def _act(host: Brick) -> None:
    assert host.perform(START) == 0


def _rows(target: Target) -> list[Row]:
    figures: list[tuple[str, str, float, Unit, Callable[[], float]]] = [
        ("size", "the delivery program", LEGOLOG_SIZE, Unit.BYTES, lambda: program(target).size),
        ("op-codes", "from a poll to the answer", LEGOLOG_OP_CODES, Unit.OP_CODES, lambda: _median(target, _poll)[1]),
        ("action", "simulated time: an action", ACTION, Unit.SIMULATED, lambda: _median(target, _act)[0]),
        ("poll", "simulated time: an idle poll", POLL, Unit.SIMULATED, lambda: _median(target, _poll)[0]),
    ]
    return [
        Row(f"{name}-{target.option}", f"{work}, classic, firmware {target.firmware}", aim, unit, sample)
        for name, work, aim, unit, sample in figures
    ]


ROWS = [row for target in Target for row in _rows(target)]
