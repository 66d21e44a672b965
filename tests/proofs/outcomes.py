"""What formulas are in single situations."""

from __future__ import annotations

from collections.abc import Callable

from golc.diagnostics import ProgramError


def outcome(evaluate: Callable[..., object], state: tuple[object, ...]) -> bool | None:
    """Whether a formula is true; none if it has no value."""
    try:
        return bool(evaluate(state, ()))
    except ProgramError:
        return None
