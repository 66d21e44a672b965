"""What is to be proved of a theory: asked of a prover, counted, and reported where nobody knows."""

from __future__ import annotations

from dataclasses import dataclass, field

from golc.diagnostics import Code, Diagnostic, Findings, Label, Severity, Span
from golc.proofs.among import Among
from golc.proofs.prover import Prover
from golc.proofs.questions import Question, Undecided, Witness
from golc.theory.theory import Action, BasicActionTheory, Static
from golc.theory.types import show_call


@dataclass
class Obligations:
    """The questions about one theory, with their findings.

    ``asked`` counts them; ``undecided`` those to which no answer was found.
    """

    theory: BasicActionTheory
    prover: Prover | Among
    findings: Findings
    asked: int = 0
    undecided: int = 0
    never_possible: set[str] = field(default_factory=set)
    """The actions that are proven never to be possible."""
    _told: set[tuple[Code, int, int]] = field(default_factory=set)

    def witness(self, question: Question, what: str, span: Span) -> Witness | None:
        """A situation in which what must not happen does; none if there is none, or if that is not decided, which is
        a finding. ``what`` completes "… is not decided"."""
        answer = self._answer(question, what, span, small=True)
        if isinstance(answer, Witness) and not answer.certain:
            self.not_decided(Undecided("it depends on what the agent knows then"), what, span)
            return None
        return answer if isinstance(answer, Witness) else None

    def is_impossible(self, question: Question, what: str, span: Span) -> bool:
        """Whether there is provably no situation; that it is not decided is a finding, unless ``what`` is empty."""
        return self._answer(question, what, span, small=False) is None

    def _answer(self, question: Question, what: str, span: Span, small: bool) -> Witness | Undecided | None:
        self.asked += 1
        answer = self.prover.answer(question, small)
        if isinstance(answer, Undecided) and what:
            self.not_decided(answer, what, span)
        return answer

    def not_decided(self, why: Undecided, what: str, span: Span) -> None:
        """Report that nobody knows, and why."""
        self.undecided += 1
        if why.function is not None:
            self._not_executed(self.theory.statics[why.function])
            return
        message = f"{what} is not decided: {why.reason}"
        note = Diagnostic(Code.NOT_DECIDED, message, span, Severity.NOTE, "not decided", help=why.help)
        self.findings.add(note)

    def _not_executed(self, static: Static) -> None:
        """Say once that a function of Python would decide something."""
        if self._is_new(Code.NOT_DECIDED, static.span):
            message = f"not all that depends on `{static.name}` is decided: its file is not executed"
            help_ = "`--trust` would decide it: it executes the file"
            self.findings.add(
                Diagnostic(Code.NOT_DECIDED, message, static.span, Severity.NOTE, "a function of Python", help=help_)
            )

    def error(
        self,
        code: Code,
        message: str,
        span: Span,
        marker: str,
        action: Action,
        witness: Witness,
        labels: tuple[Label, ...] = (),
    ) -> None:
        """Report what a witness shows of an action; the same mistake, found on several ways, once."""
        if self._is_new(code, span):
            self.findings.error(code, message, span, marker, None, labels, self._example(action, witness))

    def warning(self, code: Code, message: str, span: Span, marker: str, labels: tuple[Label, ...] = ()) -> None:
        """Report what is true in no situation, or in all; once for each place."""
        if self._is_new(code, span):
            self.findings.warning(code, message, span, marker, None, labels, self._where())

    @property
    def everywhere(self) -> str:
        """In which situations something is so that is so in all."""
        return "in every state that can be reached" if self._where() else "in every situation"

    def _where(self) -> tuple[str, ...]:
        """Which states were gone through for what the last question found in none of them."""
        scope = self.prover.nowhere if isinstance(self.prover, Among) else None
        return () if scope is None else (str(scope),)

    def _example(self, action: Action, witness: Witness) -> tuple[str, ...]:
        """A witness in words: the situation, and the action with its arguments; how the situation is reached."""
        args = witness.variables[: len(action.parameters)]
        verb = "happens" if action.exogenous else "is done"
        done = f"`{show_call(action.name, args)}` {verb}"
        shown = (
            f"for example when {witness} and {done}"
            if witness.fluents
            else f"for example when {done}, in any situation"
        )
        if not isinstance(self.prover, Among):
            return (shown,)
        if witness.way is None:
            return shown, "whether this situation can be reached is not known"
        steps = ", ".join(witness.way)
        return shown, f"this is reached by {steps}" if steps else "this is so at first"

    def _is_new(self, code: Code, span: Span) -> bool:
        key = (code, span.start, span.end)
        new = key not in self._told
        self._told.add(key)
        return new
