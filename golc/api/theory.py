"""A theory as users see it: every question that can be asked of it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from golc.api import acting
from golc.api.acting import Doing
from golc.api.declared import Declared
from golc.api.state import State
from golc.diagnostics import GolcError, LimitError
from golc.loading import Examined
from golc.program.blame import Blocked
from golc.situation import worlds
from golc.situation.dynamics import Dynamics
from golc.theory.ground import Call, read_procedure
from golc.theory.queries import Queries
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.statements import Strategy

if TYPE_CHECKING:
    from golc.api.report import Report
    from golc.nqc.build import BrickProgram
    from golc.planning.goals import GoalPlanning
    from golc.planning.planner import Planning
    from golc.planning.plans import Outcome, Plan
    from golc.scenarios.play import Played

ASKED = 1000
"""How many texts of formulas and terms are kept compiled."""


StrategyName: TypeAlias = Literal["first", "shortest", "cheapest"]
"""A ``Strategy`` by its name."""


class NoPlanError(GolcError):
    """There is no plan; ``outcome`` says how that is known, and how far the search came."""

    exit_code = 1

    def __init__(self, program: str, outcome: Outcome) -> None:
        super().__init__("\n".join(outcome.failure(program)))
        self.outcome = outcome


class Theory(Declared):
    """A basic action theory with its programs, as ``golc.load`` reads it from a domain file.

    It never changes, and asking changes nothing. Actions are texts such as ``"push(left)"``, or what ``possible`` and
    plans are made of. Every method raises ``UserError`` for a text that has no meaning, and ``ProgramError`` where the
    language says that something is an error (chapter "Errors" of the manual); both carry diagnostics with a place.

    >>> import golc
    >>> lift = golc.load("examples/elevator/elevator.gl")
    >>> state = lift.do(lift.initial(), "down")
    >>> state["at"], lift.holds(state, "lit(at)")
    (2, True)
    """

    def __init__(self, examined: Examined) -> None:
        """Raises ``UserError`` with every error of the domain if there is one."""
        super().__init__(examined)
        self._formula = lru_cache(ASKED)(self._compiled_formula)
        self._term = lru_cache(ASKED)(self._compiled_term)

    def check(self, *, proofs: bool = True, reachable: bool = False) -> Report:
        """What ``golc check`` says of it; ``proofs`` and ``reachable`` are as for ``golc.check``.

        >>> import golc
        >>> golc.load("examples/elevator/elevator.gl").check().warnings
        ()
        """
        from golc.api.report import report_of

        return report_of(self._examined, self, proofs, reachable)

    def test(self) -> Iterator[Played]:
        """Runs its scenarios offline, one after the other; ``failure`` says what went wrong in one, if anything did."""
        from golc.scenarios.play import play

        for scenario in self.elaborated.scenarios.values():
            yield play(self.elaborated, scenario)

    def explain(self, name: str, *, latex: bool = False) -> str:
        """What a name stands for in the notation of the papers: of a fluent its successor state axiom, of an action its
        precondition and effects; as text, or as a part of a LaTeX document that uses amsmath.

        >>> import golc
        >>> print(golc.load("examples/elevator/elevator.gl").explain("top"))  # doctest: +ELLIPSIS
        const top...
        """
        from golc.explain import rendering
        from golc.explain.pages import explain

        pages = explain(self.elaborated, name)
        return rendering.as_latex(pages) if latex else rendering.as_text(pages)

    @cached_property
    def _dynamics(self) -> Dynamics:
        return Dynamics(self.elaborated)

    def initial(self) -> State:
        """The initial state: one world, or all that the domain leaves possible."""
        return self.state(self._dynamics.initial())

    def state(self, raw: worlds.State) -> State:
        """A state as the rooms inside golc have it, for users."""
        return State(self._dynamics, raw)

    def possible(self, state: State, *, exogenous: bool = False) -> list[Call]:
        """The ground actions that are known to be possible; with ``exogenous`` those that may happen instead.

        In the order of declaration, then of the arguments, the last one fastest. Actions whose instances cannot be
        listed (a parameter of type ``int``), or are more than 100,000, are left out: ask ``why_not``.

        >>> import golc
        >>> lift = golc.load("examples/elevator/elevator.gl")
        >>> [str(call) for call in lift.possible(lift.initial())]
        ['up', 'down', 'open', 'close']
        """
        with deep_recursion(EVALUATION):
            return list(acting.listed(self._dynamics, self._raw(state), exogenous))

    def why_not(self, state: State, action: Doing) -> tuple[Blocked, ...]:
        """Each part of the action's ``poss`` that is not known to be true; empty if the action is possible.

        ``text`` says which part and whether it is false or not known, ``values`` what it speaks of with the values that
        it had, ``span`` where it stands.

        >>> import golc
        >>> lift = golc.load("examples/elevator/elevator.gl")
        >>> [part.text for part in lift.why_not(lift.initial(), "off(3)")]
        ['`lit(n)` is false']
        """
        with deep_recursion(EVALUATION):
            return acting.against(self._dynamics, self._raw(state), acting.call_of(self._dynamics, action))

    def do(self, state: State, action: Doing, *sensed: object) -> State:
        """The state after an action that is possible, or an exogenous action that may happen.

        ``sensed``: the value of each term that the action senses; they may be left out where the state tells them.
        Raises ``ProgramError`` if the action is not possible, with the parts of ``why_not``, or cannot sense this.

        >>> import golc
        >>> lift = golc.load("examples/elevator/elevator.gl")
        >>> lift.do(lift.initial(), "up")["at"]
        4
        """
        with deep_recursion(EVALUATION):
            call = acting.call_of(self._dynamics, action)
            return self.state(acting.after(self._dynamics, self._raw(state), call, sensed))

    def holds(self, state: State, formula: str) -> bool:
        """Whether a formula is known to be true. The text may use every name that the domain declares."""
        with deep_recursion(EVALUATION):
            return bool(self._formula(formula)(self._raw(state), ()))

    def value(self, state: State, term: str) -> Any:
        """The value of a term or a formula; an ``Unknown`` with the possible ones if it is not known.

        >>> import golc
        >>> lift = golc.load("examples/elevator/elevator.gl")
        >>> lift.value(lift.initial(), "count n: floor. lit(n)")
        3
        """
        with deep_recursion(EVALUATION):
            return self._term(term)(self._raw(state), ())

    def _raw(self, state: State) -> worlds.State:
        if state.dynamics is not self._dynamics:
            raise ValueError(f"the state is one of another theory, or of `{self.name}` as it was loaded before")
        return state.raw

    @cached_property
    def _queries(self) -> Queries:
        assert self._examined.file is not None
        return Queries(self._examined.file, self.elaborated.source, self._examined.constants, self.elaborated.python)

    def _compiled_formula(self, text: str) -> Callable[..., Any]:
        with deep_recursion():
            return self._dynamics.knowing.condition(self._queries.formula(text), 0)

    def _compiled_term(self, text: str) -> Callable[..., Any]:
        with deep_recursion():
            return self._dynamics.knowing.shown(self._queries.term(text), 0)

    def plan(
        self,
        program: str | None = None,
        *,
        goal: str | None = None,
        state: State | None = None,
        strategy: StrategyName = "first",
        conformant: bool = False,
        steps: int | None = None,
        nodes: int | None = None,
        seconds: float | None = None,
    ) -> Plan:
        """A plan; the parameters are those of ``planning``.

        Raises ``NoPlanError`` if there is none, and ``LimitError`` if the search gave up at one of its limits.

        >>> import golc
        >>> lift = golc.load("examples/elevator/elevator.gl")
        >>> lift.plan("go_to(5)")
        <Plan: up, up>
        >>> lift.plan(goal="at = 5 and not lit(5)").actions[-1].args
        (5,)
        """
        planning = self.planning(
            program,
            goal=goal,
            state=state,
            strategy=strategy,
            conformant=conformant,
            steps=steps,
            nodes=nodes,
            seconds=seconds,
        )
        for plan in planning:
            return plan
        wanted = goal or program or "control"
        if planning.outcome.gave_up:
            raise LimitError("\n".join(planning.outcome.failure(wanted)))
        raise NoPlanError(wanted, planning.outcome)

    def planning(
        self,
        program: str | None = None,
        *,
        goal: str | None = None,
        state: State | None = None,
        strategy: StrategyName = "first",
        every: bool = False,
        conformant: bool = False,
        steps: int | None = None,
        nodes: int | None = None,
        seconds: float | None = None,
    ) -> Planning | GoalPlanning:
        """A search: iterate over it for the plans, then read its ``outcome``.

        ``program``: a procedure with its arguments, as ``"serve(3)"``; by default ``control``. ``goal``: a formula, to
        plan without a program for what makes it true with the fewest steps. ``state``: where to begin, by default the
        initial state. ``strategy``: which plan of the program, by default the first in program order. ``every``: not
        one plan, but every distinct sequence of actions, in program order; ``ValueError`` if plans depend on what is
        sensed. ``conformant``: only plans that make no use of what is sensed. The limits are ``steps`` in a plan,
        ``nodes`` (pairs of program and state expanded) and wall-clock ``seconds``; none is no limit.
        """
        from golc.planning.goals import GoalPlanning
        from golc.planning.limits import Limits
        from golc.planning.planner import Planning, executable

        limits = Limits(steps, nodes, seconds)
        start = None if state is None else self._raw(state)
        if goal is not None:
            if program is not None or every or strategy == "cheapest":
                raise ValueError(
                    "a goal asks for one shortest plan: leave out `program`, `every` and `strategy='cheapest'`"
                )
            return GoalPlanning(self.elaborated, self._queries.formula(goal, "<goal>"), limits, conformant, start)
        call = read_procedure(self.elaborated, program or "control")
        ready = executable(self.elaborated, call.action, call.args, conformant)
        return Planning(ready, limits, every, Strategy(strategy), start)

    def gen_nqc(
        self, folder: str | Path | None = None, *, device: str | None = None, target: str = "rcx2", tones: bool = False
    ) -> tuple[BrickProgram, ...]:
        """Write the NQC program of each brick, or of the one named ``device``.

        ``folder``: by default ``build`` beside the domain; a file in it that somebody has edited is left alone.
        ``target``: ``rcx`` is firmware 1.0, ``rcx2`` firmware 2.0. ``tones``: the brick is heard when it hears or says
        something. Raises ``UserError`` with all findings if one is an error; ``ValueError`` for an unknown name.
        """
        from golc.api.bricks import chosen, target_of
        from golc.nqc.build import brick_program

        place = Path(self.path).parent / "build" if folder is None else Path(folder)
        firmware = target_of(target)
        return tuple(
            [brick_program(self.elaborated, brick, place, firmware, tones) for brick in chosen(self.elaborated, device)]
        )
