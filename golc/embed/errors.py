"""What a Python theory may not say: findings with their place in the Python file."""

from __future__ import annotations

from golc.diagnostics import Code, Diagnostic, Label, Span, UserError


class Refused(UserError):  # noqa: N818
    """A part of a theory in Python that cannot be meant; caught where the next part begins."""


def refused(code: Code, message: str, span: Span, help: str | None = None, labels: tuple[Label, ...] = ()) -> Refused:
    """The error that carries one finding."""
    return Refused(Diagnostic(code, message, span, help=help, labels=labels))


def meaningless(message: str, span: Span, help: str | None = None) -> Refused:
    """Python that has no meaning in a theory."""
    return refused(Code.PYTHON_MEANING, message, span, help)
