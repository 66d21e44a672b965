"""Typed statements to rules: every term is compiled once, every procedure when it is first called."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from golc.program import concurrency, iteration, lookahead, rules, timing
from golc.program.nodes import Node
from golc.program.program import Program
from golc.program.rules import Rule
from golc.situation.compile import FORMULA
from golc.situation.dynamics import Dynamics
from golc.theory import statements as st
from golc.theory.order import is_written_by_type
from golc.theory.terms import Binder, Term, Variable, ranges, subterms
from golc.theory.theory import Parameter, Procedure
from golc.theory.types import Number, Value, show

LONGEST = 10**9
"""Seconds; more than 30 years are as good as for ever, and what the clock can count in."""


class Builder:
    """Compiles the procedures of a theory into the rules of one program."""

    def __init__(self, dynamics: Dynamics, program: Program) -> None:
        self.dynamics = dynamics
        self.theory = dynamics.theory
        self.knowing = dynamics.knowing
        self.program = program
        self._bodies: dict[str, Rule] = {}
        self._calls: list[rules.Invoke] = []
        self._read: set[int] = set()

    def start(self, procedure: str, args: tuple[Value, ...] = ()) -> Node:
        """The program that calls a procedure; arguments must be of the parameters' types."""
        body = self._procedure(self.theory.procedures[procedure])
        self._resolve()
        return self.program.at(body, args)

    def _resolve(self) -> None:
        """Give every call its procedure's body; a loop, for bodies bring further calls."""
        while self._calls:
            call = self._calls.pop()
            call.body = self._procedure(self.theory.procedures[call.procedure])

    def _procedure(self, procedure: Procedure) -> Rule:
        if procedure.name not in self._bodies:
            self._bodies[procedure.name] = self._rule(procedure.body, len(procedure.parameters))
        return self._bodies[procedure.name]

    def _rule(self, statement: st.Statement, depth: int) -> Rule:
        outer, self._read = self._read, set()
        rule = self._sealed(self._compiled(statement, depth), depth)
        self._read |= outer
        return rule

    def _sealed(self, rule: Rule, depth: int) -> Rule:
        """Tell a rule which variables it does not read, now that everything inside it has been compiled."""
        rule.dead = frozenset(range(depth)) - self._read
        if rule is not self.program.skip and len(rule.dead) == depth:
            self.program.close(rule, depth)
        return rule

    def _compiled(self, statement: st.Statement, depth: int) -> Rule:
        span = statement.span
        match statement:
            case st.Skip():
                return self.program.skip
            case st.Perform(action=action, args=args):
                parameters = self.theory.actions[action].parameters
                possible = self.dynamics.possible_function(action)
                values, types = self._args(action, parameters, args, depth), [each.type for each in parameters]
                typed = tuple(types) if any(map(is_written_by_type, types)) else ()
                return rules.Perform(span, action, values, typed, possible)
            case st.Invoke(procedure=name):
                return self._invoke(statement, self.theory.procedures[name], depth)
            case st.Test(condition=condition):
                return rules.Test(span, self._condition(condition, depth), condition)
            case st.Sequence(parts=parts):
                return self._sequence(parts, depth)
            case st.If(condition=condition, then=then, otherwise=otherwise):
                condition_ = self._term(condition, depth, FORMULA)
                return rules.If(span, condition_, self._rule(then, depth), self._rule(otherwise, depth))
            case st.While(condition=condition, body=body):
                return iteration.While(span, self._term(condition, depth, FORMULA), self._rule(body, depth))
            case st.Choose(branches=branches):
                return rules.Choose(span, self._rules(branches, depth))
            case st.Pick(binders=binders, where=where, body=body):
                environments = self._environments(binders, where, depth)
                return rules.Pick(span, environments, self._rule(body, depth + len(binders)))
            case st.Star():
                return self._star(statement, depth)
            case st.For():
                return self._for(statement, depth)
            case st.Let(value=value, body=body):
                return rules.Let(span, self._term(value, depth), self._rule(body, depth + 1))
            case st.Together(branches=branches):
                return concurrency.Branching(span, concurrency.Together(span), self._rules(branches, depth))
            case st.TogetherStar(body=body):
                return concurrency.TogetherStar(span, self._rule(body, depth))
            case st.Prefer(branches=branches):
                return concurrency.Branching(span, concurrency.Prefer(span), self._rules(branches, depth))
            case st.Interrupts(handlers=handlers):
                return concurrency.Interrupts(span, tuple(self._handler(handler, depth) for handler in handlers))
            case st.Guard(condition=condition, body=body):
                holds, over = self._condition(condition, depth), self.knowing.refuted(condition, depth)
                return concurrency.Guard(span, holds, over, condition, self._rule(body, depth))
            case st.Search(body=body):
                return lookahead.Search(span, self._request(statement, depth), self._rule(body, depth))
            case st.Wait():
                return rules.WaitRule(span)
            case st.WaitUntil(condition=condition):
                return rules.WaitUntil(span, self._condition(condition, depth), condition)
            case st.WaitTime(seconds=seconds):
                return timing.WaitTime(span, self._seconds(seconds, depth))
            case st.Within(seconds=seconds, body=body, otherwise=otherwise):
                time = self._seconds(seconds, depth)
                return timing.Within(span, time, self._rule(body, depth), self._rule(otherwise, depth))
            case st.Say(message=message):
                return rules.SayRule(span, self._message(message, depth))
            case st.Abort(message=message):
                return rules.AbortRule(span, self._message(message, depth))

    def _rules(self, statements: tuple[st.Statement, ...], depth: int) -> tuple[Rule, ...]:
        return tuple(self._rule(statement, depth) for statement in statements)

    def _sequence(self, parts: tuple[st.Statement, ...], depth: int) -> Rule:
        """From the last statement to the first, each with the block below it."""
        block = self._rule(parts[-1], depth)
        for part in reversed(parts[:-1]):
            block = self._sealed(rules.Block(part.span, self._rule(part, depth), block), depth)
        return block

    def _star(self, statement: st.Star, depth: int) -> Rule:
        body = self._rule(statement.body, depth)
        if statement.limit is None:
            return iteration.Star(statement.span, body)
        return iteration.BoundedStar(statement.span, self._term(statement.limit, depth, "a bound"), body)

    def _for(self, statement: st.For, depth: int) -> Rule:
        binders, body = statement.binders, statement.body
        if statement.where is not None:
            body = st.If(statement.where, body, st.Skip(span=statement.span), span=statement.span)
        turn = self._rule(body, depth + len(binders))
        if any(binder.within is not None for binder in binders):
            return iteration.ForEach(statement.span, self._environments(binders, None, depth), turn)
        return iteration.For(statement.span, tuple(binder.variable.type.values for binder in binders), turn)

    def _request(self, statement: st.Search, depth: int) -> Callable[..., lookahead.Request]:
        """A function of a state and an environment that says what a ``search`` asks for."""
        steps = None if statement.steps is None else self._term(statement.steps, depth, "a bound")
        seconds = None if statement.seconds is None else self._seconds(statement.seconds, depth)
        if steps is None and seconds is None:
            request = lookahead.Request(statement.strategy)
            return lambda state, env: request
        return lambda state, env: lookahead.Request(
            statement.strategy, steps and steps(state, env), seconds and seconds(state, env)
        )

    def _seconds(self, duration: st.Duration, depth: int) -> Callable[..., float]:
        """A function of a state and an environment that gives a time in seconds."""
        if isinstance(duration, Fraction):
            constant = float(min(duration, Fraction(LONGEST)))
            return lambda state, env: constant
        term: Callable[..., Number] = self._term(duration, depth, "a time")

        def seconds(state: Any, env: Any) -> float:
            value = term(state, env)
            return float(max(0, min(value, LONGEST)))

        return seconds

    def _handler(self, handler: st.Interrupt, depth: int) -> concurrency.On:
        environments = self._environments(handler.binders, handler.condition, depth)
        body = self._rule(handler.body, depth + len(handler.binders))
        return concurrency.On(handler.span, environments, handler.condition, body)

    def _invoke(self, statement: st.Invoke, procedure: Procedure, depth: int) -> Rule:
        args = self._args(procedure.name, procedure.parameters, statement.args, depth)
        rule = rules.Invoke(statement.span, procedure.name, args, procedure.recursive)
        self._calls.append(rule)
        return rule

    def _term(self, term: Term, depth: int, what: str | None = None) -> Callable[..., Any]:
        self._reads(term)
        return self.knowing.settled(term, depth, what)

    def _condition(self, term: Term, depth: int) -> Callable[..., Any]:
        self._reads(term)
        return self.knowing.condition(term, depth)

    def _environments(self, binders: tuple[Binder, ...], where: Term | None, depth: int) -> Callable[..., Any]:
        for term in (*ranges(binders), *(() if where is None else (where,))):
            self._reads(term)
        return self.knowing.environments(binders, where, depth)

    def _args(
        self, what: str, parameters: tuple[Parameter, ...], args: tuple[Term, ...], depth: int
    ) -> Callable[..., tuple[Value, ...]]:
        for arg in args:
            self._reads(arg)
        return self.knowing.arguments(what, parameters, args, depth)

    def _reads(self, term: Term) -> None:
        self._read |= {part.level for part in subterms(term) if isinstance(part, Variable)}

    def _message(self, message: st.Message, depth: int) -> Callable[..., str]:
        """A function of a state and an environment that makes the text of a message."""
        for part in message.parts:
            if not isinstance(part, str):
                self._reads(part)
        parts = [part if isinstance(part, str) else self.knowing.shown(part, depth) for part in message.parts]

        def text(state: Any, env: Any) -> str:
            return "".join(part if isinstance(part, str) else show(part(state, env)) for part in parts)

        return text
