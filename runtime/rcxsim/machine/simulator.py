"""Puts a simulated brick with a machine together: a line, and the machine at its end."""

from __future__ import annotations

import random

from golc.bytecode.image import Image
from golc.runtime.rcxsim.line import Line, LineOptions
from golc.runtime.rcxsim.machine.brick import MachineBrick
from golc.runtime.rcxsim.machine.options import Firmware, Options
from golc.runtime.rcxsim.surroundings import Surroundings
from golc.runtime.rcxsim.trace import Trace


def build(
    firmware: Firmware,
    image: Image | None,
    surroundings: Surroundings,
    options: Options,
    line: LineOptions,
    trace: Trace,
) -> tuple[Line, MachineBrick]:
    """The line to a brick with a program in its first slot, which has been started; without one, to an empty brick.

    Raises DeviceError if the image is no program that fits. What goes wrong on the line depends on the seed of the
    options, too, but in a stream of its own.
    """
    brick = MachineBrick(firmware, surroundings, trace, options)
    if image is not None:
        brick.machine.load(image)
        brick.machine.start(0)
    return Line(brick, line, random.Random(f"{options.seed}: noise"), trace), brick
