"""Invariants while a program runs: which are false in a state, and what is said of the step that led there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from golc.diagnostics import Code, Diagnostic, Label, ProgramError, Span
from golc.program.blame import false_parts
from golc.situation.dynamics import Dynamics
from golc.situation.worlds import State
from golc.theory.recursion import deep_recursion
from golc.theory.theory import Definition
from golc.theory.types import show


class Invariants:
    """The invariants of a theory, compiled."""

    def __init__(self, dynamics: Dynamics) -> None:
        self._dynamics = dynamics
        self._compiled: list[tuple[Definition, Callable[..., Any]]] = []
        with deep_recursion():
            for name in dynamics.theory.invariants:
                invariant = dynamics.theory.definitions[name]
                self._compiled.append((invariant, dynamics.knowing.condition(invariant.body, 0)))

    def check(self, state: State, step: str | None, span: Span) -> None:
        """Raise ``ProgramError`` if an invariant is false in the state to which ``step``, from ``span``, has led.

        Without a step it is the initial state.
        """
        for invariant, holds in self._compiled:
            if not holds(state, ()):
                raise self._broken(invariant, state, step, span)

    def _broken(self, invariant: Definition, state: State, step: str | None, span: Span) -> ProgramError:
        labels = []
        for part in false_parts(self._dynamics, state, invariant.body):
            values = ", ".join(f"{name} = {show(value)}" for name, value in part.values)
            labels.append(Label(part.span, f"false: {values}" if values else "false"))
        shown = ", ".join(f"{name} = {show(value)}" for name, value in self._dynamics.show(state).items())
        return ProgramError(
            Diagnostic(
                Code.INVARIANT_BROKEN,
                f"invariant `{invariant.name}` is false " + (f"after `{step}`" if step else "in the initial state"),
                span,
                marker="breaks it" if step else "",
                labels=tuple(labels),
                notes=(f"the state: {shown}",),
            )
        )
