"""What golc finds in a theory that elaboration alone does not see; one family of rules a module."""

from __future__ import annotations

from golc.checks.beginning import initial_worlds, open_at_first
from golc.checks.devices import check_devices
from golc.checks.initial import check_initial
from golc.checks.invariants import check_invariants
from golc.checks.knowledge import check_knowledge
from golc.checks.names import check_names
from golc.checks.programs import check_programs
from golc.diagnostics import Diagnostic, Findings
from golc.syntax import tree
from golc.theory.theory import BasicActionTheory


def check(theory: BasicActionTheory, file: tree.File) -> list[Diagnostic]:
    """Every finding about a theory and the file that describes it, family by family."""
    findings = Findings()
    check_names(theory, file, findings)
    check_initial(theory, findings)
    if not findings.has_errors:  # an initial value that cannot be computed has been said
        beginning = initial_worlds(theory, findings) if open_at_first(theory) else None
        if beginning is not None or not open_at_first(theory):
            check_invariants(theory, beginning, findings)
        if beginning is not None:
            check_knowledge(theory, beginning, findings)
    check_programs(theory, findings)
    check_devices(theory, findings)
    return findings.diagnostics
