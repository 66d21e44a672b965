"""One exchange with a brick: a message goes out, an answer that makes sense comes back, or nothing does.

Whatever else is heard has a place here too: the answer to a poll that was given up, answers to something that was sent
twice, an echo that was missed, panic, nonsense.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Container
from dataclasses import dataclass

from golc.runtime.devices.rcx.errors import NonsenseError, PanicError
from golc.runtime.devices.rcx.numbers import MAXIMUM, ClassicParameters, Digits
from golc.runtime.devices.rcx.timing import BrickStatistics, Timing
from golc.runtime.devices.rcx.tower import AWAKE_SECONDS, Tower

logger = logging.getLogger(__name__)

FORGETFUL_ASKS = 2
"""Number of times that *continue* is sent to a brick that may take the second one for another acknowledgement."""
NEW_AFTER = 2.9
"""A brick that remembers takes a message for the one before it if it is the same and comes 3 s later or more."""
LONGEST = 16
"""Digits after which a number counts as endless: one for each bit is enough in any base."""


@dataclass(frozen=True, slots=True)
class Collected:
    """A number of one or more digits as it arrived; ``sure`` if no digit can be missing or double.

    A brick that remembers takes a *continue* that follows another one, and is lost the first time, for the one before;
    one that does not may send a digit again of its own accord.
    """

    number: int
    digits: int
    sure: bool


class Exchange:
    """Asks a brick and sorts what is heard; ``stale`` while answers to something sent twice may be under way."""

    def __init__(
        self, tower: Tower, numbers: ClassicParameters, timing: Timing, statistics: BrickStatistics, remembers: bool
    ) -> None:
        self.events: deque[int] = deque()
        self.nonsense: list[int] = []
        self.stale = False
        self.doubtful = False
        """The brick may have taken the message asked last for the one before it, which was the same."""
        self._tower = tower
        self._numbers = numbers
        self._timing = timing
        self._statistics = statistics
        self._remembers = remembers
        self._last_sent: int | None = None
        self._last_sent_at = float("-inf")
        self._unsettled: set[int] = set()
        self._follows_itself = False
        self._answered = True
        self._late_digits: list[int] = []
        self._late_until = float("-inf")

    def may_be_last(self, number: int) -> bool:
        """Whether the brick may have heard this message last: the last that it answered, or one sent since then."""
        return number in self._unsettled

    @property
    def asks(self) -> int:
        """Number of times that *continue* is sent before what it should bring counts as lost."""
        return self._timing.part_sends if self._remembers else FORGETFUL_ASKS

    def send(self, number: int) -> float:
        """Send ``number``; the simulated time at which its last bit is out."""
        self._last_sent = number
        self._unsettled.add(number)
        self._answered = True
        self._last_sent_at = self._tower.send(number)
        return self._last_sent_at

    def ask(self, number: int, accept: Container[int], wait: float) -> int | None:
        """Send ``number`` once; the first acceptable answer within ``wait``, or None. PanicError, NonsenseError."""
        same, before = number == self._last_sent, self._last_sent_at
        again = same and not self._answered
        if not again:
            self._follows_itself = same
        sent = self.send(number)
        self.doubtful = self._remembers and self._follows_itself and (again or sent - before > NEW_AFTER)
        deadline = sent + max(wait, self._tower.least_wait)
        while (heard := self._tower.receive(deadline)) is not None:
            if heard in accept:
                self._unsettled = {number}
                self.nonsense.clear()
                if again and number != self._numbers.request:
                    self._drop_twins(heard)
                return heard
            # An echo of which noise has hidden the beginning looks like a message.
            if heard != number or self._late_digits:
                self._stray(heard)
        self._answered = False
        return None

    def _drop_twins(self, answer: int) -> None:
        """If the first sending was answered late, then the answer to the second comes now."""
        until = self._tower.now() + self._timing.poll
        while (heard := self._tower.receive(until)) is not None:
            if heard != answer:
                self._stray(heard)

    def collect(self, first: int, kind: Digits) -> Collected | None:
        """The number that begins with the digit ``first``: asks for the others; None if one never comes."""
        messages = [first]
        sure = True
        while messages[-1] in kind.more:
            if len(messages) == LONGEST:
                raise NonsenseError(
                    f"the brick sends a number without end ({', '.join(map(str, messages[:4]))}, ...)",
                    "does its program belong to the numbers that the device declares?",
                )
            asked = self._tower.now()
            answer = self._next_digit(kind)
            if answer is None:
                return None
            late = self._tower.now() - asked > self._timing.late
            sure = sure and not (self.doubtful if self._remembers else late)
            messages.append(answer)
        number = kind.join(messages)
        return Collected(number, len(messages), sure and number <= MAXIMUM)

    def _next_digit(self, kind: Digits) -> int | None:
        # A program that remembers gives up half a value in the end, but never an event: it is worth more patience.
        patient = self._remembers and kind == self._numbers.actions
        for attempt in range(self._timing.event_sends if patient else self.asks):
            self._statistics.resent += attempt > 0
            answer = self.ask(self._numbers.proceed, kind.all, self._timing.answer)
            if answer is not None:
                return answer
        return None

    def catch_up(self) -> None:
        """Sort what has arrived since the last exchange; the rest of a number that has begun is waited for."""
        wait = 0.0
        while (heard := self._tower.receive(self._tower.now() + wait)) is not None:
            self._stray(heard, between=True)
            wait = self._timing.poll if self._late_digits else 0.0
        self._late_digits.clear()

    def let_pass(self, seconds: float) -> None:
        """Listen for a while and ignore everything: the brick is being reset."""
        until = self._tower.now() + seconds
        while self._tower.receive(until) is not None:
            pass

    def expect_late(self) -> None:
        """The answer to the poll just made may still come, for as long as the tower is awake."""
        self._late_until = self._tower.now() + AWAKE_SECONDS

    def forget(self) -> None:
        """Start afresh: nothing is under way any more. Exogenous actions that were received stay."""
        self.nonsense.clear()
        self.stale = False
        self._late_digits.clear()
        self._late_until = float("-inf")

    def _stray(self, heard: int, between: bool = False) -> None:
        """Something that is no answer to what was asked, or comes between exchanges."""
        # A brick that remembers must not hear anything else before a message is sent again; nor does it need to, since
        # it keeps an event until it is acknowledged and does nothing twice. Another one must not be left alone.
        may_speak = between or not self._remembers
        if heard == self._numbers.panic:
            raise PanicError("the brick panics")
        if self._tower.now() <= self._late_until and (
            heard == self._numbers.none or heard in self._numbers.actions.all
        ):
            if heard != self._numbers.none and (may_speak or heard in self._numbers.actions.last):
                self._late_digit(heard)
        elif self.stale and self._is_reply(heard):
            if may_speak and (heard == self._numbers.more_time or heard in self._numbers.values.more):
                self.send(self._numbers.proceed)
        else:
            self._count_nonsense(heard)

    def _is_reply(self, heard: int) -> bool:
        return heard in self._numbers.values.all or heard in (self._numbers.proceed, self._numbers.more_time)

    def _late_digit(self, heard: int) -> None:
        self._late_digits.append(heard)
        if heard in self._numbers.actions.more and len(self._late_digits) < LONGEST:
            self.send(self._numbers.proceed)
            self.expect_late()
            return
        self.events.append(self._numbers.actions.join(self._late_digits))
        self._late_digits.clear()
        self._statistics.late += 1
        self._statistics.events += 1

    def _count_nonsense(self, heard: int) -> None:
        self.nonsense.append(heard)
        self._statistics.nonsense += 1
        logger.debug("%s: %d means nothing here", self._tower.name, heard)
        if len(self.nonsense) > self._timing.nonsense:
            raise self.nonsense_error()

    def nonsense_error(self) -> NonsenseError:
        """The error that tells what was heard."""
        heard = ", ".join(map(str, self.nonsense[:8]))
        return NonsenseError(
            f"the brick answers with numbers that mean nothing here ({heard})",
            "does its program belong to the numbers that the device declares, and is no other brick in sight?",
        )
