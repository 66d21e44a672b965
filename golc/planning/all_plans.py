"""Every distinct action sequence of a program, once, in the order in which depth-first search first derives it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TypeAlias

from golc.planning.dead_end import DeadEnd
from golc.planning.depth_first import find
from golc.planning.limits import Budget
from golc.planning.plans import Step
from golc.program.ahead import Ahead, Successor
from golc.program.labels import Act, Expect
from golc.program.nodes import Node
from golc.situation.worlds import State

Pair: TypeAlias = tuple[Node, State]


def enumerate_plans(
    machine: Ahead, node: Node, state: State, budget: Budget, dead_end: DeadEnd
) -> Iterator[tuple[Step, ...]]:
    """Yield each distinct sequence of primitive and expected exogenous actions that ends in a final pair.

    A pair met again after the same actions adds nothing and is skipped; so is a pair that has no continuation. Raises
    ``LimitError`` at a limit; ``dead_end`` is told where the search got stuck.
    """
    continuations = _Continuations(machine, budget, dead_end)
    root = _Prefix()
    stack: list[tuple[Pair, _Prefix, Iterator[Successor]]] = []
    arrived: tuple[Pair, _Prefix] | None = ((node, state), root)
    while True:
        if arrived is not None and continuations.has(arrived[0]):
            pair, prefix = arrived
            budget.spend()
            prefix.seen.add(pair)
            stack.append((pair, prefix, machine.successors(*pair)))
            if machine.final(*pair) and prefix.list():
                yield prefix.steps()
        if not stack:
            return
        arrived = _next(budget, *stack[-1])
        if arrived is None:
            stack.pop()


def _next(budget: Budget, pair: Pair, prefix: _Prefix, successors: Iterator[Successor]) -> tuple[Pair, _Prefix] | None:
    """The next pair to enter from an open one, with the actions that lead there; none when all have been."""
    for label, residual, state in successors:
        longer = prefix.extended(label) if isinstance(label, (Act, Expect)) else prefix
        if budget.allows(longer.length) and (residual, state) not in longer.seen:
            return (residual, state), longer
    return None


@dataclass(eq=False)
class _Prefix:
    """A sequence of steps as a path in a tree: equal sequences are one object; ``length`` counts the actions."""

    step: Step | None = None
    parent: _Prefix | None = None
    length: int = 0
    children: dict[Step, _Prefix] = field(default_factory=dict)
    seen: set[Pair] = field(default_factory=set)
    listed: bool = False

    def extended(self, step: Step) -> _Prefix:
        """The sequence with one more step."""
        if step not in self.children:
            self.children[step] = _Prefix(step, self, self.length + isinstance(step, Act))
        return self.children[step]

    def list(self) -> bool:
        """Whether the sequence is listed for the first time."""
        listed, self.listed = self.listed, True
        return not listed

    def steps(self) -> tuple[Step, ...]:
        """The steps in order."""
        steps: list[Step] = []
        prefix: _Prefix | None = self
        while prefix is not None and prefix.step is not None:
            steps.append(prefix.step)
            prefix = prefix.parent
        return tuple(reversed(steps))


class _Continuations:
    """Which pairs lead to a final one: each is searched for a way once, and a way answers for all pairs on it."""

    def __init__(self, machine: Ahead, budget: Budget, dead_end: DeadEnd) -> None:
        self._machine = machine
        self._budget = budget
        self._dead_end = dead_end
        self._known: dict[Pair, bool] = {}

    def has(self, pair: Pair) -> bool:
        """Whether a final pair can be reached (under a bound on steps the bound decides instead)."""
        if self._budget.limits.steps is not None:
            return True
        if pair not in self._known:
            path = find(self._machine, *pair, self._budget, self._dead_end)
            for way in zip(path.programs, path.states, strict=True) if path else ():
                self._known[way] = True
            self._known[pair] = path is not None or self._machine.final(*pair)
        return self._known[pair]
