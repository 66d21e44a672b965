"""The simulated machine with the delivery robot's compiled program, and golc's link as its host, in one process."""

from __future__ import annotations

import tempfile
import time
from functools import cache
from pathlib import Path

from golc.bytecode.image import Image
from golc.diagnostics import Findings
from golc.loading import load
from golc.nqc.generate import generate
from golc.nqc.numbering import number_device
from golc.nqc.toolchain import Target, compile_program
from golc.runtime.devices.rcx.brick import Brick
from golc.runtime.devices.rcx.tower import Tower
from golc.runtime.rcxsim.line import LineOptions
from golc.runtime.rcxsim.machine.options import FIRMWARES, Options
from golc.runtime.rcxsim.machine.simulator import build
from golc.runtime.rcxsim.surroundings import Bench
from golc.runtime.rcxsim.trace import Trace
from tests.bench.measure import Row, Unit
from tests.bench.startup import DELIVERY
from tests.rcxsim.virtual_port import VirtualPort

SIGNAL = 1
"""The number of an action that takes half a second on the brick."""
POLLS, PAUSE = 12, 0.25


@cache
def program(target: Target) -> Image:
    theory = load(DELIVERY)
    device = next(device for device in theory.devices if device.kind == "rcx")
    actions = number_device(theory, device, Findings())
    with tempfile.TemporaryDirectory() as folder:
        generated = generate(theory, actions, Path(folder), Findings(), False)
        assert generated is not None
        return compile_program(generated.path, generated.folders, target, device.span).image


def simulated_rate(target: Target, seconds: float = 60.0) -> float:
    """Simulated seconds a second, while a host orders actions and polls."""
    image = program(target)
    line, _ = build(FIRMWARES[image.target], image, Bench(), Options(), LineOptions(), Trace())
    port = VirtualPort(line)
    host = Brick(Tower(port))
    started = time.perf_counter()
    while port.now() < seconds:
        host.perform(SIGNAL)
        for _ in range(POLLS):
            host.poll()
            port.read(port.now() + PAUSE)
    return port.now() / (time.perf_counter() - started)


ROWS = [
    Row(
        f"machine-{target.option}",
        f"simulated seconds of delivery, firmware {target.firmware}",
        50,
        Unit.RATE,
        lambda target=target: simulated_rate(target),  # type: ignore[misc]
    )
    for target in Target
]
