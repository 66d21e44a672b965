"""The effects of an action on several possible worlds at once, and effects that leave several values possible.

Each clause is asked in the cases that it distinguishes. Clauses that have nothing to do with one another are applied
each to its own factors; what a clause changes in the same way in every case, it changes in what all worlds agree on.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, cast

from golc.situation.compile import Cell, Cells, Compiler, variables
from golc.situation.layout import Layout, Slots, World
from golc.situation.worlds import MOST_CASES, State, TooManyCasesError, View, Worlds, rebuilt, survey
from golc.theory import errors
from golc.theory.order import elements
from golc.theory.terms import Choice
from golc.theory.theory import Action, Effect
from golc.theory.types import Unknown, Value, show_call


class Options(NamedTuple):
    """Any of several values: what ``unknown`` and ``one of`` give a fluent."""

    values: tuple[Value, ...]


@dataclass(frozen=True)
class _Instance:
    """A clause for some values of its binders.

    ``written``: the slots that it changes in some case. ``factors``: those that decide whether and how; none if it does
    the same in every case.
    """

    clause: Clause
    env: tuple[Value, ...]
    written: frozenset[int]
    factors: frozenset[int]


class Branching:
    """The compiled clauses of one action."""

    def __init__(self, action: Action, layout: Layout, compiler: Compiler) -> None:
        self._layout = layout
        self._clauses = [Clause(effect, len(action.parameters), layout, compiler) for effect in action.effects]

    def progress(self, state: State, args: tuple[Value, ...]) -> State:
        """What is possible after the action; raises ``TooManyCasesError`` if that is too much."""
        worlds = state if isinstance(state, Worlds) else Worlds(state, ())
        every = (clause.instance(worlds, env) for clause in self._clauses for env in clause.environments(args))
        instances = [instance for instance in every if instance.written]
        written = frozenset[int]().union(*[instance.written for instance in instances])
        replaced: set[int] = set()
        tables: list[tuple[Sequence[int], Sequence[World]]] = []
        for group in _groups(instances):
            factors = frozenset[int]().union(*[instance.factors for instance in group])
            tables.append(self._table(worlds, group, sorted(factors), written))
            replaced |= factors
        for number in {worlds.owner[slot] for slot in written if slot in worlds.owner} - replaced:
            replaced.add(number)
            slots, rows = worlds.factors[number].without(written)
            if slots:
                tables.append((slots, rows))
        return rebuilt(worlds.base, worlds.factors, replaced, tables)

    def _table(
        self, worlds: Worlds, group: Sequence[_Instance], numbers: Sequence[int], written: frozenset[int]
    ) -> tuple[list[int], list[World]]:
        """The slots that a group reads as unknown or writes, and the values that they may have together afterwards.

        Without those that are ``written`` by another group: that has read none of these factors.
        """
        own = frozenset[int]().union(*[instance.written for instance in group])
        read = frozenset[int]().union(*[worlds.factors[number].slots for number in numbers])
        slots = sorted(own | (read - written))
        rows: dict[World, None] = {}
        factors = [worlds.factors[number] for number in numbers]
        view = View(worlds)
        for combined in itertools.product(*[factor.rows for factor in factors]):
            for factor, row in zip(factors, combined, strict=True):
                view.assign(factor, row)
            changes = self._merged(group, view)
            values = [changes[slot] if slot in changes else view[slot] for slot in slots]
            each = [value.values if isinstance(value, Options) else (value,) for value in values]
            rows.update(dict.fromkeys(itertools.product(*each)))
            if len(rows) > MOST_CASES:
                raise TooManyCasesError(MOST_CASES)
        return slots, [*rows]

    def _merged(self, group: Sequence[_Instance], view: View) -> dict[int, Value]:
        changes: dict[int, Value] = {}
        for instance in group:
            for slot, value in instance.clause.changes(view, instance.env):
                if changes.setdefault(slot, value) != value:
                    name = show_call(*self._layout.ground_fluents[slot])
                    first, second = (
                        Unknown(new.values) if isinstance(new, Options) else new for new in (changes[slot], value)
                    )
                    raise errors.conflicting_effects(instance.clause.effect.span, name, first, second)
        return changes


def _groups(instances: Sequence[_Instance]) -> Iterator[list[_Instance]]:
    """The instances that share a factor or a written slot, directly or through others."""
    groups: dict[int, list[_Instance]] = {}
    keys_of: dict[int, set[int]] = {}
    group_of: dict[int, int] = {}
    for number, instance in enumerate(instances):
        keys = instance.written | {-1 - factor for factor in instance.factors}
        groups[number], keys_of[number] = [instance], set(keys)
        for other in {group_of[key] for key in keys if key in group_of}:
            groups[number] = groups.pop(other) + groups[number]
            keys_of[number] |= keys_of.pop(other)
        group_of.update(dict.fromkeys(keys_of[number], number))
    return iter(groups.values())


class Clause:
    """A compiled clause: the slots that it changes in a world, each with its new value."""

    def __init__(self, effect: Effect, depth: int, layout: Layout, compiler: Compiler) -> None:
        self.effect = effect
        self._layout = layout
        self._compiler = compiler
        self._outer = effect.binders if all(binder.within is None for binder in effect.binders) else ()
        cells: Cells = variables(depth + len(self._outer))
        self._function = compiler.function(", ".join(["s", *(cell.text for cell in cells)]), self._lines(cells))

    def environments(self, args: tuple[Value, ...]) -> Iterator[tuple[Value, ...]]:
        """The arguments of the action with values of the clause's binders: of those over types."""
        for values in itertools.product(*[binder.variable.type.values for binder in self._outer]):
            yield (*args, *values)

    def changes(self, world: Slots, env: tuple[Value, ...]) -> list[tuple[int, Value]]:
        """The slots that change in a world, each with its new value or with ``Options``."""
        found: list[tuple[int, Value]] = self._function(world, *env)
        return found

    def instance(self, worlds: Worlds, env: tuple[Value, ...]) -> _Instance:
        """The clause for some values, with what it reads and writes."""
        # The cases, of which there may be many, are not kept.
        first = dict(self.changes(View(worlds), env))
        same, written, always, read = True, {*first}, {*first}, set[int]()
        for case, answer in survey(worlds, lambda world: self.changes(world, env)):
            changes = dict(answer)
            same = same and changes == first
            written |= changes.keys()
            always &= changes.keys()
            read.update([number for number, _ in case])
        if same:
            return _Instance(self, env, frozenset(written), frozenset())
        owners = {worlds.owner[slot] for slot in written - always if slot in worlds.owner}
        return _Instance(self, env, frozenset(written), frozenset(read | owners))

    def _lines(self, cells: Cells) -> list[str]:
        effect, compiler = self.effect, self._compiler
        lines, indent = ["w = []"], ""
        if not self._outer:
            for binder in effect.binders:
                cells, loop = compiler.loops((binder,), None, cells)
                lines.append(f"{indent}{loop}:")
                indent += "  "
        for condition in (effect.where, effect.condition):
            if condition is not None:
                lines.append(f"{indent}if {compiler.formula(condition, cells)}:")
                indent += "  "
        place = self._layout.places[effect.fluent]
        slot = compiler.slot(place, effect.args, cells)
        return [*lines, f"{indent}w.append(({slot}, {self._new_value(cells)}))", "return w"]

    def _new_value(self, cells: tuple[Cell, ...]) -> str:
        value, type_ = self.effect.value, self._layout.places[self.effect.fluent].fluent.type
        if isinstance(value, Choice):
            return f"{self._compiler.bind('options', self._options)}({self._compiler.expression(value.among, cells)})"
        what = self.effect.fluent

        def failure(outside: Value) -> Exception:
            return errors.value_outside(value.span, what, outside, type_)

        return self._compiler.checked(value, type_, cells, failure)

    def _options(self, among: Value) -> Options:
        fluent = self._layout.places[self.effect.fluent].fluent
        choice = cast(Choice, self.effect.value)
        span = choice.span
        values = tuple(dict.fromkeys(elements(among, choice.among.type)))
        if not values:
            raise errors.nothing_possible(span, fluent.name)
        for value in values:
            if value not in fluent.type:
                raise errors.value_outside(span, fluent.name, value, fluent.type)
        return Options(values)
