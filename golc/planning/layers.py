"""Uniform-cost search: the ways of a program in layers of equal weight, the lightest layer first.

Inside a layer the ways are looked at in program order. Steps that weigh nothing are followed depth first, so that of
several plans of the least weight the first in program order is found. A (program, state) pair that has been expanded is
skipped; under a bound on steps it is expanded again when it is reached with more of the bound left.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cmp_to_key
from heapq import heappop, heappush
from typing import TypeAlias

from golc.planning.dead_end import DeadEnd
from golc.planning.limits import Budget
from golc.program.ahead import Ahead, Successor
from golc.program.circles import CIRCLES, runs_in_circles
from golc.program.labels import Act, Foreseen
from golc.program.nodes import Node
from golc.program.paths import Path
from golc.situation.worlds import State
from golc.theory.types import Number

Weigh: TypeAlias = Callable[[State, Act], Number]
"""What an action adds to the weight of a way, given the state before it; at least 0."""


@dataclass(slots=True, eq=False)
class _Way:
    """A way to a pair: the label and the number, among its successors, of the step that extends another way.

    ``depth`` counts the steps, ``actions`` the actions, ``quiet`` the steps since the last one.
    """

    node: Node
    state: State
    label: Foreseen | None = None
    parent: _Way | None = None
    number: int = 0
    depth: int = 0
    actions: int = 0
    quiet: int = 0

    def extended(self, number: int, successor: Successor) -> _Way:
        """One step more; a program that runs in circles is an error."""
        label, residual, after = successor
        actions, quiet = (self.actions + 1, 0) if isinstance(label, Act) else (self.actions, self.quiet + 1)
        if quiet > CIRCLES:
            raise runs_in_circles(label.span)
        return _Way(residual, after, label, self, number, self.depth + 1, actions, quiet)

    def back(self) -> Iterator[_Way]:
        """This way, and each that it extends, the longest first."""
        way: _Way | None = self
        while way is not None:
            yield way
            way = way.parent

    def labels(self) -> list[Foreseen]:
        """The labels of its steps."""
        return [way.label for way in self.back() if way.label is not None][::-1]

    def path(self) -> Path:
        """The way as a path."""
        ways = list(self.back())[::-1]
        return Path(tuple(way.node for way in ways), tuple(self.labels()), tuple(way.state for way in ways))


@dataclass(slots=True)
class _Layer:
    """The ways of one weight that are still to be looked at.

    ``known``: of each pair the first way to it, and the weight of the layer that it came from.
    """

    ways: list[_Way] = field(default_factory=list)
    known: dict[tuple[Node, State], tuple[_Way, Number]] = field(default_factory=dict)
    source: Number | None = None
    mixed: bool = False

    def add(self, way: _Way, source: Number) -> None:
        """Put in a way, unless it adds nothing to another: those from one layer come in program order."""
        other, came_from = self.known.setdefault((way.node, way.state), (way, source))
        if other is not way and came_from == source and other.actions <= way.actions:
            return
        self.mixed = self.mixed or self.source not in (None, source)
        self.source = source
        self.ways.append(way)

    def in_order(self) -> list[_Way]:
        """The ways in program order."""
        return sorted(self.ways, key=cmp_to_key(_program_order)) if self.mixed else self.ways


def _program_order(first: _Way, second: _Way) -> int:
    """Negative if the first way comes first: compares the steps where the two part (neither extends the other)."""
    for a in first.back():
        if a.depth <= second.depth:
            first = a
            break
    for b in second.back():
        if b.depth <= first.depth:
            second = b
            break
    while first.parent is not second.parent:
        assert first.parent is not None and second.parent is not None
        first, second = first.parent, second.parent
    return first.number - second.number


def find(
    machine: Ahead, node: Node, state: State, budget: Budget, weigh: Weigh, dead_end: DeadEnd | None = None
) -> Path | None:
    """The first of the lightest ways with at least one step to a final pair, or none if there is none.

    Raises ``LimitError`` at a limit; ``dead_end`` is told where the search got stuck.
    """
    search = _Search(machine, budget, weigh, dead_end or DeadEnd())
    goal = search.run(_Way(node, state))
    return None if goal is None else goal.path()


class _Search:
    """The layers of one search and the pairs that have been expanded, each with the fewest actions that led there."""

    def __init__(self, machine: Ahead, budget: Budget, weigh: Weigh, dead_end: DeadEnd) -> None:
        self._machine = machine
        self._budget = budget
        self._weigh = weigh
        self._dead_end = dead_end
        self._layers: dict[Number, _Layer] = {}
        self._weights: list[Number] = []
        self._expanded: dict[tuple[Node, State], int] = {}

    def run(self, root: _Way) -> _Way | None:
        """The goal that comes first, layer by layer. The root itself is none: a way has a step."""
        goal = self._follow(root, 0)
        while goal is None and self._weights:
            weight = heappop(self._weights)
            for way in self._layers.pop(weight).in_order():
                goal = way if self._ends(way) else self._follow(way, weight) if self._is_new(way) else None
                if goal is not None:
                    break
        return goal

    def _follow(self, start: _Way, weight: Number) -> _Way | None:
        """The steps from a way that weigh nothing, depth first; others lead to a later layer."""
        stack = [(start, self._steps(start))]
        while stack:
            way, steps = stack[-1]
            after = next(steps, None)
            if after is None:
                stack.pop()
                continue
            heavier = self._weigh(way.state, after.label) if isinstance(after.label, Act) else 0
            if heavier:
                self._postpone(after, weight + heavier, weight)
            elif self._ends(after):
                return after
            elif self._is_new(after):
                stack.append((after, self._steps(after)))
        return None

    def _steps(self, way: _Way) -> Iterator[_Way]:
        """The ways that are one step longer, as far as the budget allows."""
        self._budget.spend()
        blocked = True
        for number, successor in enumerate(self._machine.successors(way.node, way.state)):
            blocked = False
            after = way.extended(number, successor)
            if self._budget.allows(after.actions):
                yield after
        if self._dead_end.outdone(way.actions, blocked):
            self._dead_end.remember(way.actions, blocked, way.labels(), way.node, way.state)

    def _postpone(self, way: _Way, weight: Number, source: Number) -> None:
        if not self._worth(way):
            return
        if weight not in self._layers:
            self._layers[weight] = _Layer()
            heappush(self._weights, weight)
        self._layers[weight].add(way, source)

    def _ends(self, way: _Way) -> bool:
        return self._machine.final(way.node, way.state)

    def _worth(self, way: _Way) -> bool:
        """Whether the pair has not been expanded, or only with less of the bound on steps left."""
        before = self._expanded.get((way.node, way.state))
        return before is None or (self._budget.limits.steps is not None and way.actions < before)

    def _is_new(self, way: _Way) -> bool:
        """Whether the pair is to be expanded, which is then on record."""
        if not self._worth(way):
            return False
        self._expanded[way.node, way.state] = way.actions
        return True
