"""The meaning of typed terms, read off the tree: slow and plain.

The generated code of ``compile`` says the same faster and is tested against this. What golc explains (why a branch is
blocked, which values a condition had) comes from here, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import cast

from golc.situation import errors
from golc.situation.happened import Happened, before
from golc.situation.layout import Layout, World
from golc.situation.worlds import ASK, Readable
from golc.theory.terms import (
    Before,
    Binder,
    Choice,
    DefinedTerm,
    Epistemic,
    FluentTerm,
    Literal,
    Membership,
    Operation,
    Operator,
    PossTerm,
    Quantified,
    StaticTerm,
    Term,
    Variable,
)
from golc.theory.theory import Action, BasicActionTheory, Effect, Parameter
from golc.theory.types import Value, show_call

Env = tuple[Value, ...]
"""The values of the variables in scope, by level."""


class Interpreter:
    """Evaluates the terms of a theory in a state.

    Every method raises ``ProgramError`` where the language says that something is an error.
    """

    def __init__(self, theory: BasicActionTheory, layout: Layout | None = None) -> None:
        self.theory = theory
        self.layout = layout or Layout(theory)

    def holds(self, formula: Term, state: Readable, env: Env) -> bool:
        """Whether a formula is true."""
        return bool(self.evaluate(formula, state, env))

    def evaluate(self, term: Term, state: Readable, env: Env) -> Value:
        """The value of a term; ``env`` has a value for every variable in scope."""
        match term:
            case Literal(value=value):
                return value
            case Variable(level=level):
                return env[level]
            case FluentTerm(fluent=name, args=args):
                values = self._arguments(name, self.theory.fluents[name].parameters, args, state, env)
                return state[self.layout.places[name].slot(values)]
            case StaticTerm():
                return self._static(term, state, env)
            case DefinedTerm(definition=name, args=args):
                definition = self.theory.definitions[name]
                values = self._arguments(name, definition.parameters, args, state, env)
                return self.evaluate(definition.body, state, values)
            case PossTerm(action=name, args=args):
                action = self.theory.actions[name]
                return self.possible(action, state, self._arguments(name, action.parameters, args, state, env))
            case Membership(element=element, within=within):
                return self.evaluate(element, state, env) in within
            case Quantified():
                return self._quantified(term, state, env)
            case Operation():
                return self._operation(term, state, env)
            case Epistemic(kind=kind, body=body):
                return ASK[kind](lambda world: self.evaluate(body, world, env), state)
            case Before(body=body):
                return before(lambda world: self.evaluate(body, world, env), cast(Happened, state))
            case _:
                raise AssertionError(term)

    def possible(self, action: Action, state: Readable, args: Env) -> bool:
        """Whether the action's preconditions hold."""
        return all(self.holds(condition, state, args) for condition in action.preconditions)

    def progress(self, action: Action, state: Readable, args: Env) -> World:
        """The state after a ground action: all its effects at once, everything else unchanged."""
        changes: dict[int, Value] = {}
        for effect in action.effects:
            for env in self.bindings(effect.binders, effect.where, state, args):
                if effect.condition is None or self.holds(effect.condition, state, env):
                    self._apply(effect, state, env, changes)
        return tuple([changes.get(slot, state[slot]) for slot in range(self.layout.size)])

    def bindings(self, binders: tuple[Binder, ...], where: Term | None, state: Readable, env: Env) -> Iterator[Env]:
        """The environments that the binders make, in order, as far as ``where`` holds."""
        if not binders:
            if where is None or self.holds(where, state, env):
                yield env
            return
        for value in binders[0].values:
            yield from self.bindings(binders[1:], where, state, (*env, value))

    def _apply(self, effect: Effect, state: Readable, env: Env, changes: dict[int, Value]) -> None:
        fluent = self.theory.fluents[effect.fluent]
        args = self._arguments(fluent.name, fluent.parameters, effect.args, state, env)
        slot = self.layout.places[fluent.name].slot(args)
        assert not isinstance(effect.value, Choice)
        value = self.evaluate(effect.value, state, env)
        if value not in fluent.type:
            raise errors.value_outside(effect.value.span, show_call(fluent.name, args), value, fluent.type)
        if changes.setdefault(slot, value) != value:
            raise errors.conflicting_effects(effect.span, show_call(fluent.name, args), changes[slot], value)

    def _arguments(
        self, what: str, parameters: tuple[Parameter, ...], args: tuple[Term, ...], state: Readable, env: Env
    ) -> Env:
        values = []
        for parameter, arg in zip(parameters, args, strict=True):
            value = self.evaluate(arg, state, env)
            if value not in parameter.type:
                raise errors.argument_outside(arg.span, what, value, parameter.type)
            values.append(value)
        return tuple(values)

    def _static(self, term: StaticTerm, state: Readable, env: Env) -> Value:
        static = self.theory.statics[term.static]
        args = self._arguments(static.name, static.parameters, term.args, state, env)
        if isinstance(static.body, Mapping):
            return static.body[args]
        try:
            value = self.evaluate(static.body, state, args)
        except RecursionError:
            raise errors.endless(static.span, static.name) from None
        if value not in static.type:
            raise errors.value_outside(static.body.span, show_call(static.name, args), value, static.type)
        return value

    def _quantified(self, term: Quantified, state: Readable, env: Env) -> Value:
        values = (
            self.evaluate(term.body, state, inner) for inner in self.bindings(term.binders, term.where, state, env)
        )
        match term.kind:
            case "exists":
                return any(values)
            case "forall":
                return all(values)
            case "count" | "sum":
                return sum(cast(Iterator[int], values))
            case kind:
                numbers = list(cast(Iterator[int], values))
                if not numbers:
                    raise errors.empty_extremum(term.span, kind)
                return min(numbers) if kind == "min" else max(numbers)

    def _operation(self, term: Operation, state: Readable, env: Env) -> Value:
        args = term.args
        match term.op:
            case Operator.AND:
                return all(self.holds(arg, state, env) for arg in args)
            case Operator.OR:
                return any(self.holds(arg, state, env) for arg in args)
            case Operator.IMPLIES:
                return not self.holds(args[0], state, env) or self.holds(args[1], state, env)
            case Operator.NOT:
                return not self.holds(args[0], state, env)
            case Operator.CONDITIONAL:
                then, condition, otherwise = args
                return self.evaluate(then if self.holds(condition, state, env) else otherwise, state, env)
            case Operator.EQUAL | Operator.IFF:
                return self.evaluate(args[0], state, env) == self.evaluate(args[1], state, env)
            case Operator.DIFFERENT:
                return self.evaluate(args[0], state, env) != self.evaluate(args[1], state, env)
            case Operator.LESS | Operator.LESS_EQUAL | Operator.GREATER | Operator.GREATER_EQUAL:
                return self._ordered(term, state, env)
            case _:
                return self._arithmetic(term, [self._number(arg, state, env) for arg in args])

    def _ordered(self, term: Operation, state: Readable, env: Env) -> bool:
        if term.order is None:
            numbers = [self._number(arg, state, env) for arg in term.args]
        else:
            numbers = [term.order.index(self._some(arg, state, env)) for arg in term.args]
        left, right = numbers
        match term.op:
            case Operator.LESS:
                return left < right
            case Operator.LESS_EQUAL:
                return left <= right
            case Operator.GREATER:
                return left > right
        return left >= right

    def _arithmetic(self, term: Operation, numbers: list[int]) -> int:
        match term.op:
            case Operator.ADD:
                return numbers[0] + numbers[1]
            case Operator.SUBTRACT:
                return numbers[0] - numbers[1]
            case Operator.MULTIPLY:
                return numbers[0] * numbers[1]
            case Operator.NEGATE:
                return -numbers[0]
            case Operator.ABSOLUTE:
                return abs(numbers[0])
            case Operator.MINIMUM:
                return min(numbers)
            case Operator.MAXIMUM:
                return max(numbers)
        if numbers[1] == 0:
            raise errors.division_by_zero(term.span)
        return numbers[0] // numbers[1] if term.op is Operator.DIVIDE else numbers[0] % numbers[1]

    def _number(self, term: Term, state: Readable, env: Env) -> int:
        return cast(int, self._some(term, state, env))

    def _some(self, term: Term, state: Readable, env: Env) -> Value:
        value = self.evaluate(term, state, env)
        if value is None:
            raise errors.nothing(term.span, "an operand")
        return value
