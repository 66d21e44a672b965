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
            if isinstance(label, Act | Wait):
                step = self._step(label, residual, state)
                if step is not None:
                    yield step
            else:
                yield Successor(label, residual, state)

    def forks(self, node: Node, state: State) -> Iterator[Fork]:
        """The successors with all that may be sensed, none of which leads to a bad situation."""
        for successor in self.successors(node, state):
            label, residual, after = successor
            outcomes = self.outcomes(successor)
            if len(outcomes) == 1 or not self._prunes or not self._prune_any(state, label, outcomes):
                yield Fork(label, residual, after, outcomes)

    def outcomes(self, successor: Successor) -> list[Outcome]:
        """What may be sensed after a step, with the states that are then known."""
        label, _, after = successor
        if self.senses and isinstance(label, Act) and self.dynamics.theory.actions[label.action].senses:
            return self.dynamics.outcomes(after, label.action, label.args)
        return [Outcome((), after)]

    def _prune_any(self, before: State, label: Foreseen, outcomes: list[Outcome]) -> bool:
        """Whether one of several outcomes is a bad situation."""
        assert isinstance(label, Act)
        for outcome in outcomes:
            prune = self._prunes.hit(before, label.action, label.args, outcome.state)
            if prune is not None:
                self.blame_at(label.span, "pruned", prune, label, outcome.results)
                return True
        return False

    def _step(self, label: Act | Wait, residual: Node, state: State) -> Successor | None:
        """The successor by an action, or by the exogenous action that ends a wait; none if it is pruned."""
        foreseen = label if isinstance(label, Act) else self._expected(label, state)
        after = self.dynamics.progress(state, foreseen.action, foreseen.args)
        if self._prunes:
            prune = self._prunes.hit(state, foreseen.action, foreseen.args, after)
            if prune is not None:
                self.blame_at(label.span, "pruned", prune, foreseen)
                return None
        return Successor(foreseen, residual, after)

    def _expected(self, wait: Wait, state: State) -> Expect:
        event = self._events.first(state)
        assert event is not None, "a wait is a transition only where something is expected"
        return Expect(event.action, event.args, wait.span)

    def _try(self, node: Node, state: State) -> None:
        for _ in self.forks(node, state):
            pass
