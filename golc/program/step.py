"""*Trans* and *Final* over (program, state), as the online loop and the planner ask for them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from typing import TYPE_CHECKING

from golc.diagnostics import Span
from golc.program.blame import Blamed, Blocked, explain
from golc.program.following import Searches
from golc.program.frames import Frame, resume
from golc.program.labels import Act, Clock, Label, Transition, Wait
from golc.program.nodes import Node
from golc.program.program import Program
from golc.program.rules import Rule
from golc.program.walks import NONE_ENTERED, Entered, Proof, Walk
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State

if TYPE_CHECKING:
    from golc.program.ahead import Ahead
    from golc.program.paths import Planner


class Machine:
    """Answers what a program can do in a state when it is executed; ``ahead`` does so for look-ahead."""

    lookahead = False
    searches: Searches
    """What the ``search`` blocks do; look-ahead sees through them."""

    def __init__(
        self, dynamics: Dynamics, program: Program, ahead: Ahead | None = None, planner: Planner | None = None
    ) -> None:
        self.dynamics = dynamics
        self.program = program
        self.ahead: Machine = ahead or self
        if ahead is not None and planner is not None:
            self.searches = Searches(self, ahead, planner)
        self.now: Callable[[], float] = lambda: 0.0
        """The clock: seconds since the start of the run. Whoever executes the program sets it."""
        self.alarm: float | None = None
        """When the program is to be asked again though nothing has happened, by the last ``decide``."""
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
            self._try(node, state)
            return [explain(self.dynamics, state, blamed) for blamed in self._blamed]
        finally:
            self._blamed = None

    def _try(self, node: Node, state: State) -> None:
        """Ask for all transitions, so that what has none is blamed."""
        for _ in self.transitions(node, state):
            pass

    def can_wait(self, state: State) -> bool:
        """Whether a wait is a transition: something may happen."""
        return True

    def ring_at(self, moment: float) -> None:
        """A rule wants to be asked again at a moment."""
        self.alarm = moment if self.alarm is None else min(self.alarm, moment)

    def is_past(self, moment: float) -> bool:
        """Whether a moment has come."""
        return self.now() >= moment

    def blame(self, rule: Rule, reason: str, *details: object) -> None:
        """A rule reports why it has no transition; kept only while somebody wants to know."""
        if self._blamed is not None:
            self._blamed.append(Blamed(rule.span, reason, details))

    def blame_at(self, span: Span, reason: str, *details: object) -> None:
        """As ``blame``, by the place."""
        if self._blamed is not None:
            self._blamed.append(Blamed(span, reason, details))


def _starting(frame: Frame | None) -> tuple[Label, Node, Frame | None] | None:
    """Instead of a wait that is the first transition of a ``within``: its clock starts, and nothing else happens."""
    timed = None if frame is None else frame.starting
    if timed is None or timed.start is None:
        return None
    return timed.start[0], timed.start[1], timed
