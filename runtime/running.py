"""Running a program from Python: what happens is told to functions, and what came of it is a value."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from golc.api.state import State
from golc.api.theory import Theory
from golc.diagnostics import GolcError, counted
from golc.runtime.loop.happenings import Done, End, Ended, Happening, Observer, Remedy, Said, TakenIn
from golc.runtime.loop.policy import OnImpossible, OnSurprise
from golc.runtime.session import SIMULATED, Settings, Voice, run_online
from golc.theory.ground import Call, read_procedure
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

    ``end`` is ``End.FINAL`` if the program came to its end, ``message`` says the same in words. ``history`` has every
    action and exogenous action in their order; ``messages`` what the program said. ``seconds``: simulated time.
    ``error``: what ended the run, if ``check=False`` kept it from being raised.
    """

    theory: Theory
    program: str
    end: End
    message: str
    state: State
    seconds: float
    history: tuple[Occurrence, ...]
    messages: tuple[str, ...]
    error: GolcError | None = None

    @property
    def actions(self) -> tuple[Call, ...]:
        """What the robot did."""
        return tuple([entry.action for entry in self.history if not entry.exogenous])

    def summary(self) -> str:
        """What was run and why it ended, in one line."""
        own = len(self.actions)
        counts = f"{counted(own, 'action')} and {counted(len(self.history) - own, 'exogenous action')}"
        return f"{self.theory.name}: {self.program}: {self.message}, after {counts} in {self.seconds:.1f} s"

    def __str__(self) -> str:
        lines = [f"{entry.time:7.2f} s  {'← ' if entry.exogenous else ''}{entry}" for entry in self.history]
        return "\n".join([*lines, self.summary(), str(self.state)])

    def _repr_html_(self) -> str:
        from golc.notebook import run_html

        return run_html(self)

    def __repr__(self) -> str:
        return f"<Run of {self.summary()}>"


SLOWEST, FASTEST = 0.01, 1000.0
"""How many simulated seconds may pass in a real one."""

Listener: TypeAlias = Callable[[Occurrence], object]
"""A function that is told what has happened."""


def run(
    theory: Theory,
    program: str = "control",
    port: str | None = None,
    *,
    on_action: Listener | None = None,
    on_sensing: Listener | None = None,
    on_exogenous: Listener | None = None,
    on_message: Callable[[str], object] | None = None,
    observers: Iterable[Observer] = (),
    voice: Voice | None = None,
    check: bool = True,
    events: str | Path | Sequence[str] | None = None,
    listen: tuple[str, int] | None = None,
    journal: str | Path | None = None,
    stop_when_idle: float | None = None,
    on_impossible: Literal["apply", "drop", "stop"] = "apply",
    on_surprise: Literal["apply", "stop"] = "apply",
    on_failure: Literal["ask", "retry", "next", "stop"] = "stop",
    check_invariants: bool = False,
    step: bool = False,
    speed: float = 1.0,
    seed: int = 0,
    world: str | Path | None = None,
    picture: str | Path | None = None,
) -> Run:
    """Run a program online with the devices of its theory until it ends; they are told to stop however it does.

    ``program``: a procedure with its arguments, as ``"serve(3)"``. ``port``: a tty, a pty, a pySerial URL or
    ``usb:PATH``; without one golc simulates the brick, in ``world`` (a file, ``"none"``, or by default the one beside
    the domain) or by the theory alone, ``speed`` seconds in a real one, with ``seed`` for what is left to chance.

    Told are ``on_action`` of every action that was done, ``on_sensing`` of those that have sensed something,
    ``on_exogenous`` of every exogenous action, ``on_message`` of the text of each ``say``, and ``observers`` of
    everything, as values of ``golc.runtime.loop.happenings``; whatever they raise ends the run. ``voice`` speaks to a
    person: ``Voice(print)`` shows the trace of ``golc run``, ``Voice(print, ask=input)`` lets them answer, too.

    ``events``: the path of an events file, or its lines. ``listen``: host and port where exogenous actions are taken
    over TCP. ``journal``: a new file for everything that happens. ``stop_when_idle``: end with success after waiting
    for so many seconds. ``picture``: a file for a drawing of the world in the end. The others are the options of
    ``golc run``. Durations are in simulated seconds.

    Raises ``UserError`` before anything happens if the theory, its devices or the events are wrong, ``ValueError`` for
    settings that make no sense, ``FileExistsError`` for a journal that is there already; ``ProgramError`` if the
    program fails and ``DeviceError`` if the world does, which are in the result instead if ``check`` is false.

    >>> import golc
    >>> sorter = golc.load("examples/sorter/sorter.gl")
    >>> done = golc.run(sorter, "sort_one", world="none", speed=1000)
    >>> [str(action) for action in done.actions][:2]
    ['feed', 'look']
    """
    if not SLOWEST <= speed <= FASTEST:
        raise ValueError(f"the speed is {speed:g}, and has to be from {SLOWEST:g} to {FASTEST:g}")
    if port not in (None, SIMULATED) and (world is not None or picture is not None):
        raise ValueError("a world and a picture are for a simulated brick, not for one at a port")
    call = read_procedure(theory.elaborated, program)
    settings = Settings(
        port=port,
        events=events,
        listen=listen,
        journal=None if journal is None else Path(journal),
        stop_when_idle=stop_when_idle,
        on_impossible=OnImpossible(on_impossible),
        on_surprise=OnSurprise(on_surprise),
        on_failure=None if on_failure == "ask" else Remedy(on_failure),
        check_invariants=check_invariants,
        step=step,
        speed=speed,
        seed=seed,
        world=None if world is None else str(world),
        picture=None if picture is None else Path(picture),
    )
    record = _Record(theory, on_action, on_sensing, on_exogenous, on_message)
    error = None
    try:
        run_online(theory.elaborated, call, settings, voice or Voice(), [*observers, record])
    except GolcError as raised:
        if check or record.ended is None:
            raise
        error = raised
    assert record.ended is not None
    ended = record.ended
    return Run(
        theory,
        program,
        ended.end,
        ended.message,
        theory.state(ended.state),
        ended.time,
        tuple(record.history),
        tuple(record.messages),
        error,
    )


class _Record:
    """An observer that keeps what a ``Run`` has, and tells the callbacks."""

    def __init__(
        self,
        theory: Theory,
        on_action: Listener | None,
        on_sensing: Listener | None,
        on_exogenous: Listener | None,
        on_message: Callable[[str], object] | None,
    ) -> None:
        self.history: list[Occurrence] = []
        self.messages: list[str] = []
        self.ended: Ended | None = None
        self._theory = theory
        self._on_action, self._on_sensing, self._on_exogenous = on_action, on_sensing, on_exogenous
        self._on_message = on_message

    def __call__(self, happening: Happening) -> None:
        match happening:
            case Done(time=time, action=action, args=args, results=results, after=after):
                entry = Occurrence(time, Call(action, args), self._theory.state(after), results)
                self._add(entry, self._on_action, self._on_sensing if results else None)
            case TakenIn(time=time, action=action, args=args, source=source, after=after):
                entry = Occurrence(time, Call(action, args), self._theory.state(after), source=source)
                self._add(entry, self._on_exogenous)
            case Said(text=text):
                self.messages.append(text)
                if self._on_message is not None:
                    self._on_message(text)
            case Ended():
                self.ended = happening

    def _add(self, entry: Occurrence, *listeners: Listener | None) -> None:
        self.history.append(entry)
        for listener in listeners:
            if listener is not None:
                listener(entry)
