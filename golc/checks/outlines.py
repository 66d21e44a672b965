"""What can be said of an outline, which is what errors have left of a theory: of its devices."""

from __future__ import annotations

from dataclasses import replace

from golc.checks.bricks import RCX
from golc.checks.devices import check_settings
from golc.diagnostics import Findings, Severity
from golc.nqc.numbering import number_device
from golc.theory.fitting import BROKEN
from golc.theory.theory import BasicActionTheory, Binding, Parameter


def check_outline(outline: BasicActionTheory, findings: Findings) -> None:
    """The errors in the settings of devices and in the numbers of their actions. Who does an action, and who reports
    one, only a whole theory says."""
    found, wrong = Findings(), {(finding.span.source, finding.span.line) for finding in findings.diagnostics}
    for device in outline.devices:
        check_settings(device, found)
        lines = [binding for binding in device.bindings if (binding.span.source, binding.span.line) not in wrong]
        sound = tuple([binding for binding in lines if _is_sound(outline, binding)])
        if device.kind == RCX and sound:
            number_device(outline, replace(device, bindings=sound), found)
    findings.diagnostics += [finding for finding in found.diagnostics if finding.severity is Severity.ERROR]


def _is_sound(outline: BasicActionTheory, binding: Binding) -> bool:
    """Whether the types of a binding's arguments, and of what its action senses, are known."""
    action = outline.actions.get(binding.action)
    if action is None:
        return False
    arguments = [slot.type for slot in binding.args if isinstance(slot, Parameter)]
    return BROKEN not in [*arguments, *(sensed.type for sensed in action.senses)]
