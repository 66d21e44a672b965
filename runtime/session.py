"""Puts an online run together: the devices, the sources, the operator, the trace and the journal."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack, closing
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from golc.diagnostics import Code, DeviceError, Diagnostic, Findings, Source, Span, UserError
from golc.planning.planner import executable
from golc.runtime.clock import Clock
from golc.runtime.devices.base import Args, Device, Router
from golc.runtime.devices.bricks import Link
from golc.runtime.devices.build import Surroundings, brick_maps, build_devices
from golc.runtime.devices.desk import Desk
from golc.runtime.loop.asking import ALL, REMEDIES, AskAboutFailure, AskBeforeActions, always
from golc.runtime.loop.executive import Executive, Outcome
from golc.runtime.loop.happenings import Observer, Remedy
from golc.runtime.loop.inbox import Inbox
from golc.runtime.loop.inbox import Source as EventSource
from golc.runtime.loop.policy import OnImpossible, OnSurprise, Policy
from golc.runtime.observers.journal import Journal
from golc.runtime.observers.trace import BOLD, DIM, MARGIN, RED, Style, Trace
from golc.runtime.observers.whereabouts import Whereabouts
from golc.runtime.signals import ending_on_signals
from golc.runtime.sources.exogenous import COMMANDS, DEEDS, Hands, Terminal, Timetable, from_operator
from golc.runtime.sources.listener import Listener
from golc.runtime.sources.polling import Poller
from golc.runtime.sources.schedule import Schedule, parse_schedule, read_schedule
from golc.situation.summary import summary
from golc.theory.ground import Call, one_of, read_value
from golc.theory.order import arranged
from golc.theory.statements import Message
from golc.theory.theory import BasicActionTheory
from golc.theory.types import show

if TYPE_CHECKING:
    from golc.runtime.rcxsim.inprocess import InProcess
    from golc.runtime.standin import Place, RobotInWorld

SIMULATED = "sim"
"""The port that stands for a simulated brick."""
DOUBLE_HELP = "what happens to the robot is told by the brick: leave the line out"


@dataclass(frozen=True)
class Settings:
    """How a run is to be; see ``golc.run``. Durations are in simulated seconds."""

    port: str | None = None
    events: str | Path | Sequence[str] | None = None
    """The path of an events file, or its lines."""
    listen: tuple[str, int] | None = None
    journal: Path | None = None
    stop_when_idle: float | None = None
    on_impossible: OnImpossible = OnImpossible.APPLY
    on_surprise: OnSurprise = OnSurprise.APPLY
    on_failure: Remedy | None = None
    """None: ask the operator."""
    check_invariants: bool = False
    step: bool = False
    speed: float = 1.0
    seed: int = 0
    world: str | None = None
    """The file of the world in which a simulated brick is, ``none``, or None for the one beside the domain."""
    picture: Path | None = None


def _nowhere(line: str) -> None:
    """Nobody is to be told."""


def _unheard(diagnostics: tuple[Diagnostic, ...]) -> None:
    """Nobody is to be told."""


@dataclass(frozen=True)
class Voice:
    """How a run speaks to a person, and listens to one; by default to nobody.

    ``write`` gets each line of the trace, ``complain`` the diagnostics of a refused line. ``verbosity`` is -1 (messages
    and trouble only), 0, or 1. ``ask`` gets each question to the operator and returns the answer, as ``input`` does;
    with ``stdin`` the operator sits at standard input instead, and may report exogenous actions there.
    """

    write: Callable[[str], object] = _nowhere
    complain: Callable[[tuple[Diagnostic, ...]], object] = _unheard
    style: Style = field(default=Style(color=False, unicode=True), repr=False)
    verbosity: int = 0
    ask: Callable[[str], str] | None = None
    stdin: bool = False


def run_online(
    theory: BasicActionTheory, program: Call, settings: Settings, voice: Voice, observers: Iterable[Observer] = ()
) -> Outcome:
    """Run a procedure of a theory online until it ends, however it ends; the signals that end a process end it too.

    Raises ``UserError`` before anything happens if the theory, its devices or the events file are wrong; afterwards
    what ``Executive.run`` raises; ``FileExistsError`` for a journal that is there already.
    """
    with ExitStack() as stack:
        stack.enter_context(ending_on_signals())
        return _Session(theory, program, settings, voice, stack).run(observers)


class _Session:
    """One run: what is put together for it, and what its parts need of one another."""

    def __init__(
        self, theory: BasicActionTheory, program: Call, settings: Settings, voice: Voice, stack: ExitStack
    ) -> None:
        self.theory = theory
        self.program = program
        self.settings = settings
        self.voice = voice
        self.stack = stack
        self.inbox = Inbox()
        self.maps = brick_maps(theory)
        self.robot: RobotInWorld | None = None
        self.line: InProcess | None = None
        self.executable = executable(theory, program.action, program.args)
        self.dynamics = self.executable.dynamics
        self.stdin = _descriptor() if voice.stdin else None
        self.interactive = self.stdin is not None and os.isatty(self.stdin)
        answers = self.stdin is not None or voice.ask is not None
        self.desk = Desk(self.ask, self.interactive, answers, self.plausible)

    def run(self, watching: Iterable[Observer]) -> Outcome:
        schedule = self.schedule or Schedule()
        observers = [*self.observers(), *watching]
        devices = build_devices(self.theory, Surroundings(self.desk, self.speak, self.link()))
        self.warn_of_doubles(schedule)
        clock = self.clock()
        timetable = Timetable(schedule.only(self.is_ours), self.inbox, clock)
        sources = [*self.sources(devices, clock), timetable]
        policy = self.policy(clock)
        self.executive = Executive(self.executable, Router(devices, self.theory), self.inbox, sources, policy, clock)
        self.executive.observers += [timetable.observe, *observers]
        if self.robot is not None:
            self.executive.observers.append(Whereabouts(self.robot.whereabouts, self.say))
        self.greet()
        outcome = self.executive.run()
        if pending := timetable.pending:
            self.say(f"the schedule still had {pending} event{'' if pending == 1 else 's'} to come")
        return outcome

    # What is put together

    def observers(self) -> list[Observer]:
        """The journal first: what is told has been written."""
        voice, journal = self.voice, self.settings.journal
        trace = Trace(self.dynamics, voice.style, voice.verbosity, voice.write, voice.complain)
        if journal is None:
            return [trace]
        opened = Journal(journal, self.dynamics, self.program.action, self.program.args)
        return [self.stack.enter_context(closing(opened)), trace]

    @cached_property
    def schedule(self) -> Schedule | None:
        """What is to happen, if somebody has said it; raises ``UserError`` for wrong lines."""
        events = self.settings.events
        if events is None:
            return None
        if isinstance(events, str | Path):
            return read_schedule(events, self.theory)
        findings = Findings()
        schedule = parse_schedule(Source("<events>", "\n".join(events)), self.theory, findings)
        if findings.has_errors:
            raise UserError(*findings.diagnostics)
        return schedule

    def link(self) -> Link | None:
        """The way to the bricks, if the domain has any: to simulated ones where no port is given."""
        settings = self.settings
        if self.place.world is None and settings.picture is not None:
            raise DeviceError("there is no world of which a picture could be drawn", help="name one with --world")
        if not self.maps:
            return None
        if not self.simulated:
            return Link(settings.port or "", settings.speed)
        if self.place.world is not None:
            return self.link_to_robot(self.place.world)
        from golc.runtime.standin import bricks_of_theory

        self.line = line = bricks_of_theory(self.theory, self.schedule, settings.speed, settings.seed)
        return Link(line.name, settings.speed, line)

    def link_to_robot(self, world: Path) -> Link:
        """The way to a brick that is simulated in a world."""
        from golc.runtime.rcxsim.trace import Trace as BrickTrace
        from golc.runtime.standin import RobotInWorld

        [actions] = self.maps.values()
        settings, trace = self.settings, BrickTrace(self.tell_fault)
        self.robot = robot = RobotInWorld(self.theory, actions, world, settings.speed, settings.seed, trace)
        if settings.picture is not None:
            self.stack.enter_context(robot.drawn(settings.picture))
        self.line = robot.transport
        return Link(str(world), settings.speed, robot.transport)

    def clock(self) -> Clock:
        """The time of the run, which is that of a brick that is simulated here: a slow computer makes both slow."""
        line, speed = self.line, self.settings.speed
        if line is None:
            return Clock(time.monotonic, time.monotonic(), speed)
        return Clock(lambda: line.now() / speed, line.now() / speed, speed)

    @cached_property
    def place(self) -> Place:
        """Where the brick is simulated, if it is."""
        from golc.runtime.standin import Place, place

        if not self.simulated and self.maps:
            return Place(None)
        return place(self.theory, self.maps, self.settings.world, self.settings.events is not None)

    @property
    def simulated(self) -> bool:
        """Whether golc itself simulates the bricks."""
        return bool(self.maps) and self.settings.port in (None, SIMULATED)

    def is_ours(self, event: Call) -> bool:
        """Whether a line of the events file is reported from here, and not by the simulated brick."""
        if self.place.world is not None:
            return True
        return not (self.simulated and any(actions.handles(event.action, event.args) for actions in self.maps.values()))

    def warn_of_doubles(self, schedule: Schedule) -> None:
        """Say of the lines of the events file that are played here that the brick reports the same."""
        findings, told = Findings(), set[str]()
        for entry in schedule.only(self.is_ours).entries:
            name = entry.event.action
            bricks = [brick for brick, actions in self.maps.items() if actions.handles(name, entry.event.args)]
            if bricks and name not in told:
                told.add(name)
                message = f"`{name}` is reported by the script, and by the brick `{bricks[0]}` as well"
                findings.warning(Code.EVENT_OF_BRICK, message, entry.span, help=DOUBLE_HELP)
        self.voice.complain(tuple(findings.diagnostics))

    def sources(self, devices: Sequence[Device], clock: Clock) -> list[EventSource]:
        """Everything that may report exogenous actions, but the schedule."""
        found: list[EventSource] = []
        polled = [device for device in devices if device.poll_interval is not None]
        if polled:
            reported = {entry.action for actions in self.maps.values() for entry in actions.entries if entry.exogenous}
            found.append(Poller(polled, frozenset(reported), self.inbox, clock))
        if self.stdin is not None:
            found.append(Terminal(self.theory, self.inbox, self.desk, self.reply, self.stdin, self.hands))
        if self.settings.listen is not None:
            listener = Listener(self.theory, self.inbox, *self.settings.listen)
            self.say("listening on {}:{}".format(*listener.address))
            found.append(listener)
        return found

    @property
    def hands(self) -> Hands | None:
        """Those of the operator at the robot, if there is a world in which it is."""
        robot = self.robot
        if robot is None:
            return None

        def act(text: str, where: Span, findings: Findings) -> None:
            if told := robot.act(text, where, findings):
                self.say(f"you: {told}")

        return act

    def policy(self, clock: Clock) -> Policy:
        settings = self.settings
        return Policy(
            on_impossible=settings.on_impossible,
            on_surprise=settings.on_surprise,
            on_failure=AskAboutFailure(self.desk, self.show)
            if settings.on_failure is None
            else always(settings.on_failure),
            retry_after=clock.real(1.0),
            stop_when_idle=settings.stop_when_idle,
            check_invariants=settings.check_invariants,
            confirm=AskBeforeActions(self.desk) if settings.step else None,
            interrupt=self.desk.interrupt,
        )

    # What is said, and to whom

    def greet(self) -> None:
        """Say what is run, where, and what the operator can do."""
        where = f"on {self.settings.port}" if self.settings.port and not self.simulated else ""
        if self.simulated:
            speed = "" if self.settings.speed == 1 else f", {self.settings.speed:g} times as fast as a real one"
            world = self.place.world
            where = "on a simulated brick" + (f" in {world}" if world else "") + speed
            where += "" if self.settings.port else " (no --port was given)"
        if self.voice.verbosity >= 0:
            title = self.voice.style.paint(BOLD, f"{self.theory.name}: {self.program}")
            self.voice.write(f"{MARGIN}{title} {where}".rstrip())
        if self.place.hint:
            self.say(self.place.hint)
        if self.interactive:
            event = one_of([action for action in self.theory.actions.values() if from_operator(self.theory, action)])
            reports = "" if event is None else f"an exogenous action such as {event}, or "
            names = [*COMMANDS, *([] if self.robot is None else DEEDS)]
            self.say(f"type {reports}one of " + ", ".join(f"!{name}" for name in names))

    def say(self, text: str) -> None:
        """Something good to know."""
        if self.voice.verbosity >= 0:
            self.voice.write(self.voice.style.paint(DIM, f"{MARGIN}{text}"))

    def tell_fault(self, record: Mapping[str, object]) -> None:
        """A simulated brick says what it does; what matters here is that its program has failed."""
        if record["what"] == "fault":
            text = "the brick has stopped its program: {task}, address {address}: {problem}".format(**record)
            self.voice.write(self.voice.style.paint(RED, f"{MARGIN}{text}"))

    def ask(self, question: str) -> None:
        """Show a question, or a word about a wrong answer, to whoever answers it."""
        if self.voice.ask is not None:
            self.desk.offer(self.voice.ask(question), report=False)
            return
        self.voice.write(self.voice.style.paint(BOLD, f"{MARGIN}? {question}"))

    def speak(self, message: Message, args: Args) -> str:
        """The text of a message now."""
        state, evaluate = self.executive.state, self.dynamics.knowing.evaluate
        texts = []
        for part in message.parts:
            text = part if isinstance(part, str) else show(arranged(evaluate(part, state, args), part.type))
            texts.append(text)
        return "".join(texts)

    def show(self, what: str) -> str:
        """The state or the history as text."""
        lines = summary(self.dynamics, self.executive.state) if what == "state" else self.executive.told()
        return f"\n{MARGIN}".join(lines) or "nothing has happened yet"

    def reply(self, result: object) -> None:
        """The answer to a command that was typed."""
        if result is not None:
            self.voice.write(MARGIN + self.show("state" if isinstance(result, Mapping) else "history"))

    def plausible(self, line: str) -> bool:
        """Whether a line that was sent ahead could be the answer to a question."""
        word = line.strip()
        asked = [device for device in self.theory.devices if device.kind == "operator"]
        if self.settings.on_failure is None and word.lower() in REMEDIES:
            return True
        if not word or (self.settings.step and word == ALL):
            return bool(asked) or self.settings.step
        senses = [term.type for action in self.theory.actions.values() for term in action.senses] if asked else []
        source = Source("<stdin>", word)
        return any(read_value(self.theory, type_, Span(source, 0, len(word)), Findings()) for type_ in senses)


def _descriptor() -> int | None:
    """Standard input, if there is one."""
    try:
        return sys.stdin.fileno()
    except (AttributeError, OSError, ValueError):
        return None
