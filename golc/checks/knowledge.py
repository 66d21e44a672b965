"""Knowledge: conditions and values that the agent can never know (row 7 of what ``golc check`` proves).

Only what is certain is reported: a term of a program or of a precondition that reads hidden fluents, and whose value
differs from one possible world to another, so that a program stops there or a test never succeeds.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, TypeAlias

from golc.checks.beginning import Beginning
from golc.checks.hidden import UNKNOWN, Hidden, UndecidedError
from golc.diagnostics import Code, Findings, Label
from golc.theory import statements as typed
from golc.theory.calls import substatements
from golc.theory.statements import Statement
from golc.theory.terms import Term
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value

Use: TypeAlias = Literal["test", "decision", "value"]
"""What a term is for: it has to be known to be true, to be true or false, or to have some value."""


def check_knowledge(theory: BasicActionTheory, beginning: Beginning, findings: Findings) -> None:
    """Warn of what is asked that can never be known."""
    hidden = Hidden(theory, beginning)
    if not hidden.fluents:
        return
    for term, use in _uses(theory):
        fluents = hidden.read_by(term)
        problem = _problem(use, hidden.answers(term)) if fluents else None
        if problem is not None:
            _report(theory, term, fluents, use, problem, findings)


def _problem(use: Use, answers: Iterator[Value]) -> str | None:
    """What can never be known of a term; none if it does not matter, or there is no telling."""
    found: set[Value] = set()
    try:
        for answer in answers:
            found.add(answer)
            if _harmless(use, found - {UNKNOWN}):
                return None
    except UndecidedError:
        return None
    if UNKNOWN not in found:
        return None
    match use:
        case "value":
            return "what `{}` is"
        case "decision" if len(found) == 1:
            return "whether `{}` is true"
        case "decision" if True in found:
            return "that `{}` is false"
        case _:
            return "that `{}` is true"


def _harmless(use: Use, certain: set[Value]) -> bool:
    """Whether there are cases in which enough is known."""
    match use:
        case "value":
            return bool(certain)
        case "test":
            return True in certain
        case "decision":
            return {True, False} <= certain


def _report(
    theory: BasicActionTheory, term: Term, fluents: list[str], use: Use, problem: str, findings: Findings
) -> None:
    text = " ".join(term.span.text.split())
    named = " and ".join(f"`{name}`" for name in fluents)
    findings.warning(
        Code.NEVER_KNOWN,
        f"it can never be known {problem.format(text)}",
        term.span,
        "never succeeds" if use == "test" else "the program stops where it is not known",
        f"let an action sense {named}, or ask what is known: `knows(…)`, `known(…)`, `possible(…)`",
        tuple(Label(theory.fluents[name].span, "unknown at first, and nothing senses or sets it") for name in fluents),
    )


def _uses(theory: BasicActionTheory) -> Iterator[tuple[Term, Use]]:
    """Every term that has to be known, with what it is for."""
    for action in theory.actions.values():
        for condition in () if action.exogenous else action.preconditions:
            yield condition, "test"
    for procedure in theory.procedures.values():
        for statement in substatements(procedure.body):
            yield from _used(statement)


def _used(statement: Statement) -> Iterator[tuple[Term, Use]]:
    """The terms of a statement itself, not of those inside it."""
    terms: tuple[object, ...] = ()
    match statement:
        case typed.If(condition=condition) | typed.While(condition=condition):
            yield condition, "decision"
        case typed.Test(condition=condition) | typed.WaitUntil(condition=condition) | typed.Guard(condition=condition):
            yield condition, "test"
        case typed.Interrupts(handlers=handlers):
            for handler in handlers:
                yield handler.condition, "test"
                terms = (*terms, *[binder.within for binder in handler.binders])
        case typed.Pick(binders=binders, where=where) | typed.For(binders=binders, where=where):
            if where is not None:
                yield where, "decision" if isinstance(statement, typed.For) else "test"
            terms = tuple([binder.within for binder in binders])
        case typed.Perform(args=args) | typed.Invoke(args=args):
            terms = args
        case typed.Let(value=value):
            terms = (value,)
        case typed.Star(limit=limit):
            terms = (limit,)
        case typed.Search(steps=steps, seconds=seconds):
            terms = (steps, seconds)
        case typed.Within(seconds=seconds) | typed.WaitTime(seconds=seconds):
            terms = (seconds,)
    for term in terms:
        if isinstance(term, Term):
            yield term, "value"
