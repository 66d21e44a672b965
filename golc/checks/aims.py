"""What is to be true some day and never can be: goals, and what scenarios wait for, end with and expect."""

from __future__ import annotations

from collections.abc import Iterator

from golc.checks.obligations import Obligations
from golc.diagnostics import Code
from golc.proofs.questions import Asked, Question
from golc.theory.reading import fluents_read
from golc.theory.scenarios import ExpectFormula, Scenario
from golc.theory.terms import Term
from golc.theory.theory import BasicActionTheory


def check_aims(obligations: Obligations) -> None:
    """The constant conditions of row 6 that stand outside of programs. What reads no fluent may well be meant."""
    theory = obligations.theory
    for what, condition in _aims(theory):
        if not fluents_read(theory, [condition]):
            continue
        if obligations.is_impossible(Question((), (Asked(condition),)), f"whether {what} can be true", condition.span):
            message = f"{what} is false {obligations.everywhere}"
            obligations.warning(Code.CONSTANT, message, condition.span, "never true")


def _aims(theory: BasicActionTheory) -> Iterator[tuple[str, Term]]:
    for name in theory.goals:
        yield f"goal `{name}`", theory.definitions[name].body
    for scenario in theory.scenarios.values():
        for condition in _of(scenario):
            yield "this condition", condition


def _of(scenario: Scenario) -> Iterator[Term]:
    for event in scenario.events:
        if isinstance(event.trigger, Term):
            yield event.trigger
    if scenario.until is not None:
        yield scenario.until
    for expectation in scenario.expectations:
        if isinstance(expectation, ExpectFormula):
            yield expectation.condition
