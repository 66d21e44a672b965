"""What certainly has a value, for the types say so, or what was asked before: ``len(l) > 0 and first(l) = 3``.

This is for what cannot be gone through: sets, lists, strings. It answers yes too seldom, never too often.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, TypeAlias

from golc.theory.border import PythonFunction
from golc.theory.fitting import includes, strip_optional
from golc.theory.operations import takes_none
from golc.theory.terms import (
    Binder,
    Choice,
    Comprehension,
    DefinedTerm,
    Display,
    Epistemic,
    FluentTerm,
    Literal,
    Membership,
    Operation,
    Operator,
    PossTerm,
    Quantified,
    StaticTerm,
    Term,
    Text,
    Variable,
    children,
    subterms,
)
from golc.theory.theory import BasicActionTheory, Effect, Parameter
from golc.theory.types import INT, Type

Env: TypeAlias = tuple[int, ...]
"""A number for each variable in scope, by level: those of one number have one value."""


class Fact(NamedTuple):
    """A term, with the numbers of its variables, is not ``none``, or (``filled``) no empty set or list."""

    term: Term
    env: Env
    filled: bool


Facts: TypeAlias = frozenset[Fact]

NO_FACTS: Facts = frozenset()


@dataclass
class Certainty:
    """Judges the terms of a theory."""

    theory: BasicActionTheory
    _judged: dict[tuple[str, str], bool] = field(default_factory=dict)
    """What is found out about each static, definition and precondition; no, as long as that is under way."""
    _fresh: Iterator[int] = field(default_factory=lambda: itertools.count(-1, -1))

    def has_value(self, term: Term, env: Env, facts: Facts = NO_FACTS) -> bool:
        """Whether a term has a value in every situation in which the facts hold."""
        match term:
            case FluentTerm(fluent=name, args=args):
                return self.are_arguments(args, self.theory.fluents[name].parameters, env, facts)
            case StaticTerm(static=name, args=args):
                parameters = self.theory.statics[name].parameters
                return self.are_arguments(args, parameters, env, facts) and self._judge("static", name)
            case DefinedTerm(definition=name, args=args):
                parameters = self.theory.definitions[name].parameters
                return self.are_arguments(args, parameters, env, facts) and self._judge("definition", name)
            case PossTerm(action=name, args=args):
                parameters = self.theory.actions[name].parameters
                return self.are_arguments(args, parameters, env, facts) and self._judge("action", name)
            case Quantified(kind="min" | "max"):
                return False
            case Quantified(binders=binders, where=where, body=body):
                inner = self.bound(binders, (where,), env, facts)
                return inner is not None and self.has_some_value(body, *inner)
            case Comprehension(binders=binders, where=where, element=element):
                inner = self.bound(binders, (where,), env, facts)
                return inner is not None and self.has_value(element, *inner)
            case Epistemic(body=body):
                return self.has_value(body, env)
            case Operation():
                return self._operation(term, env, facts)
            case Literal() | Variable() | Membership() | Display() | Text():
                return self._have_values(children(term), env, facts)
            case _:
                return False

    def bound(
        self, binders: tuple[Binder, ...], conditions: Iterable[Term | None], env: Env, facts: Facts
    ) -> tuple[Env, Facts] | None:
        """The variables and the facts behind some binders and conditions, all of which have a value; otherwise none."""
        for binder in binders:
            if binder.within is not None:
                if not self.has_some_value(binder.within, env, facts):
                    return None
                facts |= _filled(binder.within, env)
            env = (*env, next(self._fresh))
        for condition in conditions:
            if condition is not None:
                if not self.has_some_value(condition, env, facts):
                    return None
                facts |= self.facts(condition, env)
        return env, facts

    def are_arguments(self, args: tuple[Term, ...], parameters: tuple[Parameter, ...], env: Env, facts: Facts) -> bool:
        """Whether terms have values of the types of some parameters."""
        pairs = zip(args, parameters, strict=True)
        return False not in [self.is_of_type(arg, parameter.type, env, facts) for arg, parameter in pairs]

    def is_of_type(self, term: Term, type_: Type, env: Env, facts: Facts) -> bool:
        """Whether a term has a value of a type."""
        if isinstance(term, Literal):
            return term.value in type_
        found = strip_optional(term.type) if _is_some(term, env, facts) else term.type
        return includes(type_, found) and self.has_value(term, env, facts)

    def succeeds(self, effect: Effect, env: Env, facts: Facts) -> bool:
        """Whether an effect can be carried out; ``env`` may have numbers for its binders already."""
        after = self.bound(effect.binders, (effect.where, effect.condition), env, facts)
        if after is None:
            return False
        env, facts = after
        fluent = self.theory.fluents[effect.fluent]
        if not self.are_arguments(effect.args, fluent.parameters, env, facts):
            return False
        match effect.value:
            case Choice(among=Display(elements=(_, *_) as elements)):
                return False not in [self.is_of_type(element, fluent.type, env, facts) for element in elements]
            case Choice(among=among):
                return isinstance(among, Literal)
            case value:
                return self.is_of_type(value, fluent.type, env, facts)

    def facts(self, formula: Term, env: Env, holds: bool = True) -> Facts:
        """What is known where a formula holds, or where it is false."""
        match formula:
            case Operation(op=Operator.NOT, args=(inside,)):
                return self.facts(inside, env, not holds)
            case Operation(op=op, args=args) if op is (Operator.AND if holds else Operator.OR):
                return NO_FACTS.union(*[self.facts(part, env, holds) for part in args])
            case Operation(op=op, args=(left, right)):
                return _compared(op if holds else NEGATED.get(op), left, right, env)
            case Membership(element=element, within=type_) if holds and None not in type_:
                return _some(element, env)
            case DefinedTerm(definition=name, args=()):
                return self.facts(self.theory.definitions[name].body, (), holds)
            case _:
                return NO_FACTS

    def _operation(self, term: Operation, env: Env, facts: Facts) -> bool:
        op, args = term.op, term.args
        match op:
            case Operator.AND | Operator.OR | Operator.IMPLIES:
                return self._in_turn(args, env, facts, holds=op is not Operator.OR)
            case Operator.CONDITIONAL:
                then, condition, otherwise = args
                return (
                    self.has_some_value(condition, env, facts)
                    and self.has_value(then, env, facts | self.facts(condition, env))
                    and self.has_value(otherwise, env, facts | self.facts(condition, env, holds=False))
                )
            case Operator.DIVIDE | Operator.MODULO if not (isinstance(args[1], Literal) and args[1].value):
                return False
            case Operator.FIRST | Operator.REST if not _is_filled(args[0], env, facts):
                return False
            case Operator.INDEX if not (args[1] == FIRST_PLACE and _is_filled(args[0], env, facts)):
                return False
        are_some = [takes_none(op, place) or _is_some(arg, env, facts) for place, arg in enumerate(args)]
        return all(are_some) and self._have_values(args, env, facts)

    def _in_turn(self, formulas: tuple[Term, ...], env: Env, facts: Facts, holds: bool) -> bool:
        """Whether formulas have values, each where those before it hold, or are false."""
        for formula in formulas:
            if not self.has_some_value(formula, env, facts):
                return False
            facts |= self.facts(formula, env, holds)
        return True

    def _have_values(self, terms: tuple[Term, ...], env: Env, facts: Facts) -> bool:
        # Not by `all`: that would take C stack, of which a long chain of definitions may need too much.
        return False not in [self.has_value(term, env, facts) for term in terms]

    def has_some_value(self, term: Term, env: Env, facts: Facts) -> bool:
        """Whether a term has a value that is not ``none``."""
        return _is_some(term, env, facts) and self.has_value(term, env, facts)

    def _judge(self, kind: str, name: str) -> bool:
        """Whether a static, a definition or a precondition has a value for all arguments of the right types."""
        if (kind, name) not in self._judged:
            self._judged[kind, name] = False
            self._judged[kind, name] = self._judgement(kind, name)
        return self._judged[kind, name]

    def _judgement(self, kind: str, name: str) -> bool:
        if kind == "definition":
            definition = self.theory.definitions[name]
            return self.has_value(definition.body, self._variables(definition.parameters))
        if kind == "action":
            action = self.theory.actions[name]
            return self.bound((), action.preconditions, self._variables(action.parameters), NO_FACTS) is not None
        static = self.theory.statics[name]
        if isinstance(static.body, Mapping):
            return True
        if isinstance(static.body, PythonFunction):
            return False
        return self.is_of_type(static.body, static.type, self._variables(static.parameters), NO_FACTS)

    def _variables(self, parameters: tuple[Parameter, ...]) -> Env:
        return tuple([next(self._fresh) for _ in parameters])


NEGATED = {
    Operator.EQUAL: Operator.DIFFERENT,
    Operator.DIFFERENT: Operator.EQUAL,
    Operator.LESS: Operator.GREATER_EQUAL,
    Operator.LESS_EQUAL: Operator.GREATER,
    Operator.GREATER: Operator.LESS_EQUAL,
    Operator.GREATER_EQUAL: Operator.LESS,
}
MIRRORED = {
    Operator.LESS: Operator.GREATER,
    Operator.LESS_EQUAL: Operator.GREATER_EQUAL,
    Operator.GREATER: Operator.LESS,
    Operator.GREATER_EQUAL: Operator.LESS_EQUAL,
}

FIRST_PLACE = Literal(0, type=INT)


def _compared(op: Operator | None, left: Term, right: Term, env: Env) -> Facts:
    """What is known of two terms that compare so."""
    match op, left, right:
        case Operator.ELEMENT, _, _:
            return _filled(right, env)
        case Operator.DIFFERENT, _, Literal(value=None):
            return _some(left, env)
        case Operator.DIFFERENT, Literal(value=None), _:
            return _some(right, env)
        case Operator.DIFFERENT, _, Display(elements=()) if "none" not in left.type.kinds:
            return _filled(left, env)
        case Operator(), Operation(op=Operator.LENGTH, args=(whole,)), Literal(value=int(number)):
            return _filled(whole, env) if _is_above(op, number) else NO_FACTS
        case Operator(), Literal(value=int(number)), Operation(op=Operator.LENGTH, args=(whole,)):
            return _filled(whole, env) if _is_above(MIRRORED.get(op, op), number) else NO_FACTS
        case _:
            return NO_FACTS


def _is_above(op: Operator, number: int) -> bool:
    """Whether a length that compares so with a number is above 0."""
    match op:
        case Operator.GREATER:
            return number >= 0
        case Operator.GREATER_EQUAL | Operator.EQUAL:
            return number > 0
        case _:
            return op is Operator.DIFFERENT and number == 0


def _some(term: Term, env: Env) -> Facts:
    return frozenset([_fact(term, env, filled=False)])


def _filled(term: Term, env: Env) -> Facts:
    return frozenset([_fact(term, env, filled=False), _fact(term, env, filled=True)])


def _fact(term: Term, env: Env, filled: bool) -> Fact:
    levels = {part.level for part in subterms(term) if isinstance(part, Variable) and part.level < len(env)}
    return Fact(term, tuple([env[level] for level in sorted(levels)]), filled)


def _is_some(term: Term, env: Env, facts: Facts) -> bool:
    return "none" not in term.type.kinds or _fact(term, env, filled=False) in facts


def _is_filled(term: Term, env: Env, facts: Facts) -> bool:
    return _fact(term, env, filled=True) in facts
