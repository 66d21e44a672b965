"""Invariants: each holds in the initial state."""

from __future__ import annotations

from golc.checks.beginning import Beginning
from golc.diagnostics import Code, Diagnostic, Findings, ProgramError, Span
from golc.proofs.at_first import AtFirst
from golc.theory.closed import Closed, NoValueError
from golc.theory.errors import ExternError, NotExecutedError
from golc.theory.evaluate import Env
from golc.theory.terms import Choice, FluentTerm, PossTerm
from golc.theory.theory import BasicActionTheory, Definition
from golc.theory.types import Value


def check_invariants(theory: BasicActionTheory, beginning: Beginning | None, findings: Findings) -> None:
    """The first half of row 5 of what ``golc check`` proves: invariants are true initially.

    ``beginning`` is given if the theory leaves something open.
    """
    for name in theory.invariants:
        invariant = theory.definitions[name]
        if beginning is None:
            _check(theory, invariant, findings)
        else:
            _check_everywhere(theory, beginning, invariant, findings)


def _check_everywhere(
    theory: BasicActionTheory, beginning: Beginning, invariant: Definition, findings: Findings
) -> None:
    """Invariants hold in each of the worlds that are possible at first."""
    try:
        for case in beginning.cases(invariant.body):
            if case is None:
                _not_decided(invariant, "too many cases are possible", findings)
            elif not case[1]:
                message = f"invariant `{invariant.name}` is false in a world that is possible at first"
                notes = (f"for example where {beginning.describe(case[0])}",) if case[0] else ()
                written = invariant.span.either("initially …", "theory.initially(…)")
                help_ = f"if it is never so, say it: `{written}`"
                findings.error(
                    Code.INVARIANT_AT_FIRST, message, invariant.body.span, "not in every world", help_, notes=notes
                )
                return
    except NotExecutedError as error:
        if _holds(theory, invariant, error.diagnostic, findings) is False:
            message = f"invariant `{invariant.name}` is false in a world that is possible at first"
            findings.error(Code.INVARIANT_AT_FIRST, message, invariant.body.span, "not in every world")
    except ExternError as error:
        findings.once(error.diagnostic)
    except ProgramError as error:
        _no_value(invariant, error.diagnostic.message, error.diagnostic.span, findings)


def _check(theory: BasicActionTheory, invariant: Definition, findings: Findings) -> None:
    initially = Initially(theory)
    try:
        holds: Value = initially.value(invariant.body)
    except (NoValueError, RecursionError) as error:
        if initially.steps < 0:
            _not_decided(invariant, "it takes too many steps", findings)
            return
        reason, span = ("it is nested too deeply", invariant.body.span)
        if isinstance(error, NoValueError):
            reason, span = error.reason, error.span
            if error.finding is not None:
                if _holds(theory, invariant, error.finding, findings) is False:
                    _does_not_hold(invariant, findings)
                return
        _no_value(invariant, reason, span, findings)
        return
    if holds is not True:
        _does_not_hold(invariant, findings)


def _holds(theory: BasicActionTheory, invariant: Definition, finding: Diagnostic, findings: Findings) -> bool | None:
    """Whether an invariant holds at first; none, and what is said already, if a function of Python has no value for
    that."""
    holds = AtFirst(theory).holds(invariant.body) if finding.code is Code.NOT_EXECUTED else None
    if holds is None:
        findings.once(finding)
    return holds


def _does_not_hold(invariant: Definition, findings: Findings) -> None:
    message = f"invariant `{invariant.name}` is false in the initial state"
    findings.error(Code.INVARIANT_AT_FIRST, message, invariant.body.span, "does not hold at first")


def _not_decided(invariant: Definition, reason: str, findings: Findings) -> None:
    message = f"whether invariant `{invariant.name}` holds at first is not decided: {reason}"
    findings.warning(Code.INVARIANT_AT_FIRST, message, invariant.body.span, "evaluated only in part")


def _no_value(invariant: Definition, reason: str, span: Span, findings: Findings) -> None:
    message = f"invariant `{invariant.name}` cannot be evaluated in the initial state: {reason}"
    findings.error(Code.INVARIANT_AT_FIRST, message, span, "here")


class Initially(Closed):
    """Evaluates terms in the initial state of a theory, with a limit on steps as for constants."""

    def __init__(self, theory: BasicActionTheory) -> None:
        super().__init__(theory.statics.get, theory.definitions.get)
        self._theory = theory

    def fluent(self, term: FluentTerm, situation: None, env: Env) -> Value:
        fluent = self._theory.fluents[term.fluent]
        assert not isinstance(fluent.initial, Choice)
        args = self.arguments(fluent.name, fluent.parameters, term.args, situation, env)
        return self.evaluate(fluent.initial, situation, args)

    def poss(self, term: PossTerm, situation: None, env: Env) -> bool:
        action = self._theory.actions[term.action]
        args = self.arguments(action.name, action.parameters, term.args, situation, env)
        return self.all_hold(action.preconditions, situation, args)
