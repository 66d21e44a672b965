"""The values of closed terms: those that read no fluent, so that they are known before there is any situation.

Constants, bounds of intervals, tables, settings of devices and initial values are closed. The evaluator calls itself
from Python code alone, never through a builtin like ``any``: then a deep term costs memory, but no C stack.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import cast

from golc.diagnostics import Span
from golc.theory.fitting import describe
from golc.theory.terms import (
    DefinedTerm,
    Literal,
    Membership,
    Operation,
    Operator,
    Quantified,
    StaticTerm,
    Term,
    Variable,
)
from golc.theory.theory import Definition, Parameter, Static
from golc.theory.types import Value, show, show_call

Env = tuple[Value, ...]
"""The values of the variables in scope, by level."""

STEPS = 500_000
"""How many terms one evaluator evaluates, about a second's worth: whatever needs more is taken for endless."""

DEPTH = 2_000
"""How many calls of static functions and definitions may be open at a time."""


class NoValueError(Exception):
    """A closed term has no value: why (nothing, if it has been said already), and which part of it is to blame."""

    def __init__(self, reason: str, span: Span) -> None:
        super().__init__(reason)
        self.reason = reason
        self.span = span


@dataclass
class Closed:
    """Evaluates closed terms.

    ``static`` and ``definition`` look a name up; they answer none for what could not be elaborated. Every method raises
    ``NoValueError`` where the language says that something is an error.
    """

    static: Callable[[str], Static | None]
    definition: Callable[[str], Definition | None]
    steps: int = STEPS
    depth: int = 0

    def evaluate(self, term: Term, env: Env = ()) -> Value:
        """The value of a term; ``env`` has a value for every variable in scope."""
        self.steps -= 1
        if self.steps < 0:
            raise NoValueError(f"it takes too many steps to evaluate (golc gives up after {STEPS})", term.span)
        match term:
            case Literal(value=value):
                return value
            case Variable(level=level):
                return env[level]
            case StaticTerm(static=name):
                return self._static(term, self.static(name), env)
            case DefinedTerm(definition=name):
                return self._defined(term, self.definition(name), env)
            case Membership(element=element, within=within):
                return self.evaluate(element, env) in within
            case Quantified():
                return self._quantified(term, env)
            case Operation():
                return self._operation(term, env)
            case _:
                raise NoValueError("it depends on the situation", term.span)

    def _static(self, term: StaticTerm, static: Static | None, env: Env) -> Value:
        if static is None:
            raise NoValueError("", term.span)
        args = self._arguments(term.static, static.parameters, term.args, env)
        if isinstance(static.body, Mapping):
            return static.body[args]
        value = self._call(term, static.body, args)
        if value not in static.type:
            call = show_call(term.static, args)
            raise NoValueError(f"`{call}` is {show(value)}, which is outside {describe(static.type)}", static.body.span)
        return value

    def _defined(self, term: DefinedTerm, definition: Definition | None, env: Env) -> Value:
        if definition is None:
            raise NoValueError("", term.span)
        args = self._arguments(term.definition, definition.parameters, term.args, env)
        return self._call(term, definition.body, args)

    def _call(self, term: Term, body: Term, args: Env) -> Value:
        if self.depth >= DEPTH:
            raise NoValueError("the recursion does not end, or goes too deep", term.span)
        self.depth += 1
        value = self.evaluate(body, args)
        self.depth -= 1
        return value

    def _arguments(self, what: str, parameters: tuple[Parameter, ...], args: tuple[Term, ...], env: Env) -> Env:
        values = []
        for parameter, arg in zip(parameters, args, strict=True):
            value = self.evaluate(arg, env)
            if value not in parameter.type:
                reason = f"argument {show(value)} of `{what}` is outside {describe(parameter.type)}"
                raise NoValueError(reason, arg.span)
            values.append(value)
        return tuple(values)

    def _quantified(self, term: Quantified, env: Env) -> Value:
        found: list[int] = []
        for values in itertools.product(*[binder.values for binder in term.binders]):
            inner = (*env, *values)
            if term.where is not None and not self.evaluate(term.where, inner):
                continue
            value = self.evaluate(term.body, inner)
            if term.kind in ("exists", "forall"):
                if value is (term.kind == "exists"):
                    return value
            else:
                found.append(cast(int, value))
        match term.kind:
            case "exists" | "forall":
                return term.kind == "forall"
            case "count" | "sum":
                return sum(found)
            case kind:
                if not found:
                    raise NoValueError(f"`{kind}` over nothing has no value", term.span)
                return min(found) if kind == "min" else max(found)

    def _operation(self, term: Operation, env: Env) -> Value:
        args = term.args
        match term.op:
            case Operator.AND | Operator.OR:
                for arg in args:
                    if self.evaluate(arg, env) is (term.op is Operator.OR):
                        return term.op is Operator.OR
                return term.op is Operator.AND
            case Operator.IMPLIES:
                return not self.evaluate(args[0], env) or self.evaluate(args[1], env)
            case Operator.NOT:
                return not self.evaluate(args[0], env)
            case Operator.CONDITIONAL:
                then, condition, otherwise = args
                return self.evaluate(then if self.evaluate(condition, env) else otherwise, env)
            case Operator.EQUAL | Operator.IFF:
                return self.evaluate(args[0], env) == self.evaluate(args[1], env)
            case Operator.DIFFERENT:
                return self.evaluate(args[0], env) != self.evaluate(args[1], env)
            case _:
                return self._arithmetic(term, env)

    def _arithmetic(self, term: Operation, env: Env) -> Value:
        numbers = []
        for arg in term.args:
            value = self.evaluate(arg, env)
            if value is None:
                raise NoValueError("an operand is `none`", arg.span)
            numbers.append(cast(int, value) if term.order is None else term.order.index(value))
        return arithmetic(term.op, numbers, term.span)


def arithmetic(op: Operator, numbers: list[int], span: Span) -> Value:
    """What an operator makes of numbers; raises ``NoValueError`` for a division by zero."""
    if op in (Operator.ADD, Operator.SUBTRACT, Operator.MULTIPLY):
        return _sum_or_product(op, numbers[0], numbers[1], span)
    match op:
        case Operator.NEGATE:
            return -numbers[0]
        case Operator.ABSOLUTE:
            return abs(numbers[0])
        case Operator.MINIMUM:
            return min(numbers)
        case Operator.MAXIMUM:
            return max(numbers)
        case Operator.LESS:
            return numbers[0] < numbers[1]
        case Operator.LESS_EQUAL:
            return numbers[0] <= numbers[1]
        case Operator.GREATER:
            return numbers[0] > numbers[1]
        case Operator.GREATER_EQUAL:
            return numbers[0] >= numbers[1]
    if numbers[1] == 0:
        raise NoValueError("the divisor is 0", span)
    return numbers[0] // numbers[1] if op is Operator.DIVIDE else numbers[0] % numbers[1]


BITS = 14_000
"""The largest number that is worked out, about what Python still turns into decimal digits: no chain of squarings shall
eat all memory."""


def _sum_or_product(op: Operator, left: int, right: int, span: Span) -> int:
    if op is Operator.MULTIPLY and left.bit_length() + right.bit_length() > BITS:
        raise NoValueError(f"the number has more than {BITS} bits", span)
    value = left * right if op is Operator.MULTIPLY else left + right if op is Operator.ADD else left - right
    if value.bit_length() > BITS:
        raise NoValueError(f"the number has more than {BITS} bits", span)
    return value
