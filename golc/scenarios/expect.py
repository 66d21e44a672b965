"""What a scenario expects, judged while it runs: the first difference ends it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from golc.diagnostics import Code, Diagnostic, ProgramError, Span, counted
from golc.program.blame import false_parts, valued
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.scenarios import ExpectActions, Expectation, ExpectCount, ExpectFormula
from golc.theory.types import Value, show_call


def failed(message: str, span: Span, marker: str = "") -> ProgramError:
    """The error of a scenario that does not go as it expects."""
    return ProgramError(Diagnostic(Code.SCENARIO, message, span, marker=marker))


class Judge:
    """Counts what happens. Every method raises ``ProgramError`` for what is not as expected."""

    def __init__(self, expectations: Sequence[Expectation], dynamics: Dynamics) -> None:
        self._expectations = expectations
        self._dynamics = dynamics
        self._actions = 0
        self._counts: Counter[int] = Counter()
        """How often what an ``ExpectCount`` speaks of has happened, by its place."""

    def happened(self, name: str, args: tuple[Value, ...], exogenous: bool = False) -> None:
        """A primitive action has been done, or an exogenous action has happened."""
        self._actions += not exogenous
        for index, expected in enumerate(self._expectations):
            match expected:
                case ExpectActions() if not exogenous:
                    self._compare(expected, show_call(name, args))
                case ExpectCount(action=action, args=only) if action == name and only in (None, args):
                    self._counts[index] += 1
                    if expected.relation != "at least" and self._counts[index] > expected.count:
                        raise self._miscounted(expected, self._counts[index])

    def at_the_end(self, state: State) -> None:
        """The run is over."""
        for index, expected in enumerate(self._expectations):
            match expected:
                case ExpectActions(actions=actions) if self._actions < len(actions):
                    missing = actions[self._actions]
                    message = f"the run ends after {counted(self._actions, 'action')}, and `{missing}` is expected next"
                    raise failed(message, missing.span, "expected next")
                case ExpectCount() if expected.relation != "at most" and self._counts[index] < expected.count:
                    raise self._miscounted(expected, self._counts[index])
                case ExpectFormula(condition=condition):
                    false = false_parts(self._dynamics, state, condition)
                    if false:
                        raise failed("at the end this is not so", expected.span, valued(false[0]))

    def _compare(self, expected: ExpectActions, done: str) -> None:
        place = self._actions - 1
        if place >= len(expected.actions):
            message = f"action {self._actions} is `{done}`, where the run is expected to have ended"
            raise failed(message, expected.span, f"{counted(len(expected.actions), 'action')} expected")
        wanted = expected.actions[place]
        if str(wanted) != done:
            message = f"action {self._actions} is `{done}`, and `{wanted}` is expected"
            raise failed(message, wanted.span, f"action {self._actions} is another one")

    def _miscounted(self, expected: ExpectCount, count: int) -> ProgramError:
        times = counted(expected.count, "time")
        message = f"`{expected}` happens {counted(count, 'time')}, and {expected.relation} {times} is expected"
        if count > expected.count:
            message = f"`{expected}` happens more than {times}"
        return failed(message, expected.span)
