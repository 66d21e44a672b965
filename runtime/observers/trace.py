"""A readable account of a run: what was decided and why, what the devices answered, what the world did."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from golc.diagnostics import DeviceError, Diagnostic, Span, counted
from golc.runtime.loop.happenings import (
    Begun,
    Blocked,
    Done,
    Dropped,
    End,
    Ended,
    Failed,
    Happening,
    Refused,
    Remedied,
    Remedy,
    Reset,
    Said,
    SourceEnded,
    Started,
    Stepped,
    TakenIn,
    Waiting,
)
from golc.runtime.observers.reasons import Reasons, one_line
from golc.situation.dynamics import Dynamics
from golc.situation.summary import summary
from golc.situation.worlds import State
from golc.theory.order import spelt
from golc.theory.types import show, show_call

WHAT, WHO = 30, 12
"""Widths of the columns: what happens and who does it; the rest of a line says why, or what has changed."""
MARGIN = " " * 11
"""As wide as the time and the space behind it."""

INSTANT = 0.005
"""Seconds below which a duration is not worth mentioning."""


@dataclass(frozen=True)
class Style:
    """How a trace looks: in color or not, with the signs of Unicode or those of ASCII."""

    color: bool
    unicode: bool

    def paint(self, code: str, text: str) -> str:
        """A text in a color, given as the numbers of the terminal's escape sequence."""
        return f"\x1b[{code}m{text}\x1b[0m" if self.color and code and text.strip() else text

    def sign(self, fancy: str, plain: str) -> str:
        """A sign that the terminal can show."""
        return fancy if self.unicode else plain


DIM, BOLD, RED, GREEN, YELLOW, CYAN = "2", "1", "1;31", "32", "1;33", "1;36"


class Trace:
    """An observer that writes a line or two for everything that happens.

    ``write`` gets each line; ``complain`` the diagnostics of refused lines. ``verbosity`` is -1 (messages and trouble
    only), 0, or 1 (test steps and the tracebacks of foreign code too).
    """

    def __init__(
        self,
        dynamics: Dynamics,
        style: Style,
        verbosity: int,
        write: Callable[[str], object],
        complain: Callable[[tuple[Diagnostic, ...]], object],
    ) -> None:
        self._dynamics = dynamics
        self._style = style
        self._verbosity = verbosity
        self._write = write
        self._complain = complain
        self._reasons = Reasons(dynamics.theory)

    def __call__(self, happening: Happening) -> None:
        if self._verbosity >= 0 or isinstance(happening, (Said, Failed, Refused, Ended)):
            for line in self._lines(happening):
                self._write(line)

    def _lines(self, happening: Happening) -> Iterator[str]:
        match happening:
            case Begun():
                yield self._begun(happening)
            case Done():
                yield from self._done(happening)
            case TakenIn():
                yield from self._taken_in(happening)
            case Waiting(time=time, span=span):
                yield self._row(
                    time,
                    DIM,
                    f"  {self._sign('…', '..')} {one_line(span)}",
                    rest=self._style.paint(DIM, self._at(span)),
                )
            case Started(state=state):
                yield from (self._style.paint(DIM, MARGIN + line) for line in summary(self._dynamics, state))
            case Ended():
                yield from self._ended(happening)
            case Failed(time=time, error=error):
                yield self._row(time, RED, f"  {self._sign('✗', 'x')} {error}")
                yield from (f"{MARGIN}    {line}" for line in self._help(error))
            case Refused(diagnostics=diagnostics):
                self._complain(diagnostics)
            case _:
                yield from self._rare(happening)

    def _rare(self, happening: Happening) -> Iterator[str]:
        match happening:
            case Said(time=time, text=text):
                yield self._row(time, BOLD, self._sign("“{}”", '"{}"').format(text))
            case Remedied(time=time, remedy=remedy) if remedy is not Remedy.STOP:
                words = {Remedy.RETRY: "tries again", Remedy.NEXT: "looks for another way"}
                yield self._row(time, DIM, f"    {words[remedy]}")
            case Dropped(time=time, action=action, args=args, source=source, reason=reason):
                yield self._row(
                    time, RED, f"{self._in} {self._dynamics.call(action, args)}", source, f"dropped: {reason}"
                )
            case Blocked(time=time, reasons=reasons, sources=sources):
                yield self._row(time, YELLOW, f"  blocked; waits for {' or '.join(sources)}")
                yield from (f"{MARGIN}    {reason}" for reason in reasons)
            case Reset(time=time, source=source):
                yield self._row(time, YELLOW, f"the devices were told to stop ({source}: !abort)")
            case Stepped(time=time, span=span) if self._verbosity > 0:
                yield self._row(time, DIM, f"  - {one_line(span)}", rest=self._style.paint(DIM, self._at(span)))
            case SourceEnded(time=time, source=source) if self._verbosity > 0:
                yield self._row(time, DIM, f"  {source} has ended")

    def _begun(self, begun: Begun) -> str:
        condition = self._reasons.where(begun.span).condition
        why = self._at(begun.span) + (f": {condition}" if condition else "")
        what = f"{self._sign('→', '->')} {self._dynamics.call(begun.action, begun.args)}"
        return self._row(begun.time, CYAN, what, begun.device, self._style.paint(DIM, why))

    def _done(self, done: Done) -> Iterator[str]:
        changes = self._changes(done.before, done.after)
        if done.duration < INSTANT and not changes and not done.results and self._verbosity < 1:
            return
        types = [term.type for term in self._dynamics.theory.actions[done.action].senses]
        answer = f"answered {', '.join(map(show, map(spelt, done.results, types)))}" if done.results else ""
        tick = f"  {self._sign('✓', 'ok')} {done.duration:.2f} s"
        yield self._row(done.time, GREEN, tick, rest="; ".join(part for part in (answer, changes) if part))
        for surprise in done.surprises:
            if surprise.fluent is None:  # a fluent has changed, as the line above says
                text = f"what it senses was thought to be {show(surprise.expected)}"
                yield self._row(None, YELLOW, "", rest=self._style.paint(YELLOW, text))

    def _taken_in(self, event: TakenIn) -> Iterator[str]:
        call = f"{self._in} {self._dynamics.call(event.action, event.args)}"
        yield self._row(event.time, YELLOW, call, event.source, self._changes(event.before, event.after))
        if event.impossible:
            text = "the theory thinks that impossible here; the world is right"
            yield self._row(None, YELLOW, "", rest=self._style.paint(YELLOW, text))

    def _at(self, span: Span) -> str:
        return self._reasons.line(span)

    @property
    def _in(self) -> str:
        return self._sign("←", "<-")

    def _sign(self, fancy: str, plain: str) -> str:
        return self._style.sign(fancy, plain)

    def _changes(self, before: State, after: State) -> str:
        if before == after:
            return ""
        arrow = self._style.sign("→", "->")
        values = self._dynamics.values
        changed = [
            f"{show_call(*name)} {show(old)} {arrow} {show(new)}"
            for (name, old), (_, new) in zip(values(before), values(after), strict=True)
            if old != new
        ]
        return ", ".join(changed)

    def _help(self, error: DeviceError) -> Iterator[str]:
        if error.help:
            yield f"= help: {error.help}"
        if self._verbosity > 0 and error.__cause__ is not None:
            yield from "".join(traceback.format_exception(error.__cause__)).splitlines()

    def _ended(self, ended: Ended) -> Iterator[str]:
        good = ended.end in (End.FINAL, End.IDLE, End.STOPPED)
        if self._verbosity < 0 and good:
            return
        own, events = counted(ended.actions, "action"), counted(ended.exogenous, "exogenous action")
        counts = f"{own} and {events} in {ended.time:.1f} s"
        yield ""
        yield self._row(ended.time, GREEN if good else RED, f"end: {ended.message}")
        yield MARGIN + self._style.paint(DIM, counts)
        yield from (MARGIN + line for line in summary(self._dynamics, ended.state))
        for device, why in ended.unstopped:
            yield MARGIN + self._style.paint(RED, f"the device {device} could not be told to stop: {why}")

    def _row(self, time: float | None, code: str, what: str, who: str = "", rest: str = "") -> str:
        """A line in columns; a long first column runs into the second where that is empty."""
        clock = MARGIN if time is None else self._style.paint(DIM, f"{time:7.2f} s") + "  "
        columns = f"{what:{WHAT}} {who:{WHO}}" if who else f"{what:{WHAT + 1 + WHO}}"
        return f"{clock}{self._style.paint(code, columns if rest else columns.rstrip())}  {rest}".rstrip()
