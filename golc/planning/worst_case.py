"""Plans whose worst branch weighs as little as possible, and so does the rest of it after every result of sensing.

The graph of pairs and options is explored from the start in the order of weight, as in Dijkstra's algorithm, and the
least weight to an end in the worst case is computed backwards over what has been explored: Knuth's generalization of
Dijkstra's algorithm (1977) with *max* as the superior function. A plan within a weight *w* uses only pairs that are
reached with at most *w*, so as soon as the start is worth no more than what is to be explored next, it is worth that.
Of the options that attain the values, the first in their order make the plan.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterator
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count
from typing import Generic, TypeAlias

from golc.diagnostics import LimitError
from golc.planning.and_or import Option, P, Problem, Solved, Stuck, first
from golc.planning.limits import Budget
from golc.program.circles import CIRCLES, runs_in_circles
from golc.program.labels import Act, Foreseen
from golc.theory.types import Number, Value

Weigh: TypeAlias = Callable[[P, Act], Number]
"""What an action adds to the weight of a branch, given the pair before it; at least 0."""


@dataclass(eq=False, slots=True)
class _Vertex(Generic[P]):
    """A pair: ``value`` is the least weight of a plan from it, as far as is known.

    ``weight`` is the least with which it was reached, and ``quiet`` the steps since the last action on that way.
    ``edges`` are given when it has been expanded; ``idle``: nothing can be done there. ``parents`` have an edge that
    leads here.
    """

    pair: P
    weight: Number
    quiet: int
    value: Number | float = math.inf
    edges: list[_Edge[P]] | None = None
    idle: bool = False
    parents: list[_Vertex[P]] = field(default_factory=list)


@dataclass(eq=False, slots=True)
class _Edge(Generic[P]):
    """An option, what it weighs, and the vertices of its outcomes."""

    option: Option[P]
    weight: Number
    vertices: tuple[_Vertex[P], ...]

    @property
    def value(self) -> Number | float:
        """The least weight of a plan that begins with it."""
        return self.weight + max([vertex.value for vertex in self.vertices])


def find(
    problem: Problem[P],
    start: P,
    budget: Budget,
    weigh: Weigh[P],
    allows: Callable[[Number], bool],
    tell: Callable[[Stuck[P]], None] = lambda stuck: None,
    place: Callable[[P], Hashable] = lambda pair: pair,
) -> Solved[P] | None:
    """The first of the lightest plans with at least one step; none if there is none.

    ``tell`` hears of the longest way to where there is no plan. ``allows``: whether a branch may weigh so much;
    ``place``: see ``and_or.first``. Raises ``LimitError`` at a limit.
    """
    graph = _Graph(problem, start, budget, weigh, allows)
    try:
        value = graph.explore()
    except LimitError:
        tell(graph.stuck())
        raise
    if value is None:
        tell(graph.stuck())
    return first(graph, start, Budget(), place=place) if value is not None and allows(value) else None


_Step: TypeAlias = tuple[_Vertex[P], Foreseen, tuple[Value, ...]]
"""A vertex, what was done there, and the results of sensing."""


class _Graph(Generic[P]):
    """What has been explored; as a problem, its options are those that attain the values."""

    def __init__(
        self, problem: Problem[P], start: P, budget: Budget, weigh: Weigh[P], allows: Callable[[Number], bool]
    ) -> None:
        self._problem = problem
        self._budget = budget
        self._weigh = weigh
        self._allows = allows
        self._root = _Vertex(start, 0, 0)
        self._vertices: dict[P, _Vertex[P]] = {} if problem.is_end(start) else {start: self._root}
        self._number = count()
        self._heap: list[tuple[Number, int, _Vertex[P]]] = [(0, next(self._number), self._root)]

    def explore(self) -> Number | None:
        """Expand what can be a part of the best plan; what it weighs, none if there is none."""
        while self._heap and self._heap[0][0] <= self._root.value:
            _, _, vertex = heappop(self._heap)
            if vertex.edges is None:
                self._expand(vertex)
                self._improve(vertex)
        return None if isinstance(self._root.value, float) else self._root.value

    def stuck(self) -> Stuck[P]:
        """The longest of the shortest ways, through pairs that have no plan, to one where nothing can be done; if there
        is always something to do, to any."""
        before: dict[_Vertex[P], _Step[P] | None] = {self._root: None}
        actions = {self._root: 0}
        deepest = self._root
        pending = [self._root]
        for vertex in pending:
            if (vertex.idle, actions[vertex]) > (deepest.idle, actions[deepest]):
                deepest = vertex
            for edge in vertex.edges or ():
                label, outcomes = edge.option
                for (results, _), other in zip(outcomes, edge.vertices, strict=True):
                    if other.value == math.inf and other not in before:
                        before[other] = vertex, label, results if len(outcomes) > 1 else ()
                        actions[other] = actions[vertex] + isinstance(label, Act)
                        pending.append(other)
        found = Stuck(deepest.pair)
        while (step := before[deepest]) is not None:
            deepest, label, results = step
            found = Stuck(deepest.pair, label, results, found, found.actions + isinstance(label, Act))
        return found

    def is_end(self, pair: P) -> bool:
        """Whether a plan may end there."""
        vertex = self._vertices.get(pair)
        return vertex is not None and vertex.value == 0 and vertex.edges is None

    def options(self, pair: P) -> Iterator[Option[P]]:
        """The options that make the best plan."""
        vertex = self._root if pair == self._root.pair else self._vertices[pair]
        for edge in vertex.edges or ():
            if edge.value == vertex.value:
                yield edge.option

    def _expand(self, vertex: _Vertex[P]) -> None:
        self._budget.spend()
        vertex.edges, vertex.idle = [], True
        for option in self._problem.options(vertex.pair):
            label, vertex.idle = option.label, False
            weight = self._weigh(vertex.pair, label) if isinstance(label, Act) else 0
            if not self._allows(vertex.weight + weight):
                continue
            quiet = 0 if isinstance(label, Act) else vertex.quiet + 1
            if quiet > CIRCLES:
                raise runs_in_circles(label.span)
            reached = [self._reached(pair, vertex.weight + weight, quiet) for _, pair in option.outcomes]
            for other in reached:
                other.parents.append(vertex)
            vertex.edges.append(_Edge(option, weight, tuple(reached)))

    def _reached(self, pair: P, weight: Number, quiet: int) -> _Vertex[P]:
        """The vertex of a pair, on the heap if it is to be expanded and was not reached with less weight."""
        vertex = self._vertices.get(pair)
        if vertex is None:
            self._vertices[pair] = vertex = _Vertex(pair, weight, quiet)
            if self._problem.is_end(pair):
                vertex.value = 0
        elif vertex.weight <= weight:
            return vertex
        vertex.weight, vertex.quiet = weight, quiet
        if vertex.value and vertex.edges is None:
            heappush(self._heap, (weight, next(self._number), vertex))
        return vertex

    def _improve(self, vertex: _Vertex[P]) -> None:
        """Lower the value of a vertex to what its edges allow, and then those of its parents."""
        pending = [vertex]
        while pending:
            vertex = pending.pop()
            value = min([edge.value for edge in vertex.edges or ()], default=math.inf)
            if value < vertex.value:
                vertex.value = value
                pending.extend(vertex.parents)
