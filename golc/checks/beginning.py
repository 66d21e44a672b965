"""The initial situation of a theory that leaves something open: which worlds are possible, and what holds in them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace

from golc.diagnostics import Code, Findings, Label, ProgramError
from golc.situation.dynamics import Dynamics
from golc.situation.knowing import placed
from golc.situation.worlds import Assignment, State, Worlds, survey
from golc.theory.reading import fluents_read
from golc.theory.terms import Choice, Term
from golc.theory.theory import BasicActionTheory
from golc.theory.types import show, show_call

MOST = 10_000
"""How many cases of what is possible are gone through before a formula is left undecided."""


@dataclass(frozen=True)
class Beginning:
    """What is possible at first."""

    dynamics: Dynamics
    state: State

    def cases(self, formula: Term) -> Iterator[tuple[Assignment, bool] | None]:
        """Whether a formula holds in each case that it distinguishes; ends with None if they are too many."""
        compiled = self.dynamics.compiler.term(formula, 0)
        with placed((formula,)):
            for number, (case, holds) in enumerate(survey(self.state, lambda world: compiled(world, ()))):
                if number == MOST:
                    yield None
                    return
                yield case, bool(holds)

    def describe(self, case: Assignment) -> str:
        """What is true in a case."""
        assert isinstance(self.state, Worlds)
        names, factors = self.dynamics.layout.ground_fluents, self.state.factors
        pairs = [pair for number, row in case for pair in zip(factors[number].slots, row, strict=True)]
        shown = [f"{show_call(*names[slot])} = {show(value)}" for slot, value in sorted(pairs)]
        return ", ".join(shown[:5]) + (", …" if len(shown) > 5 else "")


def open_at_first(theory: BasicActionTheory) -> bool:
    """Whether several worlds may be possible at first, or none."""
    return bool(theory.initially) or any(isinstance(fluent.initial, Choice) for fluent in theory.fluents.values())


def initial_worlds(theory: BasicActionTheory, findings: Findings) -> Beginning | None:
    """The initial worlds of a theory that leaves something open; none, and a finding, if none is possible."""
    try:
        found = Beginning(dynamics := Dynamics(theory), dynamics.initial())
    except ProgramError as error:
        findings.once(error.diagnostic)
        return None
    free = Dynamics(replace(theory, initially=()))
    everything = Beginning(free, free.initial())
    for constraint in theory.initially:
        with suppress(ProgramError):  # it has a value only where the constraints before it hold
            if all(case is not None and case[1] for case in everything.cases(constraint)):
                _report_idle(theory, constraint, findings)
    return found


def _report_idle(theory: BasicActionTheory, constraint: Term, findings: Findings) -> None:
    """A constraint that is true whatever is possible; a false one leaves no world."""
    read = [theory.fluents[name] for name in sorted(fluents_read(theory, [constraint]))]
    known = not any(isinstance(fluent.initial, Choice) for fluent in read)
    findings.warning(
        Code.IDLE_CONSTRAINT,
        "this constraint rules out no world: it holds in every one that is possible",
        constraint.span,
        "speaks only of what is known at first" if known else "always true",
        "a formula that should hold in every situation is an `invariant`" if known else None,
        tuple(Label(fluent.span, "has one initial value") for fluent in read[:5]) if known else (),
    )
