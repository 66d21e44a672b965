"""What a run says to a person, and what it asks them."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from golc.diagnostics import Diagnostic, Findings, Source, Span
from golc.runtime.devices.base import Args
from golc.runtime.devices.desk import Desk
from golc.runtime.loop.asking import ALL, REMEDIES
from golc.runtime.loop.intake import Intake
from golc.runtime.observers.trace import BOLD, DIM, MARGIN, RED, Style
from golc.runtime.settings import Settings
from golc.runtime.sources.exogenous import COMMANDS, from_operator, standard_input
from golc.situation.summary import summary
from golc.theory.ground import one_of, read_value
from golc.theory.order import arranged
from golc.theory.statements import Message
from golc.theory.theory import BasicActionTheory
from golc.theory.types import show


def _unheard(said: object) -> None:
    """Nobody is there."""


@dataclass(frozen=True)
class Voice:
    """How a run speaks to a person, and listens to one; by default to nobody.

    ``write`` gets each line of the trace, ``complain`` the diagnostics of a line that was refused or is doubtful.
    ``verbosity`` is -1 (messages and trouble only), 0, or 1. ``ask`` gets each question to the operator and returns the
    answer, as ``input`` does; with ``stdin`` the operator sits at standard input instead, and may report exogenous
    actions there.
    """

    write: Callable[[str], object] = _unheard
    complain: Callable[[tuple[Diagnostic, ...]], object] = _unheard
    style: Style = field(default=Style(color=False, unicode=True), repr=False)
    verbosity: int = 0
    ask: Callable[[str], str] | None = None
    stdin: bool = False


class Conversation:
    """Words for the person behind a voice, and the desk at which they answer.

    ``stdin``: the descriptor at which they sit, if they do; ``interactive``: whether it is a terminal. What is said
    about the situation of the run needs ``begin`` first.
    """

    def __init__(self, theory: BasicActionTheory, settings: Settings, voice: Voice) -> None:
        self.stdin = standard_input() if voice.stdin else None
        self.interactive = self.stdin is not None and os.isatty(self.stdin)
        answered = self.stdin is not None or voice.ask is not None
        self.desk = Desk(self._ask, self.interactive, answered, lambda line: plausible(line.strip(), theory, settings))
        self._theory = theory
        self._voice = voice
        self._intake: Intake | None = None

    def begin(self, intake: Intake, title: str, where: str, hint: str, deeds: Sequence[str]) -> None:
        """Say what is run and where, and what the operator can do, ``deeds`` at a simulated robot among it."""
        self._intake = intake
        if self._voice.verbosity >= 0:
            self._voice.write(f"{MARGIN}{self._voice.style.paint(BOLD, title)} {where}".rstrip())
        if hint:
            self.say(hint)
        if self.interactive:
            mine = [action for action in self._theory.actions.values() if from_operator(self._theory, action)]
            event = one_of(mine)
            reports = "" if event is None else f"an exogenous action such as {event}, or "
            self.say(f"type {reports}one of " + ", ".join(f"!{name}" for name in (*COMMANDS, *deeds)))

    def say(self, text: str) -> None:
        """Something good to know."""
        if self._voice.verbosity >= 0:
            self._voice.write(self._voice.style.paint(DIM, f"{MARGIN}{text}"))

    def warn(self, text: str) -> None:
        """Something that is wrong, however little is to be said."""
        self._voice.write(self._voice.style.paint(RED, f"{MARGIN}{text}"))

    def _ask(self, question: str) -> None:
        """Show a question, or a word about a wrong answer, to whoever answers it."""
        if self._voice.ask is not None:
            self.desk.offer(self._voice.ask(question), report=False)
            return
        self._voice.write(self._voice.style.paint(BOLD, f"{MARGIN}? {question}"))

    def fill_in(self, message: Message, args: Args) -> str:
        """The text of a message now."""
        intake = self._begun()
        state, evaluate = intake.state, intake.dynamics.knowing.evaluate
        texts = []
        for part in message.parts:
            text = part if isinstance(part, str) else show(arranged(evaluate(part, state, args), part.type))
            texts.append(text)
        return "".join(texts)

    def show(self, what: str) -> str:
        """The ``state`` or the ``history`` as text."""
        intake = self._begun()
        lines = summary(intake.dynamics, intake.state) if what == "state" else intake.told()
        return f"\n{MARGIN}".join(lines) or "nothing has happened yet"

    def reply(self, result: object) -> None:
        """The answer to a command that was typed."""
        if result is not None:
            self._voice.write(MARGIN + self.show("state" if isinstance(result, Mapping) else "history"))

    def _begun(self) -> Intake:
        assert self._intake is not None, "the run has not begun"
        return self._intake


def plausible(word: str, theory: BasicActionTheory, settings: Settings) -> bool:
    """Whether a word that was sent ahead could be the answer to a question of a run; the empty one is Enter."""
    asked = any(device.kind == "operator" for device in theory.devices)
    if settings.on_failure == "ask" and word.lower() in REMEDIES:
        return True
    if not word or (settings.step and word == ALL):
        return asked or settings.step
    senses = [term.type for action in theory.actions.values() for term in action.senses] if asked else []
    where = Span(Source("<stdin>", word), 0, len(word))
    return any(read_value(theory, type_, where, Findings()) for type_ in senses)
