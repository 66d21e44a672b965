"""The meaning of typed terms, read off the tree: slow and plain.

Two layers stand on it, ``closed`` for terms before there is a situation and ``situation.interpret`` for terms in a
state. The generated code of ``situation.compile`` says the same faster and is tested against it. The evaluator calls
itself from Python code alone, never through a builtin like ``any`` or a generator: a deep term costs no C stack.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Generic, NamedTuple, TypeAlias, TypeVar, cast

from golc.theory import errors
from golc.theory.border import PythonFunction, extern_value
from golc.theory.operations import apply, takes_none
from golc.theory.order import arranged, elements
from golc.theory.terms import (
    Before,
    Binder,
    Comprehension,
    DefinedTerm,
    Display,
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
    Text,
    Variable,
)
from golc.theory.theory import Definition, Parameter, Static
from golc.theory.types import Collection, Value, number, show, show_call

Env: TypeAlias = tuple[Value, ...]
"""The values of the variables in scope, by level."""

S = TypeVar("S")
"""What stands for a situation."""

MOST_REMEMBERED = 100_000
"""How many values of static functions are kept."""

DEPTH = 1_000
"""How many calls of static functions may be open at a time: a recursion that goes deeper is taken for endless."""


class _Called(NamedTuple):
    """The value of a static function for some arguments, and how many calls are open at a time to work it out."""

    value: Value
    calls: int


class Evaluator(Generic[S]):
    """Evaluates terms in situations; a subclass says where names lead and what fluents are.

    Every method raises ``ProgramError`` where the language says that something is an error.
    """

    steps: float = math.inf
    """How many more terms it evaluates."""
    depth = 0
    """How many calls of static functions are open."""
    _deepest = 0
    """The most that have been open at a time since the one that is worked out began."""

    @cached_property
    def _called(self) -> dict[tuple[str, Env], _Called]:
        """What static functions, which never change, have given for some arguments."""
        return {}

    def static(self, name: str) -> Static:
        """A static function."""
        raise NotImplementedError

    def definition(self, name: str) -> Definition:
        """A definition."""
        raise NotImplementedError

    def fluent(self, term: FluentTerm, situation: S, env: Env) -> Value:
        """The value of a fluent."""
        raise NotImplementedError

    def poss(self, term: PossTerm, situation: S, env: Env) -> bool:
        """Whether an action is possible."""
        raise NotImplementedError

    def epistemic(self, term: Epistemic, situation: S, env: Env) -> bool:
        """What the agent knows; here, that the world is as the situation says."""
        return term.kind == "known" or self.holds(term.body, situation, env)

    def before(self, term: Before, situation: S, env: Env) -> Value:
        """What a term was before the last action."""
        raise NotImplementedError

    def exhausted(self, term: Term) -> Exception:
        """What to raise when there are no more steps."""
        raise NotImplementedError

    def operate(self, term: Operation, values: list[Value]) -> Value:
        """The value of an operation whose operands have been evaluated."""
        return apply(term.op, values, term.span, term.order)

    def holds(self, formula: Term, situation: S, env: Env) -> bool:
        """Whether a formula is true."""
        return self.some(formula, situation, env, "a formula") is True

    def some(self, term: Term, situation: S, env: Env, what: str) -> Value:
        """The value of a term that must not be ``none``; ``what`` says what the term is."""
        value = self.evaluate(term, situation, env)
        if value is None:
            raise errors.nothing(term.span, what)
        return value

    def all_hold(self, formulas: tuple[Term, ...], situation: S, env: Env) -> bool:
        """Whether all formulas are true; stops at the first one that is not."""
        holds = True
        for formula in formulas:
            holds = holds and self.holds(formula, situation, env)
        return holds

    def evaluate(self, term: Term, situation: S, env: Env) -> Value:
        """The value of a term; ``env`` has a value for every variable in scope."""
        self.steps -= 1
        if self.steps < 0:
            raise self.exhausted(term)
        match term:
            case Literal(value=value):
                return value
            case Variable(level=level):
                return env[level]
            case Operation():
                return self._operation(term, situation, env)
            case FluentTerm():
                return self.fluent(term, situation, env)
            case StaticTerm():
                return self._static(term, situation, env)
            case DefinedTerm(definition=name):
                definition = self.definition(name)
                args = self.arguments(name, definition.parameters, term.args, situation, env)
                return self.evaluate(definition.body, situation, args)
            case PossTerm():
                return self.poss(term, situation, env)
            case Membership(element=element, within=within):
                return self.evaluate(element, situation, env) in within
            case Quantified():
                return self._quantified(term, situation, env)
            case Display():
                return self._display(term, situation, env)
            case Comprehension():
                return self._comprehension(term, situation, env)
            case Text():
                return self._text(term, situation, env)
            case Epistemic():
                return self.epistemic(term, situation, env)
            case Before():
                return self.before(term, situation, env)

    def arguments(
        self, what: str, parameters: tuple[Parameter, ...], args: tuple[Term, ...], situation: S, env: Env
    ) -> Env:
        """The values of the arguments of ``what``, each of which has to be of its parameter's type."""
        values = []
        for parameter, arg in zip(parameters, args, strict=True):
            value = self.evaluate(arg, situation, env)
            if value not in parameter.type:
                raise errors.argument_outside(arg.span, what, value, parameter.type)
            values.append(value)
        return tuple(values)

    def visit(
        self,
        binders: tuple[Binder, ...],
        where: Term | None,
        situation: S,
        env: Env,
        visitor: Callable[[Env], bool | None],
    ) -> bool:
        """Show a visitor the environments that binders make, in order, as far as ``where`` holds, until it answers
        true; whether it did."""
        if not binders:
            return (where is None or self.holds(where, situation, env)) and bool(visitor(env))
        for value in self._range(binders[0], situation, env):
            if self.visit(binders[1:], where, situation, (*env, value), visitor):
                return True
        return False

    def _range(self, binder: Binder, situation: S, env: Env) -> Sequence[Value]:
        if binder.within is None:
            return binder.variable.type.values
        return elements(self.some(binder.within, situation, env, "a collection"), binder.within.type)

    def _static(self, term: StaticTerm, situation: S, env: Env) -> Value:
        static = self.static(term.static)
        args = self.arguments(term.static, static.parameters, term.args, situation, env)
        if isinstance(static.body, Mapping):
            return static.body[args]
        if isinstance(static.body, PythonFunction):
            return extern_value(static, args, term.span)
        found = self._called.get((term.static, args))
        if self.depth + (1 if found is None else found.calls) > DEPTH:
            raise errors.endless(static.span, static.name)
        if found is None:
            found = self._call(static, static.body, situation, args)
            if len(self._called) < MOST_REMEMBERED:
                self._called[term.static, args] = found
        self._deepest = max(self._deepest, self.depth + found.calls)
        return found.value

    def _call(self, static: Static, body: Term, situation: S, args: Env) -> _Called:
        before = self._deepest
        self.depth += 1
        self._deepest = self.depth
        try:
            value = self.evaluate(body, situation, args)
        except RecursionError:
            raise errors.endless(static.span, static.name) from None
        finally:
            self.depth -= 1
            calls = self._deepest - self.depth
            self._deepest = max(before, self._deepest)
        if value not in static.type:
            raise errors.value_outside(body.span, show_call(static.name, args), value, static.type)
        return _Called(value, calls)

    def _quantified(self, term: Quantified, situation: S, env: Env) -> Value:
        found: list[Value] = []
        what = "a formula" if term.kind in ("exists", "forall", "count") else "an operand"

        def decides(inner: Env) -> bool:
            value = self.some(term.body, situation, inner, what)
            found.append(value)
            return value is (term.kind == "exists") and term.kind in ("exists", "forall")

        decided = self.visit(term.binders, term.where, situation, env, decides)
        match term.kind:
            case "exists":
                return decided
            case "forall":
                return not decided
            case "count" | "sum":
                return number(sum(cast(list[int], found)))
            case kind:
                if not found:
                    raise errors.empty_extremum(term.span, kind)
                return min(cast(list[int], found)) if kind == "min" else max(cast(list[int], found))

    def _display(self, term: Display, situation: S, env: Env) -> Value:
        found = []
        for part in term.elements:
            found.append(self.evaluate(part, situation, env))
        return _collection(term, found)

    def _comprehension(self, term: Comprehension, situation: S, env: Env) -> Value:
        found: list[Value] = []

        def add(inner: Env) -> None:
            found.append(self.evaluate(term.element, situation, inner))

        self.visit(term.binders, term.where, situation, env, add)
        return _collection(term, found)

    def _text(self, term: Text, situation: S, env: Env) -> str:
        texts = []
        for part in term.parts:
            if not isinstance(part, str):
                part = show(arranged(self.evaluate(part, situation, env), part.type))
            texts.append(part)
        return "".join(texts)

    def _operation(self, term: Operation, situation: S, env: Env) -> Value:
        args = term.args
        match term.op:
            case Operator.AND | Operator.OR:
                decisive = term.op is Operator.OR
                for arg in args:
                    if self.holds(arg, situation, env) is decisive:
                        return decisive
                return not decisive
            case Operator.IMPLIES:
                return not self.holds(args[0], situation, env) or self.holds(args[1], situation, env)
            case Operator.NOT:
                return not self.holds(args[0], situation, env)
            case Operator.IFF:
                return self.holds(args[0], situation, env) == self.holds(args[1], situation, env)
            case Operator.CONDITIONAL:
                then, condition, otherwise = args
                return self.evaluate(then if self.holds(condition, situation, env) else otherwise, situation, env)
            case _:
                return self.operate(term, self._operands(term, situation, env))

    def _operands(self, term: Operation, situation: S, env: Env) -> list[Value]:
        values = []
        for place, arg in enumerate(term.args):
            value = self.evaluate(arg, situation, env)
            if value is None and not takes_none(term.op, place):
                raise errors.nothing(arg.span, "an operand")
            values.append(value)
        return values


def _collection(term: Display | Comprehension, found: list[Value]) -> Value:
    assert isinstance(term.type, Collection)
    return frozenset(found) if term.type.kind == "set" else tuple(found)
