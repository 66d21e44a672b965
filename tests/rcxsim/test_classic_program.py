"""The classic protocol on the brick, message by message in virtual time; the behaviours have fixed durations."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from golc.nqc.wire import Wire
from golc.runtime.rcxsim.theory.classic import ClassicProgram, Phase, digits, spell
from golc.runtime.rcxsim.trace import Trace

CONTINUE, POLL, NONE, MORE_TIME, ABORT, PANIC = 82, 83, 84, 85, 81, 80
TURN, LOOK, LONG, GO = 32, 33, 34, 35  # the actions 0 to 3, each in one digit


@dataclass
class Hooks:
    """Behaviours with fixed durations and results; action 65 exists, so that there is one with two digits."""

    events: list[int] = field(default_factory=list)
    begun: list[int] = field(default_factory=list)
    done_at: float | None = None
    result: int = 0

    def begin(self, number: int, now: float) -> None:
        self.begun.append(number)
        seconds, self.result = {0: (1.0, 0), 1: (1.0, 9), 2: (8.0, 5), 3: (0.0, 0), 65: (0.5, 3)}.get(number, (0.0, 0))
        self.done_at = now + seconds if seconds else None

    def busy(self) -> bool:
        return self.done_at is not None

    def value(self) -> int:
        return self.result

    def stop_all(self, now: float) -> None:
        self.done_at = None
        self.events.clear()

    def event(self, now: float) -> int | None:
        return self.events[0] if self.events else None

    def reported(self, now: float) -> None:
        del self.events[0]

    def tick(self, now: float) -> None:
        if self.done_at is not None and self.done_at <= now:
            self.done_at = None

    def due(self) -> float | None:
        return self.done_at


class Bench:
    """A program and a clock that only moves when it is told."""

    def __init__(self) -> None:
        self.hooks = Hooks()
        self.program = ClassicProgram(self.hooks, Wire(), Trace())
        self.now = 0.0

    def say(self, message: int) -> list[int]:
        """What the brick answers at once."""
        return list(self.program.hear(message, self.now))

    def wait(self, seconds: float) -> list[int]:
        """What the brick sends in the seconds that follow."""
        until = self.now + seconds
        sent: list[int] = []
        while (due := self.program.due()) is not None and due <= until:
            self.now = due
            sent += self.program.tick(due)
        self.now = until
        return sent


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_digits_and_their_messages() -> None:
    assert digits(0, 16) == [0]
    assert digits(65, 16) == [1, 4]
    assert spell(65, 32, 16) == [49, 36]
    assert spell(3, 32, 16, least=2) == [51, 32]
    assert spell(100, 64, 8) == [76, 76, 65]


def test_action_is_answered_when_it_is_done(bench: Bench) -> None:
    assert bench.say(TURN) == []
    assert bench.wait(0.9) == []
    assert bench.wait(0.2) == [64]
    assert bench.hooks.begun == [0]


def test_instant_action_is_answered_at_once(bench: Bench) -> None:
    assert bench.say(GO) == [64]


def test_value_of_two_digits_waits_for_continue(bench: Bench) -> None:
    bench.say(LOOK)
    assert bench.wait(1.5) == [73]
    assert bench.say(CONTINUE) == [65]
    assert bench.program.phase is Phase.READY


def test_number_of_two_digits_is_acknowledged(bench: Bench) -> None:
    assert bench.say(49) == [CONTINUE]
    assert bench.say(36) == []
    assert bench.wait(1) == [67]
    assert bench.hooks.begun == [65]


def test_asks_for_more_time_until_it_is_done(bench: Bench) -> None:
    bench.say(LONG)
    assert bench.wait(2.6) == [MORE_TIME]
    assert bench.say(CONTINUE) == []
    assert bench.wait(3.4) == [MORE_TIME]
    assert bench.say(CONTINUE) == []
    assert bench.wait(2.4) == [69]


def test_granted_after_it_is_done_answers_at_once(bench: Bench) -> None:
    bench.say(LONG)
    assert bench.wait(20) == [MORE_TIME]
    assert bench.say(CONTINUE) == [69]


def test_action_sent_again_while_it_runs_is_not_done_again(bench: Bench) -> None:
    bench.say(LONG)
    bench.wait(3.2)  # its "more time" was lost
    assert bench.say(LONG) == [MORE_TIME]
    assert bench.say(CONTINUE) == []
    assert bench.hooks.begun == [2]


def test_action_sent_again_after_a_lost_answer_is_not_done_again(bench: Bench) -> None:
    bench.say(TURN)
    assert bench.wait(3.5) == [64]
    assert bench.say(TURN) == [64]
    assert bench.wait(3.5) == []
    assert bench.say(TURN) == [64]
    assert bench.hooks.begun == [0]


def test_same_action_soon_after_the_answer_is_a_new_one(bench: Bench) -> None:
    bench.say(TURN)
    bench.wait(1.1)
    assert bench.say(TURN) == []
    assert bench.hooks.begun == [0, 0]


def test_same_action_after_a_poll_is_a_new_one(bench: Bench) -> None:
    bench.say(TURN)
    bench.wait(3.5)
    bench.say(POLL)
    assert bench.say(TURN) == []
    assert bench.hooks.begun == [0, 0]


def test_digit_sent_again_does_not_spoil_the_number(bench: Bench) -> None:
    bench.say(49)
    bench.wait(3.5)
    assert bench.say(49) == [CONTINUE]
    bench.say(36)
    assert bench.hooks.begun == [65]


def test_continue_sent_again_gets_the_same_digit_again(bench: Bench) -> None:
    bench.say(LOOK)
    bench.wait(1)
    assert bench.say(CONTINUE) == [65]
    bench.wait(3.5)
    assert bench.say(CONTINUE) == [65]


def test_number_left_unfinished_long_ago_is_forgotten(bench: Bench) -> None:
    bench.say(49)
    bench.wait(60)
    bench.say(GO)
    assert bench.hooks.begun == [3]


def test_poll_without_events(bench: Bench) -> None:
    assert bench.say(POLL) == [NONE]


def test_event_has_two_digits_so_that_it_is_acknowledged(bench: Bench) -> None:
    bench.hooks.events.append(3)
    assert bench.say(POLL) == [51]
    assert bench.say(CONTINUE) == [32]
    assert bench.say(POLL) == [NONE]


def test_event_that_nobody_heard_is_told_again(bench: Bench) -> None:
    bench.hooks.events.append(3)
    bench.say(POLL)
    bench.wait(0.3)
    assert bench.say(POLL) == [51]


def test_event_waits_while_the_host_does_something_else(bench: Bench) -> None:
    bench.hooks.events.append(3)
    bench.say(POLL)
    assert bench.wait(60) == []
    assert bench.say(GO) == [64]
    assert bench.say(POLL) == [51]


def test_event_is_kept_for_a_host_that_is_hard_to_hear(bench: Bench) -> None:
    bench.hooks.events.append(3)
    assert bench.say(POLL) == [51]
    bench.wait(25)
    assert bench.say(CONTINUE) == [32]


def test_last_digit_of_an_event_that_was_lost_comes_again(bench: Bench) -> None:
    bench.hooks.events += [3, 20]
    bench.say(POLL)
    bench.say(CONTINUE)
    bench.wait(3.5)
    assert bench.say(CONTINUE) == [32]
    assert bench.say(POLL) == [52]
    assert bench.say(CONTINUE) == [33]


def test_events_come_in_order(bench: Bench) -> None:
    bench.hooks.events += [65, 4]
    assert bench.say(POLL) + bench.say(CONTINUE) == [49, 36]
    assert bench.say(POLL) + bench.say(CONTINUE) == [52, 32]
    assert bench.say(POLL) == [NONE]


def test_poll_while_a_behaviour_runs_lets_it_run(bench: Bench) -> None:
    bench.say(LONG)
    bench.wait(1)
    assert bench.say(POLL) == [NONE]
    assert bench.hooks.busy()
    assert bench.wait(20) == []


def test_abort_stops_the_behaviour(bench: Bench) -> None:
    bench.say(LONG)
    bench.wait(1)
    assert bench.say(ABORT) == []
    assert not bench.hooks.busy()
    assert bench.wait(20) == []
    assert bench.say(GO) == [64]


def test_abort_forgets_half_a_number(bench: Bench) -> None:
    bench.say(49)
    bench.say(ABORT)
    bench.say(GO)
    assert bench.hooks.begun == [3]


def test_panic_when_a_number_is_not_acknowledged(bench: Bench) -> None:
    bench.say(LOOK)
    assert bench.wait(10) == [73]
    assert bench.wait(6.5) == [PANIC, PANIC, PANIC]
    assert [bench.say(POLL), bench.say(GO), bench.say(CONTINUE)] == [[], [], []]
    assert bench.wait(1) == [PANIC]
    assert bench.hooks.begun == [1]
    assert bench.say(ABORT) == []
    assert bench.say(POLL) == [NONE]


@pytest.mark.parametrize("message", [1, 31, 64, 79, 80, 84, 85, 86, 255])
def test_messages_of_others_are_ignored(bench: Bench, message: int) -> None:
    bench.say(49)
    assert bench.say(message) == []
    bench.say(36)
    assert bench.hooks.begun == [65]


def test_continue_out_of_nowhere_changes_nothing(bench: Bench) -> None:
    assert bench.say(CONTINUE) == []
    assert bench.say(POLL) == [NONE]
    assert bench.say(GO) == [64]


def test_late_continue_gets_the_last_answer_again(bench: Bench) -> None:
    bench.hooks.events.append(3)
    bench.say(POLL)
    assert bench.say(CONTINUE) == [32]
    bench.wait(1)
    assert bench.say(CONTINUE) == [32]


def test_other_ranges_of_messages() -> None:
    program = ClassicProgram(Hooks(), Wire(96, 16, 128, 8, 144), Trace())
    assert list(program.hear(83, 0.0)) == []
    assert list(program.hear(147, 0.0)) == [148]
    assert list(program.hear(99, 0.0)) == [128]
