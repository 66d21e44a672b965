"""Conditional plans: ways to the end of a program, or to a goal, that branch by what is sensed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from golc.planning import and_or, worst_case
from golc.planning.and_or import Option, P, Problem, Solved, Stuck
from golc.planning.dead_end import DeadEnd
from golc.planning.ground_actions import GroundActions
from golc.planning.limits import Budget
from golc.planning.plans import answers, sensed, told
from golc.program.ahead import Ahead
from golc.program.labels import Act, Expect
from golc.program.nodes import Node
from golc.program.paths import Path, Run, joined
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.statements import Strategy
from golc.theory.types import Number

Pair: TypeAlias = tuple[Node, State]
Counted: TypeAlias = tuple[Pair, int]


class Programs(Problem[Pair]):
    """What a program can do: the pairs are residual programs with states."""

    def __init__(self, machine: Ahead) -> None:
        self._machine = machine

    def is_end(self, pair: Pair) -> bool:
        """Whether the program is final."""
        return self._machine.final(*pair)

    def options(self, pair: Pair) -> Iterator[Option[Pair]]:
        """The transitions in program order."""
        for fork in self._machine.forks(*pair):
            outcomes = tuple([(outcome.results, (fork.residual, outcome.state)) for outcome in fork.outcomes])
            yield Option(fork.label, outcomes)


class Goal(Problem[Pair]):
    """What can be done without a program; a plan ends where a formula is known to be true."""

    def __init__(self, actions: GroundActions, holds: Callable[..., bool]) -> None:
        self._actions = actions
        self._holds = holds

    def is_end(self, pair: Pair) -> bool:
        """Whether the goal is reached."""
        return self._holds(pair[1], ())

    def options(self, pair: Pair) -> Iterator[Option[Pair]]:
        """What can be done, in the order of the ground actions."""
        for label, outcomes in self._actions.forks(pair[1]):
            yield Option(label, tuple([(outcome.results, (pair[0], outcome.state)) for outcome in outcomes]))


class _Counted(Problem[Counted]):
    """A problem in which every plan has at most as many actions as a budget allows: the pairs count them."""

    def __init__(self, problem: Problem[Pair], budget: Budget) -> None:
        self._problem = problem
        self._budget = budget

    def is_end(self, pair: Counted) -> bool:
        return self._problem.is_end(pair[0])

    def options(self, pair: Counted) -> Iterator[Option[Counted]]:
        for label, outcomes in self._problem.options(pair[0]):
            actions = pair[1] + isinstance(label, Act)
            if self._budget.allows(actions):
                yield Option(label, tuple([(results, (after, actions)) for results, after in outcomes]))


def find(
    problem: Problem[Pair], dynamics: Dynamics, strategy: Strategy, start: Pair, budget: Budget, dead_end: DeadEnd
) -> Path | None:
    """The first, shortest or cheapest plan with at least one step, or none if there is none.

    A plan is as short or cheap as its worst branch, and its branches are so, too, from where they begin. Raises
    ``LimitError`` at a limit; ``dead_end`` is told where the search got stuck.
    """

    def cost(pair: Pair, act: Act) -> Number:
        return dynamics.cost(pair[1], act.action, act.args)

    def tell(stuck: Stuck[Pair]) -> None:
        _tell(dead_end, stuck, dynamics, lambda pair: pair)

    def tell_counted(stuck: Stuck[Counted]) -> None:
        _tell(dead_end, stuck, dynamics, _uncounted)

    found: Solved[Pair] | None
    match strategy:
        case Strategy.FIRST:
            found = and_or.first(problem, start, budget, tell)
        case Strategy.SHORTEST:
            found = worst_case.find(problem, start, budget, _one, lambda weight: budget.allows(int(weight)), tell)
        case Strategy.CHEAPEST if budget.limits.steps is None:
            found = worst_case.find(problem, start, budget, cost, _always, tell)
        case Strategy.CHEAPEST:
            counted = _Counted(problem, budget)
            way = worst_case.find(
                counted, (start, 0), budget, lambda pair, act: cost(pair[0], act), _always, tell_counted, _uncounted
            )
            return _path(way, dynamics, _uncounted)
    return _path(found, dynamics, lambda pair: pair)


def _uncounted(pair: Counted) -> Pair:
    return pair[0]


def _one(pair: Pair, act: Act) -> int:
    return 1


def _always(weight: Number) -> bool:
    return True


def _path(found: Solved[P] | None, dynamics: Dynamics, pair_of: Callable[[P], Pair]) -> Path | None:
    return None if found is None else joined(found, lambda solved: _run(solved, dynamics, pair_of))


def _run(solved: Solved[P], dynamics: Dynamics, pair_of: Callable[[P], Pair]) -> Run[Solved[P]]:
    """A plan up to the first option with several outcomes."""
    node, state = pair_of(solved.pair)
    programs, labels, states = [node], [], [state]
    while solved.option is not None:
        label, outcomes = solved.option
        labels.append(label)
        node, after = pair_of(outcomes[0][1])
        programs.append(node)
        if len(outcomes) > 1:
            assert isinstance(label, Act)
            states.append(dynamics.progress(state, label.action, label.args))
            branches = [(results, way) for (results, _), way in zip(outcomes, solved.ways, strict=True)]
            return Path(tuple(programs), tuple(labels), tuple(states)), tuple(branches)
        states.append(after)
        state, solved = after, solved.ways[0]
    return Path(tuple(programs), tuple(labels), tuple(states)), ()


def _tell(dead_end: DeadEnd, stuck: Stuck[P], dynamics: Dynamics, pair_of: Callable[[P], Pair]) -> None:
    """Remember the way to where nothing leads on."""
    dead_end.actions = stuck.actions
    way = []
    while stuck.then is not None:
        if isinstance(stuck.label, Act | Expect):
            way.append(_answered(stuck, pair_of(stuck.then.pair)[1], dynamics))
        stuck = stuck.then
    dead_end.way = tuple(way)
    dead_end.node, dead_end.state = pair_of(stuck.pair)


def _answered(stuck: Stuck[P], after: State, dynamics: Dynamics) -> str:
    """A step that leads to a dead end, with the results of sensing that do."""
    if not stuck.results:
        return str(stuck.label)
    assert isinstance(stuck.label, Act)
    names, results = sensed(dynamics, stuck.label, after), told(dynamics, stuck.label, stuck.results)
    return f"{stuck.label} ({answers(names, results)})"
