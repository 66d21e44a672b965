"""Programs: interrupts that stand where they are never reached."""

from __future__ import annotations

import itertools

from golc.diagnostics import Code, Findings, Label
from golc.theory import statements as typed
from golc.theory.calls import substatements
from golc.theory.closed import Closed, NoValueError
from golc.theory.statements import Interrupt, Statement
from golc.theory.terms import FluentTerm, Literal, Operation, Operator, PossTerm, Term, Variable, subterms
from golc.theory.theory import BasicActionTheory


def check_programs(theory: BasicActionTheory, findings: Findings) -> None:
    """The part of row 1 that is about branches below ``on true``."""
    for procedure in theory.procedures.values():
        for statement in substatements(procedure.body):
            if isinstance(statement, typed.Interrupts):
                _check_interrupts(theory, statement.handlers, findings)


def _check_interrupts(theory: BasicActionTheory, handlers: tuple[Interrupt, ...], findings: Findings) -> None:
    for index, handler in enumerate(handlers):
        below = handlers[index + 1 :]
        may_be_empty = any(binder.within is not None for binder in handler.binders)
        if below and not may_be_empty and _always(theory, handler.condition):
            _hides_all(handler, below[0], steps_always(theory, handler.body), findings)
            return  # what is below is not reached, so nothing more is to be said of it
        if not handler.binders and steps_always(theory, handler.body):
            for lower in below:
                if _implies(lower.condition, handler.condition):
                    _hides_one(handler, lower, findings)


def _hides_all(handler: Interrupt, below: Interrupt, certain: bool, findings: Findings) -> None:
    condition = handler.condition.span
    on = condition.either(f"on {condition.text}", f"on({condition.text})")
    written = f"`{on}`" if not handler.binders else "an interrupt that is always true"
    reached = "never" if certain else "only when its block cannot begin"
    findings.warning(
        Code.UNREACHABLE,
        f"{written} stands above other interrupts, which are {reached} reached",
        handler.condition.span,
        "always true",
        labels=(Label(below.condition.span, f"from here on {reached} reached"),),
        help="move it to the end: the first interrupt that can step has the turn",
    )


def _hides_one(handler: Interrupt, lower: Interrupt, findings: Findings) -> None:
    findings.warning(
        Code.UNREACHABLE,
        "this interrupt is never reached: whenever it could fire, a higher one does",
        lower.condition.span,
        "never reached",
        labels=(Label(handler.condition.span, "true whenever the lower one is"),),
        help="put the special case above the general one",
    )


def _always(theory: BasicActionTheory, condition: Term) -> bool:
    """Whether a condition is true in every situation, as far as that shows without looking at any."""
    if isinstance(condition, Literal):
        return condition.value is True
    if any(isinstance(part, (FluentTerm, PossTerm, Variable)) for part in subterms(condition)):
        return False
    try:
        return Closed(theory.statics.get, theory.definitions.get, steps=1000).value(condition) is True
    except NoValueError:
        return False


def steps_always(theory: BasicActionTheory, statement: Statement) -> bool:
    """Whether a program can make its first step in every situation, as far as its form shows that."""
    entered: set[str] = set()
    while True:
        match statement:
            case typed.Wait() | typed.WaitTime() | typed.Say() | typed.Abort():
                return True
            case typed.Perform(action=name, args=args):
                return not theory.actions[name].preconditions and all(isinstance(arg, Literal) for arg in args)
            case typed.Sequence(parts=parts):
                statement = next((part for part in parts if not isinstance(part, typed.Skip)), parts[0])
            case typed.Invoke(procedure=name) if name not in entered:
                entered.add(name)
                statement = theory.procedures[name].body
            case _:
                return False


def _implies(lower: Term, higher: Term) -> bool:
    """Whether one formula follows from another because it is one of its parts (or the other way round)."""
    if not (_small(lower) and _small(higher)):
        return False
    known = set(_parts(lower, Operator.AND))
    return any(known.issuperset(_parts(choice, Operator.AND)) for choice in _parts(higher, Operator.OR))


def _parts(term: Term, op: Operator) -> tuple[Term, ...]:
    return term.args if isinstance(term, Operation) and term.op is op else (term,)


def _small(term: Term) -> bool:
    """Comparing terms recurs into them, which only a small one is safe for."""
    return sum(1 for _ in itertools.islice(subterms(term), 100)) < 100
