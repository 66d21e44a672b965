"""Look-ahead: what a program can do in a world in which nothing happens but what is expected."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from golc.program.expected import Events
from golc.program.labels import Act, Expect, Foreseen, Transition, Wait
from golc.program.nodes import Node
from golc.program.program import Program
from golc.program.prunes import Prunes
from golc.program.step import Machine
from golc.situation.dynamics import Dynamics, Outcome
from golc.situation.worlds import State
from golc.theory.types import Value


class Successor(NamedTuple):
    """A step of look-ahead: its label, the residual program, and the state after it.

    The state is the one before it is known what the action senses.
    """

    label: Foreseen
    residual: Node
    state: State


class Fork(NamedTuple):
    """A successor with what its action may sense, at least one outcome; the state of each is the one to go on from."""

    label: Foreseen
    residual: Node
    state: State
    outcomes: list[Outcome]


def may_branch(dynamics: Dynamics) -> bool:
    """Whether an action of the theory may tell something that is not known, so that plans depend on it."""
    return dynamics.compiler.uncertain and any(action.senses for action in dynamics.theory.actions.values())


class Ahead(Machine):
    """Answers what a program can do in a state when it is only thought through.

    Time stands still: ``wait`` ends with an expected exogenous action or not at all, a time is never up, ``abort`` is a
    dead end, and ``search`` is seen through. ``senses``: whether an action may tell something that is not known; with
    ``conformant`` nothing is told.
    """

    lookahead = True

    def __init__(self, dynamics: Dynamics, program: Program, conformant: bool = False) -> None:
        super().__init__(dynamics, program)
        self.senses = may_branch(dynamics) and not conformant
        self._events = Events(dynamics)
        self._prunes = Prunes(dynamics) if dynamics.theory.prunes else None

    def can_wait(self, state: State) -> bool:
        """Whether an expected exogenous action is possible."""
        return self._events.first(state) is not None

    def transitions(self, node: Node, state: State) -> Iterator[Transition]:
        """The transitions in program order; a wait is one only where the program can do nothing else."""
        transitions = super().transitions(node, state)
        return self._waits_last(transitions) if self._events else transitions

    def successors(self, node: Node, state: State) -> Iterator[Successor]:
        """The steps in program order that lead to no bad situation, each computed when it is asked for."""
        for label, residual in self.transitions(node, state):
            if isinstance(label, Act):
                after = self.dynamics.progress(state, label.action, label.args)
                if self._prunes is None or not self._is_pruned(state, label, after):
                    yield Successor(label, residual, after)
            elif isinstance(label, Wait):
                event = self._expected(label, state)
                after = self.dynamics.progress(state, event.action, event.args)
                if not self._is_pruned(state, event, after):
                    yield Successor(event, residual, after)
            else:
                yield Successor(label, residual, state)

    def forks(self, node: Node, state: State) -> Iterator[Fork]:
        """The successors with all that may be sensed, none of which leads to a bad situation."""
        for successor in self.successors(node, state):
            label, residual, after = successor
            outcomes = self.outcomes(successor)
            if len(outcomes) == 1 or not any(self._is_pruned(state, label, o.state, o.results) for o in outcomes):
                yield Fork(label, residual, after, outcomes)

    def outcomes(self, successor: Successor) -> list[Outcome]:
        """What may be sensed after a step, with the states that are then known."""
        label, _, after = successor
        if self.senses and isinstance(label, Act) and self.dynamics.theory.actions[label.action].senses:
            return self.dynamics.outcomes(after, label.action, label.args)
        return [Outcome((), after)]

    def _is_pruned(self, before: State, label: Foreseen, after: State, results: tuple[Value, ...] = ()) -> bool:
        """Whether what has happened leads to a bad situation, which is then blamed."""
        if self._prunes is None or not isinstance(label, Act | Expect):
            return False
        prune = self._prunes.hit(before, label.action, label.args, after)
        if prune is not None:
            self.blame_at(label.span, "pruned", prune, label, results)
        return prune is not None

    def _expected(self, wait: Wait, state: State) -> Expect:
        event = self._events.first(state)
        assert event is not None, "a wait is a transition only where something is expected"
        return Expect(event.action, event.args, wait.span)

    def _waits_last(self, transitions: Iterator[Transition]) -> Iterator[Transition]:
        """What is no wait; if there is nothing, the waits."""
        waits: list[Transition] = []
        acts = False
        for transition in transitions:
            if isinstance(transition.label, Wait):
                waits.append(transition)
            else:
                acts = True
                yield transition
        if not acts:
            yield from waits

    def _try(self, node: Node, state: State) -> None:
        for _ in self.forks(node, state):
            pass
