"""The values of closed terms: those that read no fluent, so that they are known before there is any situation.

Constants, bounds of intervals, tables, settings of devices and initial values are closed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from golc.diagnostics import NOWHERE, Diagnostic, ProgramError, Span
from golc.theory.errors import ExternError
from golc.theory.evaluate import Env, Evaluator
from golc.theory.operations import apply
from golc.theory.terms import FluentTerm, Operation, Operator, PossTerm, Term
from golc.theory.theory import Definition, Static
from golc.theory.types import Value

STEPS = 500_000
"""How many terms one evaluator evaluates, about a second's worth: whatever needs more is taken for endless."""

BITS = 14_000
"""The largest number that is worked out, about what Python still turns into decimal digits: no chain of squarings shall
eat all memory."""


class NoValueError(Exception):
    """A closed term has no value: why (nothing, if it has been said already), and which part of it is to blame.

    ``finding`` is given if it says all, whatever the value is for.
    """

    def __init__(self, reason: str, span: Span, finding: Diagnostic | None = None) -> None:
        super().__init__(reason)
        self.reason = reason
        self.span = span
        self.finding = finding


class Closed(Evaluator[None]):
    """Evaluates closed terms within limits; what it raises is ``NoValueError``.

    ``static`` and ``definition`` look a name up; they answer none for what could not be elaborated.
    """

    def __init__(
        self,
        static: Callable[[str], Static | None],
        definition: Callable[[str], Definition | None],
        steps: int = STEPS,
    ) -> None:
        self._found_static = static
        self._found_definition = definition
        self.steps = steps

    def value(self, term: Term, env: Env = ()) -> Value:
        """The value of a term; ``env`` has a value for every variable in scope."""
        try:
            return self.evaluate(term, None, env)
        except ProgramError as error:
            found = error.diagnostic
            finding = found if isinstance(error, ExternError) else None
            raise NoValueError(found.message, found.span, finding) from None

    def static(self, name: str) -> Static:
        found = self._found_static(name)
        if found is None:
            raise NoValueError("", NOWHERE)
        return found

    def definition(self, name: str) -> Definition:
        found = self._found_definition(name)
        if found is None:
            raise NoValueError("", NOWHERE)
        return found

    def fluent(self, term: FluentTerm, situation: None, env: Env) -> Value:
        raise NoValueError("it depends on the situation", term.span)

    def poss(self, term: PossTerm, situation: None, env: Env) -> bool:
        raise NoValueError("it depends on the situation", term.span)

    def exhausted(self, term: Term) -> NoValueError:
        return NoValueError(f"it takes too many steps to evaluate (golc gives up after {STEPS})", term.span)

    def operate(self, term: Operation, values: list[Value]) -> Value:
        return _limited(term.op, values, term.span, term.order)


def arithmetic(op: Operator, numbers: list[Any], span: Span) -> Value:
    """What an operator makes of numbers; raises ``NoValueError`` where it has no value or is too large."""
    try:
        return _limited(op, numbers, span)
    except ProgramError as error:
        raise NoValueError(error.diagnostic.message, span) from None


def _limited(op: Operator, values: Sequence[Any], span: Span, order: Sequence[Value] | None = None) -> Value:
    """The value of an operation, unless it is a number that is too large."""
    if op is not Operator.MULTIPLY or sum(map(_bits, values)) <= BITS:
        value = apply(op, values, span, order)
        if _bits(value) <= BITS:
            return value
    raise NoValueError(f"the number has more than {BITS} bits", span)


def _bits(value: Value) -> int:
    """How many bits a number has; other values have none."""
    if isinstance(value, Fraction):
        return value.numerator.bit_length() + value.denominator.bit_length()
    return value.bit_length() if isinstance(value, int) else 0
