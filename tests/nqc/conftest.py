"""A workshop: a folder with a domain and NQC files, in which programs are generated and compiled by the real nqc."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import pytest

from golc.diagnostics import Diagnostic, Findings, UserError
from golc.loading import examine
from golc.nqc.generate import Generated, generate
from golc.nqc.limits import check_limits
from golc.nqc.numbering import ActionMap, number_device
from golc.nqc.toolchain import Compiled, Target, compile_program
from golc.theory.theory import BasicActionTheory


@dataclass
class Workshop:
    """``findings`` are those of the last generation."""

    folder: Path
    findings: list[Diagnostic] = field(default_factory=list)

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def theory(self, text: str) -> BasicActionTheory:
        """A domain without errors."""
        examined = examine(self.write("robot.gl", text))
        theory, found = examined.theory, examined.findings
        assert theory is not None, [str(diagnostic) for diagnostic in found]
        return theory

    def found(self, text: str) -> list[Diagnostic]:
        """What ``golc check`` finds about devices."""
        found = examine(self.write("robot.gl", text), proofs=True).findings
        return [diagnostic for diagnostic in found if "GL080" <= diagnostic.code.code <= "GL099"]

    def numbers(self, text: str) -> ActionMap:
        """The map of the only brick of a domain."""
        theory = self.theory(text)
        findings = Findings()
        actions = number_device(theory, theory.devices[0], findings)
        assert not findings.diagnostics
        return actions

    def generate(self, text: str, tones: bool = False) -> Generated | None:
        """Generate the program of the first brick into ``build``."""
        theory = self.theory(text)
        findings = Findings()
        actions = number_device(theory, theory.devices[0], findings)
        assert not findings.diagnostics
        generated = generate(theory, actions, self.folder / "build", findings, tones)
        self.findings = findings.diagnostics
        return generated

    def compile(self, text: str, target: Target = Target.RCX2) -> Compiled:
        """Generate and compile; raises UserError with what is wrong, limits included."""
        generated = self.generate(text)
        if generated is None:
            raise UserError(*self.findings)
        where = generated.actions.device.span
        findings = Findings()
        check_limits(generated.program, generated.user, generated.stubs, target, where, findings)
        if findings.diagnostics:
            raise UserError(*findings.diagnostics)
        return compile_program(generated.path, generated.folders, target, where)


@pytest.fixture
def workshop(tmp_path: Path) -> Workshop:
    return Workshop(tmp_path)
