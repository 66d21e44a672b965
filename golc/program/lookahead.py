"""*Trans* and *Final* of ``search``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from golc.diagnostics import Span
from golc.program.nodes import Node
from golc.program.rules import Env, Found, Rule
from golc.program.walks import Proof, Walk
from golc.situation.worlds import State
from golc.theory.statements import Strategy


@dataclass(frozen=True)
class Request:
    """Which way to the end of a block is wanted: the ``strategy``, at most so many primitive actions (``steps``), found
    in so many ``seconds`` of wall-clock time; none is no bound."""

    strategy: Strategy = Strategy.FIRST
    steps: int | None = None
    seconds: float | None = None

    def after(self, actions: int) -> Request:
        """What is wanted of the rest, when so many actions have been done: they count."""
        return self if self.steps is None else replace(self, steps=self.steps - actions)


ANY = Request()
"""The first way in program order, however long it is."""


class Search(Rule):
    """*Σ(δ)*: online, the first step of a way to the end of the block; look-ahead sees through it.

    ``how``: the request, made when the search begins.
    """

    def __init__(self, span: Span, how: Callable[[State, Env], Request], body: Rule) -> None:
        super().__init__(span)
        self.how = how
        self.body = body
        self.may_finish = body.may_finish

    def trans(self, walk: Walk, node: Node) -> Found:
        body = walk.machine.program.at(self.body, node.operands)
        if walk.machine.lookahead:
            walk.push(body)
            return None
        return walk.machine.searches.begin(self, body, walk.state, self.how(walk.state, node.operands))

    def final(self, proof: Proof, node: Node) -> bool:
        body = proof.machine.program.at(self.body, node.operands)
        return proof.machine.ahead.final(body, proof.state, proof.entered)


class Following(Rule):
    """*Σ(δ)* that has begun: the operands are the path that was found and how far it has been followed."""

    def trans(self, walk: Walk, node: Node) -> Found:
        path, index = node.operands
        if walk.machine.lookahead:
            walk.push(path.programs[index])
            return None
        return walk.machine.searches.follow(self, path, index, walk.state)

    def final(self, proof: Proof, node: Node) -> bool:
        path, index = node.operands
        return proof.machine.ahead.final(path.programs[index], proof.state, proof.entered)
