"""Depth-first search for a way to the end of a program, in program order.

A (program, state) pair that has been expanded is skipped: what can be reached from it has been or will be looked at.
Under a bound on steps it is expanded again when it is reached with more of the bound left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from golc.planning.dead_end import DeadEnd
from golc.planning.limits import Budget
from golc.program.ahead import Ahead, Successor
from golc.program.circles import CIRCLES, runs_in_circles
from golc.program.labels import Act, Foreseen
from golc.program.nodes import Node
from golc.program.paths import Path
from golc.situation.worlds import State


@dataclass(slots=True)
class _Step:
    """A pair on the current way, the label that led to it, and its successors still to try.

    ``actions`` counts the actions up to it, ``quiet`` the steps since the last one.
    """

    label: Foreseen | None
    node: Node
    state: State
    actions: int
    quiet: int
    successors: Iterator[Successor]
    leads_on: bool = field(default=False)

    def count(self, label: Foreseen) -> tuple[int, int]:
        """``actions`` and ``quiet`` after one more step; a program that runs in circles is an error."""
        if isinstance(label, Act):
            return self.actions + 1, 0
        if self.quiet >= CIRCLES:
            raise runs_in_circles(label.span)
        return self.actions, self.quiet + 1


def find(machine: Ahead, node: Node, state: State, budget: Budget, dead_end: DeadEnd | None = None) -> Path | None:
    """The first way with at least one step from a program and a state to a final pair, or none if there is none.

    Raises ``LimitError`` at a limit; ``dead_end`` is told where the search got stuck.
    """
    reached: dict[tuple[Node, State], int] = {(node, state): 0}
    steps = [_Step(None, node, state, 0, 0, machine.successors(node, state))]
    budget.spend()
    while steps:
        step = steps[-1]
        for label, residual, after in step.successors:
            step.leads_on = True
            actions, quiet = step.count(label)
            if not budget.allows(actions):
                continue
            if machine.final(residual, after):
                steps.append(_Step(label, residual, after, actions, quiet, iter(())))
                return _path(steps)
            if _is_new(reached, (residual, after), actions, budget):
                budget.spend()
                steps.append(_Step(label, residual, after, actions, quiet, machine.successors(residual, after)))
                break
        else:
            blocked = not step.leads_on
            if dead_end is not None and dead_end.outdone(step.actions, blocked):
                dead_end.remember(step.actions, blocked, (step.label for step in steps), step.node, step.state)
            steps.pop()
    return None


def _is_new(reached: dict[tuple[Node, State], int], pair: tuple[Node, State], actions: int, budget: Budget) -> bool:
    before = reached.get(pair)
    if before is not None and (budget.limits.steps is None or before <= actions):
        return False
    reached[pair] = actions
    return True


def _path(steps: list[_Step]) -> Path:
    return Path(
        tuple(step.node for step in steps),
        tuple(step.label for step in steps if step.label is not None),
        tuple(step.state for step in steps),
    )
