"""Puts an online run together: the devices, the sources, the operator, the trace and the journal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import ExitStack, closing
from pathlib import Path

from golc.diagnostics import Findings, Source, Span, UserError, counted
from golc.planning.planner import Executable, executable
from golc.runtime.clock import Clock
from golc.runtime.connection import Connection
from golc.runtime.conversation import Conversation, Voice
from golc.runtime.devices.base import Device, Router
from golc.runtime.devices.build import Surroundings, build_devices
from golc.runtime.loop.asking import AskAboutFailure, AskBeforeActions, always
from golc.runtime.loop.executive import Executive, Outcome
from golc.runtime.loop.happenings import Observer, Remedy
from golc.runtime.loop.inbox import Inbox
from golc.runtime.loop.inbox import Source as EventSource
from golc.runtime.loop.policy import OnImpossible, OnSurprise, Policy
from golc.runtime.observers.journal import Journal
from golc.runtime.observers.trace import Trace
from golc.runtime.observers.whereabouts import Whereabouts
from golc.runtime.settings import Settings
from golc.runtime.signals import ending_on_signals
from golc.runtime.sources.exogenous import DEEDS, Hands, Terminal, Timetable
from golc.runtime.sources.listener import Listener
from golc.runtime.sources.polling import Poller
from golc.runtime.sources.schedule import Schedule, parse_schedule, read_schedule
from golc.theory.ground import Call
from golc.theory.theory import BasicActionTheory


def run_online(
    theory: BasicActionTheory, program: Call, settings: Settings, voice: Voice, watching: Iterable[Observer] = ()
) -> Outcome:
    """Run a procedure of a theory online until it ends, however it ends; the signals that end a process end it too.

    Raises ``UserError`` before anything happens if the theory, its devices or the events file are wrong; afterwards
    what ``Executive.run`` raises; ``FileExistsError`` for a journal that is there already.
    """
    with ExitStack() as stack:
        stack.enter_context(ending_on_signals())
        return _Session(theory, program, settings, voice).run(watching, stack)


class _Session:
    """One run: what is put together for it."""

    def __init__(self, theory: BasicActionTheory, program: Call, settings: Settings, voice: Voice) -> None:
        self.theory = theory
        self.program = program
        self.settings = settings
        self.voice = voice
        self.inbox = Inbox()
        self.connection = Connection(theory, settings)
        self.conversation = Conversation(theory, settings, voice)

    def run(self, watching: Iterable[Observer], stack: ExitStack) -> Outcome:
        """Put everything together and run it; ``stack`` gets what is to be closed afterwards."""
        ready = executable(self.theory, self.program.action, self.program.args)
        connection, conversation = self.connection, self.conversation
        scripted = _schedule(self.settings.events, self.theory)
        schedule = scripted or Schedule()
        observers = [*self.observers(ready, stack), *watching]
        link = connection.link(scripted, conversation.warn, stack)
        devices = build_devices(self.theory, Surroundings(conversation.desk, conversation.fill_in, link))
        if doubles := tuple(connection.doubles(schedule)):
            self.voice.complain(doubles)
        clock = connection.clock()
        timetable = Timetable(schedule.only(connection.is_ours), self.inbox, clock)
        sources = [*self.sources(devices, clock), timetable]
        executive = Executive(ready, Router(devices, self.theory), self.inbox, sources, self.policy(clock), clock)
        executive.observers += [timetable.observe, *observers]
        if connection.robot is not None:
            executive.observers.append(Whereabouts(connection.robot.whereabouts, conversation.say))
        self.greet(executive)
        outcome = executive.run()
        if pending := timetable.pending:
            conversation.say(f"the schedule still had {counted(pending, 'event')} to come")
        return outcome

    def observers(self, ready: Executable, stack: ExitStack) -> list[Observer]:
        """The journal first: what is told has been written."""
        voice, journal, dynamics = self.voice, self.settings.journal, ready.dynamics
        trace = Trace(dynamics, voice.style, voice.verbosity, voice.write, voice.complain)
        if journal is None:
            return [trace]
        opened = Journal(Path(journal), dynamics, self.program.action, self.program.args)
        return [stack.enter_context(closing(opened)), trace]

    def sources(self, devices: Sequence[Device], clock: Clock) -> list[EventSource]:
        """Everything that may report exogenous actions, but the schedule."""
        found: list[EventSource] = []
        conversation, maps = self.conversation, self.connection.maps
        polled = [device for device in devices if device.poll_interval is not None]
        if polled:
            reported = {entry.action for actions in maps.values() for entry in actions.entries if entry.exogenous}
            found.append(Poller(polled, frozenset(reported), self.inbox, clock))
        if (stdin := conversation.stdin) is not None:
            desk, reply = conversation.desk, conversation.reply
            found.append(Terminal(self.theory, self.inbox, desk, reply, stdin, self.hands()))
        if self.settings.listen is not None:
            listener = Listener(self.theory, self.inbox, *self.settings.listen)
            conversation.say("listening on {}:{}".format(*listener.address))
            found.append(listener)
        return found

    def hands(self) -> Hands | None:
        """Those of the operator at the robot, if there is a world in which it is."""
        robot = self.connection.robot
        if robot is None:
            return None

        def act(text: str, where: Span, findings: Findings) -> None:
            if told := robot.act(text, where, findings):
                self.conversation.say(f"you: {told}")

        return act

    def policy(self, clock: Clock) -> Policy:
        """What is decided beforehand, and who is asked about the rest."""
        settings, conversation = self.settings, self.conversation
        ask = AskAboutFailure(conversation.desk, conversation.show)
        return Policy(
            on_impossible=OnImpossible(settings.on_impossible),
            on_surprise=OnSurprise(settings.on_surprise),
            on_failure=ask if settings.on_failure == "ask" else always(Remedy(settings.on_failure)),
            retry_after=clock.real(1.0),
            stop_when_idle=settings.stop_when_idle,
            check_invariants=settings.check_invariants,
            confirm=AskBeforeActions(conversation.desk) if settings.step else None,
            interrupt=conversation.desk.interrupt,
        )

    def greet(self, executive: Executive) -> None:
        """Say what is run, where, and what the operator can do."""
        deeds = () if self.connection.robot is None else DEEDS
        title = f"{self.theory.name}: {self.program}"
        self.conversation.begin(executive, title, self.connection.described, self.connection.place.hint, deeds)


def _schedule(events: str | Path | Sequence[str] | None, theory: BasicActionTheory) -> Schedule | None:
    """What is to happen, if somebody has said it; raises ``UserError`` for wrong lines."""
    if events is None:
        return None
    if isinstance(events, str | Path):
        return read_schedule(events, theory)
    findings = Findings()
    schedule = parse_schedule(Source("<events>", "\n".join(events)), theory, findings)
    if findings.has_errors:
        raise UserError(*findings.diagnostics)
    return schedule
