"""Planning as the online loop, the command line and the Python API ask for it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from golc.diagnostics import LimitError
from golc.planning import cheapest, conditional, depth_first, shortest
from golc.planning.all_plans import enumerate_plans
from golc.planning.dead_end import DeadEnd
from golc.planning.limits import Budget, GivenUpSearchError, Limits
from golc.planning.plans import Outcome, Plan, plan_of
from golc.program.ahead import Ahead
from golc.program.build import Builder
from golc.program.lookahead import Request
from golc.program.nodes import Node
from golc.program.paths import NoPath, Path
from golc.program.program import Program
from golc.program.step import Machine
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.statements import Strategy
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value, show

MOST_NODES = 500_000
"""Pairs of program and state after which a ``search`` block gives up online: about 0.5 GB of memory."""


@dataclass(frozen=True)
class Executable:
    """A procedure of a theory, ready to be executed by ``machine``, in look-ahead by ``ahead``.

    ``look_ahead`` does what its ``search`` blocks want.
    """

    dynamics: Dynamics
    machine: Machine
    ahead: Ahead
    node: Node
    look_ahead: LookAhead


def executable(
    theory: BasicActionTheory, procedure: str, args: tuple[Value, ...] = (), conformant: bool = False
) -> Executable:
    """Compile a procedure; its arguments must be of the parameters' types.

    ``conformant``: look-ahead makes no use of what actions sense.
    """
    dynamics = Dynamics(theory)
    program = Program()
    look_ahead = LookAhead()
    ahead = Ahead(dynamics, program, conformant)
    with deep_recursion():
        node = Builder(dynamics, program).start(procedure, args)
    return Executable(dynamics, Machine(dynamics, program, ahead, look_ahead), ahead, node, look_ahead)


class LookAhead:
    """What a ``search`` block does: find the way to its end that is requested."""

    def __init__(self) -> None:
        self._given_up = False

    def __call__(self, machine: Ahead, node: Node, state: State, request: Request) -> Path | NoPath:
        """The way, or that there is none; raises ``GivenUpSearchError`` after ``give_up``."""
        limits = Limits(steps=request.steps, seconds=request.seconds, nodes=MOST_NODES)
        budget, dead_end = Budget(limits, given_up=lambda: self._given_up), DeadEnd()
        try:
            path = _find(request.strategy, machine, node, state, budget, dead_end)
        except GivenUpSearchError:
            raise
        except LimitError as error:
            return NoPath(str(error))
        finally:
            self._given_up = False
        if path is not None:
            return replace(path, request=request)
        limit = f"no way of more than {_steps(request.steps)} was considered" if budget.cut else None
        if dead_end.node is None:
            return NoPath(limit)
        return NoPath(limit, dead_end.way, tuple(machine.why_blocked(dead_end.node, dead_end.state)))

    def give_up(self) -> None:
        """Have the search that is under way, otherwise the next one, end without a result; for other threads."""
        self._given_up = True


def _find(
    strategy: Strategy, machine: Ahead, node: Node, state: State, budget: Budget, dead_end: DeadEnd
) -> Path | None:
    if machine.senses:
        problem = conditional.Programs(machine)
        return conditional.find(problem, machine.dynamics, strategy, (node, state), budget, dead_end)
    match strategy:
        case Strategy.FIRST:
            return depth_first.find(machine, node, state, budget, dead_end)
        case Strategy.SHORTEST:
            return shortest.find(machine, node, state, budget, dead_end)
        case Strategy.CHEAPEST:
            return cheapest.find(machine, node, state, budget, dead_end)


def _next(plans: Iterator[Plan]) -> Plan | None:
    with deep_recursion(EVALUATION):
        return next(plans, None)


def _steps(count: int | None) -> str:
    return f"{show(count)} step{'' if count == 1 else 's'}"


class Planning:
    """A search for the plans of a program; iterate over it, then read its ``outcome``.

    One plan, by the ``strategy``, or all of them in program order; ``ValueError`` for all plans of a domain whose plans
    depend on what is sensed, unless they are conformant. ``start``: where they begin, by default the initial state.
    """

    def __init__(
        self,
        executable: Executable,
        limits: Limits,
        all_plans: bool = False,
        strategy: Strategy = Strategy.FIRST,
        start: State | None = None,
    ) -> None:
        if all_plans and executable.ahead.senses:
            raise ValueError("plans that branch by what is sensed are not listed")
        self.outcome = Outcome()
        self._executable = executable
        self._budget = Budget(limits)
        self._all = all_plans
        self._strategy = strategy
        self._start = start
        self._dead_end = DeadEnd()

    def __iter__(self) -> Iterator[Plan]:
        outcome = self.outcome
        try:
            plans = self._plans()
            while (plan := _next(plans)) is not None:
                outcome.plans += 1
                self._count()
                yield plan
            if self._budget.cut and (self._all or not outcome.plans):
                outcome.gave_up = f"no plan of more than {self._budget.limits.steps} steps was considered"
        except LimitError as error:
            outcome.gave_up = str(error)
        self._count()
        if not outcome.plans:
            self._explain()

    def _plans(self) -> Iterator[Plan]:
        machine, node = self._executable.ahead, self._executable.node
        state = self._executable.dynamics.initial() if self._start is None else self._start
        if self._all:
            yield from map(Plan, enumerate_plans(machine, node, state, self._budget, self._dead_end))
        elif machine.final(node, state):
            yield self._plan(Path((node,), (), (state,)))
        elif path := _find(self._strategy, machine, node, state, self._budget, self._dead_end):
            yield self._plan(path)

    def _plan(self, path: Path) -> Plan:
        dynamics = self._executable.dynamics
        cost = cheapest.cost(dynamics, path) if self._strategy is Strategy.CHEAPEST else None
        return plan_of(path, dynamics, cost)

    def _count(self) -> None:
        self.outcome.expanded = self._budget.expanded
        self.outcome.seconds = self._budget.elapsed

    def _explain(self) -> None:
        dead_end = self._dead_end
        if dead_end.node is not None:
            self.outcome.stuck = dead_end.way
            self.outcome.reasons = self._executable.ahead.why_blocked(dead_end.node, dead_end.state)
