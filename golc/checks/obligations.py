"""What is to be proved of a theory: asked of a prover, counted, and reported where nobody knows."""

from __future__ import annotations

from dataclasses import dataclass, field

from golc.diagnostics import Code, Diagnostic, Findings, Label, Severity, Span
from golc.proofs.prover import Prover
from golc.proofs.questions import Question, Undecided, Witness
from golc.theory.theory import Action, BasicActionTheory
from golc.theory.types import show_call


@dataclass
class Obligations:
    """The questions about one theory, with their findings.

    ``asked`` counts them; ``undecided`` those to which no answer was found.
    """

    theory: BasicActionTheory
    prover: Prover
    findings: Findings
    asked: int = 0
    undecided: int = 0
    never_possible: set[str] = field(default_factory=set)
    """The actions that are proven never to be possible."""
    _told: set[tuple[Code, int, int]] = field(default_factory=set)

    def witness(self, question: Question, what: str, span: Span) -> Witness | None:
        """A situation in which what must not happen does; none if there is none, or if that is not decided, which is
        a finding. ``what`` completes "… is not decided"."""
        answer = self._answer(question, what, span)
        if isinstance(answer, Witness) and not answer.certain:
            self.not_decided(Undecided("it depends on what the agent knows then"), what, span)
            return None
        return answer if isinstance(answer, Witness) else None

    def is_impossible(self, question: Question, what: str, span: Span) -> bool:
        """Whether there is provably no situation; that it is not decided is a finding, unless ``what`` is empty."""
        return self._answer(question, what, span) is None

    def _answer(self, question: Question, what: str, span: Span) -> Witness | Undecided | None:
        self.asked += 1
        answer = self.prover.answer(question)
        if isinstance(answer, Undecided) and what:
            self.not_decided(answer, what, span)
        return answer

    def not_decided(self, why: Undecided, what: str, span: Span) -> None:
        """Report that nobody knows, and why."""
        self.undecided += 1
        message = f"{what} is not decided: {why.reason}"
        note = Diagnostic(Code.NOT_DECIDED, message, span, Severity.NOTE, "not decided", help=why.help)
        self.findings.add(note)

    def error(
        self, code: Code, message: str, span: Span, marker: str, note: str, labels: tuple[Label, ...] = ()
    ) -> None:
        """Report what a witness shows; the same mistake, found on several ways, once."""
        if self._is_new(code, span):
            self.findings.error(code, message, span, marker, None, labels, (note,))

    def warning(self, code: Code, message: str, span: Span, marker: str, labels: tuple[Label, ...] = ()) -> None:
        """Report what is true in no situation, or in all; once for each place."""
        if self._is_new(code, span):
            self.findings.warning(code, message, span, marker, None, labels)

    def _is_new(self, code: Code, span: Span) -> bool:
        key = (code, span.start, span.end)
        new = key not in self._told
        self._told.add(key)
        return new


def example(action: Action, witness: Witness) -> str:
    """A witness in words: the situation, and the action with its arguments."""
    args = witness.variables[: len(action.parameters)]
    verb = "happens" if action.exogenous else "is done"
    return f"for example when {witness} and `{show_call(action.name, args)}` {verb}"
