"""A brick that speaks the classic protocol of Legolog: actions, exogenous actions, abort; numbers in, numbers out.

The wire has no sequence numbers, so the host cannot tell a lost message from a lost answer: it sends a part again when
no answer has come for 3.5 s. A control program that golc generated recognises that by the time and by what came before,
and answers again without doing anything twice. Legolog's own does not (``remembers=False``), so with that the host

- finds out first, with a request for exogenous actions, whether the brick still waits for a digit, when the answer to a
  part of a longer number is missing, and starts the number again if it does not;
- throws away a sensing value of several digits in which an answer was missing or late, and repeats the action.

What remains there: an action whose answer was lost is done again, unless the caller forbids it (``repeat=False``). With
both, an answer that comes late is not taken for the answer to the next action, and an exogenous action that comes after
its poll was given up is kept for the next poll.
"""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator
from dataclasses import dataclass
from types import TracebackType
from typing import Self

from golc.runtime.devices.rcx.errors import LinkError, NonsenseError, OverdueError, PanicError, SilentBrickError
from golc.runtime.devices.rcx.exchange import Exchange
from golc.runtime.devices.rcx.numbers import ClassicParameters
from golc.runtime.devices.rcx.timing import BrickStatistics, Timing
from golc.runtime.devices.rcx.tower import Tower

logger = logging.getLogger(__name__)

DEFAULT_TIMEOUT = 15.0
"""Seconds that an action may take, as in Legolog."""
PROBES = 6
"""Requests, together as long as one wait for an answer, after which a brick that says nothing waits for a digit."""
ABORT_WAITS = 3
"""An abort is repeated for as long as so many answers may take."""
CHECK_HELP = (
    "is the brick switched on and in sight of the tower, does its program run (the green Run button), "
    "and do the numbers of the device belong to that program?"
)


@dataclass
class _Action:
    """An action under way: how often in a row the brick has not answered, and how often it was begun."""

    number: int
    parts: list[int]
    timeout: float
    repeat: bool
    silences: int = 0
    beginnings: int = 0
    deadline: float = 0.0


class Brick:
    """The host's end of the classic protocol; one exchange at a time, not for use by several threads."""

    def __init__(
        self,
        tower: Tower,
        parameters: ClassicParameters | None = None,
        timing: Timing | None = None,
        remembers: bool = True,
    ) -> None:
        """``remembers``: the program on the brick recognises a message that is sent again, as those of golc do."""
        self.statistics = BrickStatistics()
        self._tower = tower
        self._numbers = parameters or ClassicParameters()
        self._timing = timing or Timing()
        self._remembers = remembers
        self._exchange = Exchange(tower, self._numbers, self._timing, self.statistics, remembers)
        self._replies = frozenset((*self._numbers.values.all, self._numbers.more_time))
        self._polled = frozenset((*self._numbers.actions.all, self._numbers.none))
        self._silent_polls = 0
        self._silent_since = 0.0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def tower(self) -> Tower:
        """The tower through which the brick is reached."""
        return self._tower

    def close(self) -> None:
        """Close the tower. The brick is not told: call ``abort`` before, if it is to stop."""
        self._tower.close()

    def perform(self, number: int, timeout: float = DEFAULT_TIMEOUT, repeat: bool = True) -> int:
        """Have the brick do an action; the sensing value it answers with, 0 for an action that senses nothing.

        ``timeout``, in simulated seconds, is for the action itself, from when the brick can first have begun it; it has
        to ask for more time every 3.5 s (``Timing``). With ``repeat=False`` the action is never sent a second time once
        the brick may have begun it: a lost message is then an error. Raises SilentBrickError, OverdueError, PanicError
        (after an abort), NonsenseError, PortGoneError, InterruptedLinkError, and ParameterError for a number that does
        not fit the wire.
        """
        parts = self._numbers.actions.split(number)
        with self._abort_on_panic():
            self._exchange.catch_up()
            action = _Action(number, parts, timeout, repeat)
            while (value := self._attempt(action)) is None:
                self.statistics.repeated += 1
        self.statistics.actions += 1
        self._silent_polls = 0
        return value

    def poll(self) -> int | None:
        """The number of an exogenous action that has occurred, or None; also None if the brick does not answer now.

        Raises SilentBrickError when several polls in a row remain without an answer (``Timing``), PanicError (after an
        abort), NonsenseError, PortGoneError.
        """
        with self._abort_on_panic():
            self._exchange.catch_up()
            if not self._exchange.events:
                self._count_silence(self._request(self._timing.poll))
        return self._exchange.events.popleft() if self._exchange.events else None

    def abort(self, confirm: bool = True) -> None:
        """Tell the brick to stop all behaviours, until it answers a request again.

        The message is sent several times, for a brick that has lost it answers all the same. With ``confirm=False``
        it is sent once and nothing is waited for. Raises SilentBrickError if the brick confirms nothing, PanicError if
        it goes on panicking, PortGoneError. May be called after any exception, KeyboardInterrupt included, has ended
        another call.
        """
        self.statistics.aborts += 1
        self._exchange.forget()
        began = self._tower.now()
        unconfirmed: LinkError = SilentBrickError("the brick does not confirm the abort: it may go on", CHECK_HELP)
        while True:
            self._exchange.send(self._numbers.abort)
            if not confirm:
                return
            for _ in range(self._timing.abort_sends - 1):
                self._exchange.let_pass(self._timing.abort_pause)
                self._exchange.send(self._numbers.abort)
            # The brick keeps only the last message, so it gets the time to read this one.
            self._exchange.let_pass(self._timing.poll)
            try:
                if self._request(self._timing.poll):
                    return
            except PanicError:
                unconfirmed = PanicError("the brick panics and does not obey the abort", "restart its program by hand")
            except NonsenseError as error:
                unconfirmed = error
            if self._tower.now() - began >= max(self._timing.abort, ABORT_WAITS * self._tower.least_wait):
                raise unconfirmed

    def _attempt(self, action: _Action) -> int | None:
        """Send the action from its first digit; None if that has to be done again."""
        self._mark_off(action)
        action.beginnings += 1
        if action.beginnings > self._timing.sends:
            raise self._silent(action, f"begun {self._timing.sends} times, and no answer was complete")
        answer = None
        for place in range(len(action.parts)):
            answer = self._deliver(place, action)
            if answer is None:
                return None
        while answer == self._numbers.more_time:
            answer = self._grant(action)
        if answer is None:
            return None
        collected = self._exchange.collect(answer, self._numbers.values)
        if collected is not None and collected.sure:
            return collected.number
        self._exchange.stale = True
        if not action.repeat:
            raise SilentBrickError(f"the sensing value of action {action.number} has arrived with gaps", CHECK_HELP)
        return None

    def _deliver(self, place: int, action: _Action) -> int | None:
        """Send a part until it is answered; None if the number has to be sent from its beginning."""
        part, last = action.parts[place], place == len(action.parts) - 1
        expected = self._replies if last else frozenset((self._numbers.proceed,))
        while True:
            action.deadline = self._tower.now() + action.timeout
            answer = self._exchange.ask(part, expected, self._timing.answer)
            if answer is None:
                self._note_silence(action, self._timing.part_sends if place else self._timing.sends)
                if last and not action.repeat:
                    raise self._silent(action, "whether it was done is not known")
                if not self._remembers and len(action.parts) > 1:
                    answer = self._where(expected)
                    if answer == self._numbers.none:
                        return None
                    if answer is None and not last:
                        answer = self._received(place, action)
            if answer is not None:
                action.silences = 0
                return None if self._exchange.doubtful and place > 0 else answer
            self.statistics.resent += 1

    def _received(self, place: int, action: _Action) -> int:
        """A brick that waits for a digit has received the first one. Of later ones that cannot be known."""
        if place > 0:
            raise self._silent(action, f"it is not known which of the digits {action.parts} it has received")
        return self._numbers.proceed

    def _where(self, expected: frozenset[int]) -> int | None:
        """Ask the brick where it is: the answer that was missed, *none* if it is idle, None if it waits for a digit."""
        for _ in range(PROBES):
            self.statistics.polls += 1
            answer = self._exchange.ask(self._numbers.request, self._polled | expected, self._timing.answer / PROBES)
            if answer is None or answer in expected:
                self._exchange.expect_late()
            if answer is not None and answer not in expected:
                self._exchange.stale = False
                self._receive_event(answer)
                return self._numbers.none
            if answer is not None:
                return answer
        return None

    def _grant(self, action: _Action) -> int | None:
        """Grant the brick the time it asks for; its next answer, or None if that was lost."""
        self.statistics.more_time += 1
        for _ in range(self._exchange.asks):
            left = max(self._timing.least, action.deadline - self._tower.now())
            answer = self._exchange.ask(self._numbers.proceed, self._replies, min(self._timing.answer, left))
            done = answer is not None and answer != self._numbers.more_time
            if not done and self._tower.now() >= action.deadline:
                raise OverdueError(
                    f"action {action.number} has not ended within its {action.timeout:g} s",
                    "give the action a longer timeout",
                )
            if answer is not None:
                action.silences = 0
                return answer
            self._note_silence(action, self._timing.part_sends)
            self.statistics.resent += 1
        if not action.repeat:
            raise self._silent(action, "it was begun, and whether it was done is not known")
        return None

    def _note_silence(self, action: _Action, most: int) -> None:
        """Once more without an answer: SilentBrickError if that was the last time."""
        action.silences += 1
        self._exchange.stale = True
        if action.silences >= most:
            raise self._silent(action, f"sent {action.silences} times, {self._timing.answer:g} s apart")

    def _silent(self, action: _Action, remark: str) -> LinkError:
        if self._exchange.nonsense:
            return self._exchange.nonsense_error()
        return SilentBrickError(f"the brick does not answer action {action.number} ({remark})", CHECK_HELP)

    def _request(self, wait: float) -> bool:
        """Ask for an exogenous action, which goes into the queue; whether the brick has answered at all."""
        self.statistics.polls += 1
        answer = self._exchange.ask(self._numbers.request, self._polled, wait)
        if answer is None:
            self.statistics.unanswered += 1
            self._exchange.expect_late()
            return False
        # The brick answers in order: whatever it had to say before is said.
        self._exchange.stale = False
        self._receive_event(answer)
        return True

    def _receive_event(self, first: int) -> None:
        """Put the exogenous action that begins with this digit, if it is one, into the queue."""
        if first == self._numbers.none:
            return
        collected = self._exchange.collect(first, self._numbers.actions)
        # From a brick without memory, two doubtful digits are right as long as it has less than 256 actions:
        # a repeated digit makes it longer, a lost one makes it end here.
        if collected is None or not (collected.sure or collected.digits == 2):
            self.statistics.lost += 1
            logger.warning("%s: an exogenous action was lost on the way (first digit %d)", self._tower.name, first)
            return
        self._exchange.events.append(collected.number)
        self.statistics.events += 1

    def _mark_off(self, action: _Action) -> None:
        """See to it that the action is taken for a new one, and its answer for its own: poll in between.

        That is needed after something was sent twice, since the brick may answer twice, and before a message equal to
        the one before, which a brick that remembers could take for the same one sent again.
        """
        looks_old = self._remembers and self._exchange.may_be_last(action.parts[0])
        if not looks_old and not self._exchange.stale:
            return
        for _ in range(PROBES):
            if self._request(self._timing.answer / PROBES):
                return
        if looks_old:
            raise self._silent(action, f"{PROBES} polls before it were not answered")

    def _count_silence(self, answered: bool) -> None:
        """SilentBrickError after many polls without an answer."""
        if answered:
            self._silent_polls = 0
            return
        self._silent_polls += 1
        if self._silent_polls == 1:
            self._silent_since = self._tower.now()
        seconds = self._tower.now() - self._silent_since
        if self._silent_polls >= self._timing.polls and seconds >= self._timing.silence:
            if self._exchange.nonsense:
                raise self._exchange.nonsense_error()
            raise SilentBrickError(f"the brick has not answered any poll for {seconds:.0f} s", CHECK_HELP)

    @contextlib.contextmanager
    def _abort_on_panic(self) -> Iterator[None]:
        """A brick in panic goes on panicking until it is told to stop."""
        try:
            yield
        except PanicError as panic:
            self.statistics.panics += 1
            try:
                self.abort()
                outcome = "it was told to stop and has confirmed that"
            except (SilentBrickError, PanicError, NonsenseError) as error:
                outcome = str(error)
            raise PanicError(
                "the brick panics: it was left alone in the middle of a number, or its program gave up",
                f"{outcome}; what it was doing is unknown",
            ) from panic
