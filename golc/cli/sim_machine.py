"""``golc sim`` for byte code: the machine and its program, and how it stands at the end."""

from __future__ import annotations

import dataclasses
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from golc.cli.sim_options import ByteCode

if TYPE_CHECKING:
    from golc.bytecode.image import Image
    from golc.nqc.toolchain import Target
    from golc.runtime.rcxsim.line import Line, LineOptions
    from golc.runtime.rcxsim.machine.brick import MachineBrick
    from golc.runtime.rcxsim.machine.machine import Machine
    from golc.runtime.rcxsim.surroundings import Surroundings
    from golc.runtime.rcxsim.trace import Trace

REST = 0.0005
"""Real seconds that the process sleeps at least, since a machine always has something to do."""

SLICE = 0.1
"""Simulated seconds from one look at whether the program has failed to the next."""
COMPILED, SOURCE = ".rcx", ".nqc"


def is_byte_code(path: Path | None) -> bool:
    """Whether a file is a program for the machine, or there is none: otherwise it is a domain."""
    return path is None or path.suffix.lower() in (COMPILED, SOURCE)


def read_program(path: Path, target: Target, constants: Mapping[str, str]) -> Image:
    """The image in a file, or that of an NQC file or of a domain's brick, compiled for a target.

    Raises UserError with what is wrong; ``constants`` are those of a domain that are replaced.
    """
    from golc.bytecode.image import read_image
    from golc.diagnostics import DeviceError

    if path.suffix.lower() == SOURCE:
        return _compile(path, target)
    if not is_byte_code(path):
        return _compile_domain(path, target, constants)
    try:
        return read_image(path.read_bytes())
    except OSError as error:
        raise refused(path, error.strerror or str(error)) from None
    except DeviceError as error:
        raise refused(path, str(error)) from None


def refused(path: Path, reason: str) -> Exception:
    """The error that a program cannot be loaded."""
    from golc.diagnostics import Code, Diagnostic, Source, Span, UserError

    return UserError(Diagnostic(Code.IMAGE, f"cannot load `{path}`: {reason}", Span(Source(str(path), ""), 0, 0)))


def _compile(path: Path, target: Target) -> Image:
    from golc.diagnostics import Span
    from golc.nqc.toolchain import compile_program
    from golc.nqc.userfiles import read_nqc

    source = read_nqc(path)
    if source is None:
        raise refused(path, "No such file or directory")
    with tempfile.TemporaryDirectory() as folder:
        return compile_program(path, (), target, Span(source, 0, 0), Path(folder) / "program.rcx").image


def _compile_domain(path: Path, target: Target, constants: Mapping[str, str]) -> Image:
    from golc.loading import load
    from golc.nqc.build import build
    from golc.runtime.rcxsim.theory.simulator import bricks

    theory = load(path, constants)
    first, *others = bricks(theory)
    if others:
        names = ", ".join(actions.device.name for actions in (first, *others))
        raise refused(path, f"there is one brick in a world, and the domain has {names}")
    with tempfile.TemporaryDirectory() as folder:
        return build(theory, first.device, target, Path(folder)).image


class Simulation:
    """A machine with the program of a file, or an empty one; raises ``UserError`` if anything is wrong with it.

    ``room`` is what is around it: without one its inputs and outputs are open. ``constants`` are those of a domain that
    are replaced.
    """

    def __init__(
        self,
        file: Path | None,
        asked: ByteCode,
        seed: int,
        room: Surroundings | None,
        trace: Trace,
        constants: Mapping[str, str],
    ) -> None:
        from golc.nqc.toolchain import Target
        from golc.runtime.rcxsim.machine.options import FIRMWARES, Firmware, Options
        from golc.runtime.rcxsim.surroundings import Bench

        chosen = next((one for one in Target if one.option == asked.target), Target.RCX2)
        self._file = file
        self._image = None if file is None else read_program(file, chosen, constants)
        self._firmware = Firmware.V1 if chosen is Target.RCX else Firmware.V2
        if self._image is not None and asked.target is None:
            self._firmware = FIRMWARES[self._image.target]
        self._options = Options(seed=seed, **asked.firmware)
        self._surroundings = room or Bench()
        self._trace = trace

    def line(self, options: LineOptions) -> Line:
        """The line to the brick, whose program has been started."""
        return self._build(options)[0]

    def shown(self, asked: ByteCode, options: LineOptions) -> list[str]:
        """What is asked for that needs no port, in lines."""
        if asked.seconds is not None:
            return self.run(asked.seconds, options)
        return self.listing() if asked.steps is None else self.finish(asked.steps, options)

    def listing(self) -> list[str]:
        """The op codes of the program."""
        from golc.bytecode.listing import listing

        assert self._image is not None
        return listing(self._image).splitlines()

    def run(self, seconds: float, options: LineOptions) -> list[str]:
        """Let time pass at once; how the brick stands then. Raises MachineError if the program cannot be executed."""
        line, brick = self._build(dataclasses.replace(options, sleep=None))  # with no host no tower need be awake
        now = 0.0
        while now < seconds:
            now = min(now + SLICE, seconds)
            _advance(line, brick, now)
        return list(_standing(brick.machine, self._image))

    def finish(self, steps: int, options: LineOptions) -> list[str]:
        """Let time pass until the program has ended; how the brick stands then.

        Raises MachineError if the program cannot be executed, LimitError if it has not ended after so many steps: op
        codes, or, where it waits, looks at the surroundings.
        """
        from golc.diagnostics import LimitError

        line, brick = self._build(dataclasses.replace(options, sleep=None))
        machine, now = brick.machine, 0.0
        while machine.processor.running:
            if max(machine.steps, machine.looks) > steps:
                raise LimitError(f"{'; '.join(_running(machine))}: the program has not ended after {steps} steps")
            now += SLICE
            _advance(line, brick, now)
        return list(_standing(machine, self._image))

    def _build(self, options: LineOptions) -> tuple[Line, MachineBrick]:
        from golc.diagnostics import DeviceError
        from golc.runtime.rcxsim.machine.simulator import build

        try:
            return build(self._firmware, self._image, self._surroundings, self._options, options, self._trace)
        except DeviceError as error:
            assert self._file is not None
            raise refused(self._file, str(error)) from None


def _advance(line: Line, brick: MachineBrick, now: float) -> None:
    line.advance(now)
    if brick.error is not None:
        raise brick.error


def _running(machine: Machine) -> list[str]:
    """Where each task is that is running."""
    return [f"{task.code}, address {task.place}" for task in machine.processor.tasks if task.code is not None]


def _standing(machine: Machine, image: Image | None) -> Iterator[str]:
    """What runs, what the motors do, the values of the variables."""
    from golc.bytecode.image import SYMBOL_OF_VARIABLE
    from golc.runtime.rcxsim.machine.outputs import NAMES
    from golc.runtime.rcxsim.machine.values import VARIABLES
    from golc.runtime.rcxsim.surroundings import Mode

    yield f"{machine.seconds:.3f} s, {'; '.join(_running(machine)) or 'no task is running'}"
    for name, output in zip(NAMES, machine.outputs.now, strict=True):
        if output.mode is Mode.ON:
            yield f"motor {name} on, {'forward' if output.forward else 'reverse'}, power {output.power}"
        else:
            yield f"motor {name} {output.mode.value}"
    for symbol in () if image is None else image.symbols:
        if symbol.type == SYMBOL_OF_VARIABLE and symbol.number < VARIABLES:
            yield f"{symbol.name} = {machine.variables[symbol.number]}"
