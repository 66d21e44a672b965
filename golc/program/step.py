"""*Trans* and *Final* over (program, state), as the online loop and the planner ask for them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

from golc.program.blame import Blamed, Blocked, explain
from golc.program.frames import Frame, resume
from golc.program.labels import Act, Clock, Label, Transition, Wait
from golc.program.lookahead import ANY, Request
from golc.program.nodes import Node
from golc.program.program import Program
from golc.program.rules import Found, Rule
from golc.program.walks import NONE_ENTERED, Entered, Proof, Walk
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State


@dataclass(frozen=True, eq=False)
class Path:
    """A way to the end of a program: ``programs`` and ``states`` have one element more than ``labels``.

    ``request``: what it answers.
    """

    programs: tuple[Node, ...]
    labels: tuple[Label, ...]
    states: tuple[State, ...]
    request: Request = ANY

    def rest(self, index: int) -> Request:
        """What is wanted of a way from the place that so many steps have led to."""
        return self.request.after(self.labels[:index])


@dataclass(frozen=True)
class NoPath:
    """There is no way; if a limit kept it from being found, ``limit`` says which.

    ``deepest`` are the actions of the longest way, ``reasons`` what failed at its end.
    """

    limit: str | None = None
    deepest: tuple[Act, ...] = ()
    reasons: tuple[Blocked, ...] = ()


class Planner(Protocol):
    """Finds a way from a program and a state to a final program, with at least one step."""

    def __call__(self, machine: Machine, node: Node, state: State, request: Request) -> Path | NoPath: ...


class Machine:
    """Answers what a program can do in a state.

    There are two of them for a program: one for what happens online, and ``ahead`` for look-ahead, in which time stands
    still: ``wait`` is a dead end, ``wait until φ`` a test, ``search`` is seen through.
    """

    def __init__(self, dynamics: Dynamics, program: Program, planner: Planner, ahead: Machine | None = None) -> None:
        self.dynamics = dynamics
        self.program = program
        self.lookahead = ahead is None
        self.ahead: Machine = ahead or self
        self._planner = planner
        self.now: Callable[[], float] = lambda: 0.0
        """The clock: seconds since the start of the run. Whoever executes the program sets it."""
        self.alarm: float | None = None
        """When the program is to be asked again though nothing has happened, by the last ``decide``."""
        self._paths: dict[tuple[Node, State, Request], Path | NoPath] = {}
        self._blamed: list[Blamed] | None = None

    def transitions(self, node: Node, state: State) -> Iterator[Transition]:
        """The transitions in program order, each computed when it is asked for."""
        for label, residual, frame in Walk(self, state, node):
            yield Transition(label, resume(self.program, residual, frame))

    def final(self, node: Node, state: State, entered: Entered = NONE_ENTERED) -> bool:
        """Whether the program may end in this state."""
        return node.may_finish and Proof(self, state, node, entered).succeeds()

    def decide(self, node: Node, state: State, barred: Collection[Act] = ()) -> Transition | None:
        """The transition that the online loop takes: a test step if there is one, otherwise the first action step that
        is not barred, otherwise the start of a clock, otherwise a wait; none if the program is final or blocked."""
        self.alarm = None
        if node.rule.steps_when_final and self.final(node, state):
            return None
        action = start = wait = timed = None
        for found in Walk(self, state, node):
            label = found[0]
            if isinstance(label, Act):
                if action is None and label not in barred:
                    action = found
            elif isinstance(label, Clock):
                start = start or found
            elif isinstance(label, Wait):
                if label.timed:
                    timed = timed or found
                else:
                    wait = wait or found
                start = start or _starting(found[2])
            else:
                action = found
                break
        taken = action or start or wait or timed
        return None if taken is None else Transition(taken[0], resume(self.program, taken[1], taken[2]))

    def successor(self, state: State, label: Label) -> State:
        """The state after a transition, without what sensing or the world might add."""
        if isinstance(label, Act):
            return self.dynamics.progress(state, label.action, label.args)
        return state

    def why_blocked(self, node: Node, state: State) -> list[Blocked]:
        """Each branch that cannot go on, in program order: where, which condition failed, and the values it had."""
        self._blamed = []
        try:
            for _ in self.transitions(node, state):
                pass
            return [explain(self.dynamics, state, blamed) for blamed in self._blamed]
        finally:
            self._blamed = None

    def ring_at(self, moment: float) -> None:
        """A rule wants to be asked again at a moment."""
        self.alarm = moment if self.alarm is None else min(self.alarm, moment)

    def is_past(self, moment: float) -> bool:
        """Whether a moment has come."""
        return self.now() >= moment

    def blame(self, rule: Rule, reason: str, *details: object) -> None:
        """A rule reports why it has no transition; kept only while somebody wants to know."""
        if self._blamed is not None:
            self._blamed.append(Blamed(rule, reason, details))

    def begin_search(self, rule: Rule, body: Node, state: State, request: Request) -> Found:
        """The first step of a way to the end of a ``search`` block."""
        path = self._path(body, state, request)
        if isinstance(path, NoPath):
            self.blame(rule, "no way", path)
            return None
        return self._step(path, 0)

    def follow(self, rule: Rule, path: Path, index: int, state: State) -> Found:
        """The next step of a path, which is replayed, or the rest searched anew, if the state is not as expected."""
        current: Path | NoPath = path
        done = index
        if path.states[index] != state:
            replayed = self._replayed(path, index, state)
            current, index = replayed or self._path(path.programs[index], state, path.rest(index)), 0
        if isinstance(current, Path) and index == len(current.labels):
            current, index = self._path(current.programs[-1], state, current.rest(index)), 0
        if isinstance(current, NoPath):
            if not self.ahead.final(path.programs[done], state):
                self.blame(rule, "lost", path, done, current)
            return None
        return self._step(current, index)

    def _step(self, path: Path, index: int) -> tuple[Label, Node]:
        label, rest = path.labels[index], self.program.node(self.program.following, (path, index + 1))
        if isinstance(label, Clock):
            return label, self.program.sequence(self.program.pause(label, self.now()), rest)
        return label, rest

    def _replayed(self, path: Path, index: int, state: State) -> Path | None:
        """The rest of a path by the same choices from another state, if they still lead to the end."""
        labels: list[Label] = []
        states = [state]
        for (node, residual), taken in zip(pairwise(path.programs[index:]), path.labels[index:], strict=True):
            transitions = self.ahead.transitions(node, state)
            label = next((label for label, to in transitions if to is residual and label == taken), None)
            if label is None:
                return None
            state = self.successor(state, label)
            labels.append(label)
            states.append(state)
        if not self.ahead.final(path.programs[-1], state):
            return None
        return Path(path.programs[index:], tuple(labels), tuple(states), path.rest(index))

    def _path(self, node: Node, state: State, request: Request) -> Path | NoPath:
        """What the planner finds; remembered, for a blocked program is asked again and again in the same state."""
        key = (node, state, request)
        if key not in self._paths:
            if len(self._paths) >= 64:
                self._paths.pop(next(iter(self._paths)))
            self._paths[key] = self._planner(self.ahead, node, state, request)
        return self._paths[key]


def _starting(frame: Frame | None) -> tuple[Label, Node, Frame | None] | None:
    """Instead of a wait that is the first transition of a ``within``: its clock starts, and nothing else happens."""
    timed = None if frame is None else frame.starting
    if timed is None or timed.start is None:
        return None
    return timed.start[0], timed.start[1], timed
