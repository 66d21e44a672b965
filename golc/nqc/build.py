"""The compiled program of a brick, generated for the occasion: beside the domain nothing is written."""

from __future__ import annotations

import shutil
from pathlib import Path

from golc.diagnostics import Findings, Severity, UserError
from golc.nqc.actionmap import ActionMap
from golc.nqc.generate import generate
from golc.nqc.limits import check_limits
from golc.nqc.toolchain import Compiled, Target, compile_program
from golc.theory.theory import BasicActionTheory

GENERATED = ("*.nqc", "*.nqh")


def build(theory: BasicActionTheory, actions: ActionMap, target: Target, folder: Path) -> Compiled:
    """Generate and compile the program of a brick in an empty folder.

    What somebody has edited in ``build/`` beside the domain is taken as it is there. Raises UserError if the brick's
    files do not fit, nqc refuses the program or it is too large; DeviceError if nqc is missing.
    """
    edited = Path(theory.source.name).parent / "build"
    for pattern in GENERATED:
        for file in edited.glob(pattern):
            shutil.copy(file, folder)
    findings = Findings()
    generated = generate(theory, actions, folder, findings)
    where = actions.device.span
    if generated is not None:
        check_limits(generated.program, generated.user, generated.stubs, target, where, findings)
    if generated is None or findings.has_errors:
        raise UserError(*[found for found in findings.diagnostics if found.severity is Severity.ERROR])
    return compile_program(generated.path, generated.folders, target, where)
