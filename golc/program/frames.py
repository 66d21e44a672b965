"""What surrounds a part of a program while its transitions are looked for, and puts the residual back in its place.

A chain of frames is to a part what a stack is to a function call: the search for transitions walks down into the
program without recursion, and each transition found is wrapped by the frames from the inside out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from golc.program.nodes import Node

if TYPE_CHECKING:
    from golc.program.rules import Interrupts
    from golc.program.step import Machine


class Token:
    """Whether a part has had a transition: what stands below it in a ``prefer`` or ``interrupts`` depends on that."""

    __slots__ = ("used",)

    def __init__(self) -> None:
        self.used = False


class Frame:
    """The base of all frames; ``outer`` is the next frame outwards."""

    __slots__ = ("outer",)

    outer: Frame | None

    def wrap(self, machine: Machine, residual: Node) -> Node:
        """The residual of the whole, given that of the part."""
        raise NotImplementedError


class Then(Frame):
    """The part is followed by ``rest``."""

    __slots__ = ("rest",)

    def __init__(self, rest: Node, outer: Frame | None) -> None:
        self.rest = rest
        self.outer = outer

    def wrap(self, machine: Machine, residual: Node) -> Node:
        return machine.program.sequence(residual, self.rest)


class Branch(Frame):
    """The part is one of the branches of a ``together`` or ``prefer``; in the latter it has a token."""

    __slots__ = ("index", "token", "whole")

    def __init__(self, whole: Node, index: int, token: Token | None, outer: Frame | None) -> None:
        self.whole = whole
        self.index = index
        self.token = token
        self.outer = outer

    def wrap(self, machine: Machine, residual: Node) -> Node:
        if self.token is not None:
            self.token.used = True
        return machine.program.with_branch(self.whole, self.index, residual)


class Handler(Frame):
    """The part is the body of an interrupt."""

    __slots__ = ("bodies", "env", "index", "rule", "token")

    def __init__(
        self,
        rule: Interrupts,
        env: tuple[object, ...],
        bodies: tuple[Node | None, ...],
        index: int,
        token: Token,
        outer: Frame | None,
    ) -> None:
        self.rule = rule
        self.env = env
        self.bodies = bodies
        self.index = index
        self.token = token
        self.outer = outer

    def wrap(self, machine: Machine, residual: Node) -> Node:
        self.token.used = True
        bodies = (*self.bodies[: self.index], residual, *self.bodies[self.index + 1 :])
        return machine.program.interrupts(self.rule, self.env, bodies)
