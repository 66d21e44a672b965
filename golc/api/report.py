"""What `golc check` has to say, as a value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from golc.diagnostics import Diagnostic, Severity, counted
from golc.loading import Examined, with_behaviours, with_proofs
from golc.proofs.reachable import Scope
from golc.rendering import render
from golc.reporting.ignores import heed

if TYPE_CHECKING:
    from golc.api.theory import Theory


@dataclass(frozen=True)
class Report:
    """The findings about a domain in the order of their places, without those that its comments leave out.

    ``theory``: what was checked; none if it has errors. ``asked``: how many questions about all situations were put;
    ``undecided``: how many of them were not decided; ``scope``: which states can be reached, if that was asked. As text
    it is what ``golc check`` writes.
    """

    findings: tuple[Diagnostic, ...]
    theory: Theory | None
    asked: int = 0
    undecided: int = 0
    scope: Scope | None = None

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        """The findings that keep the domain from being used."""
        return tuple([finding for finding in self.findings if finding.severity is Severity.ERROR])

    @property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """The findings that do not."""
        return tuple([finding for finding in self.findings if finding.severity is Severity.WARNING])

    def __str__(self) -> str:
        return "\n\n".join(map(render, self.findings)) or self.counts()

    def __repr__(self) -> str:
        return f"<Report: {self.counts()}>"

    def _repr_html_(self) -> str:
        from golc.notebook import report_html

        return report_html(self)

    def counts(self) -> str:
        """``2 errors, 1 warning``, or that nothing was found."""
        pairs = ((len(self.errors), "error"), (len(self.warnings), "warning"))
        open_ = f"; {counted(self.undecided, 'question')} not decided" if self.undecided else ""
        return (", ".join([counted(*pair) for pair in pairs if pair[0]]) or "nothing found") + open_


def report_of(examined: Examined, theory: Theory | None, proofs: bool, reachable: bool) -> Report:
    """The report about what was examined; with ``proofs`` also what takes all situations into account, or all that
    are ``reachable``."""
    found = with_proofs(examined, reachable) if proofs else examined
    if examined.theory is not None:
        found = with_behaviours(found, examined.theory)
    theory = None if found.theory is None else theory
    return Report(heed(found, proofs), theory, found.asked, found.undecided, found.scope)
