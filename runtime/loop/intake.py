"""The first step of the online loop: take in every exogenous action that has occurred, and what the operator wants."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence

from golc.diagnostics import NOWHERE, Code, Diagnostic, ProgramError
from golc.program.invariants import Invariants
from golc.program.labels import Act
from golc.runtime.clock import Clock
from golc.runtime.devices.base import Args, Device
from golc.runtime.loop.happenings import Dropped, End, Happening, Observer, Refused, Reset, SourceEnded, TakenIn
from golc.runtime.loop.inbox import Broken, Closed, Command, Inbox, Item, Refusal, Report
from golc.runtime.loop.policy import OnImpossible, Policy
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.types import show_call

REMEMBERED = 1_000
"""How many actions the history keeps in memory; the journal has them all."""


class Intake:
    """The situation of a run, and how the world changes it.

    ``state``, ``actions``, ``exogenous`` (how many of each there were) and ``history`` (the latest of both) may be read
    at any time, by other threads too. Observers may be attached and detached at any time; without any, nothing is told.
    """

    def __init__(
        self, dynamics: Dynamics, inbox: Inbox, devices: Sequence[Device], policy: Policy, clock: Clock
    ) -> None:
        self.dynamics = dynamics
        self.state: State = self.dynamics.initial()
        self.actions = 0
        self.exogenous = 0
        self.history: deque[Act | Report] = deque(maxlen=REMEMBERED)
        self.observers: list[Observer] = []
        self.clock = clock
        self._inbox = inbox
        self._devices = tuple(devices)
        self._policy = policy
        self._invariants = Invariants(dynamics) if policy.check_invariants else None
        self._verdict: tuple[End, str] | None = None
        self._engaged: Callable[[], None] | None = None
        """Makes what the loop is engaged in give up, while that may take long."""
        inbox.at_once = self._at_once
        inbox.hasten = self._hasten

    def tell(self, happening: Happening) -> None:
        """Tell all observers."""
        for observer in self.observers:
            observer(happening)

    def take_in(self) -> bool:
        """Empty the inbox, in order of arrival; whether an exogenous action was applied."""
        before = self.exogenous
        items = self._inbox.items
        while items:
            self._take(items.popleft())
        return self.exogenous > before

    def _take(self, item: Item) -> None:
        match item:
            case Report():
                self._report(item)
            case Command():
                self._command(item)
            case Refusal(text=text, source=source, diagnostics=diagnostics):
                self.tell(Refused(self.clock.now(), text, source, diagnostics))
            case Closed(source=source):
                self.tell(SourceEnded(self.clock.now(), source))
            case Broken(error=error):
                raise error

    def _report(self, report: Report) -> None:
        action, args, before = report.action, report.args, self.state
        if (misfit := self._misfit(report)) is not None:
            finding = Diagnostic(Code.EVENT, misfit, NOWHERE)
            self.tell(Refused(self.clock.now(), show_call(action, args), report.source, (finding,)))
            return
        witnessed = self._witnessed(action, args)
        if witnessed is None and not self._goes_on(report):
            return
        try:
            self.state = after = self.dynamics.progress(before if witnessed is None else witnessed, action, args)
        except ProgramError as error:
            self._drop(report, error.diagnostic.message)
            return
        self.exogenous += 1
        self.history.append(report)
        if self.observers:
            self.tell(TakenIn(self.clock.now(), action, args, report.source, witnessed is None, before, after))
        if self._invariants is not None:
            self._invariants.check(after, self.dynamics.call(action, args), self.dynamics.theory.actions[action].span)

    def _misfit(self, report: Report) -> str | None:
        """What keeps a report from being an exogenous action of the domain at all."""
        action = self.dynamics.theory.actions.get(report.action)
        if action is None or not action.exogenous:
            return f"`{report.action}` is not an exogenous action of this domain"
        return self.dynamics.misfit(report.action, report.args)

    def _witnessed(self, action: str, args: Args) -> State | None:
        """The worlds in which an exogenous action could occur; none if in no world, or if that has no answer."""
        try:
            return self.dynamics.witness(self.state, action, args)
        except ProgramError:
            return None

    def _goes_on(self, report: Report) -> bool:
        """Whether an exogenous action that the theory thinks impossible is applied all the same."""
        match self._policy.on_impossible:
            case OnImpossible.APPLY:
                return True
            case OnImpossible.DROP:
                self._drop(report, "it is not possible in this state")
                return False
            case OnImpossible.STOP:
                call = self.dynamics.call(report.action, report.args)
                span = self.dynamics.theory.actions[report.action].span
                message = f"`{call}` has occurred, which is not possible in this state"
                raise ProgramError(Diagnostic(Code.IMPOSSIBLE_EVENT, message, span, help="see its `poss`"))

    def _drop(self, report: Report, reason: str) -> None:
        self.tell(Dropped(self.clock.now(), report.action, report.args, report.source, reason))

    def _command(self, command: Command) -> None:
        match command.name:
            case "state" | "history":
                self._answer(command)
            case "abort":
                for device in self._devices:
                    device.abort()
                self.tell(Reset(self.clock.now(), command.source))
                command.reply(None)
            case "stop":
                self._verdict = End.STOPPED, f"stopped by the operator ({command.source})"
                command.reply(None)

    def _answer(self, command: Command) -> None:
        command.reply(self.dynamics.show(self.state) if command.name == "state" else self.told())

    def told(self) -> list[str]:
        """The history as text, oldest first; exogenous actions with their sources."""
        lines = (
            [f"… {forgotten} before"] if (forgotten := self.actions + self.exogenous - len(self.history)) > 0 else []
        )
        for entry in tuple(self.history):
            call = self.dynamics.call(entry.action, entry.args)
            lines.append(call if isinstance(entry, Act) else f"{call} from {entry.source}")
        return lines

    def _at_once(self, command: Command) -> bool:
        """Called by the thread of a source: while the loop is engaged, questions are answered at once."""
        if self._engaged is None or command.name not in ("state", "history"):
            return False
        self._answer(command)
        return True

    def _hasten(self, command: Command) -> None:
        """Called by the thread of a source, when a command is in the queue (so that the loop, woken, finds it there):
        what the loop is engaged in gives up for a command that stops it."""
        engaged = self._engaged
        if engaged is not None and command.name in ("abort", "stop"):
            engaged()
