"""The whole way from a theory to the program of a brick: generated, checked, and compiled for the occasion."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from golc.diagnostics import Diagnostic, Findings, UserError
from golc.nqc.download import Heard, download
from golc.nqc.generate import Generated, generate
from golc.nqc.limits import check_limits
from golc.nqc.numbering import number_device
from golc.nqc.toolchain import Compiled, Target, compile_program
from golc.theory.theory import BasicActionTheory, Device

GENERATED = ("*.nqc", "*.nqh")


@dataclass(frozen=True)
class BrickProgram:
    """The NQC program of a brick, as it was written: ``generated`` says where and what, ``warnings`` what to mind."""

    generated: Generated
    target: Target
    warnings: tuple[Diagnostic, ...]

    @property
    def path(self) -> Path:
        """The file that nqc compiles."""
        return self.generated.path

    @cached_property
    def compiled(self) -> Compiled:
        """The program as nqc has compiled it, when this was first asked, with what it takes of the brick.

        Raises ``UserError`` if nqc refuses the program or it is too large, ``DeviceError`` if nqc is missing.
        """
        return compile_program(self.path, self.generated.folders, self.target, self.generated.actions.device.span)

    def download(self, port: str, slot: int | None = None, heard: Heard = lambda text: None) -> None:
        """Send the compiled program to a brick, into a slot (1 to 5) or the one that is selected there.

        ``port`` is the path of a tty, or ``usb:`` and a path; ``heard`` gets nqc's progress as it comes. Raises
        ``DeviceError`` if the brick does not take it.
        """
        download(self.compiled.path, self.target, port, slot, heard)


def brick_program(
    theory: BasicActionTheory, device: Device, folder: Path, target: Target, tones: bool = False
) -> BrickProgram:
    """Write the program of a brick into a folder; raises ``UserError`` with all findings if one is an error."""
    findings = Findings()
    actions = number_device(theory, device, findings)
    generated = None if findings.has_errors else generate(theory, actions, folder, findings, tones)
    if generated is not None:
        check_limits(generated.program, generated.user, generated.stubs, target, device.span, findings)
    if generated is None or findings.has_errors:
        raise UserError(*findings.diagnostics)
    return BrickProgram(generated, target, tuple(findings.diagnostics))


def build(theory: BasicActionTheory, device: Device, target: Target, folder: Path) -> Compiled:
    """Generate and compile the program of a brick in an empty folder.

    What somebody has edited in ``build/`` beside the domain is taken as it is there. Raises UserError if the brick's
    files do not fit, nqc refuses the program or it is too large; DeviceError if nqc is missing.
    """
    edited = Path(theory.source.name).parent / "build"
    for pattern in GENERATED:
        for file in edited.glob(pattern):
            shutil.copy(file, folder)
    return brick_program(theory, device, folder, target).compiled
