"""*Trans* and *Final* of what runs at the same time or is watched: concurrency, priorities, interrupts, guards."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from golc.diagnostics import Span
from golc.program.frames import Branch, Copy, Guarded, Handler, Token
from golc.program.nodes import Node
from golc.program.rules import Env, Evaluate, Found, Rule
from golc.program.walks import Proof, Walk
from golc.situation.worlds import State
from golc.theory.terms import Term

if TYPE_CHECKING:
    from golc.program.program import Program

Bodies: TypeAlias = tuple[Node | None, ...]
"""The residual body of each interrupt of a block, or none where it is not active."""


class Together(Rule):
    """*δ1 ∥ δ2*: interleaved concurrency; the operands are the branches that are not over."""

    needs_all = True

    def trans(self, walk: Walk, node: Node) -> Found:
        for index in reversed(range(len(node.operands))):
            walk.push_inside(node.operands[index], Branch(node, index, None, walk.outer))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require_all(node.operands)
        return False


class TogetherStar(Rule):
    """*δ∥*: any number of copies, begun one after the other."""

    def __init__(self, span: Span, body: Rule) -> None:
        super().__init__(span)
        self.body = body
        self.together = Together(span)

    def trans(self, walk: Walk, node: Node) -> Found:
        body = walk.machine.program.at(self.body, node.operands)
        walk.push_inside(body, Copy(self.together, node, walk.outer))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        return True


class Prefer(Rule):
    """*δ1 ⟩⟩ δ2*: the lower part only if the higher one has no transition; the operands are the parts in order."""

    needs_all = True

    def __init__(self, span: Span) -> None:
        super().__init__(span)
        self.lower = Lower(span)

    def trans(self, walk: Walk, node: Node) -> Found:
        return self.lower.trans(walk, (node, 0, None))

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require_all(node.operands)
        return False


class Lower(Rule):
    """A part of a ``prefer``, if the part above it has had no transition."""

    def trans(self, walk: Walk, node: tuple[Node, int, Token | None]) -> Found:
        whole, index, above = node
        if above is not None and above.used:
            return None
        token = Token(walk.outer)
        if index + 1 < len(whole.operands):
            walk.push_task(self, (whole, index + 1, token))
        walk.push_inside(whole.operands[index], Branch(whole, index, token, walk.outer))
        return None


class Branching(Rule):
    """``together`` or ``prefer`` as written: its nodes are of the rule ``whole``."""

    def __init__(self, span: Span, whole: Rule, branches: tuple[Rule, ...]) -> None:
        super().__init__(span)
        self.whole = whole
        self.branches = branches
        self.may_finish = all(branch.may_finish for branch in branches)

    def instance(self, program: Program, env: Env) -> Node:
        return program.branches(self.whole, tuple([program.at(branch, env) for branch in self.branches]))


class Guard(Rule):
    """*gexec(φ, δ)* as written; its nodes are of the rule ``guarded``."""

    def __init__(self, span: Span, condition: Evaluate, over: Evaluate, term: Term, body: Rule) -> None:
        super().__init__(span)
        self.body = body
        self.guarded = GuardedBlock(span, condition, over, term)

    def instance(self, program: Program, env: Env) -> Node:
        return self.guarded.around(program, env, program.at(self.body, env))


class GuardedBlock(Rule):
    """A step of the block only while the condition holds; over when it does not. Operands environment and block.

    ``over``: whether the condition is false, which is more than not being known to be true.
    """

    def __init__(self, span: Span, condition: Evaluate, over: Evaluate, term: Term) -> None:
        super().__init__(span)
        self.condition = condition
        self.over = over
        self.term = term

    def around(self, program: Program, env: Env, block: Node) -> Node:
        """The node of a block; one that is over needs no guard."""
        return block if block is program.nil else program.node(self, (env, block))

    def trans(self, walk: Walk, node: Node) -> Found:
        env, block = node.operands
        if self.condition(walk.state, env):
            walk.push_inside(block, Guarded(self, env, walk.outer))
        else:
            walk.machine.blame(self, "false", self.term, env)
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        env, block = node.operands
        if self.over(proof.state, env):
            return True
        proof.require(block)
        return False


class On:
    """One interrupt: the environments for which its condition holds, and its body."""

    __slots__ = ("body", "environments", "span", "term")

    def __init__(self, span: Span, environments: Callable[[State, Env], Iterator[Env]], term: Term, body: Rule) -> None:
        self.span = span
        self.environments = environments
        self.term = term
        self.body = body


class Interrupts(Rule):
    """*⟨φ → δ⟩* in order of priority, none of them active."""

    steps_when_final = False

    def __init__(self, span: Span, handlers: tuple[On, ...]) -> None:
        super().__init__(span)
        self.handlers = handlers
        self.idle: Bodies = (None,) * len(handlers)
        self.active = Active(span, self)
        self.attempt = Attempt(self)

    def trans(self, walk: Walk, node: Node) -> Found:
        return self.attempt.trans(walk, Turn(node.operands, self.idle, self.idle, 0, Token(walk.outer)))

    def final(self, proof: Proof, node: Node) -> bool:
        return next(proof.machine.transitions(node, proof.state), None) is None

    def frame(self, walk: Walk, turn: Turn) -> Handler:
        """What surrounds the body of the interrupt whose turn it is."""
        return Handler(self, turn.env, turn.going_on, turn.next, turn.token, walk.outer)


class Active(Rule):
    """Interrupts of which some are active: operands environment and, for each interrupt, its residual body or none.

    A body that is final goes on if it can; as soon as anything else of the block steps, it has ended.
    """

    steps_when_final = False

    def __init__(self, span: Span, interrupts: Interrupts) -> None:
        super().__init__(span)
        self.interrupts = interrupts

    def trans(self, walk: Walk, node: Node) -> Found:
        env, bodies = node.operands
        machine, state = walk.machine, walk.state
        going_on = tuple([body if body is None or not machine.final(body, state) else None for body in bodies])
        return self.interrupts.attempt.trans(walk, Turn(env, bodies, going_on, 0, Token(walk.outer)))

    def final(self, proof: Proof, node: Node) -> bool:
        """The active bodies are final and nothing can step."""
        machine, state = proof.machine, proof.state
        return (
            all(machine.final(body, state) for body in node.operands[1] if body is not None)
            and next(machine.transitions(node, state), None) is None
        )


class Turn(NamedTuple):
    """The interrupts from the ``next`` one on have their turn, unless one above has used the ``token``.

    ``bodies``: the residual body of each active interrupt. ``going_on``: those of them that are not final.
    """

    env: Env
    bodies: Bodies
    going_on: Bodies
    next: int
    token: Token


class Attempt(Rule):
    """The interrupts from one on: the operand is a turn."""

    def __init__(self, interrupts: Interrupts) -> None:
        super().__init__(interrupts.span)
        self.interrupts = interrupts
        self.fire = Fire(interrupts)

    def trans(self, walk: Walk, node: Turn) -> Found:
        """Go on to the next interrupt that is active or may fire, and come back for the others below it."""
        if node.token.used:
            return None
        for index in range(node.next, len(node.bodies)):
            body, inner, environments = node.bodies[index], None, None
            if node.going_on[index] is None:
                handler = self.interrupts.handlers[index]
                environments = handler.environments(walk.state, node.env)
                inner = next(environments, None)
                if inner is None:
                    walk.machine.blame(self, "no interrupt", handler, node.env)
            if body is None and inner is None:
                continue
            turn = node._replace(next=index)
            if index + 1 < len(node.bodies):
                walk.push_task(self, node._replace(next=index + 1))
            if environments is not None and inner is not None:
                walk.push_task(self.fire, (turn, inner, environments))
            if body is not None:
                walk.push_inside(body, self.interrupts.frame(walk, turn))
            break
        return None


class Fire(Rule):
    """An interrupt that is not active, or whose body is final: the first binding whose body can step.

    The operand is the turn, the binding that is next (none: it is still to be looked for), and those after it.
    """

    def __init__(self, interrupts: Interrupts) -> None:
        super().__init__(interrupts.span)
        self.interrupts = interrupts

    def trans(self, walk: Walk, node: tuple[Turn, Env | None, Iterator[Env]]) -> Found:
        turn, inner, environments = node
        if turn.token.used:
            return None
        if inner is None:
            inner = next(environments, None)
            if inner is None:
                return None
        walk.push_task(self, (turn, None, environments))
        body = self.interrupts.handlers[turn.next].body
        walk.push_inside(walk.machine.program.at(body, inner), self.interrupts.frame(walk, turn))
        return None
