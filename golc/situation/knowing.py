"""Questions to what an agent knows, made of the compiled functions that answer them in one world.

A plain condition asks whether it is known to be true; a decision (``if``, ``while``) or a value has to be settled one
way or the other. In a theory that leaves nothing open there is only one world, and the compiled functions are used as
they are.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any, TypeAlias

from golc.diagnostics import NOWHERE
from golc.situation.compile import FORMULA, Compiler
from golc.situation.interpret import Interpreter
from golc.situation.worlds import State, TooManyCasesError, agreed, survey
from golc.theory import errors
from golc.theory.evaluate import Env
from golc.theory.order import arranged, spelt
from golc.theory.reading import fluents_read
from golc.theory.terms import Binder, DefinedTerm, FluentTerm, StaticTerm, Term, Variable, subterms
from golc.theory.theory import BasicActionTheory, Parameter
from golc.theory.types import Unknown, Value, show, show_call

Asked: TypeAlias = Callable[..., Any]
"""A function of a state and of an environment, or of each argument of something."""


class Knowing:
    """Compiles the terms of programs into functions of what is known."""

    def __init__(self, theory: BasicActionTheory, compiler: Compiler, interpreter: Interpreter) -> None:
        self.theory = theory
        self.compiler = compiler
        self.interpreter = interpreter

    def condition(self, term: Term, depth: int) -> Asked:
        """Whether a formula is known to be true: a function of a state and an environment of ``depth`` variables."""
        return self.known_true(self.compiler.term(term, depth, FORMULA), (term,))

    def refuted(self, term: Term, depth: int) -> Asked:
        """Whether a formula is known to be false, as for ``condition``."""
        function = self.compiler.term(term, depth, FORMULA)
        return self.known_true(lambda world, env: not function(world, env), (term,))

    def settled(self, term: Term, depth: int, what: str | None = None) -> Asked:
        """The value of a term, or whether a formula is true; if worlds disagree, the function raises
        ``UndecidedError``. ``what`` as for ``Compiler.term``."""
        return self._settled(self.compiler.term(term, depth, what), term)

    def arguments(self, what: str, parameters: tuple[Parameter, ...], args: tuple[Term, ...], depth: int) -> Asked:
        """The values of the arguments of something, as for ``settled``."""
        function = self.compiler.argument_values(what, parameters, args, depth)
        return self._settled(function, *args)

    def shown(self, term: Term, depth: int) -> Asked:
        """The value of a term, or an ``Unknown``, as it is to be written in a message."""
        function = self.compiler.term(term, depth)

        def asked(state: State, env: Env) -> Value:
            answers = (answer for _, answer in survey(state, lambda world: function(world, env)))
            return arranged(agreed(answers), term.type)

        return asked

    def known_true(self, function: Asked, terms: Sequence[Term]) -> Asked:
        """Whether what a compiled function of some formulas answers is true in all worlds."""
        if not self.compiler.uncertain:
            return function

        def asked(state: State, *rest: Any) -> bool:
            if type(state) is tuple:
                return bool(function(state, *rest))
            with placed(terms):
                return all(answer for _, answer in survey(state, lambda world: function(world, *rest)))

        return asked

    def environments(self, binders: tuple[Binder, ...], where: Term | None, depth: int) -> Callable[..., Iterator[Env]]:
        """The environments that binders make of one of ``depth`` variables, as far as ``where`` is known to hold."""
        certain: Callable[..., Iterator[Env]] = self.compiler.environments(binders, where, depth)
        if not self.compiler.uncertain:
            return certain
        steps = []
        for number, binder in enumerate(binders):
            longer = self._listed(self.compiler.environments((binder,), None, depth + number))
            steps.append(longer if binder.within is None else self._settled(longer, binder.within))
        holds = None if where is None else self.condition(where, depth + len(binders))

        def environments(state: State, env: Env) -> Iterator[Env]:
            if type(state) is tuple:
                return certain(state, env)
            found: Iterator[Env] = iter((env,))
            for step in steps:
                found = itertools.chain.from_iterable(map(partial(step, state), found))
            return found if holds is None else (each for each in found if holds(state, each))

        return environments

    def verdict(self, term: Term, state: State, env: Env) -> bool | None:
        """Whether a formula holds; none if the worlds disagree. Slow: asks the interpreter, not compiled code."""
        answer = self.evaluate(term, state, env)
        return None if isinstance(answer, Unknown) else bool(answer)

    def evaluate(self, term: Term, state: State, env: Env) -> Value:
        """The value of a term, or an ``Unknown``. Slow: asks the interpreter, not compiled code."""
        with placed((term,)):
            cases = survey(state, lambda world: self.interpreter.evaluate(term, world, env))
            return agreed(answer for _, answer in cases)

    def spoken_of(self, term: Term, state: State, env: Env) -> dict[str, Value]:
        """The ground fluents, definitions and variables that a term speaks of, each once, with their values."""
        values: dict[str, Value] = {}
        for part in subterms(term):
            if any(isinstance(inner, Variable) and inner.level >= len(env) for inner in subterms(part)):
                continue
            match part:
                case Variable(name=name, level=level):
                    values[name] = spelt(env[level], part.type)
                case FluentTerm(fluent=name, args=args) | DefinedTerm(definition=name, args=args):
                    of = tuple(self.evaluate(arg, state, env) for arg in args)
                    values[show_call(name, of)] = spelt(self.evaluate(part, state, env), part.type)
                case StaticTerm():
                    continue
        return values

    def sensing(self, term: Term) -> list[str]:
        """The primitive actions that sense something that a term depends on."""
        fluents = fluents_read(self.theory, [term])
        actions = self.theory.actions.values()
        return [action.name for action in actions if fluents & fluents_read(self.theory, action.senses)]

    def _listed(self, function: Asked) -> Asked:
        return lambda state, env: tuple(function(state, env))

    def _settled(self, function: Asked, *terms: Term) -> Asked:
        if not self.compiler.uncertain:
            return function

        def asked(state: State, env: Env) -> Any:
            if type(state) is tuple:
                return function(state, env)
            with placed(terms):
                cases = survey(state, lambda world: function(world, env))
                _, first = next(cases)
                if all(answer == first for _, answer in cases):
                    return first
            raise self._undecided(terms, state, env)

        return asked

    def _undecided(self, terms: tuple[Term, ...], state: State, env: Env) -> errors.UndecidedError:
        term = next((each for each in terms if isinstance(self.evaluate(each, state, env), Unknown)), terms[0])
        value = self.evaluate(term, state, env)
        text = " ".join(term.span.text.split())
        problem = f"`{text}` is neither known to be true nor known to be false"
        if not isinstance(value, Unknown) or not all(isinstance(each, bool) for each in value.values):
            problem = f"the value of `{text}` is not known"
        spoken = self.spoken_of(term, state, env).items()
        notes = tuple(f"{name} = {show(value)}" for name, value in spoken if isinstance(value, Unknown))
        return errors.undecided(term.span, problem, notes, who_senses(self.sensing(term)))


def who_senses(actions: list[str]) -> str | None:
    """What to do about something that is not known, if anything can be done."""
    named = [f"`{name}`" for name in actions]
    match named:
        case []:
            return None
        case [name]:
            return f"{name} senses it"
        case _:
            return f"{', '.join(named[:-1])} and {named[-1]} sense it"


@contextmanager
def placed(terms: Sequence[Term]) -> Iterator[None]:
    """Name the term, the first of these, that asks more than can be gone through."""
    try:
        yield
    except TooManyCasesError as error:
        raise errors.too_many_worlds(terms[0].span if terms else NOWHERE, error.most) from None
