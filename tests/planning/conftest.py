from __future__ import annotations

import contextlib
import io
import itertools
import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from golc.cli import invoke
from golc.theory.order import spelt
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Type, writable
from tests.reference.definitions import Definitions

Plan = list[dict[str, Any]]
"""A plan as it is printed."""

MOST_SILENT = 60
"""Steps without an action in a row that are looked at."""


def as_json(values: tuple[Any, ...], types: list[Type]) -> str:
    """Values as they are printed."""
    return json.dumps(writable(tuple(map(spelt, values, types))))


class Validity:
    """Says whether a printed plan is an execution of a program to its end in every possible world.

    Nothing of the planning or of the machine that executes programs is used: the definitions decide. ``conformant``:
    what is sensed is not made use of.
    """

    def __init__(self, theory: BasicActionTheory, conformant: bool = False) -> None:
        self.d = Definitions(theory, True)
        self.theory = theory
        self.conformant = conformant

    def of_program(self, plan: Plan, procedure: str = "control", args: tuple[Any, ...] = ()) -> bool:
        """Whether some choices of the program lead through exactly these steps to its end."""
        return bool(self._executes(self.d.start(procedure, args), self.d.k.initial(), plan, 0))

    def of_goal(self, plan: Plan, goal: str) -> bool:
        """Whether the steps can be done, and lead to where a goal is known to hold."""
        return self._reaches(self.theory.definitions[goal].body, self.d.k.initial(), plan)

    def _executes(self, config: Any, worlds: Any, plan: Plan, silent: int) -> bool:
        if not plan and self.d.final(config, worlds):
            return True
        for label, left, after in self._steps(config, worlds):
            if label in ("test", "clock"):
                if silent < MOST_SILENT and self._executes(left, after, plan, silent + 1):
                    return True
            elif plan and self._is(plan[0], label):
                name, args = label[1:] if label[0] == "expected" else label
                ways = self._ways(plan, name, args, worlds, after)
                if ways and all(self._executes(left, known, rest, 0) for known, rest in ways):
                    return True
        return False

    def _steps(self, config: Any, worlds: Any) -> Iterator[tuple[Any, Any, Any]]:
        """The transitions; those that wait end with what is expected, if nothing else can be done."""
        found = self.d.trans(config, worlds)
        yield from [step for step in found if step[0] != "wait"]
        event = self.d.expected(worlds)
        if event is not None and all(step[0] == "wait" for step in found):
            for _, left, _ in found:
                yield ("expected", *event), left, self.d.k.progress(event[0], worlds, event[1])

    def _is(self, step: dict[str, Any], label: tuple[Any, ...]) -> bool:
        kind, name, args = label if label[0] == "expected" else ("action", *label)
        types = [parameter.type for parameter in self.theory.actions[name].parameters]
        return step.get(kind) == name and json.dumps(step["args"]) == as_json(args, types)

    def _ways(self, plan: Plan, name: str, args: Any, before: Any, after: Any) -> list[tuple[Any, Plan]] | None:
        """What is known after the first step of a plan, by the results of sensing, each with the steps to go on with;
        none if a result is left out or cannot be, or the situation is a bad one."""
        outcomes = {(): after} if self.conformant else self.d.k.outcomes(name, after, args)
        if any(self.d.k.pruned(name, args, before, known) for known in outcomes.values()):
            return None
        branches = plan[0].get("branches")
        if branches is None:
            return [(after, plan[1:])] if len(outcomes) == 1 else None
        if len(plan) > 1 or len(outcomes) == 1 or len(branches) != len(outcomes):
            return None
        by_results = {json.dumps(branch["results"]): branch["plan"] for branch in branches}
        types = [term.type for term in self.theory.actions[name].senses]
        named = {as_json(results, types): known for results, known in outcomes.items()}
        return [(known, by_results[name]) for name, known in named.items()] if {*named} == {*by_results} else None

    def _reaches(self, goal: Any, worlds: Any, plan: Plan) -> bool:
        if not plan:
            return bool(self.d.k.holds(goal, worlds, ()))
        event = self.d.expected(worlds)
        label: tuple[Any, ...] | None
        if "expected" in plan[0]:
            label = ("expected", *event) if event is not None else None
        else:
            label = next((ground for ground in self._ground(worlds) if self._is(plan[0], ground)), None)
        if label is None or not self._is(plan[0], label):
            return False
        name, args = label[-2:]
        ways = self._ways(plan, name, args, worlds, self.d.k.progress(name, worlds, args))
        return ways is not None and all(self._reaches(goal, known, rest) for known, rest in ways)

    def _ground(self, worlds: Any) -> Iterator[tuple[str, Any]]:
        """The actions that are possible."""
        for action in self.theory.actions.values():
            for args in itertools.product(*[p.type.values for p in action.parameters]) if not action.exogenous else ():
                if self.d.k.possible(action.name, worlds, args):
                    yield action.name, args


@pytest.fixture(scope="session")
def validity() -> type[Validity]:
    """The judge of the plans of a theory."""
    return Validity


@pytest.fixture(scope="session")
def printed() -> Callable[..., list[Plan]]:
    """The plans that ``golc plan`` prints with some arguments."""

    def plans(*arguments: str) -> list[Plan]:
        output = io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(io.StringIO()):
            invoke(["plan", *arguments, "--format", "json"])
        found: list[Plan] = json.loads(output.getvalue())["plans"]
        return found

    return plans
