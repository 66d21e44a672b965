"""A situation together with the one before its last action, of which ``before(e)`` speaks."""

from __future__ import annotations

from collections.abc import Callable

from golc.situation.worlds import Readable, State, survey
from golc.theory.types import Value


class NotKnownError(Exception):
    """What a term was before the last action is not known."""


class Happened:
    """A world as terms are evaluated in it, and what was known ``before`` the action that led to it."""

    __slots__ = ("_world", "before", "state")

    def __init__(self, world: Readable, before: State) -> None:
        self._world = world
        self.before = before
        self.state: State = world if isinstance(world, tuple) else world.state

    def __getitem__(self, slot: int) -> Value:
        return self._world[slot]


def before(ask: Callable[..., Value], world: Happened, *rest: Value) -> Value:
    """``before(e)``: what a term was known to be before; raises ``NotKnownError`` if the worlds disagree."""
    answers = (answer for _, answer in survey(world.before, lambda other: ask(other, *rest)))
    first = next(answers)
    if all(answer == first for answer in answers):
        return first
    raise NotKnownError
