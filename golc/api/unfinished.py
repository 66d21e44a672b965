"""A theory that is being written in Python shows itself: as a whole one, or as far as it has come."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from golc.api.contents import Table, as_text, declared
from golc.api.theory import Theory
from golc.diagnostics import Diagnostic, counted
from golc.loading import examine
from golc.rendering import render

if TYPE_CHECKING:
    from golc.embed.theory import Theory as Embedded


def showing(embedded: Embedded) -> Theory | Unfinished:
    """What a theory in Python shows: what ``golc.load`` makes of it, or that it makes nothing of it yet, and why.

    Its functions are translated, which calls the plain functions in them; Python code that it names (``extern``) is not
    executed.
    """
    examined = examine(embedded)
    if examined.theory is not None:
        return Theory(examined)
    written = embedded.written()
    return Unfinished(embedded.name, written.sources[0].name, declared(written.file), examined.findings)


@dataclass(frozen=True)
class Unfinished:
    """What a theory declares so far, and what is wrong with it or missing; ``path`` is where it began."""

    name: str
    path: str
    declared: Table
    findings: tuple[Diagnostic, ...]

    def __str__(self) -> str:
        head = f"domain {self.name} ({self.path}): {self.counts()}"
        return "\n\n".join([head, "\n".join(as_text(self.declared)), *map(render, self.findings)])

    def _repr_html_(self) -> str:
        from golc.notebook import unfinished_html

        return unfinished_html(self)

    def counts(self) -> str:
        """How much there is to be said about it."""
        return f"not finished, {counted(len(self.findings), 'finding')}"
