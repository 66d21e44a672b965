"""What is to be said of the program of a brick before it is written: its NQC files against the device's lines."""

from __future__ import annotations

from golc.diagnostics import Code, Findings
from golc.nqc.behaviours import check_behaviours, check_reports, check_timer
from golc.nqc.busy import check_rests
from golc.nqc.program import TIMER, Program, queue_of
from golc.nqc.source import NqcSource


def review(program: Program, user: NqcSource, findings: Findings) -> None:
    """Find what does not fit between the NQC files of a brick and its device; ``user`` is what the files bring."""
    actions = program.actions
    check_behaviours(actions, user, {*program.variables, *program.macros}, findings)
    check_timer(user, TIMER, findings)
    check_rests(user, findings)
    if program.sampled:
        findings.warning(
            Code.NQC_SAMPLED,
            "`exogAction` holds one event at a time: the first of two that come quickly may be lost",
            actions.device.span,
            help="report with `golc_report(EXOG_…);` instead, which loses none",
        )
    elif user.sources:
        check_reports(actions, {counter.name: counter.entry for counter in program.counters}, user, findings)
    queue = queue_of(actions)
    if program.counters and not queue.depth:
        findings.error(
            Code.NUMBER_RANGE,
            f"the numbers of the exogenous actions lie too far apart: {queue.first} to {queue.last}",
            actions.device.span,
            help="give them numbers that follow each other",
        )
