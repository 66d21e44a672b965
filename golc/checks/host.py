"""Python files of devices: the functions that the bindings name are there, with the right number of parameters."""

from __future__ import annotations

from pathlib import Path

from golc.diagnostics import Findings, Severity
from golc.nqc.numbering import implied
from golc.theory.python_text import misfit, unreadable
from golc.theory.theory import BasicActionTheory, ByCall, Device


def check_host(theory: BasicActionTheory, device: Device, findings: Findings) -> None:
    """Look into the file of a device ``host``; nothing is executed.

    That it cannot be read is a warning: what is planned needs no device.
    """
    file = theory.python.file(Path(device.folder) / (device.file or ""))
    problem = unreadable(file)
    if problem is not None:
        findings.add(problem.finding(device.span, Severity.WARNING))
        return
    for binding in device.bindings or implied(theory, device):
        action = theory.actions[binding.action]
        if action.exogenous:
            continue
        match binding.behaviour:
            case ByCall(function=name, span=span):
                problem = misfit(file, name, len(action.parameters))
            case _:
                span = binding.span
                problem = misfit(file, action.name, len(action.parameters))
        if problem is not None:
            findings.add(problem.finding(span))
