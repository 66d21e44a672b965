"""What can be said of devices although there are errors elsewhere in the theory."""

from __future__ import annotations

from itertools import product

from golc.checks.devices import check_devices
from golc.diagnostics import Findings, Severity, Span
from golc.syntax import tree
from golc.syntax.keywords import closest
from golc.theory.context import WORD
from golc.theory.elaborate import is_about
from golc.theory.theory import BasicActionTheory


def check_devices_anyway(outline: BasicActionTheory, file: tree.File, findings: Findings) -> None:
    """The errors that ``check_devices`` finds in what errors have left of a theory.

    Nothing if one of them is in a device, or in what may be a device or bring one: who does an action is then unknown.
    """
    devices = [node.span for node in file.declarations if isinstance(node, tree.Device)]
    wrong = [*(finding.span for finding in findings.diagnostics), *file.unread]
    imports = any(isinstance(node, tree.Import) for node in file.declarations)
    if imports or any(map(_may_be_a_device, file.unread)) or any(_meet(*pair) for pair in product(devices, wrong)):
        return
    found = Findings()
    check_devices(outline, found)
    findings.diagnostics += [
        finding
        for finding in found.diagnostics
        if finding.severity is Severity.ERROR and not is_about(finding, file.unread)
    ]


def _may_be_a_device(unread: Span) -> bool:
    first = WORD.match(unread.text)
    return first is not None and closest(first[0], ["device", "import"]) is not None


def _meet(one: Span, other: Span) -> bool:
    return one.source is other.source and one.start <= other.end and other.start <= one.end
