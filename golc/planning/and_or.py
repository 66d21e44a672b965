"""Depth-first search of AND-OR graphs: plans that work whatever is sensed.

In a *pair* (of program and state) one of its options is chosen (OR); an option whose action senses something has an
outcome for each result, and the plan must go on from every one of them (AND). This is AND-OR-GRAPH-SEARCH of Russell &
Norvig, "Artificial Intelligence: A Modern Approach", section 4.3, with two tables: pairs that are solved, and pairs
from which there is no plan. A pair that is met again on the way to itself is given up there: plans have no circles.

A failure that was caused by such a pair *q*, still open on the way, holds only while q is open: if q is solved after
all, by another option, there may be a plan through q. Such failures are *tentative*. They are forgotten when a pair
under which they were found is solved, and proven when one fails that depends on nothing above itself.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Generic, NamedTuple, Protocol, TypeVar

from golc.diagnostics import LimitError
from golc.planning.limits import Budget
from golc.program.circles import CIRCLES, runs_in_circles
from golc.program.labels import Act, Foreseen
from golc.theory.types import Value

P = TypeVar("P", bound=Hashable)


class Option(NamedTuple, Generic[P]):
    """Something that can be done in a pair: ``outcomes`` are the results that sensing may have, at least one, each with
    the pair that it leads to."""

    label: Foreseen
    outcomes: tuple[tuple[tuple[Value, ...], P], ...]


class Problem(Protocol[P]):
    """Which pairs end a plan, and what can be done in the others."""

    def is_end(self, pair: P) -> bool: ...

    def options(self, pair: P) -> Iterable[Option[P]]: ...


@dataclass(frozen=True, eq=False, slots=True)
class Solved(Generic[P]):
    """A plan from a pair: none of its options if it is an end, otherwise one, with a plan for each outcome.

    ``actions``: how many the longest branch has.
    """

    pair: P
    option: Option[P] | None = None
    ways: tuple[Solved[P], ...] = ()
    actions: int = 0


@dataclass(frozen=True, eq=False, slots=True)
class Stuck(Generic[P]):
    """Why there is no plan from a pair: nothing can be done there, or the option whose way leads deepest leads, with
    one of its results, to where there is none. ``actions``: how many there are on the way; ``blocked``: nothing can be
    done where it ends, while otherwise all that can be done there leads back or is cut off by the bound on steps."""

    pair: P
    label: Foreseen | None = None
    results: tuple[Value, ...] = ()
    then: Stuck[P] | None = None
    actions: int = 0
    blocked: bool = True


@dataclass(eq=False, slots=True)
class _Failure(Generic[P]):
    """There is no plan from a pair; under a bound on steps, if it is reached with so many actions or more.

    ``position``: that among the tentative failures; none if it is proven.
    """

    pair: P
    actions: int
    stuck: Stuck[P]
    position: int | None


@dataclass(eq=False, slots=True)
class _Open(Generic[P]):
    """A pair on the way: the option that is being tried, and the plans for the first of its outcomes.

    ``actions``: how many led here; ``quiet``: the steps since the last. ``low``: the depth of the highest open pair
    that a failure below depends on. ``mark``: how many tentative failures there were when it was opened.
    """

    pair: P
    actions: int
    quiet: int
    mark: int
    options: Iterator[Option[P]]
    option: Option[P] | None = None
    ways: list[Solved[P]] = field(default_factory=list)
    low: float = math.inf
    stuck: Stuck[P] | None = None
    idle: bool = True

    def fail(self, low: float, stuck: Stuck[P] | None) -> None:
        """The option is given up: one of its outcomes leads nowhere."""
        option, self.option = self.option, None
        assert option is not None
        self.low = min(self.low, low)
        if stuck is None:
            return
        actions = stuck.actions + isinstance(option.label, Act)
        if self.stuck is None or (stuck.blocked, actions) > (self.stuck.blocked, self.stuck.actions):
            results = option.outcomes[len(self.ways)][0] if len(option.outcomes) > 1 else ()
            self.stuck = Stuck(self.pair, option.label, results, stuck, actions, stuck.blocked)


def first(
    problem: Problem[P],
    start: P,
    budget: Budget,
    tell: Callable[[Stuck[P]], None] = lambda stuck: None,
    place: Callable[[P], Hashable] = lambda pair: pair,
) -> Solved[P] | None:
    """The first plan with at least one step that ends in every outcome, options in their order; none if there is none.

    ``tell`` hears why there is none.
    ``place``: what must not be met again on a way. Raises ``LimitError`` at a limit.
    """
    search = _Search(problem, budget, place)
    try:
        found = search.run(start)
    except LimitError:
        if (stuck := search.stuck()) is not None:
            tell(stuck)
        raise
    if isinstance(found, Stuck):
        tell(found)
    return found if isinstance(found, Solved) else None


class _Search(Generic[P]):
    """One search: the open pairs from the start to the current one, and what is known of others."""

    def __init__(self, problem: Problem[P], budget: Budget, place: Callable[[P], Hashable]) -> None:
        self._problem = problem
        self._budget = budget
        self._place = place
        self._way: list[_Open[P]] = []
        self._depths: dict[Hashable, int] = {}
        self._solved: dict[P, Solved[P]] = {}
        self._failed: dict[P, _Failure[P]] = {}
        self._tentative: list[_Failure[P]] = []

    def run(self, start: P) -> Solved[P] | Stuck[P]:
        """See ``first``."""
        self._enter(start, 0, 0)
        while True:
            top = self._way[-1]
            if top.option is None:
                self._choose(top)
            if top.option is not None and len(top.ways) < len(top.option.outcomes):
                self._try(top, top.option)
                continue
            verdict, low = self._leave(top)
            if not self._way:
                return verdict
            if isinstance(verdict, Solved):
                self._way[-1].ways.append(verdict)
            else:
                self._way[-1].fail(low, verdict)

    def stuck(self) -> Stuck[P] | None:
        """Why there is no plan as far as is known: as if nothing but the current way were left."""
        stuck = None
        for open_ in reversed(self._way):
            if stuck is not None and open_.option is not None:
                open_.fail(math.inf, stuck)
            stuck = open_.stuck
        return stuck

    def _enter(self, pair: P, actions: int, quiet: int) -> None:
        self._budget.spend()
        if self._way or not self._problem.is_end(pair):  # a start that is an end may be come back to
            self._depths[self._place(pair)] = len(self._way)
        options = iter(self._problem.options(pair))
        self._way.append(_Open(pair, actions, quiet, len(self._tentative), options))

    def _choose(self, top: _Open[P]) -> None:
        """Take the next option, if there is one that the bound on steps allows."""
        top.ways = []
        for option in top.options:
            top.idle = False
            if self._budget.allows(top.actions + isinstance(option.label, Act)):
                top.option = option
                return

    def _try(self, top: _Open[P], option: Option[P]) -> None:
        """The next outcome of an option: its plan, its failure, or else it is entered."""
        pair = option.outcomes[len(top.ways)][1]
        actions, quiet = (top.actions + 1, 0) if isinstance(option.label, Act) else (top.actions, top.quiet + 1)
        if quiet > CIRCLES:
            raise runs_in_circles(option.label.span)
        solved = self._plan(pair, actions)
        failure = self._failed.get(pair)
        bounded = self._budget.limits.steps is not None
        if solved is not None:
            top.ways.append(solved)
        elif failure is not None and (failure.actions <= actions or not bounded):
            top.fail(self._low(failure), failure.stuck)
        elif (depth := self._depths.get(self._place(pair))) is not None:
            top.fail(depth, None)
        else:
            self._enter(pair, actions, quiet)

    def _plan(self, pair: P, actions: int) -> Solved[P] | None:
        """The plan from a pair that has been reached with so many actions, if it is known and within the bound."""
        solved = self._solved.get(pair)
        if solved is None:
            if pair in self._failed or self._place(pair) in self._depths or not self._problem.is_end(pair):
                return None
            self._solved[pair] = solved = Solved(pair)
        bound = self._budget.limits.steps
        return solved if bound is None or actions + solved.actions <= bound else None

    def _low(self, failure: _Failure[P]) -> float:
        """The depth of the highest open pair that a failure may depend on: it was found below the last open pair that
        was open before it, and what it depends on, that pair's ``low`` has been told of."""
        if failure.position is None:
            return math.inf
        return self._way[bisect_right(self._way, failure.position, key=lambda open_: open_.mark) - 1].low

    def _leave(self, top: _Open[P]) -> tuple[Solved[P] | Stuck[P], float]:
        """Close the last pair of the way: its plan, or why there is none and the ``low`` of this failure."""
        depth = len(self._way) - 1
        self._way.pop()
        self._depths.pop(self._place(top.pair), None)
        if top.option is not None:
            actions = isinstance(top.option.label, Act) + max(way.actions for way in top.ways)
            solved = Solved(top.pair, top.option, tuple(top.ways), actions)
            for failure in self._tentative[top.mark :]:
                if self._failed.get(failure.pair) is failure:
                    del self._failed[failure.pair]
            del self._tentative[top.mark :]
            self._solved[top.pair] = solved
            return solved, math.inf
        stuck = top.stuck or Stuck(top.pair, blocked=top.idle)
        self._failed[top.pair] = failure = _Failure(top.pair, top.actions, stuck, None)
        low = top.low if top.low < depth else math.inf
        if low < depth:
            failure.position = len(self._tentative)
            self._tentative.append(failure)
        else:
            for proven in self._tentative[top.mark :]:
                proven.position = None
            del self._tentative[top.mark :]
        return stuck, low
