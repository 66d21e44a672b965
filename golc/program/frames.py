"""What surrounds a part of a program while its transitions are looked for, and puts the residual back in its place.

A chain of frames is to a part what a stack is to a function call: the search for transitions walks down into the
program without recursion, and a transition that is taken is wrapped by the frames from the inside out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from golc.program.nodes import Node
from golc.theory.types import Value

if TYPE_CHECKING:
    from golc.program.concurrency import GuardedBlock, Interrupts, Together
    from golc.program.labels import Clock
    from golc.program.program import Program
    from golc.program.timing import Watched


class Token:
    """Whether a part has had a transition: what stands below it in a ``prefer`` or ``interrupts`` depends on that.

    ``outer`` is the token of the next such part outwards, of which this one is a part.
    """

    __slots__ = ("outer", "used")

    def __init__(self, outer: Frame | None) -> None:
        self.used = False
        self.outer = outer.token if outer is not None else None

    def use(self) -> None:
        """The part has had a transition, and so has everything around it."""
        token: Token | None = self
        while token is not None and not token.used:
            token.used = True
            token = token.outer


class Frame:
    """The base of all frames; ``outer`` is the next frame outwards, ``token`` the innermost one that is waited for.

    ``starting``: the outermost ``within`` around the part whose clock does not run yet.
    """

    __slots__ = ("outer", "starting", "token")

    def __init__(self, outer: Frame | None, token: Token | None = None) -> None:
        self.outer = outer
        self.starting: Timed | None = None if outer is None else outer.starting
        self.token: Token | None = token if token is not None or outer is None else outer.token

    def wrap(self, program: Program, residual: Node) -> Node:
        """The residual of the whole, given that of the part."""
        raise NotImplementedError


class Then(Frame):
    """The part is followed by ``rest``."""

    __slots__ = ("rest",)

    def __init__(self, rest: Node, outer: Frame | None) -> None:
        super().__init__(outer)
        self.rest = rest

    def wrap(self, program: Program, residual: Node) -> Node:
        return program.sequence(residual, self.rest)


class Branch(Frame):
    """The part is one of the branches of a ``together`` or ``prefer``; in the latter it has a token."""

    __slots__ = ("index", "whole")

    def __init__(self, whole: Node, index: int, token: Token | None, outer: Frame | None) -> None:
        super().__init__(outer, token)
        self.whole = whole
        self.index = index

    def wrap(self, program: Program, residual: Node) -> Node:
        return program.with_branch(self.whole, self.index, residual)


class Handler(Frame):
    """The part is the body of an interrupt."""

    __slots__ = ("bodies", "env", "index", "rule")

    def __init__(
        self,
        rule: Interrupts,
        env: tuple[object, ...],
        bodies: tuple[Node | None, ...],
        index: int,
        token: Token,
        outer: Frame | None,
    ) -> None:
        super().__init__(outer, token)
        self.rule = rule
        self.env = env
        self.bodies = bodies
        self.index = index

    def wrap(self, program: Program, residual: Node) -> Node:
        bodies = (*self.bodies[: self.index], residual, *self.bodies[self.index + 1 :])
        return program.interrupts(self.rule, self.env, bodies)


class Copy(Frame):
    """The part is one copy beside the iteration it was made from."""

    __slots__ = ("node", "rule")

    def __init__(self, rule: Together, node: Node, outer: Frame | None) -> None:
        super().__init__(outer)
        self.rule = rule
        self.node = node

    def wrap(self, program: Program, residual: Node) -> Node:
        return program.branches(self.rule, (residual, self.node))


class Guarded(Frame):
    """The part is the body of a ``guard``."""

    __slots__ = ("env", "rule")

    def __init__(self, rule: GuardedBlock, env: tuple[Value, ...], outer: Frame | None) -> None:
        super().__init__(outer)
        self.rule = rule
        self.env = env

    def wrap(self, program: Program, residual: Node) -> Node:
        return self.rule.around(program, self.env, residual)


class Timed(Frame):
    """The part is the block of a ``within``, whose time is up at a ``moment``.

    ``start``: if its clock does not run yet, the label that starts it and the block as it is.
    """

    __slots__ = ("env", "moment", "rule", "start")

    def __init__(
        self,
        rule: Watched,
        env: tuple[Value, ...],
        moment: float,
        outer: Frame | None,
        start: tuple[Clock, Node] | None = None,
    ) -> None:
        super().__init__(outer)
        self.rule = rule
        self.env = env
        self.moment = moment
        self.start = start
        if start is not None and self.starting is None:
            self.starting = self

    def wrap(self, program: Program, residual: Node) -> Node:
        return self.rule.around(program, self.env, self.moment, residual)


def resume(program: Program, residual: Node, frame: Frame | None) -> Node:
    """The residual of the whole program, given that of a part."""
    while frame is not None:
        residual = frame.wrap(program, residual)
        frame = frame.outer
    return residual
