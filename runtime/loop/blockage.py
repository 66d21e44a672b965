"""What is to be said of a program that is blocked for good."""

from __future__ import annotations

from collections.abc import Sequence

from golc.diagnostics import Code, Diagnostic, Label, ProgramError, Span
from golc.program.blame import Blocked, valued
from golc.program.labels import Act
from golc.runtime.loop.intake import Intake


def blockage(intake: Intake, branches: Sequence[Blocked], rule: Span, is_open: bool) -> ProgramError:
    """The error that says of each branch its condition and the values it had.

    ``rule`` is the place of the program where no branch is known; ``is_open``: a source might report something still.
    """
    span = branches[0].span if branches else rule
    marker = valued(branches[0]) if branches else ""
    labels = tuple([Label(branch.span, valued(branch)) for branch in branches[1:]])
    message = "the program is blocked" + ("" if is_open else ", and no source is open that could report anything")
    notes = tuple([note for branch in branches if (note := _since_the_plan(intake, branch))])
    return ProgramError(Diagnostic(Code.BLOCKED, message, span, marker=marker, labels=labels, notes=notes))


def _since_the_plan(intake: Intake, branch: Blocked) -> str | None:
    """Where a plan of ``search`` was lost, the exogenous actions since it was made."""
    if branch.actions is None:
        return None
    own, events = 0, []
    for item in reversed(intake.history):
        if not isinstance(item, Act):
            events.append(intake.dynamics.call(item.action, item.args))
            continue
        own += 1
        if own >= branch.actions:  # the first action of the plan, or the last one before it
            break
    return f"exogenous actions since the plan was made: {', '.join(reversed(events))}" if events else None
