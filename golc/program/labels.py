"""What a transition does beside changing the program: the labels of *Trans*."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple, TypeAlias

from golc.diagnostics import Span
from golc.program.nodes import Node
from golc.theory.order import spelt
from golc.theory.types import Type, Value, show_call


@dataclass(frozen=True, slots=True)
class Silent:
    """A test, or a procedure reached again without a step in between: nothing happens."""

    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Act:
    """A primitive action with its arguments, by the statement at ``span``.

    ``types``: those of the arguments, unless all are written the same whatever their types.
    """

    action: str
    args: tuple[Value, ...]
    span: Span = field(compare=False, repr=False)
    types: tuple[Type, ...] = field(default=(), compare=False, repr=False)

    @property
    def written(self) -> tuple[Value, ...]:
        """The arguments as they are to be written."""
        return tuple(map(spelt, self.args, self.types)) if self.types else self.args

    def __str__(self) -> str:
        return show_call(self.action, self.written)


@dataclass(frozen=True, slots=True)
class Say:
    """A message to the operator. The text takes no part in comparison, for it may differ from state to state."""

    text: str = field(compare=False)
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Wait:
    """Let an exogenous action happen; if ``timed``, none ends it, but the clock."""

    span: Span = field(compare=False, repr=False)
    timed: bool = field(default=False, repr=False)


@dataclass(frozen=True, slots=True)
class Clock:
    """The clock of ``wait e s`` or ``within e s`` starts; in look-ahead a silent step."""

    seconds: float
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Abort:
    """End the run as failed."""

    text: str = field(compare=False)
    span: Span = field(compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Expect:
    """In look-ahead only: the expected exogenous action that ends the wait at ``span`` happens."""

    action: str
    args: tuple[Value, ...]
    span: Span = field(compare=False, repr=False)

    def __str__(self) -> str:
        return f"… {show_call(self.action, self.args)}"


Label: TypeAlias = Silent | Act | Say | Wait | Clock | Abort

Foreseen: TypeAlias = Label | Expect
"""The label of a step that look-ahead has taken."""


class Transition(NamedTuple):
    """One element of *Trans*: the label and the residual program."""

    label: Label
    residual: Node
