"""The device ``operator``: a person at the terminal, who does what a prompt says and answers what is sensed."""

from __future__ import annotations

from collections.abc import Callable

from golc.diagnostics import Findings, Source, Span
from golc.runtime.devices.base import Args, Bindings, Device, translated
from golc.runtime.devices.desk import Desk, WrongAnswerError
from golc.theory.ground import describe, read_value
from golc.theory.statements import Message
from golc.theory.theory import BasicActionTheory, Binding, ByPrompt
from golc.theory.types import Type, Value, show_call

Speak = Callable[[Message, Args], str]
"""The text of a message for these arguments, in the state the run is in."""


class Operator(Device):
    """Prompts a person. ``speak`` fills in a message."""

    def __init__(
        self, name: str, bindings: tuple[Binding, ...], theory: BasicActionTheory, desk: Desk, speak: Speak
    ) -> None:
        super().__init__(name)
        self._bindings = Bindings(bindings)
        self._theory = theory
        self._desk = desk
        self._speak = speak

    def handles(self, action: str, args: Args) -> bool:
        return self._bindings.find(action, args) is not None

    def perform(self, action: str, args: Args) -> Args:
        """Show the prompt; done when the operator presses Enter or has given each value that is sensed."""
        binding = self._bindings.find(action, args)
        assert binding is not None
        question = self._question(binding, action, args)
        senses = self._theory.actions[action].senses
        if not senses:
            self._desk.ask(question, _enter)
            return ()
        kinds = [term.type for term in senses]
        answers = [self._value(question, kind, place, kinds, binding) for place, kind in enumerate(kinds)]
        return tuple(answers)

    def interrupt(self) -> None:
        self._desk.interrupt()

    def _question(self, binding: Binding, action: str, args: Args) -> str:
        if isinstance(binding.behaviour, ByPrompt):
            return self._speak(binding.behaviour.message, args)
        senses = self._theory.actions[action].senses
        return f"{show_call(action, args)}: " + ("what is it?" if senses else "please do it, then press Enter")

    def _value(self, question: str, type_: Type, place: int, types: list[Type], binding: Binding) -> Value:
        which = f", answer {place + 1} of {len(types)}" if len(types) > 1 else ""
        text = f"{question} [{describe(type_)}{which}]"

        def read(line: str) -> Value:
            return _read_value(line, type_, self._theory, binding)

        return self._desk.ask(text, read)


def _enter(line: str) -> None:
    if line:
        raise WrongAnswerError("press Enter, with nothing before it, when it is done")


def _read_value(line: str, type_: Type, theory: BasicActionTheory, binding: Binding) -> Value:
    """The value of a type that the operator typed; a binding's table may give numbers another meaning."""
    if line.isdecimal() and (value := translated(binding, int(line))) in type_:
        return value
    findings = Findings()
    source = Source("<stdin>", line)
    read = read_value(theory, type_, Span(source, 0, len(line)), findings) if line else None
    if read is None:
        said = findings.diagnostics[0] if findings.diagnostics else None
        what = (
            f"{said.message}{f': {said.help}' if said.help else ''}" if said else f"type a value of {describe(type_)}"
        )
        raise WrongAnswerError(what)
    return read[0]
