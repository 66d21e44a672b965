"""The control program on the brick, classic protocol: numbers in digits, more time, polls, abort, panic.

It behaves as the control programs that golc generates, which repair what a brick can without leaving the wire format. A
symbol that comes again after the host's time-out, with nothing in between, is the same one sent again: it gets the same
answer, and nothing is done twice. An event goes out with at least two digits, since a digit that has more to come is
acknowledged and a last one is not.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Protocol

from golc.nqc.wire import Wire
from golc.runtime.rcxsim.trace import Trace

REPEAT_AFTER = 3.0
"""The host sends again after 3.5 s without an answer; the same action anew comes sooner, or after a poll."""
MORE_TIME_AFTER = 2.5
"""Seconds after the host's last part at which a behaviour that still runs asks for more time."""
PATIENCE = 13.0
"""Seconds without a word in the middle of a number after which it is given up: the host had time to repeat itself three
times, the last time some 11 s after what was heard last. Who gives up before that takes the next digit for a number."""
NEVER = float("inf")
PANIC_EVERY = 1.0
"""Seconds from one cry of panic to the next."""


class Behaviours(Protocol):
    """What the control program steers: the hooks of the program with their numbers."""

    def begin(self, number: int, now: float) -> None:
        """Start the behaviour of an action."""

    def busy(self) -> bool:
        """Whether the behaviour begun last still runs."""

    def value(self) -> int:
        """The sensing number of the behaviour begun last, which is done."""

    def stop_all(self, now: float) -> None:
        """Stop every behaviour and forget what was to be reported."""

    def event(self, now: float) -> int | None:
        """The host asks: the number of the oldest event that waits to be reported."""

    def reported(self, now: float) -> None:
        """The oldest event has been reported."""

    def tick(self, now: float) -> None:
        """Let happen what is due."""

    def due(self) -> float | None:
        """When something happens next."""


def digits(number: int, radix: int) -> list[int]:
    """The digits of a number that is not negative, least significant first; at least one."""
    found = [number % radix]
    while number := number // radix:
        found.append(number % radix)
    return found


def spell(number: int, base: int, radix: int, least: int = 1) -> list[int]:
    """The messages for a number, in at least so many digits: all but the last say that more come."""
    found = digits(number, radix)
    found += [0] * (least - len(found))
    return [base + radix + digit for digit in found[:-1]] + [base + found[-1]]


class Phase(Enum):
    READY = "ready"
    RUNNING = "running"
    """The host waits for the value of an action."""
    ASKING = "asking"
    """More time was asked for and is not granted yet."""
    SENDING = "sending"
    """A part of a number is out that must be acknowledged."""
    PANIC = "panic"


class ClassicProgram:
    """Answers the host's messages; all times are in seconds since the start, and the caller has the clock."""

    def __init__(self, behaviours: Behaviours, wire: Wire, trace: Trace) -> None:
        self._behaviours = behaviours
        self._wire = wire
        self._trace = trace
        self._phase = Phase.READY
        self._received: list[int] = []  # the digits of an action number so far
        self._rest: list[int] = []  # what is still to be sent of a number
        self._is_event = False
        self._deadline = 0.0
        self._last = (0, float("-inf"))
        self._answer: Sequence[int] = ()

    @property
    def phase(self) -> Phase:
        return self._phase

    def hear(self, message: int, now: float) -> Sequence[int]:
        """Take a message of the host; what the brick answers at once."""
        wire = self._wire
        if message not in wire.ranges()["action numbers"] and message not in (wire.abort, wire.proceed, wire.request):
            self._trace.tell(now, "ignored", message=message, why="outside the brick's range")
            return ()
        if message == wire.abort:
            return self._abort(now)
        if self._phase is Phase.PANIC:
            return ()
        if self._sent_again(message, now):
            self._trace.tell(now, "repeated", message=message)
            self._deadline = now + MORE_TIME_AFTER
            self._start_patience(now)
        else:
            self._answer = self._take(message, now)
        self._last = (message, now)
        return self._answer

    def tick(self, now: float) -> Sequence[int]:
        """Do what is due: a behaviour has ended, more time is needed, the host has gone silent."""
        self._behaviours.tick(now)
        if self._phase is Phase.RUNNING and not self._behaviours.busy():
            self._answer = self._send_value()
        elif self._phase is Phase.RUNNING and now >= self._deadline:
            self._phase = Phase.ASKING
            self._answer = (self._wire.more_time,)
        elif self._phase is Phase.SENDING and now >= self._deadline:
            self._trace.tell(now, "panicked", why="the host stopped acknowledging in the middle of a number")
            self._phase = Phase.PANIC
            return self._panic(now)
        elif self._phase is Phase.PANIC and now >= self._deadline:
            return self._panic(now)
        else:
            return ()
        self._start_patience(now)
        return self._answer

    def due(self) -> float | None:
        """When ``tick`` is wanted next."""
        timed = self._phase in (Phase.RUNNING, Phase.SENDING, Phase.PANIC)
        due = self._behaviours.due()
        earliest = min(self._deadline if timed else NEVER, NEVER if due is None else due)
        return None if earliest == NEVER else earliest

    def reset(self, now: float) -> None:
        """Stop everything and begin anew: after an abort, or when the brick was switched off."""
        self._behaviours.stop_all(now)
        self._phase = Phase.READY
        self._received.clear()
        self._answer = ()
        self._last = (self._wire.abort, now)

    def _abort(self, now: float) -> Sequence[int]:
        self._trace.tell(now, "aborted", phase=self._phase.value)
        self.reset(now)
        return ()

    def _sent_again(self, message: int, now: float) -> bool:
        """Whether the host repeats itself because it has got no answer; polls are repeated anyway."""
        before, at = self._last
        if message != before or message == self._wire.request:
            return False
        if self._phase in (Phase.RUNNING, Phase.ASKING):
            return message != self._wire.proceed  # which grants time, however often it comes
        return now - at >= REPEAT_AFTER

    def _take(self, message: int, now: float) -> Sequence[int]:
        if message == self._wire.request:
            return self._polled(now)
        if message == self._wire.proceed:
            return self._go_on(now)
        more, digit = divmod(message - self._wire.action_base, self._wire.action_digits)
        return self._digit(digit, bool(more), now)

    def _digit(self, digit: int, more: bool, now: float) -> Sequence[int]:
        if now - self._last[1] > PATIENCE:
            self._received.clear()  # the number before was never finished
        self._phase = Phase.READY
        self._received.append(digit)
        if more:
            return (self._wire.proceed,)
        radix = self._wire.action_digits
        number = sum(part * radix**place for place, part in enumerate(self._received))
        self._received.clear()
        self._behaviours.begin(number, now)
        if not self._behaviours.busy():
            answer = self._send_value()
            self._start_patience(now)
            return answer
        self._phase = Phase.RUNNING
        self._deadline = now + MORE_TIME_AFTER
        return ()

    def _polled(self, now: float) -> Sequence[int]:
        """Whatever was under way, the host does not wait for it any more."""
        self._received.clear()
        self._phase = Phase.READY
        number = self._behaviours.event(now)
        if number is None:
            return (self._wire.none,)
        self._is_event = True
        answer = self._begin_sending(spell(number, self._wire.action_base, self._wire.action_digits, least=2))
        self._start_patience(now)
        return answer

    def _go_on(self, now: float) -> Sequence[int]:
        if self._phase in (Phase.RUNNING, Phase.ASKING) and self._behaviours.busy():
            self._phase = Phase.RUNNING
            self._deadline = now + MORE_TIME_AFTER
            return ()
        if self._phase is Phase.ASKING:
            answer = self._send_value()
        elif self._phase is Phase.SENDING:
            answer = (self._rest.pop(0),)
            if not self._rest:
                self._phase = Phase.READY
                if self._is_event:
                    self._behaviours.reported(now)
        else:
            answer = self._answer  # the host has not heard how it ended
        self._start_patience(now)
        return answer

    def _send_value(self) -> Sequence[int]:
        self._is_event = False
        return self._begin_sending(spell(self._behaviours.value(), self._wire.value_base, self._wire.value_digits))

    def _begin_sending(self, symbols: list[int]) -> Sequence[int]:
        self._rest = symbols[1:]
        self._phase = Phase.SENDING if self._rest else Phase.READY
        return (symbols[0],)

    def _start_patience(self, now: float) -> None:
        """A value that is not fetched is a reason to panic; an event is kept, whatever the host does first."""
        if self._phase is Phase.SENDING:
            self._deadline = NEVER if self._is_event else now + PATIENCE

    def _panic(self, now: float) -> Sequence[int]:
        self._deadline = now + PANIC_EVERY
        return (self._wire.panic,)
