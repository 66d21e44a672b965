"""Where a search got stuck."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from golc.program.labels import Act, Expect, Foreseen
from golc.program.nodes import Node
from golc.situation.worlds import State


@dataclass
class DeadEnd:
    """The longest way on which a search got stuck: how many actions it has, how it is shown, and where it ended."""

    actions: int = 0
    way: tuple[str, ...] = ()
    node: Node | None = None
    state: State = ()

    def consider(self, actions: int, labels: Iterable[Foreseen | None], node: Node, state: State) -> None:
        """Remember a dead end if it is the deepest so far: the number of its actions, and the steps that led there."""
        if self.node is None or actions > self.actions:
            self.actions = actions
            self.way = tuple(str(label) for label in labels if isinstance(label, Act | Expect))
            self.node, self.state = node, state
