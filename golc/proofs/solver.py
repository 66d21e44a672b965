"""Questions about all situations, put to Z3 (the extra ``golc[smt]``)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import z3

from golc.proofs.encode import Encoder, Env, Read
from golc.proofs.encoded import Encoded, Formula, both, either, negated, same, selected
from golc.proofs.questions import Afterwards, Asked, Changed, Compared, Question, Step
from golc.proofs.symbols import NotDecidedError
from golc.theory.terms import Choice, Display, Literal
from golc.theory.theory import BasicActionTheory, Effect
from golc.theory.types import Value

PATIENCE = 2_000
"""Milliseconds for one question."""

Found = tuple[Mapping[tuple[str, tuple[Value, ...]], Value], Sequence[Value]]
"""The values of ground fluents, and those of the question's variables."""


def solve(theory: BasicActionTheory, question: Question) -> Found | None:
    """A situation that answers a question with yes, or none if there is provably none.

    Raises ``NotDecidedError`` if the solver does not know, or the question cannot be put to it.
    """
    encoder = Encoder(theory)
    variables = tuple([encoder.variable(variable.name, variable.type) for variable in question.variables])
    asking = _Asking(theory, encoder, variables)
    wanted = asking.question(question)
    solver = z3.Solver()
    solver.set("timeout", PATIENCE)
    solver.add(*[formula for formula in (wanted, *encoder.facts) if formula is not True])
    answer = z3.unsat if wanted is False else solver.check()
    if answer == z3.unsat:
        return None
    if answer != z3.sat:
        raise NotDecidedError("the solver does not decide it")
    return encoder.values(solver.model()), [encoder.decoded(each, solver.model()) for each in variables]


class _Asking:
    """The steps of one question as formulas."""

    def __init__(self, theory: BasicActionTheory, encoder: Encoder, variables: Env) -> None:
        self._theory = theory
        self._encoder = encoder
        self._variables = variables

    def question(self, question: Question) -> Formula:
        """Whether every step succeeds (or one fails) in a situation in which the invariants hold."""
        steps = [self._step(step) for step in question.steps]
        before: list[Formula] = []
        failures: list[Formula] = []
        for succeeds, ok in steps:
            failures.append(both(*before, negated(ok)))
            before.append(both(ok, succeeds))
        invariants = [self._asked(Asked(self._theory.definitions[name].body)) for name in self._theory.invariants]
        assumed = [both(invariant.ok, invariant.truth) for invariant in invariants]
        return both(either(*failures) if question.fails else both(*before), *assumed)

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
        """Whether an effect can be carried out."""
        applies, ok = self._applies(effect, env)
        fluent = self._theory.fluents[effect.fluent]
        args = [self._encoder.term(arg, env, self._encoder.fluent) for arg in effect.args]
        fits = [both(a.ok, self._encoder.within(a, p.type)) for a, p in zip(args, fluent.parameters, strict=True)]
        values = [both(v.ok, self._encoder.within(v, fluent.type)) for v in self._values(effect, env)]
        return both(ok, either(negated(applies), both(*fits, *values)))

    def _applies(self, effect: Effect, env: Env) -> tuple[Formula, Formula]:
        """Whether an effect takes place for some values of its binders, and whether that has an answer."""
        if any(binder.within is not None for binder in effect.binders):
            raise NotDecidedError("a variable runs over a collection")
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
        match effect.value:
            case Choice(among=Literal(value=values)):
                return [self._encoder.literal(value) for value in values]  # type: ignore[attr-defined]
            case Choice(among=Display(elements=elements)):
                return [self._encoder.term(element, env, self._encoder.fluent) for element in elements]
            case Choice():
                raise NotDecidedError("a value is one of a collection")
            case value:
                return [self._encoder.term(value, env, self._encoder.fluent)]

    def _after(self, step: Afterwards, args: Env) -> Read:
        """How fluents are read after an action."""
        encoder, effects = self._encoder, self._theory.actions[step.action].effects

        def read(name: str, at: Sequence[Encoded]) -> Encoded:
            found = encoder.fluent(name, at)
            for effect in effects:
                for env in encoder.environments(effect.binders, args) if effect.fluent == name else ():
                    applies, _ = self._applies(effect, env)
                    own = [encoder.term(arg, env, encoder.fluent) for arg in effect.args]
                    here = both(applies, *[same(left, right) for left, right in zip(own, at, strict=True)])
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
