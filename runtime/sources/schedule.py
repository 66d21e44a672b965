"""Events files: which exogenous actions happen and when, for a run without people or a brick without a world.

One event a line, ``#`` begins a comment::

    at 3 s: request_delivery(2, 5)
    on start_to_next_station after 2.5 s: arrive_at_station
    on look(2) after 0 s: light_changed
    on signal_arrival once after 1 s: push_go_button
    on 3rd signal_arrival after 0 s: request_delivery(1, 4)

``at`` counts from the start of the run. ``on`` counts from the beginning of each execution of a primitive action (with
these arguments, if some are given), of the first one only (``once``), or of the n-th one only (``3rd``).
"""

from __future__ import annotations

import heapq
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from golc.diagnostics import Code, Findings, Source, Span, UserError
from golc.syntax.text import read_source
from golc.theory.ground import Call, read_exogenous, read_primitive
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Value

_TIME = r"(?P<time>\d{1,12}(?:\.\d+)?|\.\d+)\s*s"
_AT = re.compile(rf"\s*at\s+{_TIME}\s*:(?P<event>.*)")
_ON = re.compile(
    r"\s*on\s+(?:(?P<nth>\d+)(?:st|nd|rd|th)\s+)?(?P<action>[^:]*?)(?P<once>\s+once)?\s+after\s+"
    + _TIME
    + r"\s*:(?P<event>.*)"
)
EMPTY = "write `at 3 s: EVENT` or `on ACTION after 2.5 s: EVENT`, or a comment, `# nothing happens`"
"""What belongs into an events file in which there is nothing."""


@dataclass(frozen=True)
class At:
    """``at 3 s: event``: ``delay`` is in seconds from the start."""

    delay: float
    event: Call
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True)
class On:
    """``on action after 2.5 s: event``: ``args`` None stands for any, ``nth`` None for every execution (from 1)."""

    action: str
    args: tuple[Value, ...] | None
    nth: int | None
    delay: float
    event: Call
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True)
class Schedule:
    """The lines of an events file, in its order."""

    entries: tuple[At | On, ...] = ()

    def only(self, wanted: Callable[[Call], bool]) -> Schedule:
        """The lines whose event is wanted."""
        return Schedule(tuple(entry for entry in self.entries if wanted(entry.event)))


class Player:
    """Plays a schedule; the caller owns the clock and says which actions begin.

    Times are in seconds since the start and never go back.
    """

    def __init__(self, schedule: Schedule) -> None:
        self._reactions = [entry for entry in schedule.entries if isinstance(entry, On)]
        self._seen = [0] * len(self._reactions)
        self._due: list[tuple[float, int, Call]] = []
        self._counter = 0
        for entry in schedule.entries:
            if isinstance(entry, At):
                self._push(entry.delay, entry.event)

    def performed(self, action: str, args: tuple[Value, ...], now: float) -> None:
        """Note that a primitive action begins, which may bring about events."""
        for index, entry in enumerate(self._reactions):
            if entry.action == action and entry.args in (None, args):
                self._seen[index] += 1
                if entry.nth in (None, self._seen[index]):
                    self._push(now + entry.delay, entry.event)

    def due(self, now: float) -> list[Call]:
        """The events that have happened by now and were not told yet, by time, equal times in order of the file."""
        events = []
        while self._due and self._due[0][0] <= now:
            events.append(heapq.heappop(self._due)[2])
        return events

    @property
    def next(self) -> float | None:
        """When the next event that is already certain happens."""
        return self._due[0][0] if self._due else None

    @property
    def pending(self) -> int:
        """How many events are certain and have not happened."""
        return len(self._due)

    def _push(self, time: float, event: Call) -> None:
        heapq.heappush(self._due, (time, self._counter, event))
        self._counter += 1


def read_schedule(path: str | Path, theory: BasicActionTheory) -> Schedule:
    """Read an events file; raises ``UserError`` with a diagnostic for each wrong line."""
    findings = Findings()
    schedule = parse_schedule(read_source(path, EMPTY), theory, findings)
    if findings.has_errors:
        raise UserError(*findings.diagnostics)
    return schedule


def parse_schedule(source: Source, theory: BasicActionTheory, findings: Findings) -> Schedule:
    """The schedule that a text describes; wrong lines are findings and are left out."""
    entries: list[At | On] = []
    for number, start in enumerate(source.line_starts, 1):
        text = source.line(number).partition("#")[0].rstrip()
        if text.strip():
            entry = _entry(Span(source, start, start + len(text)), theory, findings)
            entries.extend([] if entry is None else [entry])
    return Schedule(tuple(entries))


def _entry(line: Span, theory: BasicActionTheory, findings: Findings) -> At | On | None:
    text = line.text
    if match := _AT.fullmatch(text):
        event = _event(match, line, theory, findings)
        return None if event is None else At(float(match["time"]), event, line)
    if match := _ON.fullmatch(text):
        return _reaction(match, line, theory, findings)
    indent = len(text) - len(text.lstrip())
    findings.error(
        Code.EVENTS,
        "this is not a line of an events file",
        Span(line.source, line.start + indent, line.end),
        help="write `at 3 s: EVENT` or `on ACTION after 2.5 s: EVENT`",
    )
    return None


def _reaction(match: re.Match[str], line: Span, theory: BasicActionTheory, findings: Findings) -> On | None:
    read = read_primitive(theory, _part(match, "action", line), findings)
    event = _event(match, line, theory, findings)
    if match["nth"] and len(match["nth"]) > 12:
        findings.error(Code.EVENTS, "nothing happens that often", line)
        return None
    if match["nth"] and (match["once"] or int(match["nth"]) == 0):
        findings.error(Code.EVENTS, "`once` and the count exclude each other, and counts begin with `1st`", line)
        return None
    if read is None or event is None:
        return None
    action, call = read
    nth = 1 if match["once"] else int(match["nth"]) if match["nth"] else None
    return On(action, None if call is None else call.args, nth, float(match["time"]), event, line)


def _event(match: re.Match[str], line: Span, theory: BasicActionTheory, findings: Findings) -> Call | None:
    where = _part(match, "event", line)
    if where.text:
        return read_exogenous(theory, where, findings)
    findings.error(
        Code.EVENTS, "the exogenous action is missing after the colon", Span(line.source, line.end - 1, line.end)
    )
    return None


def _part(match: re.Match[str], group: str, line: Span) -> Span:
    """The place of a group without the spaces around it."""
    text = match[group]
    start = line.start + match.start(group) + len(text) - len(text.lstrip())
    return Span(line.source, start, start + len(text.strip()))
