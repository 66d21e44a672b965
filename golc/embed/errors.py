"""What a Python theory may not say: findings with their place in the Python file."""

from __future__ import annotations

from collections.abc import Iterable

from golc.diagnostics import Code, Diagnostic, Label, Span, UserError
from golc.syntax import tree


class Refused(UserError):  # noqa: N818
    """A part of a theory in Python that cannot be meant; caught where the next part begins.

    ``rest`` is the declaration that is left without the parts that were passed over, ``unread``, if anything is.
    """

    rest: tree.Declaration | None = None
    unread: tuple[Span, ...] = ()

    @classmethod
    def but(cls, found: Iterable[Diagnostic], rest: tree.Declaration, unread: Iterable[Span]) -> Refused:
        """The findings about a declaration of which something is left."""
        error = cls(*found)
        error.rest, error.unread = rest, tuple(unread)
        return error


def refused(code: Code, message: str, span: Span, help: str | None = None, labels: tuple[Label, ...] = ()) -> Refused:
    """The error that carries one finding."""
    return Refused(Diagnostic(code, message, span, help=help, labels=labels))


def meaningless(message: str, span: Span, help: str | None = None) -> Refused:
    """Python that has no meaning in a theory."""
    return refused(Code.PYTHON_MEANING, message, span, help)
