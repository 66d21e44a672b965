"""*Trans* and *Final* of what depends on the clock: ``wait e s`` and ``within e s``. Look-ahead has no clock."""

from __future__ import annotations

from typing import TYPE_CHECKING

from golc.diagnostics import Span
from golc.program.frames import Timed
from golc.program.labels import Clock, Wait
from golc.program.nodes import Node
from golc.program.rules import Env, Evaluate, Found, Rule
from golc.program.walks import Proof, Walk

if TYPE_CHECKING:
    from golc.program.program import Program


class WaitTime(Rule):
    """``wait e s``: online the start of its clock, in look-ahead a silent step."""

    may_finish = False

    def __init__(self, span: Span, seconds: Evaluate) -> None:
        super().__init__(span)
        self.seconds = seconds

    def trans(self, walk: Walk, node: Node) -> Found:
        machine = walk.machine
        seconds = self.seconds(walk.state, node.operands)
        label = Clock(seconds, self.span)
        return label, machine.program.nil if machine.lookahead else machine.program.pause(label, machine.now())

    def final(self, proof: Proof, node: Node) -> bool:
        return False


class Pause(Rule):
    """A wait whose clock runs: operands the moment when it is over, and the place that says so."""

    def trans(self, walk: Walk, node: Node) -> Found:
        moment, span = node.operands
        if walk.machine.lookahead or walk.machine.is_past(moment):
            return None
        walk.machine.ring_at(moment)
        return Wait(span, timed=True), node

    def final(self, proof: Proof, node: Node) -> bool:
        return proof.machine.lookahead or proof.machine.is_past(node.operands[0])


class Within(Rule):
    """``within e s`` whose clock does not run yet: it starts with the first transition of the block."""

    def __init__(self, span: Span, seconds: Evaluate, body: Rule, otherwise: Rule) -> None:
        super().__init__(span)
        self.seconds = seconds
        self.body = body
        self.may_finish = body.may_finish
        self.watched = Watched(span, otherwise)

    def trans(self, walk: Walk, node: Node) -> Found:
        machine = walk.machine
        body = machine.program.at(self.body, node.operands)
        if machine.lookahead:
            walk.push(body)
            return None
        seconds = self.seconds(walk.state, node.operands)
        moment = machine.now() + seconds
        start = Clock(seconds, self.span)
        walk.push_inside(body, Timed(self.watched, node.operands, moment, walk.outer, (start, body)))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require(proof.machine.program.at(self.body, node.operands))
        return False


class Watched(Rule):
    """``within e s`` whose clock runs: operands environment, the moment when the time is up, and the block."""

    def __init__(self, span: Span, otherwise: Rule) -> None:
        super().__init__(span)
        self.otherwise = otherwise

    def around(self, program: Program, env: Env, moment: float, block: Node) -> Node:
        """The node of a block; one that is over has no time any more."""
        return block if block is program.nil else program.node(self, (env, moment, block))

    def trans(self, walk: Walk, node: Node) -> Found:
        env, moment, block = node.operands
        machine = walk.machine
        if machine.lookahead:
            walk.push(block)
        elif machine.is_past(moment):
            walk.push(machine.program.at(self.otherwise, env))
        else:
            machine.ring_at(moment)
            walk.push_inside(block, Timed(self, env, moment, walk.outer))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        env, moment, block = node.operands
        is_over = not proof.machine.lookahead and proof.machine.is_past(moment)
        proof.require(proof.machine.program.at(self.otherwise, env) if is_over else block)
        return False
