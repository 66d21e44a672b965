"""Where a search got stuck."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from golc.program.labels import Act, Expect, Foreseen
from golc.program.nodes import Node
from golc.situation.worlds import State


@dataclass
class DeadEnd:
    """The longest way on which a search got stuck: how many actions it has, how it is shown, and where it ended.

    ``blocked``: nothing could be done there; if there was always something to do, any way will do.
    """

    actions: int = 0
    way: tuple[str, ...] = ()
    node: Node | None = None
    state: State = ()
    blocked: bool = False

    def outdone(self, actions: int, blocked: bool) -> bool:
        """Whether a dead end with so many actions, or one that is blocked, says more."""
        return self.node is None or (blocked, actions) > (self.blocked, self.actions)

    def remember(
        self, actions: int, blocked: bool, labels: Iterable[Foreseen | None], node: Node, state: State
    ) -> None:
        """Take this dead end for the deepest: the number of its actions, and the steps that led there."""
        self.actions, self.blocked = actions, blocked
        self.way = tuple(str(label) for label in labels if isinstance(label, Act | Expect))
        self.node, self.state = node, state
