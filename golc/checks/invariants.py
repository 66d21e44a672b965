"""Invariants: each holds in the initial state."""

from __future__ import annotations

from dataclasses import dataclass

from golc.diagnostics import Code, Findings
from golc.theory.closed import Closed, Env, NoValueError
from golc.theory.terms import Choice, FluentTerm, PossTerm, Term
from golc.theory.theory import BasicActionTheory, Definition
from golc.theory.types import Value


def check_invariants(theory: BasicActionTheory, findings: Findings) -> None:
    """The first half of row 5 of what ``golc check`` proves: invariants are true initially."""
    for name in theory.invariants:
        _check(theory, theory.definitions[name], findings)


def _check(theory: BasicActionTheory, invariant: Definition, findings: Findings) -> None:
    initially = Initially(theory.statics.get, theory.definitions.get, theory=theory)
    try:
        holds = initially.evaluate(invariant.body)
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


@dataclass
class Initially(Closed):
    """Evaluates terms in the initial state of a theory, with a limit on steps as for constants."""

    theory: BasicActionTheory | None = None

    def evaluate(self, term: Term, env: Env = ()) -> Value:
        """The value of a term; fluents have their initial values."""
        theory = self.theory
        match term:
            case FluentTerm(fluent=name, args=args) if theory is not None:
                fluent = theory.fluents[name]
                if isinstance(fluent.initial, Choice):
                    raise NoValueError(f"`{name}` has several possible initial values", term.span)
                return self.evaluate(fluent.initial, self._arguments(name, fluent.parameters, args, env))
            case PossTerm(action=name, args=args) if theory is not None:
                action = theory.actions[name]
                inner = self._arguments(name, action.parameters, args, env)
                value: Value = True
                for condition in action.preconditions:
                    value = value and self.evaluate(condition, inner)
                return value
            case _:
                return super().evaluate(term, env)
