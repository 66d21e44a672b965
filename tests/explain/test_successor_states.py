"""A successor state axiom says of every ground fluent, state and ground action what progression makes of it.

The evaluator below reads the axiom's structure; it knows nothing of the code that compiles and evaluates terms.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import product
from pathlib import Path
from random import Random
from types import MappingProxyType
from typing import Any

import pytest

from golc.diagnostics import ProgramError
from golc.explain.axioms import Cause, SuccessorState, successor_state
from golc.loading import load
from golc.situation.dynamics import Dynamics
from golc.theory import terms as t
from golc.theory.border import PythonFunction
from golc.theory.theory import BasicActionTheory
from golc.theory.types import Collection, Type, Value

ROOT = Path(__file__).parents[2]
EXAMPLES = [
    ROOT / "examples" / "delivery" / "delivery.gl",
    ROOT / "examples" / "elevator" / "elevator.gl",
    ROOT / "examples" / "sorter" / "sorter.gl",
    ROOT / "tests" / "programs" / "lift.gl",
    ROOT / "examples" / "elevator" / "reactive.gl",
]
SMALL = range(-12, 13)
"""The integers that are tried where a type has all of them."""

MIXED = """type side = {left, right}
type floor = 1..4
static other(x: side): side = {left: right, right: left}
static twice(n: int): int = n + n
define low(n: floor) := level(n) < 2
fluent level(n: floor): floor = n
fluent on(x: side, n: floor) = n = 2
fluent ready = true
fluent target(x: side): floor? = none
fluent total: int = 0
action reset
action press(x: side, n: floor):
    poss ready
    causes on(other(x), n) := not on(x, n)
    causes ready := exists m: floor. on(x, m) and m != n
    causes total := total + twice(n) when poss(press(x, n))
action copy(n: 1..3, m: floor):
    causes level(n) := level(n + 1) when n + 1 != m
    causes forall k: floor where k > n. level(k) := m if low(k) else level(k)
    causes target(left) := n
    causes forall x: side, k: 2..3 where k = m. on(x, k) := x = left
exog set_to(x: side, n: int):
    causes total := n
    causes target(x) := none when n < 0
    causes target(x) := n when n in floor
    causes level(max(1, min(n, 4))) := count k: floor where on(x, k). k > 0
axiom spare(x, n):
    after copy(x, n) := 1
    after copy(y, 2) := 2 when y != x
    after copy(3, m) := m when m > n
    after reset := min(x, n)
    otherwise unchanged
fluent spare(x: 1..2, n: 1..4): floor = x
"""

UNCERTAIN = """type door = {open, closed}
type side = {left, right}
fluent gate(s: side): door = closed
fluent lit(s: side) = false
fluent times: 0..3 = 0
action shake(s: side):
    causes gate(s) := unknown when times < 3
    causes lit(s) := one of {true, false}
    causes times := one of {times, 3 - times}
action slam:
    causes forall s: side. gate(s) := one of {closed} when lit(s)
    causes lit(left) := one of {lit(right), gate(left) = open}
    causes lit(right) := unknown
fluent at(s: side): 1..4 = 1
axiom at(s):
    after shake(s) := one of {1, 4}
    after shake(other) := unknown when times = 1
    otherwise unchanged
"""

COLLECTIONS = """type side = {left, right}
fluent seen: set[side] = {}
fluent route: list[side] = []
fluent mark(x: side) = false
action go(x: side):
    causes seen := seen + {y for y: side where y != x and mark(y)} - {x} when len(route) < 2
    causes route := route + [x] when x not in route
action turn:
    causes forall x in route. mark(x) := x in seen
    causes route := [y for y in seen where mark(y)]
action put(l: list[side], s: set[side]):
    causes route := l
    causes seen := one of [s, {}]
"""

Values = tuple[Value, ...]
AGGREGATES: dict[str, Callable[..., Any]] = {
    "exists": any,
    "forall": all,
    "count": sum,
    "sum": sum,
    "min": min,
    "max": max,
}


class Reading:
    """What terms are in a state."""

    def __init__(self, theory: BasicActionTheory, state: Mapping[tuple[str, Values], Value]) -> None:
        self.theory = theory
        self.state = state

    def __call__(self, term: t.Term, scope: Values) -> Any:
        match term:
            case t.Literal(value=value):
                return value
            case t.Variable(level=level):
                return scope[level]
            case t.FluentTerm(fluent=name, args=args):
                return self.state[name, self.all(args, scope)]
            case t.StaticTerm(static=name, args=args):
                body, values = self.theory.statics[name].body, self.all(args, scope)
                assert not isinstance(body, PythonFunction)
                return body[values] if isinstance(body, Mapping) else self(body, values)
            case t.DefinedTerm(definition=name, args=args):
                return self(self.theory.definitions[name].body, self.all(args, scope))
            case t.PossTerm(action=name, args=args):
                values = self.all(args, scope)
                return all(self(part, values) for part in self.theory.actions[name].preconditions)
            case t.Membership(element=element, within=within):
                return self(element, scope) in within
            case t.Operation(op=op, args=args):
                return self.operation(op, args, scope)
            case t.Quantified(kind=kind, binders=binders, where=where, body=body):
                bound = [values for values in self.bindings(binders, scope) if where is None or self(where, values)]
                found = [self(body, values) for values in bound]
                return AGGREGATES[kind](found)
            case t.Display(elements=elements):
                return collected(term.type, self.all(elements, scope))
            case t.Comprehension(binders=binders, where=where, element=element):
                bound = [values for values in self.bindings(binders, scope) if where is None or self(where, values)]
                return collected(term.type, [self(element, values) for values in bound])
        raise AssertionError(term)

    def all(self, terms: tuple[t.Term, ...], scope: Values) -> Values:
        return tuple([self(term, scope) for term in terms])

    def bindings(
        self, binders: tuple[t.Binder, ...], scope: Values, known: Mapping[int, Value] = MappingProxyType({})
    ) -> Iterator[Values]:
        scopes = [scope]
        for binder in binders:
            scopes = [(*outer, value) for outer in scopes for value in self.range(binder, outer, known)]
        yield from scopes

    def range(self, binder: t.Binder, scope: Values, known: Mapping[int, Value]) -> list[Value]:
        if binder.variable.level in known:
            return [known[binder.variable.level]]
        if binder.within is None:
            return possible(binder.variable.type)
        elements = self(binder.within, scope)
        in_order = isinstance(elements, tuple)
        return list(elements) if in_order else sorted(elements, key=possible(binder.variable.type).index)

    def operation(self, op: t.Operator, args: tuple[t.Term, ...], scope: Values) -> Any:
        match op, args:
            case t.Operator.AND, _:
                return all(self(arg, scope) for arg in args)
            case t.Operator.OR, _:
                return any(self(arg, scope) for arg in args)
            case t.Operator.CONDITIONAL, (then, condition, otherwise):
                return self(then if self(condition, scope) else otherwise, scope)
        values: Any = self.all(args, scope)
        operations: dict[t.Operator, Callable[..., Any]] = {
            t.Operator.NOT: lambda a: not a,
            t.Operator.EQUAL: lambda a, b: a == b,
            t.Operator.DIFFERENT: lambda a, b: a != b,
            t.Operator.LESS: lambda a, b: a < b,
            t.Operator.LESS_EQUAL: lambda a, b: a <= b,
            t.Operator.GREATER: lambda a, b: a > b,
            t.Operator.GREATER_EQUAL: lambda a, b: a >= b,
            t.Operator.ADD: lambda a, b: a + b,
            t.Operator.SUBTRACT: lambda a, b: a - b,
            t.Operator.NEGATE: lambda a: -a,
            t.Operator.ABSOLUTE: abs,
            t.Operator.MINIMUM: min,
            t.Operator.MAXIMUM: max,
            t.Operator.ELEMENT: lambda a, b: a in b,
            t.Operator.UNION: lambda a, b: a | b,
            t.Operator.DIFFERENCE: lambda a, b: a - b,
            t.Operator.CONCATENATION: lambda a, b: a + b,
            t.Operator.LENGTH: len,
        }
        return operations[op](*values)

    def caused(self, cause: Cause, action: str, args: Values, scope: Values) -> bool:
        """Whether a cause holds of a ground action; its own variables can only be what makes the actions equal."""
        if cause.action != action:
            return False
        own = {term.level: value for term, value in zip(cause.args, args, strict=True) if isinstance(term, t.Variable)}
        for inner in self.bindings(tuple(map(t.Binder, cause.variables)), scope, own):
            if self.all(cause.args, inner) == args and all(self(part, inner) for part in cause.conditions):
                return True
        return False

    def after(self, axiom: SuccessorState, action: str, args: Values, of: Values) -> Sequence[Value]:
        """The values that the axiom allows a ground fluent after a ground action."""
        before = self.state[axiom.fluent.name, of]
        if axiom.value is None:
            gains = any(self.caused(cause, action, args, of) for cause in axiom.gains)
            losses = any(self.caused(cause, action, args, of) for cause in axiom.losses)
            may_hold = gains or (before is True and not losses)
            may_fail = losses or (before is False and not gains)
            return [True] * may_hold + [False] * may_fail
        candidates = possible(axiom.fluent.type)
        becomes = [y for y in candidates if any(self.caused(c, action, args, (*of, y)) for c in axiom.gains)]
        return [y for y in candidates if y in becomes or (y == before and not becomes)]


def collected(type_: Type, elements: Iterable[Value]) -> Value:
    return frozenset(elements) if isinstance(type_, Collection) and type_.kind == "set" else tuple(elements)


def possible(type_: Type) -> list[Value]:
    """The values of a type; of a list those with two elements at most, of the integers small ones."""
    if isinstance(type_, Collection):
        tuples = [each for length in range(3) for each in product(type_.element.values, repeat=length)]
        return list(dict.fromkeys(collected(type_, each) for each in tuples))
    return list(type_.values) if type_.finite else list(SMALL)


def agree(theory: BasicActionTheory, random: Random, rounds: int) -> int:
    """Compare the axioms with progression in random states; in how many it was possible."""
    dynamics = Dynamics(theory)
    axioms = {name: successor_state(theory, fluent) for name, fluent in theory.fluents.items()}
    ground = dynamics.layout.ground_fluents
    slots = list(enumerate(ground))
    compared = 0
    for _ in range(rounds):
        state = tuple([random.choice(possible(theory.fluents[name].type)) for _, (name, _) in slots])
        action = random.choice(list(theory.actions.values()))
        args = tuple([random.choice(possible(parameter.type)) for parameter in action.parameters])
        try:
            after = dynamics.progress(state, action.name, args)
        except ProgramError:
            continue  # conflicting effects, or a value outside its type
        worlds = [after] if isinstance(after, tuple) else list(after)
        if any(
            world[place] not in possible(theory.fluents[name].type) for world in worlds for place, (name, _) in slots
        ):
            continue  # an integer that is not among those tried
        reading = Reading(theory, dict(zip(ground, state, strict=True)))
        allowed = [reading.after(axioms[name], action.name, args, of) for _, (name, of) in slots]
        assert set(worlds) == set(product(*allowed)), (action.name, args)
        compared += 1
    return compared


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_axioms_of_the_examples_say_what_progression_does(path: Path) -> None:
    assert agree(load(path), Random(1), 150) > 100


@pytest.mark.parametrize("seed", range(4))
def test_the_axioms_of_a_theory_with_every_kind_of_effect_say_what_progression_does(
    seed: int, theory: Callable[[str], BasicActionTheory]
) -> None:
    assert agree(theory(MIXED), Random(seed), 150) > 100


def test_the_axioms_of_collections_say_what_progression_does(theory: Callable[[str], BasicActionTheory]) -> None:
    assert agree(theory(COLLECTIONS), Random(7), 200) > 100


def test_an_axiom_allows_what_an_uncertain_effect_leaves_open(theory: Callable[[str], BasicActionTheory]) -> None:
    assert agree(theory(UNCERTAIN), Random(5), 150) > 100
