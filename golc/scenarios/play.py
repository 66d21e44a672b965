"""Plays a scenario: the online loop without devices, in a world that does what the scenario says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from golc.diagnostics import Code, Diagnostic, Label, ProgramError, Span
from golc.planning.planner import executable
from golc.program.blame import false_parts, impossible, valued
from golc.program.circles import CIRCLES, runs_in_circles
from golc.program.invariants import Invariants
from golc.program.labels import Abort, Act, Say, Wait
from golc.scenarios.expect import Judge, failed
from golc.situation.layout import World
from golc.situation.worlds import ActualWorld, State, keep, survey
from golc.theory.recursion import EVALUATION, deep_recursion
from golc.theory.scenarios import Assignment, Assumption, Events, GroundCall, Scenario
from golc.theory.terms import Term
from golc.theory.theory import BasicActionTheory
from golc.theory.types import show

LONGEST = 100_000
"""Actions and events after which a scenario is taken not to end."""


@dataclass
class Played:
    """What came of a scenario: ``failure`` is none if it went as it expects.

    ``trace`` has a line for each action, event and message, up to the first difference.
    """

    scenario: Scenario
    actions: int = 0
    events: int = 0
    trace: list[str] = field(default_factory=list)
    failure: Diagnostic | None = None


def play(theory: BasicActionTheory, scenario: Scenario) -> Played:
    """Run a scenario to its end; whatever goes wrong in it is its failure."""
    played = Played(scenario)
    try:
        with deep_recursion(EVALUATION):
            _Play(theory, scenario, played).run()
    except ProgramError as error:
        played.failure = error.diagnostic
    return played


class _Play:
    """A scenario under way."""

    def __init__(self, theory: BasicActionTheory, scenario: Scenario, played: Played) -> None:
        self.scenario = scenario
        self.played = played
        ready = executable(theory, scenario.procedure.name, scenario.procedure.args)
        self.dynamics, self.machine, self.node = ready.dynamics, ready.machine, ready.node
        self.judge = Judge(scenario.expectations, self.dynamics)
        self.invariants = Invariants(self.dynamics)
        self._now = 0.0
        self.machine.now = lambda: self._now
        self.state: State
        self.world: World
        self._begin()
        self._until = None if scenario.until is None else self._formula(scenario.until)
        self._lines = [
            (line, self._formula(line.trigger) if isinstance(line.trigger, Term) else None) for line in scenario.events
        ]
        self._waited: set[int] = set()

    def run(self) -> None:
        """Raises ``ProgramError`` for the first difference."""
        self._after_actions()
        self._loop()
        self.judge.at_the_end(self.now)

    def _formula(self, term: Term) -> Callable[..., Any]:
        with deep_recursion():
            return self.dynamics.compiler.term(term, 0)

    def _begin(self) -> None:
        """The initial state, and the world that is real: the first possible one of which everything given is true."""
        places = self.dynamics.layout.places
        values = [given for given in self.scenario.givens if isinstance(given, Assignment)]
        self.state = self.dynamics.initial({places[each.fluent].slot(each.args): each.value for each in values})
        real = self.state
        for given in self.scenario.givens:
            if isinstance(given, Assumption):
                real = self._narrowed(real, given)
        self.world = self.dynamics.realize(real)
        self.invariants.check(self.now, None, self.scenario.span)

    def _narrowed(self, real: State, given: Assumption) -> State:
        holds = self._formula(given.condition)
        cases = [case for case, found in survey(real, lambda world: holds(world, ())) if found]
        if not cases:
            why = false_parts(self.dynamics, real, given.condition)[0]
            raise failed("this is not so in the initial state", given.span, valued(why))
        return keep(real, cases)

    @property
    def now(self) -> World:
        """The world as it is, in which formulas may ask what the agent knows, too."""
        return self.world if self.world == self.state else ActualWorld.of(self.world, self.state)

    def _loop(self) -> None:
        quiet = 0
        while self._until is None or not self._until(self.now, ()):
            choice = self.machine.decide(self.node, self.state)
            if choice is None:
                if self.machine.final(self.node, self.state):
                    return self._stop("the program is final")
                if not self._goes_on():
                    raise self._blocked()
                continue
            label, residual = choice
            quiet += 1
            match label:
                case Act():
                    quiet = 0
                    self._act(label)
                case Wait(span=span):
                    quiet = 0
                    if not self._world():
                        if self._later():
                            continue
                        return self._stop(f"the program waits, at line {span.line}, and nothing more happens")
                case Say(text=text):
                    self.played.trace.append(f'      "{text}"')
                case Abort(text=text, span=span):
                    raise ProgramError(Diagnostic(Code.ABORTED, text or "the program aborts", span))
            if quiet >= CIRCLES:
                raise runs_in_circles(label.span)
            self.node = residual
        return None

    def _goes_on(self) -> bool:
        """Something happens in the world, or else time passes."""
        return self._world() or self._later()

    def _later(self) -> bool:
        """Let time pass until the program has to be asked again, if a clock of it runs; nothing else takes time."""
        alarm = self.machine.alarm
        if alarm is None or alarm <= self._now:
            return False
        self._now = alarm
        self.played.trace.append(f"      {alarm:g} s")
        return True

    def _stop(self, why: str) -> None:
        """The program has come to rest, which must not be before ``until`` holds."""
        until = self.scenario.until
        if until is not None:
            parts = false_parts(self.dynamics, self.now, until)
            raise failed(f"`until` never holds: {why}", until.span, valued(parts[0]) if parts else "")

    def _blocked(self) -> ProgramError:
        branches = self.machine.why_blocked(self.node, self.state)
        labels = tuple(Label(branch.span, valued(branch)) for branch in branches)
        message = f"the program is blocked in scenario `{self.scenario.name}`, and nothing more happens"
        return ProgramError(Diagnostic(Code.SCENARIO, message, self.scenario.span, labels=labels))

    def _act(self, act: Act) -> None:
        action, args = act.action, act.args
        self.state = self.dynamics.progress(self.state, action, args)
        self.world = self.dynamics.realize(self.dynamics.progress(self.world, action, args))
        results = self.dynamics.sense(self.now, action, args)
        self.state, _ = self.dynamics.assimilate(self.state, action, args, results)
        self.played.actions += 1
        sensed = f": {', '.join(map(show, results))}" if results else ""
        self.played.trace.append(f"{self.played.actions:>5} {act}{sensed}")
        self.invariants.check(self.now, str(act), act.span)
        self.judge.happened(act.action, act.args)
        self._end_at_last(act.span)
        self._after_actions()

    def _after_actions(self) -> None:
        """The events that are to happen right after so many actions."""
        for line, _ in self._lines:
            if isinstance(line.trigger, int) and line.trigger == self.played.actions:
                self._happen(line)

    def _world(self) -> bool:
        """The program can only wait: the first line that has something for this moment happens; whether one has."""
        for index, (line, condition) in enumerate(self._lines):
            if condition is not None:
                happens = bool(condition(self.now, ()))
            else:
                happens = line.trigger is None and index not in self._waited
            if happens:
                self._waited.add(index)
                self._happen(line)
                return True
        return False

    def _happen(self, line: Events) -> None:
        for event in line.events:
            self._event(event)

    def _event(self, event: GroundCall) -> None:
        call = self.dynamics.call(event.name, event.args)
        if not self.dynamics.possible(self.now, event.name, event.args):
            why = impossible(self.dynamics, self.now, event.name, event.args)
            message = f"`{call}` cannot happen here"
            labels = (Label(why.span, valued(why)),)
            raise ProgramError(Diagnostic(Code.SCENARIO, message, event.span, labels=labels))
        before = self.dynamics.witness(self.state, event.name, event.args)
        self.state = self.dynamics.progress(self.state if before is None else before, event.name, event.args)
        self.world = self.dynamics.realize(self.dynamics.progress(self.world, event.name, event.args))
        self.played.events += 1
        self.played.trace.append(f"      <- {call}")
        self.invariants.check(self.now, call, event.span)
        self.judge.happened(event.name, event.args, exogenous=True)
        self._end_at_last(event.span)

    def _end_at_last(self, span: Span) -> None:
        if self.played.actions + self.played.events >= LONGEST:
            raise failed(f"scenario `{self.scenario.name}` does not end: {LONGEST} actions and events", span)
