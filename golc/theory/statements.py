"""Typed programs: what the elaborator makes of blocks. As in ``terms`` each binder adds the next level."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from fractions import Fraction
from typing import TypeAlias

from golc.diagnostics import NOWHERE, Span
from golc.theory.terms import Binder, Term, Variable


@dataclass(frozen=True)
class Base:
    """The base of all statements."""

    span: Span = field(default=NOWHERE, compare=False, repr=False, kw_only=True)


class Strategy(Enum):
    """Which way to the end of its block ``search`` takes: the first in program order, or the first of the best."""

    FIRST = "first"
    SHORTEST = "shortest"
    """The fewest primitive actions."""
    CHEAPEST = "cheapest"
    """The least sum of the actions' costs."""


Duration: TypeAlias = Term | Fraction
"""Seconds: a term whose values are numbers, or a number that is written with decimals."""


@dataclass(frozen=True)
class Message:
    """Pieces of text and terms in turn, spoken one after the other."""

    parts: tuple[str | Term, ...]


@dataclass(frozen=True)
class Skip(Base):
    pass


@dataclass(frozen=True)
class Perform(Base):
    """A primitive action."""

    action: str
    args: tuple[Term, ...]


@dataclass(frozen=True)
class Invoke(Base):
    """A procedure call."""

    procedure: str
    args: tuple[Term, ...]


@dataclass(frozen=True)
class Test(Base):
    condition: Term


@dataclass(frozen=True)
class Sequence(Base):
    """At least two statements, none of them a ``Sequence``."""

    parts: tuple[Statement, ...]


@dataclass(frozen=True)
class If(Base):
    """``elif`` is an ``If`` in ``otherwise``; a missing ``else`` is ``Skip``."""

    condition: Term
    then: Statement
    otherwise: Statement


@dataclass(frozen=True)
class While(Base):
    condition: Term
    body: Statement


@dataclass(frozen=True)
class Choose(Base):
    branches: tuple[Statement, ...]


@dataclass(frozen=True)
class Pick(Base):
    binders: tuple[Binder, ...]
    where: Term | None
    body: Statement


@dataclass(frozen=True)
class Star(Base):
    """``limit`` bounds the number of rounds; it is evaluated with the first."""

    limit: Term | None
    body: Statement


@dataclass(frozen=True)
class For(Base):
    binders: tuple[Binder, ...]
    where: Term | None
    body: Statement


@dataclass(frozen=True)
class Let(Base):
    variable: Variable
    value: Term
    body: Statement


@dataclass(frozen=True)
class Together(Base):
    branches: tuple[Statement, ...]


@dataclass(frozen=True)
class TogetherStar(Base):
    body: Statement


@dataclass(frozen=True)
class Prefer(Base):
    """Highest first."""

    branches: tuple[Statement, ...]


@dataclass(frozen=True)
class Interrupt(Base):
    """``on condition`` (no binders) or ``on some binders where condition``."""

    binders: tuple[Binder, ...]
    condition: Term
    body: Statement


@dataclass(frozen=True)
class Interrupts(Base):
    handlers: tuple[Interrupt, ...]


@dataclass(frozen=True)
class Guard(Base):
    condition: Term
    body: Statement


@dataclass(frozen=True)
class Search(Base):
    """``steps`` bounds the actions of a plan and ``seconds`` the time it may take to find one; none: no bound."""

    strategy: Strategy
    steps: Term | None
    seconds: Duration | None
    body: Statement


@dataclass(frozen=True)
class Wait(Base):
    pass


@dataclass(frozen=True)
class WaitUntil(Base):
    condition: Term


@dataclass(frozen=True)
class WaitTime(Base):
    seconds: Duration


@dataclass(frozen=True)
class Within(Base):
    """A missing ``else`` is ``Skip``."""

    seconds: Duration
    body: Statement
    otherwise: Statement


@dataclass(frozen=True)
class Say(Base):
    message: Message


@dataclass(frozen=True)
class Abort(Base):
    message: Message


Statement: TypeAlias = (
    Skip
    | Perform
    | Invoke
    | Test
    | Sequence
    | If
    | While
    | Choose
    | Pick
    | Star
    | For
    | Let
    | Together
    | TogetherStar
    | Prefer
    | Interrupts
    | Guard
    | Search
    | Wait
    | WaitUntil
    | WaitTime
    | Within
    | Say
    | Abort
)
