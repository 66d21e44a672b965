"""The online loop of Legolog (Levesque & Pagnucco 2000, section 4): hear the world, decide, act, and never go back.

In each round: (1) every exogenous action that has occurred is taken in, in order of arrival; (2) if the program is
final the run has succeeded; (3) a test step is taken if there is one; (4) otherwise the run commits to the first
possible action, has a device do it, and applies its effects and sensing results when the device reports success; (5)
otherwise it waits, if the program says so. A program without a transition is blocked: it fails, unless a source is open
that might report something that helps.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass

from golc.diagnostics import Code, DeviceError, Diagnostic, ProgramError
from golc.planning.limits import GivenUpSearchError
from golc.planning.planner import Executable
from golc.program.circles import CIRCLES, runs_in_circles
from golc.program.labels import Abort, Act, Clock, Say, Silent, Wait
from golc.program.nodes import Node
from golc.runtime import clock as clocks
from golc.runtime.devices.base import Args, Device, GivenUpError, Router
from golc.runtime.loop.blockage import blockage
from golc.runtime.loop.ending import release, verdict_on
from golc.runtime.loop.happenings import (
    Begun,
    Blocked,
    Done,
    End,
    Ended,
    Failed,
    Remedied,
    Remedy,
    Said,
    Started,
    Stepped,
    Waiting,
)
from golc.runtime.loop.inbox import Inbox, Source
from golc.runtime.loop.intake import Intake
from golc.runtime.loop.policy import OnSurprise, Policy, surprising
from golc.runtime.signals import undisturbed
from golc.situation.dynamics import Surprise
from golc.situation.worlds import State

A_MOMENT = 0.05
"""Real seconds after which a run that would be idle asks again whether a device still has something to report."""
LONGEST = 3600.0
"""Seconds after which a program that waits for the clock is asked again; what is longer need not fit a timer."""


@dataclass(frozen=True)
class Outcome:
    """How a run ended that did not fail, with the state it reached."""

    end: End
    message: str
    state: State
    actions: int
    exogenous: int


class Executive(Intake):
    """One online run of a program."""

    def __init__(
        self,
        executable: Executable,
        router: Router,
        inbox: Inbox,
        sources: Sequence[Source] = (),
        policy: Policy | None = None,
        clock: clocks.Clock | None = None,
    ) -> None:
        clock = clock or clocks.Clock(time.monotonic, time.monotonic())
        super().__init__(executable.dynamics, inbox, router.devices, policy or Policy(), clock)
        self.machine = executable.machine
        self.machine.now = self.clock.now
        self._node = executable.node
        self._give_up = executable.look_ahead.give_up
        self._router = router
        self._sources = tuple(sources)
        events = [action for action in self.dynamics.theory.actions.values() if action.exogenous]
        self._reporting = tuple(source for source in sources if any(map(source.may_report, events)))
        self._failed: set[Act] = set()
        """The actions that have failed and are not to be tried again before something changes."""
        self._last_failure: DeviceError | None = None

    def run(self) -> Outcome:
        """Execute the program to its end; the devices are told to stop whatever happens. An executive runs once.

        Raises ``ProgramError`` if the program fails, ``UserError`` if no device does an action that it has come to, and
        ``DeviceError`` if the world fails.
        """
        opened: list[Device] = []
        try:
            self.tell(Started(self.clock.now(), self.state))
            for device in self._devices:
                device.open()
                opened.append(device)
            for source in self._sources:
                source.start()
            end, message = self._loop(self._node)
        except BaseException as error:
            self._finish(opened, *verdict_on(error))
            raise
        self._finish(opened, end, message)
        return Outcome(end, message, self.state, self.actions, self.exogenous)

    def _finish(self, opened: Sequence[Device], end: End, message: str) -> None:
        """Stop everything, then tell; an observer that fails now can keep nobody from being told."""
        self._engaged = None
        with undisturbed():
            unstopped = release(self._sources, opened)
            ended = Ended(self.clock.now(), end, message, self.state, self.actions, self.exogenous, unstopped)
            for observer in self.observers:
                with suppress(OSError, DeviceError):
                    observer(ended)

    def _loop(self, node: Node) -> tuple[End, str]:
        items, final, decide, give_up = self._inbox.items, self.machine.final, self.machine.decide, self._give_up
        quiet = 0
        while True:
            if items and self.take_in():
                quiet = 0
                self._failed.clear()
            if self._verdict is not None:
                return self._verdict
            self._engaged = give_up
            try:
                choice = decide(node, self.state, self._failed)
            except GivenUpSearchError:
                continue
            finally:
                self._engaged = None
            if choice is None:
                if final(node, self.state):
                    return End.FINAL, "the program is final"
                self._stay_blocked(node)
                continue
            label, residual = choice
            if isinstance(label, Act):
                if not self._commit(label):
                    continue
                quiet = 0
            elif isinstance(label, Wait):
                exogenous, quiet = self.exogenous, 0
                self._wait(label)
                if self.exogenous == exogenous:
                    continue  # the wait goes on: nothing has happened but that time has passed
            else:
                quiet += 1
                self._step(label, quiet)
            node = residual

    def _step(self, label: Silent | Say | Clock | Abort, quiet: int) -> None:
        """A step without an action."""
        self._failed.clear()
        match label:
            case Say(text=text, span=span) if self.observers:
                self.tell(Said(self.clock.now(), text, span))
            case Silent(span=span) | Clock(span=span) if self.observers:
                self.tell(Stepped(self.clock.now(), span))
            case Abort(text=text, span=span):
                raise ProgramError(Diagnostic(Code.ABORTED, text or "the program aborts", span))
        if quiet >= CIRCLES:
            raise runs_in_circles(label.span)

    def _commit(self, label: Act) -> bool:
        """Have a device do an action and apply its effects; False if it was not done, or is to be decided anew."""
        if self._policy.confirm is not None and not self._confirmed(label, self._policy.confirm):
            return False
        after = self.dynamics.progress(self.state, label.action, label.args)  # an error of the theory moves no robot
        device = self._router.device(label.action, label.args)
        try:
            performed = self._perform(label, device)
        except DeviceError as error:
            self._cope(label, error)
            return False
        if performed is None:
            return False
        self._apply(label, after, *performed)
        return True

    def _perform(self, label: Act, device: Device) -> tuple[Args, float] | None:
        """Have a device do an action; its sensing results and when it began, or none if it is to be decided anew."""
        self._engaged = device.interrupt
        try:
            with device.free():
                if self._inbox.items:  # something has happened since the decision
                    return None
                began = self._begin(label, device)
                return device.perform(label.action, label.args), began
        finally:
            self._engaged = None

    def _begin(self, label: Act, device: Device) -> float:
        """Tell that an action begins; when that was, if anybody listens."""
        if not self.observers:
            return 0.0
        began = self.clock.now()
        self.tell(Begun(began, label.action, label.args, device.label(label.action, label.args), label.span))
        return began

    def _apply(self, label: Act, after: State, results: Args, began: float) -> None:
        """The effects of an action that was done, then its sensing results."""
        action, args, before = label.action, label.args, self.state
        surprises: Sequence[Surprise] = ()
        if results:
            after, surprises = self.dynamics.assimilate(after, action, args, results)
        self.state = after
        self.actions += 1
        self.history.append(label)
        self._failed.clear()
        if self.observers:
            now = self.clock.now()
            self.tell(Done(now, action, args, results, now - began, before, after, tuple(surprises)))
        if surprises and self._policy.on_surprise is OnSurprise.STOP:
            raise surprising(label, surprises[0])
        if self._invariants is not None:
            self._invariants.check(after, str(label), label.span)

    def _confirmed(self, label: Act, confirm: Callable[[Act], None]) -> bool:
        """Ask whether an action may begin; False if something has happened meanwhile."""
        with self._engaging(self._policy.interrupt):
            confirm(label)
        return not self._inbox.items

    def _cope(self, label: Act, error: DeviceError) -> None:
        """An action failed: what has happened meanwhile comes first, then what is to be done about it."""
        self.tell(Failed(self.clock.now(), label.action, label.args, error))
        self.take_in()
        if self._verdict is not None:
            return
        remedy = self._remedy(label, error)
        self.tell(Remedied(self.clock.now(), label.action, label.args, remedy))
        match remedy:
            case Remedy.STOP:
                raise error
            case Remedy.NEXT:
                self._failed.add(label)
                self._last_failure = error
            case Remedy.RETRY if not isinstance(error, GivenUpError):
                self._inbox.wait(self._policy.retry_after)

    def _remedy(self, label: Act, error: DeviceError) -> Remedy:
        """What is to be done; an action that the operator had given up is simply decided upon anew."""
        if isinstance(error, GivenUpError):
            return Remedy.RETRY
        with self._engaging(self._policy.interrupt):
            return self._policy.on_failure(label, error)

    @contextmanager
    def _engaging(self, interrupt: Callable[[], None]) -> Iterator[None]:
        """While the loop is engaged in something that ``interrupt`` can end."""
        self._engaged = interrupt
        try:
            yield
        finally:
            self._engaged = None

    def _wait(self, label: Wait) -> None:
        """Let time pass until an exogenous action has been taken in, or the run is to end."""
        if self.observers:
            self.tell(Waiting(self.clock.now(), label.span))
        if self._until_event() or self._verdict is not None:
            return
        idle = self._policy.stop_when_idle
        if idle is None:
            message = "the program waits, and nothing can happen any more: no source of exogenous actions is open"
            help_ = "`--stop-when-idle 0` ends such a run with success"
            raise ProgramError(Diagnostic(Code.WAITS_FOR_EVER, message, label.span, help=help_))
        self._verdict = End.IDLE, f"idle: the program waits, at line {label.span.line}"

    def _stay_blocked(self, node: Node) -> None:
        """Nothing can be done: wait for an event, if one can come."""
        if self.observers and self._open():
            reasons = tuple(self.machine.why_blocked(node, self.state))
            self.tell(Blocked(self.clock.now(), reasons, self._open()))
        if self._until_event():
            self._failed.clear()
        elif self._verdict is None:
            if self._failed and self._last_failure is not None:
                raise self._last_failure
            raise blockage(self, self.machine.why_blocked(node, self.state), node.rule.span, bool(self._open()))

    def _until_event(self) -> bool:
        """Take in what comes until an exogenous action was applied, or the program is to be asked again by the clock.

        False if none can come or none came in time, or if the operator ended the run, which is then the verdict.
        """
        idle = self._policy.stop_when_idle
        deadline = None if idle is None else self.clock.now() + idle
        items, alarm = self._inbox.items, self.machine.alarm
        while self._verdict is None:
            if items:
                if self.take_in():
                    return True
            elif alarm is not None:
                if not self._inbox.wait(min(self.clock.until(alarm), LONGEST)):
                    return True
            elif not self._open() and not items:
                return False
            elif deadline is None:
                self._inbox.wait()
            elif not self._inbox.wait(self.clock.until(deadline)) and self.clock.now() >= deadline:
                if not any(device.polling for device in self._devices):
                    return bool(items) and self.take_in()
                self._inbox.wait(A_MOMENT)
        return False

    def _open(self) -> tuple[str, ...]:
        """The sources that have not ended and may report an exogenous action of this domain."""
        return tuple(source.name for source in self._reporting if not source.ended)
