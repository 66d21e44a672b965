"""The initial situation: the worlds that the initial values and the constraints on them leave possible."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from golc.situation.compile import Compiler
from golc.situation.interpret import Interpreter
from golc.situation.knowing import placed
from golc.situation.layout import World
from golc.situation.worlds import State, choices, keep, survey
from golc.theory import errors
from golc.theory.evaluate import Env
from golc.theory.order import elements
from golc.theory.recursion import deep_recursion
from golc.theory.terms import Choice, Operation, Operator, Quantified, Term
from golc.theory.theory import Fluent
from golc.theory.types import Value, show_call


def initial_state(interpreter: Interpreter, compiler: Compiler, given: Mapping[int, Value]) -> State:
    """What is possible at first; ``given`` are values of slots that replace those of the theory.

    Raises ``ProgramError`` if nothing is possible, or an initial value is no value.
    """
    base: list[Value] = []
    options: dict[int, Sequence[Value]] = {}
    for slot, (name, args) in enumerate(interpreter.layout.ground_fluents):
        fluent = interpreter.theory.fluents[name]
        values = (given[slot],) if slot in given else _values(interpreter, fluent, args)
        base.append(values[0])
        if len(values) > 1:
            options[slot] = values
    state = choices(tuple(base), options)
    parts = [part for constraint in interpreter.theory.initially for part in _parts(constraint)]
    compiled: dict[int, Callable[..., Any]] = {}  # by the identity of the formula, which many parts may share
    for formula, env in parts:
        if id(formula) not in compiled:
            with deep_recursion():
                compiled[id(formula)] = compiler.term(formula, len(env))
        with placed((formula,)):
            state = _constrained(state, compiled[id(formula)], formula, env)
    return state


def _values(interpreter: Interpreter, fluent: Fluent, args: World) -> Sequence[Value]:
    """The values that a ground fluent may have at first."""
    initial, what = fluent.initial, show_call(fluent.name, args)
    values: Sequence[Value]
    if isinstance(initial, Choice):
        among = elements(interpreter.evaluate(initial.among, (), args), initial.among.type)
        values = tuple(dict.fromkeys(among))
        if not values:
            raise errors.nothing_possible(initial.span, what)
    else:
        values = (interpreter.evaluate(initial, (), args),)
    for value in values:
        if value not in fluent.type:
            raise errors.value_outside(initial.span, what, value, fluent.type)
    return values


def _constrained(state: State, holds: Callable[..., Any], formula: Term, env: Env) -> State:
    kept = [case for case, found in survey(state, lambda world: holds(world, env)) if found]
    if not kept:
        raise errors.no_initial_world(formula.span)
    return keep(state, kept)


def _parts(constraint: Term) -> Iterator[tuple[Term, Env]]:
    """The conjuncts of a constraint, one for each value of a ``forall``: each concerns fewer fluents than the whole."""
    stack: list[tuple[Term, Env]] = [(constraint, ())]
    while stack:
        term, env = stack.pop()
        match term:
            case Operation(op=Operator.AND, args=args):
                stack.extend((arg, env) for arg in reversed(args))
            case Quantified(kind="forall", binders=binders, where=where, body=body) if not any(
                binder.within for binder in binders
            ):
                if where is not None:
                    body = Operation(Operator.IMPLIES, (where, body), type=term.type, span=term.span)
                values = itertools.product(*[binder.variable.type.values for binder in binders])
                stack.extend((body, (*env, *each)) for each in reversed([*values]))
            case _:
                yield term, env
