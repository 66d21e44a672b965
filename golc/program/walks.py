"""The walks through a program that decide *Trans* and *Final*, each with a stack of its own instead of recursion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from golc.program.frames import Frame
from golc.program.labels import Label
from golc.program.nodes import Node
from golc.situation.worlds import State
from golc.theory.errors import UndecidedError

if TYPE_CHECKING:
    from golc.program.rules import Rule
    from golc.program.step import Machine

Entered: TypeAlias = frozenset[str]
"""The recursive procedures that have been entered without a step in between."""

NONE_ENTERED: Entered = frozenset()


class Walk:
    """Finds the transitions of a program in a state, one by one, in program order.

    While a rule is asked, ``outer`` is what surrounds its node and ``entered`` what has been entered on the way there.
    """

    __slots__ = ("entered", "machine", "outer", "stack", "state")

    def __init__(self, machine: Machine, state: State, node: Node) -> None:
        self.machine = machine
        self.state = state
        self.outer: Frame | None = None
        self.entered = NONE_ENTERED
        self.stack: list[tuple[Rule, Any, Frame | None, Entered]] = [(node.rule, node, None, NONE_ENTERED)]

    def __iter__(self) -> Iterator[tuple[Label, Node, Frame | None]]:
        """The label of each transition, what is left of the part that makes it, and what surrounds that part."""
        stack = self.stack
        while stack:
            rule, node, self.outer, self.entered = stack.pop()
            try:
                found = rule.trans(self, node)
            except UndecidedError as error:
                if not self.machine.lookahead:
                    raise
                self.machine.blame(rule, "undecided", error)
                continue
            if found is not None:
                outer = self.outer
                if outer is not None and outer.token is not None:
                    outer.token.use()
                yield found[0], found[1], outer

    def push(self, node: Node) -> None:
        """The part's transitions are the node's own; what is pushed last comes first."""
        self.stack.append((node.rule, node, self.outer, self.entered))

    def push_inside(self, node: Node, frame: Frame) -> None:
        """The part's transitions are the node's, with a frame around each residual."""
        self.stack.append((node.rule, node, frame, self.entered))

    def push_task(self, rule: Rule, operand: Any) -> None:
        """Ask a rule again, about something of its own making."""
        self.stack.append((rule, operand, self.outer, self.entered))


class Proof:
    """Decides whether a program is final in a state: a search through *or*, with a chain of obligations for *and*."""

    __slots__ = ("entered", "machine", "rest", "stack", "state")

    def __init__(self, machine: Machine, state: State, node: Node, entered: Entered) -> None:
        self.machine = machine
        self.state = state
        self.rest: Any = None
        self.entered = entered
        self.stack: list[tuple[Node, Any, Entered]] = [(node, None, entered)]

    def succeeds(self) -> bool:
        """Whether it is final."""
        stack = self.stack
        while stack:
            node, self.rest, self.entered = stack.pop()
            try:
                final = node.rule.final(self, node)
            except UndecidedError:
                if not self.machine.lookahead:
                    raise
                continue
            if final:
                if self.rest is None:
                    return True
                stack.append(self.rest)
        return False

    def require(self, node: Node) -> None:
        """Final if the node is; asked again, it offers an alternative, tried before those offered so far."""
        self.stack.append((node, self.rest, self.entered))

    def require_any(self, nodes: Sequence[Node]) -> None:
        """Final if one of the nodes is."""
        for node in reversed(nodes):
            self.require(node)

    def require_all(self, nodes: Iterable[Node]) -> None:
        """Final if all of the nodes are."""
        rest = self.rest
        for node in reversed(tuple(nodes)):
            rest = (node, rest, self.entered)
        self.stack.append(rest)
