"""Planning as the online loop, the command line and the Python API ask for it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from golc.diagnostics import LimitError
from golc.planning import cheapest, depth_first, shortest
from golc.planning.all_plans import enumerate_plans
from golc.planning.dead_end import DeadEnd
from golc.planning.limits import Budget, GivenUpSearchError, Limits
from golc.program.blame import Blocked
from golc.program.build import Builder
from golc.program.labels import Act
from golc.program.lookahead import Request
from golc.program.nodes import Node
from golc.program.program import Program
from golc.program.step import Machine, NoPath, Path
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.recursion import deep_recursion
from golc.theory.statements import Strategy
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Number, Value, show

MOST_NODES = 500_000
"""Pairs of program and state after which a ``search`` block gives up online: about 0.5 GB of memory."""


@dataclass(frozen=True)
class Executable:
    """A procedure of a theory, ready to be executed: online by ``machine``, in look-ahead by ``machine.ahead``.

    ``look_ahead`` does what its ``search`` blocks want.
    """

    dynamics: Dynamics
    machine: Machine
    node: Node
    look_ahead: LookAhead


def executable(theory: BasicActionTheory, procedure: str, args: tuple[Value, ...] = ()) -> Executable:
    """Compile a procedure; its arguments must be of the parameters' types."""
    dynamics = Dynamics(theory)
    program = Program()
    look_ahead = LookAhead()
    ahead = Machine(dynamics, program, look_ahead)
    with deep_recursion():
        node = Builder(dynamics, program).start(procedure, args)
    return Executable(dynamics, Machine(dynamics, program, look_ahead, ahead), node, look_ahead)


class LookAhead:
    """What a ``search`` block does: find the way to its end that is requested."""

    def __init__(self) -> None:
        self._given_up = False

    def __call__(self, machine: Machine, node: Node, state: State, request: Request) -> Path | NoPath:
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
        return NoPath(limit, dead_end.actions, tuple(machine.why_blocked(dead_end.node, dead_end.state)))

    def give_up(self) -> None:
        """Have the search that is under way, otherwise the next one, end without a result; for other threads."""
        self._given_up = True


def _find(
    strategy: Strategy, machine: Machine, node: Node, state: State, budget: Budget, dead_end: DeadEnd | None = None
) -> Path | None:
    match strategy:
        case Strategy.FIRST:
            return depth_first.find(machine, node, state, budget, dead_end)
        case Strategy.SHORTEST:
            return shortest.find(machine, node, state, budget, dead_end)
        case Strategy.CHEAPEST:
            return cheapest.find(machine, node, state, budget, dead_end)


def _steps(count: int | None) -> str:
    return f"{show(count)} step{'' if count == 1 else 's'}"


@dataclass(frozen=True)
class Plan:
    """A sequence of primitive actions that executes a program to its end.

    ``cost`` is the sum of their costs, of the cheapest plan only.
    """

    actions: tuple[Act, ...]
    cost: Number | None = None


@dataclass
class Outcome:
    """What a search for plans came to.

    ``stuck`` and ``reasons`` say, where no plan was found, how far the longest way came and what failed there;
    ``gave_up`` is the limit that ended the search, if one did; ``proof`` is what is proven without plan and limit.
    """

    plans: int = 0
    gave_up: str | None = None
    stuck: tuple[Act, ...] = ()
    reasons: list[Blocked] = field(default_factory=list)
    expanded: int = 0
    seconds: float = 0.0
    proof: str = "it cannot be executed to its end"


class Planning:
    """A search for the plans of a program from the initial state; iterate over it, then read its ``outcome``.

    One plan, by the ``strategy``, or all of them in program order.
    """

    def __init__(
        self, executable: Executable, limits: Limits, all_plans: bool = False, strategy: Strategy = Strategy.FIRST
    ) -> None:
        self.outcome = Outcome()
        self._executable = executable
        self._budget = Budget(limits)
        self._all = all_plans
        self._strategy = strategy
        self._dead_end = DeadEnd()

    def __iter__(self) -> Iterator[Plan]:
        outcome = self.outcome
        try:
            for plan in self._plans():
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
        machine, node = self._executable.machine.ahead, self._executable.node
        state = self._executable.dynamics.initial()
        if self._all:
            yield from map(Plan, enumerate_plans(machine, node, state, self._budget, self._dead_end))
        elif machine.final(node, state):
            yield self._plan(Path((node,), (), (state,)))
        elif path := _find(self._strategy, machine, node, state, self._budget, self._dead_end):
            yield self._plan(path)

    def _plan(self, path: Path) -> Plan:
        actions = tuple(label for label in path.labels if isinstance(label, Act))
        if self._strategy is not Strategy.CHEAPEST:
            return Plan(actions)
        return Plan(actions, cheapest.cost(self._executable.dynamics, path))

    def _count(self) -> None:
        self.outcome.expanded = self._budget.expanded
        self.outcome.seconds = self._budget.elapsed

    def _explain(self) -> None:
        dead_end = self._dead_end
        if dead_end.node is not None:
            self.outcome.stuck = dead_end.actions
            self.outcome.reasons = self._executable.machine.ahead.why_blocked(dead_end.node, dead_end.state)
