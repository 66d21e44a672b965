"""The way whose actions cost the least; among equally cheap ones the first in program order."""

from __future__ import annotations

from golc.planning import layers
from golc.planning.dead_end import DeadEnd
from golc.planning.limits import Budget
from golc.program.ahead import Ahead
from golc.program.labels import Act
from golc.program.nodes import Node
from golc.program.paths import Path, bottom_up
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.types import Number


def find(machine: Ahead, node: Node, state: State, budget: Budget, dead_end: DeadEnd | None = None) -> Path | None:
    """The cheapest way with at least one step to a final pair, or none if there is none.

    Raises ``LimitError`` at a limit and ``ProgramError`` if an action's cost is negative;
    ``dead_end`` is told where the search got stuck.
    """

    def weigh(before: State, action: Act) -> Number:
        return machine.dynamics.cost(before, action.action, action.args)

    return layers.find(machine, node, state, budget, weigh, dead_end)


def cost(dynamics: Dynamics, path: Path) -> Number:
    """The sum of the costs of a path's actions; where it branches, in the dearest branch."""
    costs: dict[Path, Number] = {}
    for part in bottom_up(path, lambda part: part.ways):
        steps = zip(part.states, part.labels, strict=False)
        own = sum(dynamics.cost(before, act.action, act.args) for before, act in steps if isinstance(act, Act))
        costs[part] = own + max([costs[way] for way in part.ways], default=0)
    return costs[path]
