"""The way with the fewest primitive actions; among equally short ones the first in program order."""

from __future__ import annotations

from golc.planning import layers
from golc.planning.dead_end import DeadEnd
from golc.planning.limits import Budget
from golc.program.ahead import Ahead
from golc.program.labels import Act
from golc.program.nodes import Node
from golc.program.paths import Path
from golc.situation.worlds import State


def find(machine: Ahead, node: Node, state: State, budget: Budget, dead_end: DeadEnd | None = None) -> Path | None:
    """The shortest way with at least one step to a final pair, or none if there is none.

    Raises ``LimitError`` at a limit; ``dead_end`` is told where the search got stuck.
    """
    return layers.find(machine, node, state, budget, _one, dead_end)


def _one(state: State, action: Act) -> int:
    return 1
