"""Questions about all situations, put to Z3 (the extra ``golc[smt]``)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import z3

from golc.proofs.effort import Effort
from golc.proofs.encode import MOST_TERMS, TOO_LONG, Encoder, Env, Read
from golc.proofs.encoded import Encoded, Formula, both, either, negated, same, selected, total
from golc.proofs.questions import Afterwards, Asked, Changed, Compared, Question, Step, terms_of
from golc.proofs.symbols import NotDecidedError
from golc.proofs.values import LONGEST, evaluated
from golc.theory.fitting import strip_optional
from golc.theory.terms import Binder, Choice, Display, Literal
from golc.theory.theory import BasicActionTheory, Effect
from golc.theory.types import Value

PATIENCE = 2_000
"""Milliseconds for one question."""

TRIES = 20
"""How often a smaller situation is looked for, each time for a part of the time."""

LONGEST_INVARIANT = 3_000
"""How many terms an invariant may have; longer ones are left out, and a witness is tried out with them."""

UNKNOWN = "the solver does not decide it"

Ground = tuple[str, tuple[Value, ...]]
"""A ground fluent: its name and its arguments."""

Found = tuple[Mapping[Ground, Value], Sequence[Value]]
"""The values of ground fluents, and those of the question's variables."""


def solve(theory: BasicActionTheory, question: Question, small: bool = False) -> Found | None:
    """A situation that answers a question with yes, or none if there is provably none.

    If it is to be ``small``, one in which integers are near to 0, and sets and lists short.

    Raises ``NotDecidedError`` if the solver does not know, or the question cannot be put to it.
    """
    effort = Effort(theory)
    if effort.of([term for step in question.steps for term in terms_of(theory, step)]) > MOST_TERMS:
        raise NotDecidedError(TOO_LONG)
    encoder = Encoder(theory)
    variables = tuple([encoder.variable(variable.name, variable.type) for variable in question.variables])
    asking = _Asking(theory, encoder, variables)
    wanted, short = asking.question(question), encoder.shortened
    assumed = [*asking.invariants(effort)]
    every = [wanted, *[formula for formula, _ in assumed], *encoder.facts]
    model = _model(every)
    if isinstance(model, z3.ModelRef):
        model = _nearest(every, encoder.sizes(variables), model) if small else model
        return encoder.values(model), [encoder.decoded(each, model) for each in variables]
    # What is impossible without an invariant of which only some situations are looked at is impossible.
    exact = [formula for formula, whole in assumed if whole]
    if not short and (
        (model is None and len(exact) == len(assumed)) or _model([wanted, *exact, *encoder.facts]) is None
    ):
        return None
    raise NotDecidedError(f"the solver looks at lists of up to {LONGEST} elements only" if model is None else UNKNOWN)


def refuted(
    theory: BasicActionTheory, question: Question, fluents: Mapping[Ground, Value], variables: Sequence[Value]
) -> Mapping[Ground, Value] | None:
    """A situation with some values in which what a question asks is not so, or an invariant does not hold, or none if
    there is provably none.

    Raises ``NotDecidedError`` if the solver does not know, or the question cannot be put to it.
    """
    encoder, effort = Encoder(theory), Effort(theory)
    types = [variable.type for variable in question.variables]
    known = [encoder.literal(value, strip_optional(of)) for value, of in zip(variables, types, strict=True)]
    asking = _Asking(theory, encoder, tuple(known))
    wanted, short = asking.question(question), encoder.shortened
    assumed = [*asking.invariants(effort)]
    given = [
        same(encoder.fluent(name, [*map(encoder.literal, args)]), encoder.literal(value, strip_optional(of)))
        for (name, args), value in fluents.items()
        for of in [theory.fluents[name].type]
    ]
    model = _model([negated(both(wanted, *[formula for formula, _ in assumed])), *given, *encoder.facts])
    if isinstance(model, z3.ModelRef):
        return encoder.values(model)
    whole = not short and len(assumed) == len(theory.invariants) and all(whole for _, whole in assumed)
    if model is None and whole:
        return None
    raise NotDecidedError(UNKNOWN)


def _model(formulas: list[Formula]) -> Any:
    """A model of some formulas; none if they have none, ``UNKNOWN`` if that takes too long."""
    if any(formula is False for formula in formulas):
        return None
    solver = z3.Solver()
    solver.set("timeout", PATIENCE)
    solver.add(*[formula for formula in formulas if formula is not True])
    answer = solver.check()
    return solver.model() if answer == z3.sat else None if answer == z3.unsat else UNKNOWN


def _nearest(formulas: list[Formula], sizes: list[Any], model: z3.ModelRef) -> z3.ModelRef:
    """A model in which the absolute values of some integers have the smallest sum that is found early."""
    solver = z3.Solver()
    solver.set("timeout", PATIENCE // TRIES)
    solver.add(*[formula for formula in formulas if formula is not True])
    size = total([z3.If(each < 0, -each, each) for each in sizes])
    low, high = 0, evaluated(size, model)
    for _ in range(TRIES):
        if low == high:
            break
        middle = (low + high) // 2
        solver.push()
        solver.add(size <= middle)
        if solver.check() == z3.sat:
            model = solver.model()
            high = evaluated(size, model)
        else:
            low = middle + 1
        solver.pop()
    return model


class _Asking:
    """The steps of one question as formulas."""

    def __init__(self, theory: BasicActionTheory, encoder: Encoder, variables: Env) -> None:
        self._theory = theory
        self._encoder = encoder
        self._variables = variables

    def question(self, question: Question) -> Formula:
        """Whether every step succeeds, or one fails."""
        steps = [self._step(step) for step in question.steps]
        before: list[Formula] = []
        failures: list[Formula] = []
        for succeeds, ok in steps:
            failures.append(both(*before, negated(ok)))
            before.append(both(ok, succeeds))
        return either(*failures) if question.fails else both(*before)

    def invariants(self, effort: Effort) -> Iterator[tuple[Formula, bool]]:
        """The invariants that are not too long, each with whether all situations are looked at."""
        for name in self._theory.invariants:
            body = self._theory.definitions[name].body
            if effort.of([body]) <= LONGEST_INVARIANT:
                self._encoder.shortened = False
                invariant = self._asked(Asked(body))
                yield both(invariant.ok, invariant.truth), not self._encoder.shortened

    def _env(self, numbers: tuple[int, ...]) -> Env:
        return tuple([self._variables[number] for number in numbers])

    def _asked(self, asked: Asked) -> Encoded:
        return self._encoder.term(asked.term, self._env(asked.env), self._encoder.fluent)

    def _step(self, step: Step) -> tuple[Formula, Formula]:
        """Whether a step succeeds, and whether that has an answer."""
        match step:
            case Asked(false=false):
                value = self._asked(step)
                return negated(value.truth) if false else value.truth, value.ok
            case Compared(left=left, right=right, equal=equal):
                one, other = self._asked(left), self._asked(right)
                alike = same(one, other)
                return alike if equal else negated(alike), both(one.ok, other.ok)
            case Changed(action=action, effect=effect, env=env):
                return True, self._works(self._theory.actions[action].effects[effect], self._env(env))
            case Afterwards(env=env, term=term):
                value = self._encoder.term(term, (), self._after(step, self._env(env)))
                return negated(value.truth), value.ok

    def _works(self, effect: Effect, env: Env) -> Formula:
        """Whether an effect can be carried out, for all values of those of its binders that ``env`` has none for."""
        encoder, fluent = self._encoder, self._theory.fluents[effect.fluent]
        works: list[Formula] = []
        for inner, is_one, has_answer in encoder.environments(_open(effect), env, encoder.fluent):
            applies, ok = self._applies(effect, inner)
            args = [encoder.term(arg, inner, encoder.fluent) for arg in effect.args]
            fits = [both(a.ok, encoder.within(a, p.type)) for a, p in zip(args, fluent.parameters, strict=True)]
            fits += [both(v.ok, encoder.within(v, fluent.type)) for v in self._values(effect, inner)]
            done = both(ok, either(negated(applies), both(*fits)))
            works += [has_answer, either(negated(is_one), done)]
        return both(*works)

    def _applies(self, effect: Effect, env: Env) -> tuple[Formula, Formula]:
        """Whether an effect takes place for some values of its binders, and whether that has an answer."""
        applies: Formula = True
        ok: Formula = True
        for part in (effect.where, effect.condition):
            if part is not None:
                value = self._encoder.term(part, env, self._encoder.fluent)
                ok = both(ok, either(negated(applies), value.ok))
                applies = both(applies, value.truth)
        return applies, ok

    def _values(self, effect: Effect, env: Env) -> list[Encoded]:
        """The values that an effect may give its fluent."""
        encoder, fluent = self._encoder, self._theory.fluents[effect.fluent]
        match effect.value:
            case Choice(among=Literal(value=values)):
                return [encoder.literal(value, strip_optional(fluent.type)) for value in values]  # type: ignore[attr-defined]
            case Choice(among=Display(elements=elements)):
                return [encoder.term(element, env, encoder.fluent) for element in elements]
            case Choice():
                raise NotDecidedError("a value is one of a collection")
            case value:
                return [encoder.term(value, env, encoder.fluent)]

    def _after(self, step: Afterwards, args: Env) -> Read:
        """How fluents are read after an action."""
        encoder, effects = self._encoder, self._theory.actions[step.action].effects

        def read(name: str, at: Sequence[Encoded]) -> Encoded:
            found = encoder.fluent(name, at)
            for effect in [effect for effect in effects if effect.fluent == name]:
                for env, is_one, _ in encoder.environments(effect.binders, args, encoder.fluent):
                    applies, _ = self._applies(effect, env)
                    own = [encoder.term(arg, env, encoder.fluent) for arg in effect.args]
                    here = both(is_one, applies, *[same(left, right) for left, right in zip(own, at, strict=True)])
                    for value in self._values(effect, env)[:1] if here is not False else ():
                        found = selected(here, self._one_of(effect, env, value), found)
            return found

        return read

    def _one_of(self, effect: Effect, env: Env, value: Encoded) -> Encoded:
        if not isinstance(effect.value, Choice):
            return value
        new = self._encoder.variable("new", self._theory.fluents[effect.fluent].type)
        self._encoder.facts.append(either(*[same(new, each) for each in self._values(effect, env)]))
        return new


def _open(effect: Effect) -> tuple[Binder, ...]:
    """The binders of an effect if they are no variables of a question, which those over collections are not."""
    return effect.binders if any(binder.within is not None for binder in effect.binders) else ()
