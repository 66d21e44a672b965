"""The generated code says what the tree interpreter says, on random theories, states, actions and terms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import ProgramError, Source
from golc.situation.dynamics import Dynamics
from golc.theory.terms import (
    Binder,
    DefinedTerm,
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
from golc.theory.theory import Action, BasicActionTheory, Definition, Effect, Fluent, Parameter, Static
from golc.theory.types import BOOL, INT, Enumeration, Interval, Optional, Type, Value

SMALL = Interval(0, 3, "small")
WIDE = Interval(-2, 5, "wide")
COLOUR = Enumeration((("red", "colour"), ("green", "colour"), ("blue", "colour")), "colour")
TYPES: list[Type] = [BOOL, SMALL, WIDE, COLOUR, Optional(SMALL), Optional(COLOUR)]
FINITE_PARAMETERS = [(), (SMALL,), (COLOUR,), (COLOUR, SMALL), (Optional(SMALL),)]

Draw = Callable[[st.SearchStrategy[Any]], Any]


@dataclass
class Vocabulary:
    """What terms may speak of: names with parameter types and value type."""

    fluents: dict[str, tuple[tuple[Type, ...], Type]]
    statics: dict[str, tuple[tuple[Type, ...], Type]]
    definitions: dict[str, tuple[tuple[Type, ...], Type]]
    actions: dict[str, tuple[Type, ...]]


def sort_of(type_: Type) -> str:
    """``bool``, ``int`` or ``colour``: what a type's values are, ``none`` apart."""
    kinds = type_.kinds - {"none"}
    return "colour" if "symbol:colour" in kinds else next(iter(kinds))


@st.composite
def terms(draw: Draw, sort: str, words: Vocabulary, scope: tuple[Type, ...], depth: int = 3) -> Term:
    """A well-sorted term; whether its values stay inside the types is left to chance, as in real theories."""

    def sub(wanted: str, inner: tuple[Type, ...] = scope) -> Term:
        term: Term = draw(terms(wanted, words, inner, depth - 1))
        return term

    def args(types: tuple[Type, ...]) -> tuple[Term, ...]:
        return tuple(sub(sort_of(type_)) for type_ in types)

    choices: list[Callable[[], Term]] = [lambda: draw(literals(sort))]
    choices += [
        lambda level=level, type_=type_: Variable(level, f"x{level}", type=type_)  # type: ignore[misc]
        for level, type_ in enumerate(scope)
        if sort_of(type_) == sort
    ]
    if depth > 0:
        for table, make in ((words.fluents, FluentTerm), (words.statics, StaticTerm), (words.definitions, DefinedTerm)):
            for name, (types, type_) in table.items():
                if sort_of(type_) == sort:
                    choices.append(lambda n=name, ts=types, t=type_, mk=make: mk(n, args(ts), type=t))  # type: ignore[misc]
        choices.append(
            lambda: Operation(Operator.CONDITIONAL, (sub(sort), sub("bool"), sub(sort)), type=whole_type(sort))
        )
        if sort == "bool":
            choices += formulas(draw, sub, args, words, scope)
        if sort == "int":
            choices += numbers(draw, sub, scope)
    term: Term = draw(st.sampled_from(choices))()
    return term


def whole_type(sort: str) -> Type:
    return {"bool": BOOL, "int": INT, "colour": Optional(COLOUR)}[sort] if sort != "int" else Optional(INT)


def literals(sort: str) -> st.SearchStrategy[Literal]:
    match sort:
        case "bool":
            return st.booleans().map(lambda v: Literal(v, type=BOOL))
        case "int":
            return st.integers(-3, 6).map(lambda v: Literal(v, type=Interval(v, v)))
        case _:
            return st.sampled_from(COLOUR.values).map(lambda v: Literal(v, type=COLOUR))


def formulas(
    draw: Draw, sub: Callable[..., Term], args: Callable[..., Any], words: Vocabulary, scope: tuple[Type, ...]
) -> list[Callable[[], Term]]:
    def comparison() -> Term:
        sort = draw(st.sampled_from(["int", "colour", "bool"]))
        return Operation(draw(st.sampled_from([Operator.EQUAL, Operator.DIFFERENT])), (sub(sort), sub(sort)), type=BOOL)

    def ordered() -> Term:
        op = draw(st.sampled_from([Operator.LESS, Operator.LESS_EQUAL, Operator.GREATER, Operator.GREATER_EQUAL]))
        if draw(st.booleans()):
            return Operation(op, (sub("colour"), sub("colour")), order=tuple(COLOUR.values), type=BOOL)
        return Operation(op, (sub("int"), sub("int")), type=BOOL)

    def connected() -> Term:
        op = draw(st.sampled_from([Operator.AND, Operator.OR, Operator.IMPLIES, Operator.IFF]))
        return Operation(op, (sub("bool"), sub("bool")), type=BOOL)

    def possible() -> Term:
        name = draw(st.sampled_from(sorted(words.actions)))
        return PossTerm(name, args(words.actions[name]), type=BOOL)

    choices: list[Callable[[], Term]] = [
        comparison,
        ordered,
        connected,
        lambda: Operation(Operator.NOT, (sub("bool"),), type=BOOL),
        lambda: Membership(sub("int"), draw(st.sampled_from([SMALL, WIDE, Optional(SMALL)])), type=BOOL),
        lambda: quantified(draw, sub, scope, draw(st.sampled_from(["exists", "forall"])), "bool"),
    ]
    return [*choices, possible] if words.actions else choices


def numbers(draw: Draw, sub: Callable[..., Term], scope: tuple[Type, ...]) -> list[Callable[[], Term]]:
    binary = [Operator.ADD, Operator.SUBTRACT, Operator.MULTIPLY, Operator.DIVIDE, Operator.MODULO]
    unary = [Operator.NEGATE, Operator.ABSOLUTE]
    return [
        lambda: Operation(draw(st.sampled_from(binary)), (sub("int"), sub("int")), type=INT),
        lambda: Operation(draw(st.sampled_from(unary)), (sub("int"),), type=INT),
        lambda: Operation(
            draw(st.sampled_from([Operator.MINIMUM, Operator.MAXIMUM])), (sub("int"), sub("int")), type=INT
        ),
        lambda: quantified(draw, sub, scope, "count", "bool"),
        lambda: quantified(draw, sub, scope, "sum", "whole"),
        lambda: quantified(draw, sub, scope, draw(st.sampled_from(["min", "max"])), "whole"),
    ]


def quantified(draw: Draw, sub: Callable[..., Term], scope: tuple[Type, ...], kind: Any, body_sort: str) -> Term:
    types = draw(st.lists(st.sampled_from([SMALL, COLOUR, BOOL, Interval(1, 60)]), min_size=1, max_size=2))
    inner = (*scope, *types)
    binders = tuple(Binder(Variable(len(scope) + index, f"b{index}", type=type_)) for index, type_ in enumerate(types))
    where = sub("bool", inner) if draw(st.booleans()) else None
    if body_sort == "whole":
        body: Term = Operation(Operator.ABSOLUTE, (sub("int", inner),), type=INT)
    else:
        body = sub(body_sort, inner)
    return Quantified(kind, binders, where, body, type=INT if kind in ("count", "sum", "min", "max") else BOOL)


@st.composite
def theories(draw: Draw) -> BasicActionTheory:
    """A theory in which everything may refer to what was made before it."""
    words = Vocabulary({}, {}, {}, {})

    def parameters(types: tuple[Type, ...]) -> tuple[Parameter, ...]:
        return tuple(Parameter(f"x{index}", type_) for index, type_ in enumerate(types))

    statics, fluents, definitions, actions = {}, {}, {}, {}
    for index in range(draw(st.integers(0, 2))):
        types, type_ = draw(st.sampled_from(FINITE_PARAMETERS)), draw(st.sampled_from(TYPES))
        body = draw(terms(sort_of(type_), words, types, 2))
        statics[f"s{index}"] = Static(f"s{index}", parameters(types), type_, body)
        words.statics[f"s{index}"] = (types, type_)
    for index in range(draw(st.integers(1, 4))):
        types, type_ = draw(st.sampled_from(FINITE_PARAMETERS)), draw(st.sampled_from([*TYPES, INT]))
        initial = Literal(draw(st.sampled_from(list(type_.values) if type_.finite else [0, 7, -1])), type=type_)
        fluents[f"f{index}"] = Fluent(f"f{index}", parameters(types), type_, initial)
        words.fluents[f"f{index}"] = (types, type_)
    for index in range(draw(st.integers(0, 2))):
        types, type_ = draw(st.sampled_from(FINITE_PARAMETERS)), draw(st.sampled_from([BOOL, INT]))
        body = draw(terms(sort_of(type_), words, types, 2))
        definitions[f"d{index}"] = Definition(f"d{index}", parameters(types), body.type, body)
        words.definitions[f"d{index}"] = (types, body.type)
    for index in range(draw(st.integers(1, 3))):
        types = draw(st.sampled_from([(), (SMALL,), (COLOUR, SMALL)]))
        actions[f"a{index}"] = draw(action(f"a{index}", types, words))
        words.actions[f"a{index}"] = types
    return BasicActionTheory(
        "random", Source("random", ""), {}, {"colour": COLOUR}, statics, fluents, definitions, actions, {}, ()
    )


@st.composite
def action(draw: Draw, name: str, types: tuple[Type, ...], words: Vocabulary) -> Action:
    effects = []
    for _ in range(draw(st.integers(0, 3))):
        binders: tuple[Binder, ...] = ()
        scope = types
        if draw(st.booleans()):
            binders = (Binder(Variable(len(types), "y", type=draw(st.sampled_from([SMALL, COLOUR])))),)
            scope = (*types, binders[0].variable.type)
        fluent = draw(st.sampled_from(sorted(words.fluents)))
        of, type_ = words.fluents[fluent]
        condition = draw(terms("bool", words, scope, 1)) if draw(st.booleans()) else None
        args = tuple(draw(terms(sort_of(t), words, scope, 1)) for t in of)
        value = draw(terms(sort_of(type_), words, scope, 2))
        effects.append(Effect(binders, None, fluent, args, value, condition))
    preconditions = tuple(draw(terms("bool", words, types, 2)) for _ in range(draw(st.integers(0, 2))))
    parameters = tuple(Parameter(f"x{index}", type_) for index, type_ in enumerate(types))
    return Action(name, parameters, False, preconditions, tuple(effects), (), None)


def outcome(compute: Callable[[], Any]) -> Any:
    """A value, or the code and message of the error in its place."""
    try:
        return compute()
    except ProgramError as error:
        return error.diagnostic.code, error.diagnostic.message


def vocabulary(theory: BasicActionTheory) -> Vocabulary:
    def types(parameters: tuple[Parameter, ...]) -> tuple[Type, ...]:
        return tuple(parameter.type for parameter in parameters)

    return Vocabulary(
        {f.name: (types(f.parameters), f.type) for f in theory.fluents.values()},
        {s.name: (types(s.parameters), s.type) for s in theory.statics.values()},
        {d.name: (types(d.parameters), d.type) for d in theory.definitions.values()},
        {a.name: types(a.parameters) for a in theory.actions.values()},
    )


def random_state(data: st.DataObject, dynamics: Dynamics) -> tuple[Value, ...]:
    values = []
    for name, _ in dynamics.layout.ground_fluents:
        type_ = dynamics.theory.fluents[name].type
        values.append(data.draw(st.sampled_from(list(type_.values)) if type_.finite else st.integers(-4, 9)))
    return tuple(values)


@given(theories(), st.data())
def test_a_compiled_term_has_the_value_that_its_tree_has(theory: BasicActionTheory, data: st.DataObject) -> None:
    dynamics = Dynamics(theory)
    state = random_state(data, dynamics)
    scope: tuple[Type, ...] = (SMALL, COLOUR)
    env = (data.draw(st.sampled_from(list(SMALL.values))), data.draw(st.sampled_from(list(COLOUR.values))))
    term = data.draw(terms(data.draw(st.sampled_from(["bool", "int", "colour"])), vocabulary(theory), scope, 4))
    compiled = dynamics.compiler.term(term, len(scope))
    assert outcome(lambda: compiled(state, env)) == outcome(lambda: dynamics.interpreter.evaluate(term, state, env))


@given(theories(), st.data())
def test_compiled_actions_do_what_their_axioms_say(theory: BasicActionTheory, data: st.DataObject) -> None:
    dynamics = Dynamics(theory)
    state = random_state(data, dynamics)
    for action in theory.actions.values():
        args = tuple(data.draw(st.sampled_from(list(parameter.type.values))) for parameter in action.parameters)
        assert outcome(lambda a=action, v=args: dynamics.possible(state, a.name, v)) == outcome(  # type: ignore[misc]
            lambda a=action, v=args: dynamics.interpreter.possible(a, state, v)  # type: ignore[misc]
        )
        assert outcome(lambda a=action, v=args: dynamics.progress(state, a.name, v)) == outcome(  # type: ignore[misc]
            lambda a=action, v=args: dynamics.interpreter.progress(a, state, v)  # type: ignore[misc]
        )
