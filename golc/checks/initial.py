"""Initial values: each can be computed, and lies in its fluent's type."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator
from typing import cast

from golc.diagnostics import Code, Findings
from golc.proofs.at_first import AtFirst
from golc.theory.closed import Closed, NoValueError
from golc.theory.evaluate import Env
from golc.theory.forms import describe
from golc.theory.terms import Choice, Membership, Term, Variable, subterms
from golc.theory.theory import BasicActionTheory, Fluent
from golc.theory.types import BOOL, Value, show, show_call

LIMIT = 100_000
"""Instances of one fluent that are looked at."""


def check_initial(theory: BasicActionTheory, findings: Findings) -> None:
    """Row 2 of what ``golc check`` proves; that there is an initial value at all is found by elaboration."""
    closed = Closed(theory.statics.get, theory.definitions.get)
    for fluent in theory.fluents.values():
        _check_fluent(theory, fluent, closed, findings)
        if closed.steps < 0:
            return


def _check_fluent(theory: BasicActionTheory, fluent: Fluent, closed: Closed, findings: Findings) -> None:
    instances = _instances(fluent)
    for args in itertools.islice(instances, LIMIT):
        if not _check_instance(theory, fluent, args, closed, findings):
            return  # the other instances have probably the same mistake
    if next(instances, None) is not None:
        _not_decided(fluent, f"it has more than {LIMIT} instances", findings)


def _not_decided(fluent: Fluent, reason: str, findings: Findings) -> None:
    message = f"the initial values of `{fluent.name}` are not decided: {reason}"
    findings.warning(Code.INITIAL_VALUE, message, fluent.initial.span, "evaluated only in part")


def _instances(fluent: Fluent) -> Iterator[Env]:
    """The arguments that have to be looked at: one of each parameter that the initial value does not depend on."""
    levels = _levels(fluent.initial.among if isinstance(fluent.initial, Choice) else fluent.initial)
    ranges = [
        parameter.type.values if level in levels else parameter.type.values[:1]
        for level, parameter in enumerate(fluent.parameters)
    ]
    return itertools.product(*ranges)


def _levels(term: Term) -> set[int]:
    return {part.level for part in subterms(term) if isinstance(part, Variable)}


def _check_instance(theory: BasicActionTheory, fluent: Fluent, args: Env, closed: Closed, findings: Findings) -> bool:
    what = show_call(fluent.name, args)
    try:
        values = _values(fluent, args, closed)
    except (NoValueError, RecursionError) as error:
        if closed.steps < 0:
            _not_decided(fluent, "they take too many steps to evaluate", findings)
            return False
        reason, span = ("it is nested too deeply", fluent.initial.span)
        if isinstance(error, NoValueError):
            reason, span = error.reason, error.span
            if error.finding is not None:
                if error.finding.code is not Code.NOT_EXECUTED or not _is_always_within(theory, fluent):
                    findings.once(error.finding)
                return False
        findings.error(Code.INITIAL_VALUE, f"the initial value of `{what}` cannot be computed: {reason}", span, "here")
        return False
    if not values:
        message = f"fluent `{what}` is one of no values at first"
        findings.error(Code.NO_CHOICE, message, fluent.initial.span, "at least one has to be possible")
    for value in values:
        if value not in fluent.type:
            message = f"the initial value {show(value)} of `{what}` is outside {describe(fluent.type, fluent.span)}"
            findings.error(Code.INITIAL_VALUE, message, fluent.initial.span, f"is {show(value)}")
            return False
    return bool(values)


def _values(fluent: Fluent, args: Env, closed: Closed) -> Collection[Value]:
    """The initial value of an instance, or all that are possible."""
    if isinstance(fluent.initial, Choice):
        return cast(Collection[Value], closed.value(fluent.initial.among, args))
    return (closed.value(fluent.initial, args),)


def _is_always_within(theory: BasicActionTheory, fluent: Fluent) -> bool:
    """Whether the initial values of a fluent are of its type whatever functions that are not executed are."""
    if isinstance(fluent.initial, Choice):
        return False
    formula = Membership(fluent.initial, fluent.type, type=BOOL, span=fluent.initial.span)
    return AtFirst(theory).holds(formula, fluent.parameters) is True
