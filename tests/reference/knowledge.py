"""What an agent knows, written out naively: all possible worlds one by one."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any, TypeAlias, cast

from golc.situation.interpret import Interpreter
from golc.theory.terms import Before, Choice, Epistemic, Term
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value

World: TypeAlias = tuple[Value, ...]
Worlds: TypeAlias = frozenset[World]
"""What an agent holds possible: one tuple of values for each possible world."""


class NotKnownError(Exception):
    """The possible worlds disagree on something that has to be known."""


class Actual(tuple[Value, ...]):
    """A world among those that are possible."""

    among: Worlds

    @classmethod
    def each(cls, worlds: Worlds) -> Iterator[Actual]:
        for world in worlds:
            actual = cls(world)
            actual.among = worlds
            yield actual


class Terms(Interpreter):
    """Evaluates terms in one of several worlds that are written down one by one."""

    then: Worlds = frozenset()
    """What was possible before the last action."""

    def evaluate(self, term: Term, situation: Any, env: tuple[Value, ...]) -> Value:
        if isinstance(term, Before):
            return agreed(self.evaluate(term.body, world, env) for world in Actual.each(self.then))
        return super().evaluate(term, situation, env)

    def epistemic(self, term: Epistemic, situation: Any, env: tuple[Value, ...]) -> bool:
        values = {self.evaluate(term.body, world, env) for world in Actual.each(situation.among)}
        return {"knows": values == {True}, "possible": True in values, "known": len(values) == 1}[term.kind]


def agreed(values: Iterator[Value]) -> Value:
    """The value, if all are the same."""
    first, *others = set(values)
    if others:
        raise NotKnownError
    return first


class Knowledge:
    """What is known, possible and brought about where these worlds are possible."""

    def __init__(self, theory: BasicActionTheory) -> None:
        self.theory = theory
        self.terms = Terms(theory)

    def initial(self) -> Worlds:
        options = []
        for name, args in self.terms.layout.ground_fluents:
            initial = self.theory.fluents[name].initial
            chosen = isinstance(initial, Choice)
            value = self.terms.evaluate(initial.among if isinstance(initial, Choice) else initial, (), args)
            options.append(cast(tuple[Value, ...], value) if chosen else (value,))
        worlds = [*Actual.each(frozenset(itertools.product(*options)))]
        return frozenset(tuple(w) for w in worlds if self.terms.all_hold(self.theory.initially, w, ()))

    def holds(self, formula: Term, s: Worlds, env: tuple[Value, ...]) -> bool:
        return all(self.terms.holds(formula, world, env) for world in Actual.each(s))

    def refuted(self, formula: Term, s: Worlds, env: tuple[Value, ...]) -> bool:
        return not any(self.terms.holds(formula, world, env) for world in Actual.each(s))

    def decides(self, formula: Term, s: Worlds, env: tuple[Value, ...]) -> bool:
        return bool(self.value(formula, s, env))

    def value(self, term: Term, s: Worlds, env: tuple[Value, ...]) -> Any:
        return agreed(self.terms.evaluate(term, world, env) for world in Actual.each(s))

    def bindings(self, binders: Any, where: Term | None, s: Worlds, env: tuple[Value, ...]) -> list[tuple[Value, ...]]:
        """The environments that binders make, as far as a condition is known to hold."""
        found = [env]
        for binder in binders:
            longer: list[tuple[Value, ...]] = []
            for inner in found:
                if binder.within is not None:
                    self.value(binder.within, s, inner)
                self.terms.visit((binder,), None, next(Actual.each(s)), inner, longer.append)
            found = longer
        return [inner for inner in found if where is None or self.holds(where, s, inner)]

    def possible(self, action: str, s: Worlds, args: tuple[Value, ...]) -> bool:
        conditions = self.theory.actions[action].preconditions
        return all(self.terms.all_hold(conditions, world, args) for world in Actual.each(s))

    def progress(self, action: str, s: Worlds, args: tuple[Value, ...]) -> Worlds:
        """All worlds that an action may lead to."""
        return frozenset(after for world in Actual.each(s) for after in self._after(action, world, args))

    def _after(self, action: str, world: Actual, args: tuple[Value, ...]) -> Iterator[World]:
        changes: dict[int, tuple[Value, ...]] = {}
        for effect in self.theory.actions[action].effects:
            envs: list[tuple[Value, ...]] = []
            self.terms.visit(effect.binders, effect.where, world, args, envs.append)
            for env in envs:
                if effect.condition is None or self.terms.holds(effect.condition, world, env):
                    place = self.terms.layout.places[effect.fluent]
                    of = tuple(self.terms.evaluate(arg, world, env) for arg in effect.args)
                    value = effect.value
                    if isinstance(value, Choice):
                        changes[place.slot(of)] = tuple(cast(Any, self.terms.evaluate(value.among, world, env)))
                    else:
                        changes[place.slot(of)] = (self.terms.evaluate(value, world, env),)
        options = [changes.get(slot, (value,)) for slot, value in enumerate(world)]
        return itertools.product(*options)

    def outcomes(self, action: str, s: Worlds, args: tuple[Value, ...]) -> dict[tuple[Value, ...], Worlds]:
        """What may be sensed, with the worlds that agree with it."""
        found: dict[tuple[Value, ...], set[World]] = {}
        for world in Actual.each(s):
            results = tuple(self.terms.evaluate(term, world, args) for term in self.theory.actions[action].senses)
            found.setdefault(results, set()).add(tuple(world))
        return {results: frozenset(worlds) for results, worlds in found.items()}

    def pruned(self, action: str, args: tuple[Value, ...], before: Worlds, after: Worlds) -> bool:
        """Whether a prune is known to hold when an action has led from one situation to another."""
        self.terms.then = before
        for prune in self.theory.prunes.values():
            try:
                if prune.action in (None, action) and self.holds(prune.condition, after, args if prune.action else ()):
                    return True
            except NotKnownError:
                pass
        return False
