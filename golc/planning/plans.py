"""Plans as they are shown, and what a search for them came to."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from golc.diagnostics import counted
from golc.program.blame import Blocked
from golc.program.labels import Act, Expect
from golc.program.paths import Path, bottom_up
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.order import spelt
from golc.theory.terms import FluentTerm
from golc.theory.types import Number, Unknown, Value, show, show_call

INDENT = "    "

Step: TypeAlias = Act | Expect
"""A step of a plan: something to be done, or something that is expected to happen."""


@dataclass(frozen=True, repr=False)
class Plan:
    """What executes a program to its end: steps, the last of which may sense what decides how to go on.

    ``senses`` names what the last action senses, where there are ``cases``. ``cost`` is the sum of the actions' costs,
    in the dearest case, of the cheapest plan only.
    """

    steps: tuple[Step, ...]
    senses: tuple[str, ...] = ()
    cases: tuple[Case, ...] = ()
    cost: Number | None = None

    @property
    def actions(self) -> tuple[Act, ...]:
        """The steps that are actions."""
        return tuple([step for step in self.steps if isinstance(step, Act)])

    def __str__(self) -> str:
        return "\n".join(lines_of(self)) or "nothing is to be done"

    def _repr_html_(self) -> str:
        from golc.notebook import plan_html

        return plan_html(self)

    def __repr__(self) -> str:
        steps = [*map(str, self.steps), *([counted(len(self.cases), "case")] if self.cases else [])]
        return f"<Plan: {', '.join(steps) or 'nothing is to be done'}>"

    @property
    def ways(self) -> list[Plan]:
        """How it may go on."""
        return [case.plan for case in self.cases]


@dataclass(frozen=True)
class Case:
    """How a plan goes on after some results of sensing."""

    results: tuple[Value, ...]
    plan: Plan


def plan_of(path: Path, dynamics: Dynamics, cost: Number | None = None) -> Plan:
    """A path as a plan; paths that are one object become one plan."""
    plans: dict[Path, Plan] = {}
    for part in bottom_up(path, lambda part: part.ways):
        steps = tuple([label for label in part.labels if isinstance(label, Act | Expect)])
        if part.branches:
            last = part.labels[-1]
            assert isinstance(last, Act)
            names = sensed(dynamics, last, part.branches[0].path.states[0])
            cases = tuple([Case(told(dynamics, last, branch.results), plans[branch.path]) for branch in part.branches])
            plans[part] = Plan(steps, names, cases)
        else:
            plans[part] = Plan(steps)
    return replace(plans[path], cost=cost)


def sensed(dynamics: Dynamics, act: Act, state: State) -> tuple[str, ...]:
    """What an action senses in the state to which it has led: a fluent with its arguments, any other term as the file
    writes it."""
    names = []
    for term in dynamics.theory.actions[act.action].senses:
        name = " ".join(term.span.text.split())
        if not isinstance(term, FluentTerm):
            name = f"({name})" if " " in name else name
        else:
            args = tuple([dynamics.knowing.evaluate(arg, state, act.args) for arg in term.args])
            if not any(isinstance(arg, Unknown) for arg in args):
                name = show_call(term.fluent, args)
        names.append(name)
    return tuple(names)


def told(dynamics: Dynamics, act: Act, results: tuple[Value, ...]) -> tuple[Value, ...]:
    """Results of sensing as they are to be written."""
    senses = dynamics.theory.actions[act.action].senses
    return tuple([spelt(result, term.type) for result, term in zip(results, senses, strict=True)])


def lines_of(plan: Plan) -> Iterator[str]:
    """A plan as text, one step a line; below a sensing action stands each result that it may have, with the rest of the
    plan indented. No recursion, for plans are deep."""
    pending: list[tuple[str, str, Plan]] = [("", "", plan)]
    while pending:
        heading, indent, part = pending.pop()
        if heading:
            yield heading
        yield from (f"{indent}{step}" for step in part.steps)
        for case in reversed(part.cases):
            rest = "" if case.plan.steps else " nothing more"
            heading = f"{indent}{answers(part.senses, case.results)}:{rest}"
            pending.append((heading, indent + INDENT, case.plan))


def answers(names: tuple[str, ...], results: tuple[Value, ...]) -> str:
    """What was sensed, with the results."""
    return ", ".join(f"{name} = {show(value)}" for name, value in zip(names, results, strict=True))


@dataclass
class Outcome:
    """What a search for plans came to.

    ``stuck`` and ``reasons`` say, where no plan was found, how far the longest way came and what failed there;
    ``gave_up`` is the limit that ended the search, if one did; ``proof`` is what is proven without plan and limit.
    """

    plans: int = 0
    gave_up: str | None = None
    stuck: tuple[str, ...] = ()
    reasons: list[Blocked] = field(default_factory=list)
    expanded: int = 0
    seconds: float = 0.0
    proof: str = "it cannot be executed to its end"

    def failure(self, program: str) -> list[str]:
        """Why there is no plan for something, in lines of text."""
        lines = [f"no plan for `{program}`: {self.gave_up or f'proven: {self.proof}'}"]
        if self.reasons:
            lines.append(f"the longest way was: {', '.join(self.stuck) or 'no action at all'}; there")
        return lines + [f"  {reason}" for reason in self.reasons]
