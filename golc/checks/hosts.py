"""Python files of devices: the functions that the bindings name are there, and take as many arguments as they get."""

from __future__ import annotations

from pathlib import Path

from golc.diagnostics import Findings
from golc.nqc.numbering import implied
from golc.theory.python_text import misfit, unreadable
from golc.theory.theory import BasicActionTheory, ByCall, Device


def review_hosts(theory: BasicActionTheory, findings: Findings) -> None:
    """Look into the Python files of the devices; nothing is executed."""
    for device in theory.devices:
        if device.kind == "host":
            _review(theory, device, findings)


def _review(theory: BasicActionTheory, device: Device, findings: Findings) -> None:
    file = theory.python.file(Path(device.folder) / (device.file or ""))
    problem = unreadable(file)
    if problem is not None:
        findings.add(problem.finding(device.span))
        return
    for binding in device.bindings or implied(theory, device):
        action = theory.actions[binding.action]
        if action.exogenous:
            continue
        name, span = action.name, binding.span
        if isinstance(binding.behaviour, ByCall):
            name, span = binding.behaviour.function, binding.behaviour.span
        problem = misfit(file, name, len(action.parameters))
        if problem is not None:
            findings.add(problem.finding(span))
