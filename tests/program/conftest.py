from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from textwrap import dedent, indent

import pytest

from golc.planning.planner import Executable, executable
from golc.program.labels import Abort, Act, Clock, Label, Say, Silent, Wait
from golc.program.nodes import Node
from golc.program.step import Machine
from golc.situation.worlds import State
from tests.theories import theory_of

DECLARATIONS = """
domain trial
type digit = 0..3
fluent x: int = 0
fluent p: bool = false
fluent on(n: digit) = n in {1, 2}
fluent todo: list[digit] = [2, 0, 2]
fluent seen: set[digit] = {3, 1}
action a
action b
action c
action act(n: int)
action inc:
    causes x := x + 1
action off(n: digit):
    poss on(n)
    causes on(n) := false
action push(n: digit):
    causes todo := todo + [n]
    causes seen := seen - {n}
type colour = {red, green, blue}
action paint(cs: set[colour], names: list[string], by: real)
action never:
    poss false
exog set_x(n: int):
    causes x := n
exog set_todo(l: list[digit]):
    causes todo := l
exog set_p:
    causes p := true
exog clear_p:
    causes p := false
"""


@dataclass
class Running:
    """A program and a state, with the questions that tests ask about them."""

    executable: Executable
    machine: Machine
    node: Node
    state: State

    def labels(self) -> list[str]:
        """The labels of the transitions, in order."""
        return [spell(label) for label, _ in self.machine.transitions(self.node, self.state)]

    @property
    def final(self) -> bool:
        return self.machine.final(self.node, self.state)

    def take(self, index: int = 0) -> Running:
        """After one of the transitions."""
        label, node = list(self.machine.transitions(self.node, self.state))[index]
        return Running(self.executable, self.machine, node, self.machine.successor(self.state, label))

    def event(self, action: str, *args: object) -> Running:
        """After an exogenous action."""
        state = self.executable.dynamics.progress(self.state, action, args)
        return Running(self.executable, self.machine, self.node, state)

    def run(self, most: int = 10**6) -> list[str]:
        """What the online loop does until the program is final or blocked, tests left out."""
        done: list[str] = []
        current = self
        for _ in range(most):
            if current.final:
                return done
            transition = current.machine.decide(current.node, current.state)
            if transition is None:
                return [*done, "blocked"]
            if isinstance(transition.label, Wait):
                return [*done, "waits"]
            if not isinstance(transition.label, Silent):
                done.append(spell(transition.label))
            state = current.machine.successor(current.state, transition.label)
            current = Running(current.executable, current.machine, transition.residual, state)
        return [*done, "goes on"]


def spell(label: Label) -> str:
    match label:
        case Act():
            return str(label)
        case Silent():
            return "test"
        case Wait():
            return "wait"
        case Clock():
            return "clock"
        case Say(text=text):
            return f"say {text}"
        case Abort(text=text):
            return f"abort {text}"


Start = Callable[..., Running]


@pytest.fixture(scope="session")
def start() -> Start:
    """Start a program: the lines of ``control``, and further procedures as they stand."""

    def make(body: str, procedures: str = "", ahead: bool = False) -> Running:
        control = indent(dedent(body).strip(), "    ")
        theory = theory_of(f"{DECLARATIONS}{dedent(procedures)}\nproc control:\n{control}\n".lstrip())
        ready = executable(theory, "control")
        machine = ready.machine.ahead if ahead else ready.machine
        return Running(ready, machine, ready.node, ready.dynamics.initial())

    return make
