"""Look-ahead: what a program can do in a world in which nothing happens but what is expected."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from golc.program.expected import Event, Events
from golc.program.labels import Act, Expect, Foreseen, Label, Transition, Wait
from golc.program.nodes import Node
from golc.program.program import Program
from golc.program.prunes import Prunes
from golc.program.step import Machine
from golc.situation.dynamics import Dynamics, Outcome
from golc.situation.layout import State


class Successor(NamedTuple):
    """A step of look-ahead: its label, the residual program, and the state after it.

    The state is the one before it is known what the action senses.
    """

    label: Foreseen
    residual: Node
    state: State


class Ahead(Machine):
    """Answers what a program can do in a state when it is only thought through.

    Time stands still: ``wait`` ends with an expected exogenous action or not at all, a time is never up, ``abort`` is a
    dead end, and ``search`` is seen through. ``senses``: whether an action may tell something that is not known.
    """

    lookahead = True

    def __init__(self, dynamics: Dynamics, program: Program) -> None:
        super().__init__(dynamics, program)
        self._events = Events(dynamics)
        self._prunes = Prunes(dynamics)

    def can_wait(self, state: State) -> bool:
        """Whether an expected exogenous action is possible."""
        return self._events.first(state) is not None

    def transitions(self, node: Node, state: State) -> Iterator[Transition]:
        """The transitions in program order; a wait is one only where the program can do nothing else."""
        waits: list[Transition] = []
        acts = False
        for transition in super().transitions(node, state):
            if isinstance(transition.label, Wait):
                waits.append(transition)
            else:
                acts = True
                yield transition
        if not acts:
            yield from waits

    def successors(self, node: Node, state: State) -> Iterator[Successor]:
        """The steps in program order that lead to no bad situation, each computed when it is asked for."""
        for label, residual in self.transitions(node, state):
            ...
