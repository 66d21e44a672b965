"""*Trans* and *Final* of the sequential constructs; ``iteration``, ``concurrency`` and ``lookahead`` have the others.

The definitions are those of De Giacomo, Lespérance & Levesque (2000), "ConGolog, a concurrent programming language
based on the situation calculus", with the order of transitions that the golc manual fixes. A rule is a compiled
statement, or one of the forms that a statement takes once it has begun; it answers two questions about its nodes:

``trans``  either gives one transition of its own, or pushes the parts that have some, the one that comes first last.
           What it pushes is looked at when the transitions before it are used up: nothing is computed in vain.
``final``  either is decided, or says which parts it requires to be final.

Neither recurses into a part that may be nested without bound: the walks (``walks``) keep the stack.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from golc.diagnostics import Span
from golc.program.frames import Then
from golc.program.labels import Abort, Act, Label, Say, Silent, Wait
from golc.program.nodes import Node
from golc.program.walks import Proof, Walk
from golc.situation.worlds import State
from golc.theory.terms import Term
from golc.theory.types import Type, Value

if TYPE_CHECKING:
    from golc.program.program import Program

Env: TypeAlias = tuple[Value, ...]
Evaluate: TypeAlias = Callable[[State, Env], Any]
"""A compiled term: its value in a state and an environment."""

Found: TypeAlias = tuple[Label, Node] | None


class Rule:
    """The base of all rules.

    ``may_finish``: whether its nodes can be final at all; with ``needs_all`` they can if all their operands can.
    ``dead``: the levels of the environment that the statement does not read. ``closed``: the only node of a statement
    that reads no variable. ``steps_when_final``: whether a final node may have transitions.
    """

    may_finish = True
    steps_when_final = True
    needs_all = False
    dead: frozenset[int] = frozenset()
    closed: Node | None = None

    def __init__(self, span: Span) -> None:
        self.span = span

    def instance(self, program: Program, env: Env) -> Node:
        """The node of a statement in an environment."""
        return program.node(self, env)

    def trans(self, walk: Walk, node: Any) -> Found:
        """One transition, or none and more work on the walk's stack."""
        raise NotImplementedError

    def final(self, proof: Proof, node: Any) -> bool:
        """True if final as it stands; otherwise false, having said what it requires (nothing: not final)."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"{type(self).__name__}@{self.span.line}"


class Skip(Rule):
    """*nil*: final, without transitions."""

    def trans(self, walk: Walk, node: Node) -> Found:
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        return True


class Step(Rule):
    """The base of the statements that are one transition, after which nothing is left of them."""

    may_finish = False

    def final(self, proof: Proof, node: Node) -> bool:
        return False


class Perform(Step):
    """*a*: a primitive action whose precondition holds; its arguments are evaluated now. ``types`` as for ``Act``."""

    def __init__(
        self,
        span: Span,
        action: str,
        args: Callable[[State, Env], Env],
        types: tuple[Type, ...],
        possible: Callable[..., bool],
    ) -> None:
        super().__init__(span)
        self.action = action
        self.args = args
        self.types = types
        self.possible = possible

    def trans(self, walk: Walk, node: Node) -> Found:
        args = self.args(walk.state, node.operands)
        if self.possible(walk.state, *args):
            return Act(self.action, args, self.span, self.types), walk.machine.program.nil
        walk.machine.blame(self, "impossible", self.action, args)
        return None


class Test(Step):
    """*φ?*: go on only if the formula holds now."""

    def __init__(self, span: Span, condition: Evaluate, term: Term) -> None:
        super().__init__(span)
        self.condition = condition
        self.term = term
        self.label = Silent(span)

    def trans(self, walk: Walk, node: Node) -> Found:
        if self.condition(walk.state, node.operands):
            return self.label, walk.machine.program.nil
        walk.machine.blame(self, "false", self.term, node.operands)
        return None


class SayRule(Step):
    """A message; always possible."""

    def __init__(self, span: Span, text: Callable[[State, Env], str]) -> None:
        super().__init__(span)
        self.text = text

    def trans(self, walk: Walk, node: Node) -> Found:
        return Say(self.text(walk.state, node.operands), self.span), walk.machine.program.nil


class AbortRule(Step):
    """The end of an online run as failed; a dead end of look-ahead."""

    def __init__(self, span: Span, text: Callable[[State, Env], str]) -> None:
        super().__init__(span)
        self.text = text

    def trans(self, walk: Walk, node: Node) -> Found:
        if walk.machine.lookahead:
            walk.machine.blame(self, "aborts")
            return None
        return Abort(self.text(walk.state, node.operands), self.span), walk.machine.program.nil


class WaitRule(Step):
    """A step that ends with the next exogenous action; a dead end of look-ahead where none is expected."""

    def __init__(self, span: Span) -> None:
        super().__init__(span)
        self.label = Wait(span)

    def trans(self, walk: Walk, node: Node) -> Found:
        if walk.machine.can_wait(walk.state):
            return self.label, walk.machine.program.nil
        walk.machine.blame(self, "waits")
        return None


class WaitUntil(Rule):
    """*while not φ: wait*; in look-ahead *(while not φ: wait); φ?*."""

    def __init__(self, span: Span, condition: Evaluate, term: Term) -> None:
        super().__init__(span)
        self.condition = condition
        self.term = term
        self.wait = Wait(span)
        self.test = Silent(span)

    def trans(self, walk: Walk, node: Node) -> Found:
        machine = walk.machine
        if self.condition(walk.state, node.operands):
            return (self.test, machine.program.nil) if machine.lookahead else None
        if machine.can_wait(walk.state):
            return self.wait, node
        machine.blame(self, "waits for", self.term, node.operands)
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        return not proof.machine.lookahead and bool(self.condition(proof.state, node.operands))


class Block(Rule):
    """*δ1; δ2* as written: a statement and the block below it. Its nodes are sequences."""

    def __init__(self, span: Span, first: Rule, rest: Rule) -> None:
        super().__init__(span)
        self.first = first
        self.rest = rest
        self.may_finish = first.may_finish and rest.may_finish

    def instance(self, program: Program, env: Env) -> Node:
        """From the last statement to the first; a loop, for blocks may be long."""
        heads: list[Node] = []
        rule: Rule = self
        while isinstance(rule, Block) and rule.closed is None:
            heads.append(program.at(rule.first, env))
            rule = rule.rest
        node = program.at(rule, env)
        for head in reversed(heads):
            node = program.sequence(head, node)
        return node


class Sequence(Rule):
    """*δ1; δ2*; the operands are the two."""

    needs_all = True

    def trans(self, walk: Walk, node: Node) -> Found:
        push_in_turn(walk, *node.operands)
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require_all(node.operands)
        return False


def push_in_turn(walk: Walk, first: Node, rest: Node) -> None:
    """The transitions of *δ1; δ2*: if δ1 is final, δ2's come first, then δ1's."""
    walk.push_inside(first, Then(rest, walk.outer))
    if first.may_finish and walk.machine.final(first, walk.state, walk.entered):
        walk.push(rest)


class If(Rule):
    """Synchronised: the test and the first step are one transition."""

    def __init__(self, span: Span, condition: Evaluate, then: Rule, otherwise: Rule) -> None:
        super().__init__(span)
        self.condition = condition
        self.then = then
        self.otherwise = otherwise
        self.may_finish = then.may_finish or otherwise.may_finish

    def _branch(self, walk: Walk | Proof, node: Node) -> Node:
        chosen = self.then if self.condition(walk.state, node.operands) else self.otherwise
        return walk.machine.program.at(chosen, node.operands)

    def trans(self, walk: Walk, node: Node) -> Found:
        walk.push(self._branch(walk, node))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require(self._branch(proof, node))
        return False


class Choose(Rule):
    """*δ1 | δ2*."""

    def __init__(self, span: Span, branches: tuple[Rule, ...]) -> None:
        super().__init__(span)
        self.branches = branches
        self.may_finish = any(branch.may_finish for branch in branches)

    def trans(self, walk: Walk, node: Node) -> Found:
        for branch in reversed(self.branches):
            walk.push(walk.machine.program.at(branch, node.operands))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require_any([proof.machine.program.at(branch, node.operands) for branch in self.branches])
        return False


class Pick(Rule):
    """*πx.δ*: a value for which ``where`` holds; the choice and the first step are one transition."""

    def __init__(self, span: Span, environments: Callable[[State, Env], Iterator[Env]], body: Rule) -> None:
        super().__init__(span)
        self.environments = environments
        self.more = Choices(span, body)
        self.may_finish = body.may_finish

    def trans(self, walk: Walk, node: Node) -> Found:
        walk.push_task(self.more, (self.environments(walk.state, node.operands), False))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        program, body = proof.machine.program, self.more.body
        proof.require_any([program.at(body, env) for env in self.environments(proof.state, node.operands)])
        return False


class Choices(Rule):
    """The values of a ``pick`` that are still to be tried: operand (environments, whether one has been tried)."""

    def __init__(self, span: Span, body: Rule) -> None:
        super().__init__(span)
        self.body = body

    def trans(self, walk: Walk, node: tuple[Iterator[Env], bool]) -> Found:
        environments, tried = node
        env = next(environments, None)
        if env is not None:
            walk.push_task(self, (environments, True))
            walk.push(walk.machine.program.at(self.body, env))
        elif not tried:
            walk.machine.blame(self, "no value")
        return None


class Let(Rule):
    """A name for a value, which is evaluated with the first transition of the body."""

    def __init__(self, span: Span, value: Evaluate, body: Rule) -> None:
        super().__init__(span)
        self.value = value
        self.body = body
        self.may_finish = body.may_finish

    def _inside(self, walk: Walk | Proof, node: Node) -> Node:
        value = self.value(walk.state, node.operands)
        return walk.machine.program.at(self.body, (*node.operands, value))

    def trans(self, walk: Walk, node: Node) -> Found:
        walk.push(self._inside(walk, node))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        proof.require(self._inside(proof, node))
        return False


class Invoke(Rule):
    """A procedure call: the transitions of the body, with the arguments as they are now.

    A recursive procedure reached again without a step in between is a step of its own. ``body`` is set when the
    procedure has been compiled.
    """

    body: Rule

    def __init__(self, span: Span, procedure: str, args: Callable[[State, Env], Env], recursive: bool) -> None:
        super().__init__(span)
        self.procedure = procedure
        self.args = args
        self.recursive = recursive
        self.label = Silent(span)

    def _body(self, walk: Walk | Proof, node: Node) -> Node:
        return walk.machine.program.at(self.body, self.args(walk.state, node.operands))

    def trans(self, walk: Walk, node: Node) -> Found:
        if self.recursive:
            if self.procedure in walk.entered:
                return self.label, self._body(walk, node)
            walk.entered = walk.entered | {self.procedure}
        walk.push(self._body(walk, node))
        return None

    def final(self, proof: Proof, node: Node) -> bool:
        if self.recursive:
            if self.procedure in proof.entered:
                return False
            proof.entered = proof.entered | {self.procedure}
        proof.require(self._body(proof, node))
        return False
