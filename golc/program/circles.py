"""Programs that step and step without anything happening."""

from __future__ import annotations

from golc.diagnostics import Code, Diagnostic, ProgramError, Span
from golc.theory.forms import word

CIRCLES = 100_000
"""Steps in a row without an action or an event after which a program is said to run in circles."""


def runs_in_circles(span: Span) -> ProgramError:
    """The error of a program that has made so many steps; ``span`` is the place of the last."""
    message = f"the program runs in circles: {CIRCLES} steps without an action or an event"
    help_ = f"let it act, or `{word('wait', span)}` for an event, in every round"
    return ProgramError(Diagnostic(Code.RUNS_IN_CIRCLES, message, span, help=help_))
