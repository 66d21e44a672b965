"""What ``search`` does online: it takes the first step of a way that look-ahead has found, then follows that way."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from golc.program.labels import Clock, Expect, Foreseen, Label, Wait
from golc.program.lookahead import Request
from golc.program.nodes import Node
from golc.program.paths import NoPath, Path, Planner, Run, joined
from golc.program.rules import Found, Rule
from golc.situation.dynamics import Outcome
from golc.situation.worlds import State

if TYPE_CHECKING:
    from golc.program.ahead import Ahead, Fork
    from golc.program.step import Machine

_Place: TypeAlias = tuple[Path, int, State]
"""A place on a way, with the state that it is reached in."""

MOST_REMEMBERED = 64
"""How many ways are kept, the latest ones: a blocked program is asked again and again in the same state."""


class Searches:
    """Finds and follows the ways of the ``search`` blocks of one program."""

    def __init__(self, machine: Machine, ahead: Ahead, planner: Planner) -> None:
        self._machine = machine
        self._program = machine.program
        self._ahead = ahead
        self._planner = planner
        self._paths: dict[tuple[Node, State, Request], Path | NoPath] = {}

    def begin(self, rule: Rule, body: Node, state: State, request: Request) -> Found:
        """The first step of a way to the end of a ``search`` block."""
        path = self._path(body, state, request)
        if isinstance(path, NoPath):
            self._machine.blame(rule, "no way", path)
            return None
        return self._step(path, 0)

    def follow(self, rule: Rule, path: Path, index: int, state: State) -> Found:
        """The next step of a path; if the state is not as expected, the same choices are tried in it, and otherwise the
        rest is searched anew."""
        current = self._current(path, index, state)
        if isinstance(current, NoPath):
            if not self._ahead.final(path.programs[index], state):
                self._machine.blame(rule, "lost", path, index, current)
            return None
        return self._step(*current)

    def _current(self, path: Path, index: int, state: State) -> tuple[Path, int] | NoPath:
        """The path that leads on from a place of another one, and the place on it."""
        place = self._place(path, index, state)
        if place is not None and place[1] < len(place[0].labels):
            return place
        found = self._path(path.programs[index], state, path.rest(index))
        return found if isinstance(found, NoPath) else (found, 0)

    def _place(self, path: Path, index: int, state: State) -> tuple[Path, int] | None:
        """The place on a way where its state is the real one: on the branch that has it, or as the same choices lead to
        the end from there; none if they do not."""
        ways = [path]
        if index == len(path.labels) and path.branches:
            ways, index = [path.continued(branch.path) for branch in path.branches], 0
        for way in ways:
            if way.states[index] == state:
                return way, index
        for way in ways:
            if again := joined((way, index, state), self._again):
                return again, 0
        return None

    def _again(self, key: _Place) -> Run[_Place] | None:
        """The rest of a way by the same choices and with the same results, from another state, up to where it branches;
        none if that does not lead to the end."""
        path, index, state = key
        labels: list[Foreseen] = []
        states = [state]
        outcomes = [Outcome((), state)]
        for number in range(index, len(path.labels)):
            taken = self._taken(path, number, states[-1]) if len(outcomes) == 1 else None
            if taken is None:
                return None
            labels.append(taken.label)
            outcomes = taken.outcomes
            states.append(outcomes[0].state if len(outcomes) == 1 else taken.state)
        run = Path(path.programs[index:], tuple(labels), tuple(states), (), path.request, path.actions(index))
        if not path.branches:
            ends = len(outcomes) == 1 and self._ahead.final(path.programs[-1], states[-1])
            return (run, ()) if ends else None
        ways = {branch.results: branch.path for branch in path.branches}
        if not all(outcome.results in ways for outcome in outcomes):
            return None
        return run, tuple([(outcome.results, (ways[outcome.results], 0, outcome.state)) for outcome in outcomes])

    def _taken(self, path: Path, number: int, state: State) -> Fork | None:
        """A step of a way, taken in another state."""
        for fork in self._ahead.forks(path.programs[number], state):
            if fork.residual is path.programs[number + 1] and fork.label == path.labels[number]:
                return fork
        return None

    def _step(self, path: Path, index: int) -> tuple[Label, Node]:
        label, rest = path.labels[index], self._program.node(self._program.following, (path, index + 1))
        if isinstance(label, Clock):
            return label, self._program.sequence(self._program.pause(label, self._machine.now()), rest)
        return (Wait(label.span), rest) if isinstance(label, Expect) else (label, rest)

    def _path(self, node: Node, state: State, request: Request) -> Path | NoPath:
        """What the planner finds; remembered."""
        key = (node, state, request)
        if key not in self._paths:
            if len(self._paths) >= MOST_REMEMBERED:
                self._paths.pop(next(iter(self._paths)))
            self._paths[key] = self._planner(self._ahead, node, state, request)
        return self._paths[key]
