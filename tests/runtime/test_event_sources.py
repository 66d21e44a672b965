"""Lines of text as exogenous actions, commands and answers: the terminal, the desk and the schedule as sources."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import DeviceError, Findings, Source
from golc.runtime.clock import Clock
from golc.runtime.devices.base import GivenUpError
from golc.runtime.devices.desk import Desk, WrongAnswerError
from golc.runtime.loop.happenings import Begun, Done
from golc.runtime.loop.inbox import Closed, Command, Inbox, Item, Refusal, Report
from golc.runtime.sources.exogenous import LONGEST_LINE, Lines, Splitter, Terminal, Timetable, one_line
from golc.runtime.sources.schedule import parse_schedule
from golc.theory.theory import BasicActionTheory

Domains = Callable[[str], BasicActionTheory]


def silent(result: object) -> None:
    """Nobody wants the answer."""


def read(theory: BasicActionTheory, line: str | bytes) -> Item | None:
    return Lines(theory, "stdin").read(line if isinstance(line, bytes) else line.encode(), silent)


def complaint(theory: BasicActionTheory, line: str | bytes) -> str:
    item = read(theory, line)
    assert isinstance(item, Refusal)
    return one_line(item.diagnostics)


@pytest.mark.parametrize(
    "line", ["request_delivery(2, 5)", "  request_delivery( 2 ,5 )\r", "request_delivery(2,5) # now"]
)
def test_an_exogenous_action(delivery: BasicActionTheory, line: str) -> None:
    assert read(delivery, line) == Report("request_delivery", (2, 5), "stdin")


def test_a_command(delivery: BasicActionTheory) -> None:
    assert read(delivery, "!state") == Command("state", "stdin", silent)


@pytest.mark.parametrize("line", ["", "   ", "\r"])
def test_a_blank_line_is_nothing(delivery: BasicActionTheory, line: str) -> None:
    assert read(delivery, line) is None


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("request_delivry(2, 5)", "unknown exogenous action `request_delivry`; did you mean `request_delivery`?"),
        ("turnaround", "`turnaround` is the robot's own, not exogenous"),
        (
            "request_delivery(2)",
            "`request_delivery` takes 2 arguments (origin: station, to: station), not 1; "
            "write for example `request_delivery(6, 6)`",
        ),
        ("push_go_button(1)", "`push_go_button` takes no arguments, not 1; write for example `push_go_button`"),
        (
            "request_delivery(2, 9)",
            "`to` of `request_delivery` is of type station (1..6), not `9`",
        ),
        ("request_delivery(2, true)", "`to` of `request_delivery` is of type station (1..6), not `true`"),
        ("!sate", "unknown command `!sate`; did you mean `!state`?"),
        ("!", "unknown command `!`; there are !state, !history, !abort, !stop"),
        ("2 + 3", "`2 + 3` is not an action; write an exogenous action, as in `request_delivery(6, 6)`"),
        (b"request\xff", "the line is not UTF-8: byte 0xff at position 8"),
    ],
)
def test_a_wrong_line_is_refused_in_one_sentence(delivery: BasicActionTheory, line: str, message: str) -> None:
    assert complaint(delivery, line) == message


def test_a_wrong_line_is_shown_with_its_number(delivery: BasicActionTheory) -> None:
    lines = Lines(delivery, "stdin")
    lines.read(b"push_go_button", silent)
    item = lines.read(b"  push_go_buton", silent)

    assert isinstance(item, Refusal)
    assert str(item.diagnostics[0].span) == "<stdin line 2>:1:1"


@given(st.binary(max_size=40))
def test_no_line_raises(line: bytes) -> None:
    assert type(read(_DELIVERY[0], line)) in (type(None), Report, Command, Refusal)


_DELIVERY: list[BasicActionTheory] = []


@pytest.fixture(autouse=True)
def _shared(delivery: BasicActionTheory) -> None:
    """Hypothesis must not get a fresh fixture for each example."""
    _DELIVERY[:] = [delivery]


def test_a_source_that_is_not_named_is_refused(start: Callable[..., object]) -> None:
    run = start("domain d\nexog done from rcx\naction a\nproc control:\n    a\n")
    theory = run.executive.dynamics.theory  # type: ignore[attr-defined]

    assert complaint(theory, "done") == "`done` is reported by rcx, not by an operator"


def test_an_operator_with_a_name_reports_what_may_come_from_that_name(unchecked: Domains) -> None:
    theory = unchecked("domain d\nexog helped from alice\naction ask\ndevice operator alice:\n    ask\n")
    assert read(theory, "helped") == Report("helped", (), "stdin")


@given(st.lists(st.binary(max_size=8).filter(lambda line: b"\n" not in line), max_size=5), st.integers(1, 7))
def test_lines_are_the_same_however_they_are_cut(lines: list[bytes], size: int) -> None:
    stream = b"".join(line + b"\n" for line in lines) + b"rest"
    splitter = Splitter()
    got = [line for at in range(0, len(stream), size) for line in splitter.feed(stream[at : at + size])]

    assert got == lines
    assert splitter.end() == [b"rest"]


def test_a_line_without_an_end_does_not_fill_the_memory() -> None:
    splitter = Splitter()

    assert [len(line) for line in splitter.feed(b"x" * (LONGEST_LINE + 5))] == [LONGEST_LINE]
    assert splitter.feed(b"x" * LONGEST_LINE) == []
    assert [len(line) for line in splitter.feed(b"\n")] == [LONGEST_LINE]
    assert splitter.feed(b"y\n") == [b"y"]


class Pipe:
    """A terminal on a pipe, with the desk and the inbox it feeds."""

    def __init__(self, theory: BasicActionTheory, interactive: bool, plausible: Callable[[str], bool]) -> None:
        self.said: list[str] = []
        self.asked = threading.Event()
        self.inbox = Inbox()
        self.desk = Desk(self._tell, interactive, True, plausible)
        self._read, self._write = os.pipe()
        self.terminal = Terminal(theory, self.inbox, self.desk, silent, self._read)
        self.terminal.start()

    def _tell(self, text: str) -> None:
        self.said.append(text)
        self.asked.set()

    def type(self, text: str) -> None:
        os.write(self._write, text.encode())

    def end(self) -> None:
        os.close(self._write)
        self._write = -1

    def items(self, count: int) -> list[Item]:
        """The next items, waited for."""
        deadline = time.monotonic() + 20
        while len(self.inbox.items) < count and time.monotonic() < deadline:
            self.inbox.wait(1)
        return [self.inbox.items.popleft() for _ in range(count)]

    def close(self) -> None:
        self.terminal.close()
        os.close(self._read)
        if self._write >= 0:
            os.close(self._write)


Pipes = Callable[..., Pipe]


@pytest.fixture
def pipe(delivery: BasicActionTheory) -> Iterator[Pipes]:
    made: list[Pipe] = []

    def make(interactive: bool = False, plausible: Callable[[str], bool] = lambda line: not line.strip()) -> Pipe:
        made.append(Pipe(delivery, interactive, plausible))
        return made[-1]

    yield make
    for each in made:
        each.close()


def enter(line: str) -> str:
    if line:
        raise WrongAnswerError("press Enter")
    return "entered"


def test_lines_of_the_terminal_arrive_in_order_and_the_end_closes_it(pipe: Pipes) -> None:
    made = pipe()
    made.type("push_go_button\nnonsense\n!stop\narrive_at_sta")
    made.type("tion")
    made.end()

    items = made.items(5)

    assert [type(item) for item in items] == [Report, Refusal, Command, Report, Closed]
    assert made.terminal.ended
    assert not made.desk.is_open


def test_an_answer_goes_to_the_question_and_a_report_to_the_inbox(pipe: Pipes) -> None:
    made = pipe(interactive=True)

    def operator() -> None:
        made.asked.wait(20)
        made.type("push_go_button\nwhat?\n\n")

    thread = threading.Thread(target=operator)
    thread.start()
    answer = made.desk.ask("Put me back, then press Enter", enter)
    thread.join()

    assert answer == "entered"
    assert made.said == ["Put me back, then press Enter", "press Enter"]
    assert made.items(1) == [Report("push_go_button", (), "stdin")]


def test_what_was_typed_before_a_question_does_not_answer_it(pipe: Pipes) -> None:
    made = pipe(interactive=True)
    made.type("\n\npush_go_button\n")
    made.items(1)

    def operator() -> None:
        made.asked.wait(20)
        made.desk.interrupt()

    thread = threading.Thread(target=operator)
    thread.start()
    with pytest.raises(GivenUpError):
        made.desk.ask("Sure?", enter)
    thread.join()


def test_an_answer_that_was_piped_ahead_waits_for_its_question(pipe: Pipes) -> None:
    made = pipe()
    made.type("\npush_go_button\n")
    made.items(1)

    assert made.desk.ask("Sure?", enter) == "entered"


def test_nobody_to_ask_is_a_device_failure(pipe: Pipes) -> None:
    made = pipe()
    made.end()

    with pytest.raises(DeviceError, match="nobody is there to answer"):
        made.desk.ask("Sure?", enter)


class Hand:
    """A clock that a test moves."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        return self.seconds


def test_the_schedule_reports_what_is_due_and_reacts_to_actions(delivery: BasicActionTheory) -> None:
    text = "at 0 s: push_go_button\non signal_arrival after 0 s: stop_abnormally\nat 1000 s: push_go_button"
    schedule = parse_schedule(Source("e", text), delivery, Findings())
    inbox = Inbox()
    timetable = Timetable(schedule, inbox, Clock(Hand(), 0.0))
    timetable.start()

    assert inbox.wait(20)
    assert inbox.items.popleft() == Report("push_go_button", (), "schedule")
    span = next(iter(delivery.actions.values())).span
    timetable.observe(Done(0.0, "signal_arrival", (), (), 0.0, (), (), ()))
    timetable.observe(Begun(0.0, "signal_arrival", (), "rcx 1", span))
    assert inbox.wait(20)
    assert inbox.items.popleft() == Report("stop_abnormally", (), "schedule")
    assert not timetable.ended
    assert timetable.pending == 1
    timetable.close()


def test_a_schedule_has_ended_when_nothing_is_certain_to_come(delivery: BasicActionTheory) -> None:
    schedule = parse_schedule(Source("e", "on signal_arrival after 1 s: push_go_button"), delivery, Findings())

    assert Timetable(schedule, Inbox(), Clock(Hand(), 0.0)).ended


def test_a_clock_runs_faster() -> None:
    hand = Hand()
    clock = Clock(hand, 0.0, speed=10)
    hand.seconds = 0.5

    assert clock.now() == 5.0
    assert clock.real(30) == 3.0
    assert clock.until(10.0) == 0.5
    assert clock.until(1.0) == 0.0
