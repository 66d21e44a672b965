"""Where exogenous actions come from: lines of text, the terminal, and a schedule. (The brick is polled by ``polling``.)

Every source has a thread of its own at most, which puts what it hears into the inbox and touches nothing else.
"""

from __future__ import annotations

import contextlib
import os
import select
import sys
import threading
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Literal, TypeAlias, cast

from golc.diagnostics import Code, Diagnostic, Findings, Source, Span
from golc.runtime.clock import Clock
from golc.runtime.devices.desk import Desk
from golc.runtime.loop.happenings import Begun, Happening
from golc.runtime.loop.inbox import Closed, Command, Inbox, Item, Refusal, Reply, Report, end_thread, reporting_thread
from golc.runtime.sources.schedule import Player, Schedule
from golc.theory.ground import Call, read_exogenous
from golc.theory.suggest import did_you_mean
from golc.theory.theory import Action, BasicActionTheory

COMMANDS: Mapping[str, str] = {
    "state": "show the value of every fluent",
    "history": "show what has happened",
    "abort": "stop what the devices do and go on",
    "stop": "end the run",
}
"""What may stand behind a ``!``, ..."""
DEEDS = ("press", "lift", "put")
"""... and the beginnings of what else may, where somebody is at a simulated robot."""
Hands: TypeAlias = Callable[[str, Span, Findings], object]
"""Those of somebody at a simulated robot: they do what a text says, or it is a finding at its place."""

LONGEST_LINE = 65_536
"""Bytes after which a line without an end is given up."""


class Lines:
    """Makes an item for the inbox of a line of text, for one source."""

    def __init__(self, theory: BasicActionTheory, source: str, hands: Hands | None = None) -> None:
        self._theory = theory
        self._source = source
        self._hands = hands
        self._count = 0

    def read(self, raw: bytes, reply: Reply) -> Item | None:
        """The report, the command, or the refusal that a line is; None for a blank line."""
        self._count += 1
        text = raw.decode("utf-8", "replace").strip()
        place = Source(f"<{self._source} line {self._count}>", text)
        if not text:
            return None
        try:
            raw.decode("utf-8")
        except UnicodeDecodeError as error:
            message = f"the line is not UTF-8: byte 0x{raw[error.start]:02x} at position {error.start + 1}"
            return self._refusal(place, Diagnostic(Code.EVENT, message, Span(place, 0, len(text))))
        if text.startswith("!"):
            return self._command(place, reply)
        return self._report(place)

    def is_report(self, text: str) -> bool:
        """Whether a line is meant as a command or as an exogenous action of the domain."""
        name = text.strip().partition("(")[0].strip()
        action = self._theory.actions.get(name)
        return name.startswith("!") or (action is not None and action.exogenous)

    def _deed(self, place: Source, hands: Hands) -> Item | None:
        """Something for the hands to do, which they do at once."""
        findings = Findings()
        hands(place.text[1:], Span(place, 1, len(place.text)), findings)
        # They use the words, and so the code, of a world file; this is none.
        refused = [replace(finding, code=Code.EVENT) for finding in findings.diagnostics]
        return self._refusal(place, *refused) if refused else None

    def _command(self, place: Source, reply: Reply) -> Item | None:
        name = place.text[1:].strip()
        if name in COMMANDS:
            return Command(cast(Literal["state", "history", "abort", "stop"], name), self._source, reply)
        if self._hands is not None and name.partition(" ")[0] in DEEDS:
            return self._deed(place, self._hands)
        known = [f"!{command}" for command in (*COMMANDS, *(DEEDS if self._hands is not None else ()))]
        help_ = did_you_mean(f"!{name}", known) or "there are " + ", ".join(known)
        where = Span(place, 0, len(place.text))
        return self._refusal(place, Diagnostic(Code.EVENT, f"unknown command `!{name}`", where, help=help_))

    def _report(self, place: Source) -> Item:
        findings = Findings()
        call = read_exogenous(self._theory, Span(place, 0, len(place.text)), findings)
        if call is None:
            return self._refusal(place, *findings.diagnostics)
        if not from_operator(self._theory, self._theory.actions[call.action]):
            return self._refusal(place, _wrong_source(self._theory.actions[call.action], call))
        return Report(call.action, call.args, self._source)

    def _refusal(self, place: Source, *diagnostics: Diagnostic) -> Refusal:
        return Refusal(place.text, self._source, diagnostics)


def from_operator(theory: BasicActionTheory, action: Action) -> bool:
    """Whether people (at the terminal, over TCP) may report an exogenous action, whatever the operator is called."""
    people = {"operator"} | {device.name for device in theory.devices if device.kind == "operator"}
    return action.exogenous and (not action.sources or not people.isdisjoint(action.sources))


def _wrong_source(action: Action, call: Call) -> Diagnostic:
    allowed = " or ".join(action.sources)
    return Diagnostic(Code.EVENT, f"`{action.name}` is reported by {allowed}, not by an operator", call.span)


def one_line(diagnostics: tuple[Diagnostic, ...]) -> str:
    """The first finding in a single line, with its help."""
    first = diagnostics[0]
    return first.message + (f"; {first.help}" if first.help else "")


class Splitter:
    """Cuts a stream of bytes into lines; a line that never ends is cut off, so that memory has a bound."""

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[bytes]:
        """The lines that are complete now, without their ends."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        if len(self._rest) > LONGEST_LINE:
            lines.append(self._rest[:LONGEST_LINE])
            self._rest = b""
        return lines

    def end(self) -> list[bytes]:
        """The last line, if the stream ended in the middle of it."""
        rest, self._rest = self._rest, b""
        return [rest] if rest else []


def standard_input() -> int | None:
    """The descriptor of standard input, if there is one."""
    try:
        return sys.stdin.fileno()
    except (AttributeError, OSError, ValueError):
        return None


class Terminal:
    """Standard input (or any file descriptor): exogenous actions, commands and answers, one a line."""

    name = "stdin"

    def __init__(
        self,
        theory: BasicActionTheory,
        inbox: Inbox,
        desk: Desk,
        reply: Reply,
        descriptor: int = 0,
        hands: Hands | None = None,
    ) -> None:
        self._theory = theory
        self._lines = Lines(theory, self.name, hands)
        self._inbox = inbox
        self._desk = desk
        self._reply = reply
        self._descriptor = descriptor
        self._wake, self._waker = os.pipe()
        self._thread = reporting_thread(inbox, self.name, self._run)
        self.ended = False

    def may_report(self, action: Action) -> bool:
        return from_operator(self._theory, action)

    def start(self) -> None:
        self._thread.start()

    def close(self) -> None:
        """Stop reading; what was not read stays in the descriptor."""
        os.write(self._waker, b"x")
        end_thread(self._thread)
        os.close(self._wake)
        os.close(self._waker)

    def _run(self) -> None:
        splitter = Splitter()
        while data := self._read():
            for line in splitter.feed(data):
                self._take(line)
        for line in splitter.end():
            self._take(line)
        self.ended = True
        self._desk.close()
        self._inbox.put(Closed(self.name))

    def _read(self) -> bytes:
        """Some bytes; none when the input has ended, cannot be read, or nobody wants it any more."""
        with contextlib.suppress(OSError):
            ready: list[int] = select.select([self._descriptor, self._wake], [], [])[0]
            return b"" if self._wake in ready else os.read(self._descriptor, 4096)
        return b""

    def _take(self, raw: bytes) -> None:
        text = raw.decode("utf-8", "replace").rstrip("\r")
        if self._desk.offer(text, self._lines.is_report(text)):
            return
        if (item := self._lines.read(raw, self._reply)) is not None:
            self._inbox.put(item)


class Timetable:
    """The lines of an events file as a source; told of the actions that begin, it reports what they bring about."""

    name = "schedule"

    def __init__(self, schedule: Schedule, inbox: Inbox, clock: Clock) -> None:
        self._player = Player(schedule)
        self._inbox = inbox
        self._clock = clock
        self._changed = threading.Condition()
        self._closed = False
        self._thread = reporting_thread(inbox, self.name, self._run)

    @property
    def ended(self) -> bool:
        """Nothing more is certain to come (an action that begins can change that), and all that came was reported."""
        with self._changed:
            return self._player.next is None

    @property
    def pending(self) -> int:
        """How many events are certain and still to come."""
        return self._player.pending

    def may_report(self, action: Action) -> bool:
        """A schedule stands for the whole world."""
        return action.exogenous

    def start(self) -> None:
        self._thread.start()

    def observe(self, happening: Happening) -> None:
        """Note that an action begins."""
        if isinstance(happening, Begun):
            with self._changed:
                self._player.performed(happening.action, happening.args, happening.time)
                self._changed.notify()

    def close(self) -> None:
        with self._changed:
            self._closed = True
            self._changed.notify()
        end_thread(self._thread)

    def _run(self) -> None:
        with self._changed:
            while not self._closed:
                for call in self._player.due(self._clock.now()):
                    self._inbox.put(Report(call.action, call.args, self.name))
                upcoming = self._player.next
                self._changed.wait(None if upcoming is None else self._clock.until(upcoming))
