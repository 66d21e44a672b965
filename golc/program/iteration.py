"""*Trans* and *Final* of what is done several times: ``while``, ``star``, ``for``."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import prod
from typing import TYPE_CHECKING

from golc.diagnostics import Span
from golc.program.frames import Then
from golc.program.nodes import Node
from golc.program.rules import Env, Evaluate, Found, Rule, push_in_turn
from golc.program.walks import Proof, Walk
from golc.theory.types import Value

if TYPE_CHECKING:
    from golc.program.program import Program


class While(Rule):
    """Synchronised: the test and the first step of the body are one transition."""

    def __init__(self, span: Span, condition: Evaluate, body: Rule) -> None:
        super().__init__(span)
        self.condition = condition
        self.body = body

    def trans(self, walk: Walk, node: Node) -> Found:
        if self.condition(walk.state, node.operands):
            body = walk.machine.program.at(self.body, node.operands)
            walk.push_inside(body, Then(node, walk.outer))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        if not self.condition(proof.state, node.operands):
            return True
        proof.require(proof.machine.program.at(self.body, node.operands))
        return False


class Star(Rule):
    """*δ\\**: stop, or the body once more."""

    def __init__(self, span: Span, body: Rule) -> None:
        super().__init__(span)
        self.body = body

    def trans(self, walk: Walk, node: Node) -> Found:
        walk.push_inside(walk.machine.program.at(self.body, node.operands), Then(node, walk.outer))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        return True


class BoundedStar(Rule):
    """*δ\\** with at most so many rounds; the bound is evaluated with the first."""

    def __init__(self, span: Span, limit: Evaluate, body: Rule) -> None:
        super().__init__(span)
        self.limit = limit
        self.rounds = Rounds(span, body)

    def trans(self, walk: Walk, node: Node) -> Found:
        walk.push(self.rounds.left(walk.machine.program, node.operands, self.limit(walk.state, node.operands)))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        return True


class Rounds(Rule):
    """The rounds that are left of a bounded iteration: operands environment and number."""

    def __init__(self, span: Span, body: Rule) -> None:
        super().__init__(span)
        self.body = body

    def left(self, program: Program, env: Env, count: int) -> Node:
        """The node of so many rounds."""
        return program.node(self, (env, count)) if count > 0 else program.nil

    def trans(self, walk: Walk, node: Node) -> Found:
        program = walk.machine.program
        env, count = node.operands
        walk.push_inside(program.at(self.body, env), Then(self.left(program, env, count - 1), walk.outer))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        return True


class For(Rule):
    """The block once for each value in order, as written; its nodes are of the rule ``turns``.

    ``values``: those of each variable; the last one changes fastest. ``turn``: the block under its condition.
    """

    def __init__(self, span: Span, values: tuple[Sequence[Value], ...], turn: Rule) -> None:
        super().__init__(span)
        self.turns = Turns(span, values, turn)
        self.may_finish = turn.may_finish or not self.turns.count

    def instance(self, program: Program, env: Env) -> Node:
        return self.turns.since(program, env, 0)


class Turns(Rule):
    """The turns of a ``for`` that are left: operands environment and the number of the next. Made as they are needed,
    for there may be many."""

    def __init__(self, span: Span, values: tuple[Sequence[Value], ...], turn: Rule) -> None:
        super().__init__(span)
        self.values = values
        self.turn = turn
        self.count = prod(map(len, values))
        self.may_finish = turn.may_finish

    def since(self, program: Program, env: Env, number: int) -> Node:
        """The node of the turns from one on."""
        return program.node(self, (env, number)) if number < self.count else program.nil

    def _parts(self, program: Program, node: Node) -> tuple[Node, Node]:
        """The next turn and those after it."""
        env, number = node.operands
        chosen: Env = ()
        rest = number
        for values in reversed(self.values):
            rest, index = divmod(rest, len(values))
            chosen = (values[index], *chosen)
        return program.at(self.turn, (*env, *chosen)), self.since(program, env, number + 1)

    def trans(self, walk: Walk, node: Node) -> Found:
        push_in_turn(walk, *self._parts(walk.machine.program, node))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require_all(self._parts(proof.machine.program, node))
        return False


class ForEach(Rule):
    """The block once for each element of collections, which are evaluated with the first step of the first turn."""

    def __init__(self, span: Span, environments: Callable[..., Iterator[Env]], turn: Rule) -> None:
        super().__init__(span)
        self.environments = environments
        self.turn = turn

    def _turns(self, walk: Walk | Proof, node: Node) -> Node:
        """All turns in sequence."""
        program = walk.machine.program
        turns = program.nil
        for env in reversed([*self.environments(walk.state, node.operands)]):
            turns = program.sequence(program.at(self.turn, env), turns)
        return turns

    def trans(self, walk: Walk, node: Node) -> Found:
        walk.push(self._turns(walk, node))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require(self._turns(proof, node))
        return False
