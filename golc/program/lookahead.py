"""*Trans* and *Final* of ``search``."""

from __future__ import annotations

from golc.diagnostics import Span
from golc.program.nodes import Node
from golc.program.rules import Found, Rule
from golc.program.walks import Proof, Walk


class Search(Rule):
    """*Σ(δ)*: online, the first step of a way to the end of the block; look-ahead sees through it."""

    def __init__(self, span: Span, how: How, body: Rule) -> None:
        super().__init__(span)
        self.how = how
        self.body = body
        self.may_finish = body.may_finish

    def trans(self, walk: Walk, node: Node) -> Found:
        body = walk.machine.program.at(self.body, node.operands)
        if walk.machine.lookahead:
            walk.push(body)
            return None
        return walk.machine.begin_search(self, body, walk.state)

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
        return walk.machine.follow(self, path, index, walk.state)

    def final(self, proof: Proof, node: Node) -> bool:
        path, index = node.operands
        return proof.machine.ahead.final(path.programs[index], proof.state, proof.entered)
