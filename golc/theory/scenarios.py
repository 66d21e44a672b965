"""Scenarios, resolved and typed: executable tests of a program."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from golc.diagnostics import NOWHERE, Span
from golc.theory.terms import Term
from golc.theory.types import Value, show_call


@dataclass(frozen=True)
class Base:
    """The base of the lines of a scenario."""

    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


@dataclass(frozen=True)
class GroundCall(Base):
    """An action or a procedure with the values of its arguments."""

    name: str
    args: tuple[Value, ...]

    def __str__(self) -> str:
        return show_call(self.name, self.args)


@dataclass(frozen=True)
class Assignment(Base):
    """``given f(args) = value`` of a fluent with one initial value: it has this one, whatever its declaration says."""

    fluent: str
    args: tuple[Value, ...]
    value: Value


@dataclass(frozen=True)
class Assumption(Base):
    """Any other ``given φ``: the real world is one of the possible ones in which φ holds; without any the scenario
    fails."""

    condition: Term


Given: TypeAlias = Assignment | Assumption


@dataclass(frozen=True)
class Events(Base):
    """Exogenous actions that happen one after the other, without anything between them.

    ``trigger`` is the number of primitive actions after which they do, or the formula that has to hold when the program
    can only wait; none: the first time that it can only wait.
    """

    events: tuple[GroundCall, ...]
    trigger: int | Term | None


@dataclass(frozen=True)
class ExpectCount(Base):
    """How often an action is done, or an exogenous action happens; no ``args``: all its instances together."""

    action: str
    args: tuple[Value, ...] | None
    relation: Literal["at least", "at most", "exactly"]
    count: int

    def __str__(self) -> str:
        return show_call(self.action, self.args or ())


@dataclass(frozen=True)
class ExpectActions(Base):
    """All primitive actions of the run, in order."""

    actions: tuple[GroundCall, ...]


@dataclass(frozen=True)
class ExpectFormula(Base):
    """What holds at the end."""

    condition: Term


Expectation: TypeAlias = ExpectCount | ExpectActions | ExpectFormula


@dataclass(frozen=True)
class Scenario(Base):
    """A scenario; its lines of each kind in the order in which they are written. ``span`` is the place of its name."""

    name: str
    givens: tuple[Given, ...]
    procedure: GroundCall
    events: tuple[Events, ...]
    until: Term | None
    expectations: tuple[Expectation, ...]
