"""Typed terms for an SMT solver: quantifiers over types are written out, definitions and preconditions put in.

A fluent is a function of the places of its arguments in their types; that its values are of its type is said for each
place where it is read.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import z3

from golc.diagnostics import ProgramError
from golc.proofs.calculated import calculated, conjunction, disjunction, with_ok
from golc.proofs.collected import collection, distinct, parts_of
from golc.proofs.encoded import (
    NONE,
    NUMBER,
    Encoded,
    Formula,
    Part,
    Parts,
    as_set,
    both,
    chosen,
    either,
    equal,
    negated,
    same,
    selected,
    total,
    truth,
)
from golc.proofs.rigid import is_open
from golc.proofs.symbols import NotDecidedError
from golc.proofs.values import Values, evaluated
from golc.theory.border import PythonFunction, extern_value
from golc.theory.fitting import size, strip_optional
from golc.theory.terms import (
    Binder,
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
    Variable,
)
from golc.theory.theory import BasicActionTheory, Parameter, Static
from golc.theory.types import INT, REAL, Type, Value

MOST_INSTANCES = 20_000
"""How many instances of quantifiers and of calls are written out for one question."""
MOST_TERMS = 10_000
"""How many terms one question may have; those of a definition count each time that it is used."""

DEEPEST = 30
"""How many calls of static functions may be open."""

COUNTING = {Operator.LENGTH, Operator.REST, Operator.INDEX, Operator.EQUAL, Operator.DIFFERENT}
"""What tells lists apart by more than what is in them, and which of that comes first."""

TOO_LONG = "the formula is too long for a solver"

Env: TypeAlias = tuple[Encoded, ...]
Read: TypeAlias = Callable[[str, Sequence[Encoded]], Encoded]
"""The value of a fluent for arguments, in some situation."""


class Encoder(Values):
    """The terms of one theory. Raises ``NotDecidedError`` for what it has no encoding for."""

    def __init__(self, theory: BasicActionTheory) -> None:
        super().__init__(theory)
        self._read: dict[tuple[str, tuple[Any, ...]], tuple[tuple[Any, ...], Encoded, bool]] = {}
        self._instances = 0
        self._depth = 0
        self._terms = 0

    def fluent(self, name: str, args: Sequence[Encoded]) -> Encoded:
        """A fluent now."""
        fluent = self.theory.fluents[name]
        places = tuple([self.place(arg, p.type) for arg, p in zip(args, fluent.parameters, strict=True)])
        key = (name, tuple([part.sexpr() if z3.is_expr(part) else part for part in places]))
        if key not in self._read:
            before, self.shortened = self.shortened, False
            found = self.of_type(name, fluent.type, places)
            self._read[key] = places, found, self.shortened
            self.shortened = before
        _, value, short = self._read[key]
        self.shortened |= short
        return value

    def sizes(self, variables: Env) -> list[Any]:
        """What is large in the fluents that were read, and in some variables: the unknown integers, the numbers of
        elements, and the integers among these."""
        found: list[Any] = []
        waiting: list[tuple[Encoded, Formula]] = [(value, True) for _, value, _ in self._read.values()]
        waiting += [(value, True) for value in variables]
        while waiting:
            value, there = waiting.pop()
            if isinstance(value.kind, int) and value.kind == NUMBER and z3.is_int(value.number):
                found.append(chosen(there, value.number, 0))
            if value.parts is not None:
                found += [chosen(both(there, part.there), 1, 0) for part in value.parts.all]
                waiting += [(part.element, both(there, part.there)) for part in value.parts.all]
        return found

    def values(self, model: Any) -> dict[tuple[str, tuple[Value, ...]], Value]:
        """The values of the ground fluents that were read, in a model of the solver."""
        found = {}
        for (name, _), (places, value, _) in self._read.items():
            types = [parameter.type for parameter in self.theory.fluents[name].parameters]
            at = [evaluated(place, model) for place in places]
            if all(0 <= index < size(type_) for index, type_ in zip(at, types, strict=True)):
                args = tuple([type_.values[index] for index, type_ in zip(at, types, strict=True)])
                found[name, args] = self.decoded(value, model)
        return found

    def term(self, term: Term, env: Env, read: Read) -> Encoded:
        """A term in the situation in which fluents are read."""
        self._terms += 1
        if self._terms > MOST_TERMS:
            raise NotDecidedError(TOO_LONG)
        match term:
            case Literal(value=value, type=type_):
                return self.literal(value, strip_optional(type_))
            case Variable(level=level):
                return env[level]
            case FluentTerm(fluent=name, args=args):
                values, ok = self._arguments(self.theory.fluents[name].parameters, args, env, read)
                return with_ok(read(name, values), ok)
            case DefinedTerm(definition=name, args=args):
                definition = self.theory.definitions[name]
                values, ok = self._arguments(definition.parameters, args, env, read)
                return with_ok(self.term(definition.body, values, read), ok)
            case PossTerm(action=name, args=args):
                action = self.theory.actions[name]
                values, ok = self._arguments(action.parameters, args, env, read)
                parts = [self.term(condition, values, read) for condition in action.preconditions]
                return with_ok(conjunction(parts), ok)
            case StaticTerm():
                return self._static(term, env, read)
            case Membership(element=element, within=within):
                value = self.term(element, env, read)
                return truth(self.within(value, within), value.ok)
            case Quantified():
                return self._quantified(term, env, read)
            case Epistemic():
                return self._epistemic(term, env, read)
            case Operation(op=op, args=args):
                values = tuple([self.term(arg, env, read) for arg in args])
                self.shortened |= op in COUNTING and _are_counted(values)
                return calculated(term, values, self.literal)
            case Display(elements=elements):
                listed = [self.term(element, env, read) for element in elements]
                return _collection(
                    term.type, [Part(element, True) for element in listed], both(*[element.ok for element in listed])
                )
            case Comprehension():
                return self._comprehension(term, env, read)
            case _:
                raise NotDecidedError("texts are put together")

    def environments(self, binders: Sequence[Binder], env: Env, read: Read) -> Iterator[tuple[Env, Formula, Formula]]:
        """The environments that binders make, each with whether it is one and whether that has an answer."""
        if not binders:
            self._instances += 1
            if self._instances > MOST_INSTANCES:
                raise NotDecidedError(f"quantifiers have more than {MOST_INSTANCES} instances")
            yield env, True, True
            return
        for element, there, ok in self._elements(binders[0], env, read):
            for inner, is_one, has_answer in self.environments(binders[1:], (*env, element), read):
                yield inner, both(there, is_one), both(ok, either(negated(there), has_answer))

    def _elements(self, binder: Binder, env: Env, read: Read) -> Iterator[tuple[Encoded, Formula, Formula]]:
        if binder.within is None:
            for value in binder.variable.type.values:
                yield self.literal(value), True, True
            return
        within = self.term(binder.within, env, read)
        ok = both(within.ok, negated(equal(within.kind, NONE)))
        parts = distinct(parts_of(within))
        for element, there in parts:
            yield element, there, ok
        if ok is not True:
            yield Encoded(NONE, 0), False, ok  # so that it is known that it fails, whether or not there are elements

    def _comprehension(self, term: Comprehension, env: Env, read: Read) -> Encoded:
        parts, oks = [], []
        for inner, is_one, has_answer in self.environments(term.binders, env, read):
            where = truth(True) if term.where is None else self.term(term.where, inner, read)
            there = both(is_one, where.truth)
            element = self.term(term.element, inner, read) if there is not False else Encoded(NONE, 0)
            oks += [has_answer, either(negated(is_one), where.ok), either(negated(there), element.ok)]
            parts += [Part(element, there)] if there is not False else []
        if "list" in term.type.kinds and any(_runs_over(binder, "set") for binder in term.binders):
            raise NotDecidedError("a list is made of a set")
        return _collection(term.type, parts, both(*oks))

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
                here = self.literal(value, strip_optional(static.type))
                found = here if found is None else selected(fits, here, found)
            assert found is not None
            return with_ok(found, ok)
        if isinstance(static.body, PythonFunction):
            return self._extern(static, values, ok)
        if self._depth >= DEEPEST:
            raise NotDecidedError(f"the recursion of `{static.name}` is followed")
        self._depth += 1
        try:
            value = self.term(static.body, values, read)
        finally:
            self._depth -= 1
        return with_ok(value, both(ok, self.within(value, static.type)))

    def _extern(self, static: Static, args: Env, ok: Formula) -> Encoded:
        """A function of Python, as a table; if it is not executed, or has too many arguments, any function."""
        types = [parameter.type for parameter in static.parameters]
        few = all(type_.finite for type_ in types) and math.prod(map(size, types)) <= MOST_INSTANCES
        if is_open(static) or not few:
            return with_ok(self._any_function(static, args), ok)
        found = Encoded(NUMBER, 0)
        for key in itertools.product(*[type_.values for type_ in types]):
            fits = both(*[same(arg, self.literal(value)) for arg, value in zip(args, key, strict=True)])
            try:
                found = selected(
                    fits, self.literal(extern_value(static, key, static.span), strip_optional(static.type)), found
                )
            except ProgramError:
                ok = both(ok, negated(fits))
        return with_ok(found, ok)

    def _any_function(self, static: Static, args: Env) -> Encoded:
        """What any function of the declared types gives for arguments: for the same ones the same value."""
        places: list[Any] = []
        for arg, parameter in zip(args, static.parameters, strict=True):
            if parameter.type.finite:
                places.append(self.place(arg, parameter.type))
            elif strip_optional(parameter.type) == INT:
                is_none = equal(arg.kind, NONE)
                places += [chosen(is_none, 1, 0), chosen(is_none, 0, arg.number)]
            else:
                raise NotDecidedError(f"`{static.name}` has arguments that are no places in a table")
        return self.of_type(static.name, static.type, tuple(places))

    def _epistemic(self, term: Epistemic, env: Env, read: Read) -> Encoded:
        guess = z3.Bool(self.fresh("known"))
        if term.kind == "known":
            return truth(guess)
        body = self.term(term.body, env, read)
        return truth(both(body.truth, guess) if term.kind == "knows" else either(body.truth, guess), body.ok)

    def _quantified(self, term: Quantified, env: Env, read: Read) -> Encoded:
        cases: list[tuple[Formula, Encoded]] = []
        oks: list[Formula] = []
        for inner, is_one, has_answer in self.environments(term.binders, env, read):
            where = truth(True) if term.where is None else self.term(term.where, inner, read)
            applies = both(is_one, where.truth)
            ok = both(has_answer, either(negated(is_one), where.ok))
            body = self.term(term.body, inner, read) if applies is not False else truth(False)
            if applies is not False or ok is not True:
                cases.append((applies, body))
                oks.append(both(ok, either(negated(applies), body.ok)))
        self.shortened |= term.kind in ("count", "sum") and any(_runs_over(binder, "list") for binder in term.binders)
        match term.kind:
            case "exists" | "forall":
                parts = [_case(term.kind, where, body, ok) for (where, body), ok in zip(cases, oks, strict=True)]
                return disjunction(parts) if term.kind == "exists" else conjunction(parts)
            case "count":
                return Encoded(NUMBER, total([chosen(both(w, body.truth), 1, 0) for w, body in cases]), both(*oks))
            case "sum":
                return Encoded(NUMBER, total([chosen(w, body.number, 0) for w, body in cases]), both(*oks))
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


def _collection(type_: Type, parts: Sequence[Part], ok: Formula) -> Encoded:
    return collection(as_set(parts) if "set" in type_.kinds else Parts(True, tuple(parts)), ok)


def _runs_over(binder: Binder, kind: str) -> bool:
    return binder.within is not None and kind in binder.within.type.kinds


def _are_counted(values: Sequence[Encoded]) -> bool:
    """Whether there are lists of which it matters how often they have an element; not for one that is empty or not."""
    lists = [value.parts for value in values if value.parts is not None and value.parts.ordered]
    return all(parts.all for parts in lists) and any(part.there is not True for parts in lists for part in parts.all)


def _case(kind: str, where: Formula, body: Encoded, ok: Formula) -> Encoded:
    holds = both(where, body.truth) if kind == "exists" else either(negated(where), body.truth)
    return truth(holds, ok)
