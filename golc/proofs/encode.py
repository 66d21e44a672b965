"""Typed terms for an SMT solver: quantifiers over types are written out, definitions and preconditions put in.

A fluent is a function of the places of its arguments in their types; that its values are of its type is said for each
place where it is read.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any, TypeAlias

import z3

from golc.diagnostics import ProgramError
from golc.proofs.encoded import (
    NONE,
    NUMBER,
    SYMBOL,
    TRUTH,
    Encoded,
    Formula,
    both,
    either,
    equal,
    negated,
    same,
    selected,
    truth,
)
from golc.proofs.symbols import NeedsPythonError, NotDecidedError
from golc.theory.border import PythonFunction, extern_value
from golc.theory.errors import NotExecutedError
from golc.theory.fitting import size
from golc.theory.terms import (
    Binder,
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
    Variable,
)
from golc.theory.theory import BasicActionTheory, Parameter, Static
from golc.theory.types import BOOL, REAL, Interval, Optional, Type, Value
from golc.theory.types import number as simplified

MOST_INSTANCES = 20_000
"""How many instances of quantifiers and of calls are written out for one question."""
MOST_TERMS = 20_000
"""How many terms one question may have; those of a definition count each time that it is used."""

DEEPEST = 30
"""How many calls of static functions may be open."""

Env: TypeAlias = tuple[Encoded, ...]
Read: TypeAlias = Callable[[str, Sequence[Encoded]], Encoded]
"""The value of a fluent for arguments, in some situation."""


class Encoder:
    """The terms of one theory. Raises ``NotDecidedError`` for what it has no encoding for.

    ``facts`` are formulas that are true in every situation: the fluents that were read are of their types.
    """

    def __init__(self, theory: BasicActionTheory) -> None:
        self.theory = theory
        self.facts: list[Formula] = []
        self.symbols = sorted(map(str, theory.symbols))
        self.places = {symbol: place for place, symbol in enumerate(self.symbols)}
        self._read: dict[tuple[str, tuple[Any, ...]], tuple[tuple[Any, ...], Encoded]] = {}
        self._instances = 0
        self._depth = 0
        self._terms = 0
        self._fresh = itertools.count()

    def variable(self, name: str, type_: Type) -> Encoded:
        """A variable of some type."""
        return self._of_type(f"{name}!{next(self._fresh)}", type_, ())

    def fluent(self, name: str, args: Sequence[Encoded]) -> Encoded:
        """A fluent now."""
        fluent = self.theory.fluents[name]
        places = tuple([self.place(arg, p.type) for arg, p in zip(args, fluent.parameters, strict=True)])
        key = (name, tuple([part.sexpr() if z3.is_expr(part) else part for part in places]))
        if key not in self._read:
            self._read[key] = places, self._of_type(name, fluent.type, places)
        return self._read[key][1]

    def values(self, model: Any) -> dict[tuple[str, tuple[Value, ...]], Value]:
        """The values of the ground fluents that were read, in a model of the solver."""
        found = {}
        for (name, _), (places, value) in self._read.items():
            types = [parameter.type for parameter in self.theory.fluents[name].parameters]
            at = [_evaluated(place, model) for place in places]
            if all(0 <= index < size(type_) for index, type_ in zip(at, types, strict=True)):
                args = tuple([type_.values[index] for index, type_ in zip(at, types, strict=True)])
                found[name, args] = self.decoded(value, model)
        return found

    def decoded(self, value: Encoded, model: Any) -> Value:
        """A value in a model of the solver."""
        number: int = _evaluated(value.number, model)
        match _evaluated(value.kind, model):
            case 0:
                return number
            case 1:
                return self.symbols[number]
            case 2:
                return None
            case _:
                return bool(number)

    def place(self, value: Encoded, type_: Type) -> Any:
        """Where a value stands in the order of a type."""
        if isinstance(type_, Interval):
            return value.number - type_.low
        place: Any = 0
        for index, each in enumerate(type_.values):
            condition = same(value, self.literal(each))
            place = index if condition is True else place if condition is False else z3.If(condition, index, place)
        return place

    def within(self, value: Encoded, type_: Type) -> Formula:
        """Whether a value belongs to a type."""
        match type_:
            case Optional(base=base):
                return either(equal(value.kind, NONE), self.within(value, base))
            case Interval(low=low, high=high):
                return both(equal(value.kind, NUMBER), low <= value.number, value.number <= high)
            case _ if type_.finite:
                return either(*[same(value, self.literal(each)) for each in type_.values])
            case _ if type_.kinds <= REAL.kinds:
                return equal(value.kind, NUMBER)
            case _:
                raise NotDecidedError(f"values of type `{type_}` are compared")

    def literal(self, value: Value) -> Encoded:
        """A known value."""
        match value:
            case None:
                return Encoded(NONE, 0)
            case bool():
                return truth(value)
            case int():
                return Encoded(NUMBER, value)
            case Fraction():
                return Encoded(NUMBER, z3.Q(value.numerator, value.denominator))
            case str() if value in self.places:
                return Encoded(SYMBOL, self.places[value])
            case _:
                raise NotDecidedError("collections or texts are compared")

    def term(self, term: Term, env: Env, read: Read) -> Encoded:
        """A term in the situation in which fluents are read."""
        self._terms += 1
        if self._terms > MOST_TERMS:
            raise NotDecidedError("the formula is too long for a solver")
        match term:
            case Literal(value=value):
                return self.literal(value)
            case Variable(level=level):
                return env[level]
            case FluentTerm(fluent=name, args=args):
                values, ok = self._arguments(self.theory.fluents[name].parameters, args, env, read)
                return _with(read(name, values), ok)
            case DefinedTerm(definition=name, args=args):
                definition = self.theory.definitions[name]
                values, ok = self._arguments(definition.parameters, args, env, read)
                return _with(self.term(definition.body, values, read), ok)
            case PossTerm(action=name, args=args):
                action = self.theory.actions[name]
                values, ok = self._arguments(action.parameters, args, env, read)
                parts = [self.term(condition, values, read) for condition in action.preconditions]
                return _with(_conjunction(parts), ok)
            case StaticTerm():
                return self._static(term, env, read)
            case Membership(element=element, within=within):
                value = self.term(element, env, read)
                return truth(self.within(value, within), value.ok)
            case Quantified():
                return self._quantified(term, env, read)
            case Epistemic():
                return self._epistemic(term, env, read)
            case Operation():
                return self._operation(term, env, read)
            case _:
                raise NotDecidedError("collections or texts are calculated with")

    def environments(self, binders: Sequence[Binder], env: Env) -> Iterator[Env]:
        """The environments that binders over types make."""
        if any(binder.within is not None for binder in binders):
            raise NotDecidedError("a variable runs over a collection")
        for values in itertools.product(*[binder.variable.type.values for binder in binders]):
            self._instances += 1
            if self._instances > MOST_INSTANCES:
                raise NotDecidedError(f"quantifiers have more than {MOST_INSTANCES} instances")
            yield (*env, *map(self.literal, values))

    def _of_type(self, name: str, type_: Type, places: tuple[Any, ...]) -> Encoded:
        """What a function of places has for a value, with the fact that it is of its type."""
        base = type_.base if isinstance(type_, Optional) else type_
        sorts = [z3.IntSort()] * len(places)
        if base == BOOL and base is type_:
            function = z3.Function(name, *sorts, z3.BoolSort())
            return truth(function(*places))
        if "string" in type_.kinds or type_.kinds & {"set", "list"}:
            raise NotDecidedError(f"values of type `{type_}` are read")
        number = z3.Function(name, *sorts, z3.RealSort() if base == REAL else z3.IntSort())(*places)
        kinds = {_kind(kind) for kind in type_.kinds}
        kind = kinds.pop() if len(kinds) == 1 else z3.Function(f"{name} kind", *sorts, z3.IntSort())(*places)
        found = Encoded(kind, number)
        self.facts.append(self.within(found, type_))
        return found

    def _arguments(
        self, parameters: tuple[Parameter, ...], args: tuple[Term, ...], env: Env, read: Read
    ) -> tuple[Env, Formula]:
        values = tuple([self.term(arg, env, read) for arg in args])
        oks = [both(v.ok, self.within(v, p.type)) for v, p in zip(values, parameters, strict=True)]
        return values, both(*oks)

    def _static(self, term: StaticTerm, env: Env, read: Read) -> Encoded:
        static = self.theory.statics[term.static]
        values, ok = self._arguments(static.parameters, term.args, env, read)
        if isinstance(static.body, Mapping):
            found: Encoded | None = None
            for key, value in static.body.items():
                fits = both(*[same(v, self.literal(k)) for v, k in zip(values, key, strict=True)])
                found = self.literal(value) if found is None else selected(fits, self.literal(value), found)
            assert found is not None
            return _with(found, ok)
        if isinstance(static.body, PythonFunction):
            return self._extern(static, values, ok)
        if self._depth >= DEEPEST:
            raise NotDecidedError(f"the recursion of `{static.name}` is followed")
        self._depth += 1
        try:
            value = self.term(static.body, values, read)
        finally:
            self._depth -= 1
        return _with(value, both(ok, self.within(value, static.type)))

    def _extern(self, static: Static, args: Env, ok: Formula) -> Encoded:
        """A function of Python, as a table."""
        types = [parameter.type for parameter in static.parameters]
        if not all(type_.finite for type_ in types) or math.prod(map(size, types)) > MOST_INSTANCES:
            raise NotDecidedError(f"`{static.name}` has more arguments than a table of its values can have")
        found = Encoded(NUMBER, 0)
        for key in itertools.product(*[type_.values for type_ in types]):
            fits = both(*[same(arg, self.literal(value)) for arg, value in zip(args, key, strict=True)])
            try:
                found = selected(fits, self.literal(extern_value(static, key, static.span)), found)
            except NotExecutedError as error:
                raise NeedsPythonError(error.why) from None
            except ProgramError:
                ok = both(ok, negated(fits))
        return _with(found, ok)

    def _epistemic(self, term: Epistemic, env: Env, read: Read) -> Encoded:
        guess = z3.Bool(f"known!{next(self._fresh)}")
        if term.kind == "known":
            return truth(guess)
        body = self.term(term.body, env, read)
        return truth(both(body.truth, guess) if term.kind == "knows" else either(body.truth, guess), body.ok)

    def _quantified(self, term: Quantified, env: Env, read: Read) -> Encoded:
        cases: list[tuple[Formula, Encoded]] = []
        oks: list[Formula] = []
        for inner in self.environments(term.binders, env):
            where = truth(True) if term.where is None else self.term(term.where, inner, read)
            if where.ok is True and where.truth is False:
                continue
            body = self.term(term.body, inner, read)
            cases.append((where.truth, body))
            oks.append(both(where.ok, either(negated(where.truth), body.ok)))
        match term.kind:
            case "exists" | "forall":
                parts = [_case(term.kind, where, body, ok) for (where, body), ok in zip(cases, oks, strict=True)]
                return _disjunction(parts) if term.kind == "exists" else _conjunction(parts)
            case "count":
                return Encoded(NUMBER, _sum([_if(both(w, body.truth), 1, 0) for w, body in cases]), both(*oks))
            case "sum":
                return Encoded(NUMBER, _sum([_if(w, body.number, 0) for w, body in cases]), both(*oks))
            case kind:
                some = either(*[where for where, _ in cases])
                found = z3.FreshConst(z3.RealSort() if term.type == REAL else z3.IntSort(), kind)
                bounds = [
                    either(negated(where), found <= body.number if kind == "min" else found >= body.number)
                    for where, body in cases
                ]
                reached = either(*[both(w, equal(found, b.number)) for w, b in cases])
                self.facts.append(either(negated(some), both(*bounds, reached)))
                return Encoded(NUMBER, found, both(*oks, some))

    def _operation(self, term: Operation, env: Env, read: Read) -> Encoded:
        args = term.args
        if term.op is Operator.ELEMENT and isinstance(args[1], Display):
            element, *choices = [self.term(part, env, read) for part in (args[0], *args[1].elements)]
            return truth(either(*[same(element, each) for each in choices]), both(element.ok, *[e.ok for e in choices]))
        values = [self.term(arg, env, read) for arg in args]
        match term.op:
            case Operator.AND:
                return _conjunction(values)
            case Operator.OR:
                return _disjunction(values)
            case Operator.IMPLIES:
                return _disjunction([truth(negated(values[0].truth), values[0].ok), values[1]])
            case Operator.NOT:
                return truth(negated(values[0].truth), values[0].ok)
            case Operator.CONDITIONAL:
                then, condition, otherwise = values
                return _with(selected(condition.truth, then, otherwise), condition.ok)
            case Operator.EQUAL | Operator.IFF:
                return truth(same(*values), both(*[value.ok for value in values]))
            case Operator.DIFFERENT:
                return truth(negated(same(*values)), both(*[value.ok for value in values]))
            case _:
                return self._arithmetic(term, values)

    def _arithmetic(self, term: Operation, values: list[Encoded]) -> Encoded:
        ok = both(*[both(value.ok, negated(equal(value.kind, NONE))) for value in values])
        numbers = [value.number for value in values]
        if term.order is not None:
            order = {value: index for index, value in enumerate(term.order)}
            numbers = [self._ranked(value, order) for value in values]
        match term.op:
            case Operator.LESS:
                return truth(_formula(numbers[0] < numbers[1]), ok)
            case Operator.LESS_EQUAL:
                return truth(_formula(numbers[0] <= numbers[1]), ok)
            case Operator.GREATER:
                return truth(_formula(numbers[0] > numbers[1]), ok)
            case Operator.GREATER_EQUAL:
                return truth(_formula(numbers[0] >= numbers[1]), ok)
            case Operator.ADD:
                return Encoded(NUMBER, numbers[0] + numbers[1], ok)
            case Operator.SUBTRACT:
                return Encoded(NUMBER, numbers[0] - numbers[1], ok)
            case Operator.MULTIPLY:
                return Encoded(NUMBER, numbers[0] * numbers[1], ok)
            case Operator.NEGATE:
                return Encoded(NUMBER, -numbers[0], ok)
            case Operator.ABSOLUTE:
                return Encoded(NUMBER, _if(_formula(numbers[0] < 0), -numbers[0], numbers[0]), ok)
            case Operator.MINIMUM | Operator.MAXIMUM:
                return Encoded(NUMBER, _extremum(term.op, numbers), ok)
            case Operator.DIVIDE | Operator.MODULO if term.type != REAL:
                return self._quotient(term.op, numbers, ok)
            case _:
                raise NotDecidedError("collections or quotients of real numbers are calculated with")

    def _quotient(self, op: Operator, numbers: list[Any], ok: Formula) -> Encoded:
        """The solver's division rounds down for positive divisors only."""
        left, right = [number if z3.is_expr(number) else z3.IntVal(number) for number in numbers]
        quotient = z3.If(right > 0, left / right, (-left) / (-right))
        number = quotient if op is Operator.DIVIDE else left - right * quotient
        return Encoded(NUMBER, number, both(ok, right != 0))

    def _ranked(self, value: Encoded, order: Mapping[Value, int]) -> Any:
        rank: Any = 0
        for each, index in order.items():
            condition = same(value, self.literal(each))
            rank = index if condition is True else rank if condition is False else z3.If(condition, index, rank)
        return rank


def _evaluated(term: Any, model: Any) -> Any:
    """What a model says of a number."""
    if not z3.is_expr(term):
        return term
    found = model.eval(term, model_completion=True)
    return found.as_long() if z3.is_int_value(found) else simplified(found.as_fraction())


def _kind(kind: str) -> int:
    return {"int": NUMBER, "real": NUMBER, "none": NONE, "bool": TRUTH}.get(kind, SYMBOL)


def _with(value: Encoded, ok: Formula) -> Encoded:
    return Encoded(value.kind, value.number, both(value.ok, ok), value.formula)


def _case(kind: str, where: Formula, body: Encoded, ok: Formula) -> Encoded:
    holds = both(where, body.truth) if kind == "exists" else either(negated(where), body.truth)
    return truth(holds, ok)


def _conjunction(parts: Sequence[Encoded]) -> Encoded:
    """From left to right; what follows a false part need have no value."""
    oks: list[Formula] = []
    before: list[Formula] = []
    for part in parts:
        oks.append(either(part.ok, negated(both(*before))))
        before.append(part.truth)
    return truth(both(*before), both(*oks))


def _disjunction(parts: Sequence[Encoded]) -> Encoded:
    """From left to right; what follows a true part need have no value."""
    oks: list[Formula] = []
    before: list[Formula] = []
    for part in parts:
        oks.append(either(part.ok, *before))
        before.append(part.truth)
    return truth(either(*before), both(*oks))


def _formula(found: Any) -> Formula:
    return found if z3.is_expr(found) else bool(found)


def _if(condition: Formula, then: Any, otherwise: Any) -> Any:
    if isinstance(condition, bool):
        return then if condition else otherwise
    return z3.If(condition, then, otherwise)


def _sum(numbers: Sequence[Any]) -> Any:
    return z3.Sum(numbers) if any(map(z3.is_expr, numbers)) else sum(numbers)


def _extremum(op: Operator, numbers: Sequence[Any]) -> Any:
    found = numbers[0]
    for number in numbers[1:]:
        found = _if(_formula(number < found if op is Operator.MINIMUM else number > found), number, found)
    return found
