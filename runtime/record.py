"""What came of a run, as a value, and the observer that makes it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from golc.api.state import State
from golc.api.theory import Theory
from golc.diagnostics import GolcError, counted
from golc.runtime.loop.happenings import Done, End, Ended, Happening, Said, TakenIn
from golc.theory.ground import Call
from golc.theory.order import spelt
from golc.theory.types import Value, show


@dataclass(frozen=True)
class Occurrence:
    """An action that was done, or an exogenous action that was taken in, and the state after it.

    ``time``: seconds since the run began, when it was over. ``sensed``: what it sensed, one value for each term.
    ``source``: who reported it; none for the robot's own. As text it is the action, with what it sensed.
    """

    time: float
    action: Call
    state: State
    sensed: tuple[Value, ...] = ()
    source: str | None = None

    @property
    def exogenous(self) -> bool:
        """Whether it happened by itself."""
        return self.source is not None

    def __str__(self) -> str:
        dynamics = self.state.dynamics
        call = dynamics.call(self.action.action, self.action.args)
        senses = dynamics.theory.actions[self.action.action].senses
        values = [show(spelt(value, term.type)) for value, term in zip(self.sensed, senses, strict=True)]
        return call + (f": {', '.join(values)}" if values else "")


@dataclass(frozen=True)
class Run:
    """What came of a run: why it ended, what happened, and the state that it reached.

    ``end`` is ``End.FINAL`` if the program came to its end, ``message`` says the same in words. ``done`` and
    ``happened``: how many actions the robot did, and how many exogenous actions were taken in. ``history`` has them in
    their order, ``messages`` what the program said: all, or the latest that the run was to remember. ``seconds``:
    simulated time. ``error``: what ended the run, if ``check=False`` kept it from being raised.
    """

    theory: Theory
    program: str
    end: End
    message: str
    state: State
    seconds: float
    done: int
    happened: int
    history: tuple[Occurrence, ...]
    messages: tuple[str, ...]
    error: GolcError | None = None

    @property
    def actions(self) -> tuple[Call, ...]:
        """What the robot did, as far as ``history`` has it."""
        return tuple([entry.action for entry in self.history if not entry.exogenous])

    def summary(self) -> str:
        """What was run and why it ended, in one line."""
        counts = f"{counted(self.done, 'action')} and {counted(self.happened, 'exogenous action')}"
        return f"{self.theory.name}: {self.program}: {self.message}, after {counts} in {self.seconds:.1f} s"

    def __str__(self) -> str:
        lines = [f"{entry.time:7.2f} s  {'← ' if entry.exogenous else ''}{entry}" for entry in self.history]
        return "\n".join([*lines, self.summary(), str(self.state)])

    def _repr_html_(self) -> str:
        from golc.notebook import run_html

        return run_html(self)

    def __repr__(self) -> str:
        return f"<Run of {self.summary()}>"


Listener: TypeAlias = Callable[[Occurrence], object]
"""A function that is told what has happened."""


@dataclass(frozen=True)
class Callbacks:
    """Who is told of each action that was done, that has sensed something, that has happened, and of each message."""

    on_action: Listener | None = None
    on_sensing: Listener | None = None
    on_exogenous: Listener | None = None
    on_message: Callable[[str], object] | None = None


class Record:
    """An observer that keeps what a ``Run`` has, and tells the callbacks; ``most`` bounds what is kept of each kind."""

    def __init__(self, theory: Theory, callbacks: Callbacks, most: int | None = None) -> None:
        self.ended: Ended | None = None
        self._theory = theory
        self._callbacks = callbacks
        self._history: deque[Occurrence] = deque(maxlen=most)
        self._messages: deque[str] = deque(maxlen=most)

    def __call__(self, happening: Happening) -> None:
        callbacks = self._callbacks
        match happening:
            case Done(time=time, action=action, args=args, results=results, after=after):
                entry = Occurrence(time, Call(action, args), self._theory.state(after), results)
                self._add(entry, callbacks.on_action, callbacks.on_sensing if results else None)
            case TakenIn(time=time, action=action, args=args, source=source, after=after):
                entry = Occurrence(time, Call(action, args), self._theory.state(after), source=source)
                self._add(entry, callbacks.on_exogenous)
            case Said(text=text):
                self._messages.append(text)
                if callbacks.on_message is not None:
                    callbacks.on_message(text)
            case Ended():
                self.ended = happening

    def _add(self, entry: Occurrence, *listeners: Listener | None) -> None:
        self._history.append(entry)
        for listener in listeners:
            if listener is not None:
                listener(entry)

    def result(self, program: str, error: GolcError | None = None) -> Run:
        """What came of the run, which is over; ``error`` is what ended it, if anything did."""
        ended = self.ended
        assert ended is not None
        return Run(
            self._theory,
            program,
            ended.end,
            ended.message,
            self._theory.state(ended.state),
            ended.time,
            ended.actions,
            ended.exogenous,
            tuple(self._history),
            tuple(self._messages),
            error,
        )
