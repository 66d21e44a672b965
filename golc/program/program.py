"""A compiled program: its rules, its residual programs, and how those are put together."""

from __future__ import annotations

from golc.diagnostics import NOWHERE
from golc.program.concurrency import Interrupts
from golc.program.labels import Clock
from golc.program.lookahead import Following
from golc.program.nodes import Node, Pool
from golc.program.rules import Env, Rule, Sequence, Skip
from golc.program.timing import Pause


class Program:
    """The residual programs of the procedures of one theory, in normal form.

    Normal form: a sequence leans to the right and has no finished part; concurrent branches that are over are dropped.
    So the residuals of a loop are the same objects in every round, and each step of a sequence looks at its head only.
    """

    def __init__(self) -> None:
        self._pool = Pool()
        self._sequence = Sequence(NOWHERE)
        self.following = Following(NOWHERE)
        self._pause = Pause(NOWHERE)
        self.skip = Skip(NOWHERE)
        self.nil = self.skip.closed = self._pool.node(self.skip, ())

    def node(self, rule: Rule, operands: tuple[object, ...]) -> Node:
        """The node of a rule and its operands."""
        return self._pool.node(rule, operands)

    def at(self, rule: Rule, env: Env) -> Node:
        """The node of a statement in an environment, of which it keeps what it reads."""
        if rule.closed is not None:
            return rule.closed
        if rule.dead:
            env = tuple([None if level in rule.dead else value for level, value in enumerate(env)])
        return rule.instance(self, env)

    def close(self, rule: Rule, depth: int) -> None:
        """Make the only node of a statement that reads no variable."""
        rule.closed = rule.instance(self, (None,) * depth)

    def sequence(self, first: Node, rest: Node) -> Node:
        """*first; rest*."""
        if first is self.nil:
            return rest
        if rest is self.nil:
            return first
        heads = []
        while first.rule is self._sequence:
            head, first = first.operands
            heads.append(head)
        rest = self._pool.node(self._sequence, (first, rest))
        for head in reversed(heads):
            rest = self._pool.node(self._sequence, (head, rest))
        return rest

    def pause(self, clock: Clock, now: float) -> Node:
        """``wait e s`` whose clock has started now."""
        return self._pool.node(self._pause, (now + clock.seconds, clock.span))

    def with_branch(self, whole: Node, index: int, residual: Node) -> Node:
        """A ``together`` or ``prefer`` in which one branch has made a step."""
        parts = whole.operands
        return self.branches(whole.rule, (*parts[:index], residual, *parts[index + 1 :]))

    def branches(self, rule: Rule, parts: tuple[Node, ...]) -> Node:
        """A ``together`` or ``prefer`` of those parts that are not over."""
        if self.nil in parts:
            parts = tuple([part for part in parts if part is not self.nil])
        match parts:
            case ():
                return self.nil
            case (part,):
                return part
            case _:
                return self._pool.node(rule, parts)

    def interrupts(self, rule: Interrupts, env: Env, bodies: tuple[Node | None, ...]) -> Node:
        """Interrupts with their residual bodies; those that are over are no longer active."""
        bodies = tuple([None if body is self.nil else body for body in bodies])
        if bodies == rule.idle:
            return self.at(rule, env)
        return self._pool.node(rule.active, (env, bodies))

    @property
    def live_nodes(self) -> int:
        """How many residual programs are in use."""
        return len(self._pool)
