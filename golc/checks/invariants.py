"""Invariants: each holds in the initial state."""

from __future__ import annotations

from golc.diagnostics import Code, Findings
from golc.theory.closed import Closed, NoValueError
from golc.theory.evaluate import Env
from golc.theory.terms import Choice, FluentTerm, PossTerm
from golc.theory.theory import BasicActionTheory, Definition
from golc.theory.types import Value


def check_invariants(theory: BasicActionTheory, findings: Findings) -> None:
    """The first half of row 5 of what ``golc check`` proves: invariants are true initially."""
    for name in theory.invariants:
        _check(theory, theory.definitions[name], findings)


def _check(theory: BasicActionTheory, invariant: Definition, findings: Findings) -> None:
    initially = Initially(theory)
    try:
        holds = initially.value(invariant.body)
    except (NoValueError, RecursionError) as error:
        if initially.steps < 0:
            message = f"whether invariant `{invariant.name}` holds at first is not decided: it takes too many steps"
            findings.warning(Code.INVARIANT_AT_FIRST, message, invariant.body.span, "evaluated only in part")
            return
        reason, span = ("it is nested too deeply", invariant.body.span)
        if isinstance(error, NoValueError):
            reason, span = error.reason, error.span
        message = f"invariant `{invariant.name}` cannot be evaluated in the initial state: {reason}"
        findings.error(Code.INVARIANT_AT_FIRST, message, span, "here")
        return
    if holds is not True:
        message = f"invariant `{invariant.name}` is false in the initial state"
        findings.error(Code.INVARIANT_AT_FIRST, message, invariant.body.span, "does not hold at first")


class Initially(Closed):
    """Evaluates terms in the initial state of a theory, with a limit on steps as for constants."""

    def __init__(self, theory: BasicActionTheory) -> None:
        super().__init__(theory.statics.get, theory.definitions.get)
        self._theory = theory

    def fluent(self, term: FluentTerm, situation: None, env: Env) -> Value:
        fluent = self._theory.fluents[term.fluent]
        if isinstance(fluent.initial, Choice):
            raise NoValueError(f"`{fluent.name}` has several possible initial values", term.span)
        args = self.arguments(fluent.name, fluent.parameters, term.args, situation, env)
        return self.evaluate(fluent.initial, situation, args)

    def poss(self, term: PossTerm, situation: None, env: Env) -> bool:
        action = self._theory.actions[term.action]
        args = self.arguments(action.name, action.parameters, term.args, situation, env)
        return self.all_hold(action.preconditions, situation, args)
