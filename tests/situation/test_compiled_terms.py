"""The generated code says what the tree interpreter says, on random theories, states, actions and terms."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from golc.diagnostics import ProgramError, Source
from golc.situation.dynamics import Dynamics
from golc.situation.happened import Happened
from golc.theory.terms import (
    Before,
    Binder,
    Comprehension,
    DefinedTerm,
    Display,
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
)
from golc.theory.theory import Action, BasicActionTheory, Definition, Effect, Fluent, Parameter, Static
from golc.theory.types import BOOL, INT, REAL, STRING, Collection, Enumeration, Interval, Optional, Type, Value

SMALL = Interval(0, 3, "small")
WIDE = Interval(-2, 5, "wide")
COLOUR = Enumeration((("red", "colour"), ("green", "colour"), ("blue", "colour")), "colour")
NUMBERS = Collection("set", SMALL)
PATH = Collection("list", COLOUR)
COLLECTIONS = [
    NUMBERS,
    PATH,
    Collection("set", COLOUR),
    Collection("list", INT),
    Collection("list", NUMBERS),
    Collection("set", NUMBERS),
    Optional(PATH),
]
TYPES: list[Type] = [BOOL, SMALL, WIDE, COLOUR, Optional(SMALL), Optional(COLOUR), REAL, STRING, *COLLECTIONS]
FINITE_PARAMETERS = [(), (SMALL,), (COLOUR,), (COLOUR, SMALL), (Optional(SMALL),)]
PARAMETERS = [*FINITE_PARAMETERS, (NUMBERS,), (PATH, INT), (Optional(PATH), REAL)]
SORTS = ["bool", "int", "colour", "real", "string"]

Draw = Callable[[st.SearchStrategy[Any]], Any]


@dataclass
class Vocabulary:
    """What terms may speak of: names with parameter types and value type."""

    fluents: dict[str, tuple[tuple[Type, ...], Type]]
    statics: dict[str, tuple[tuple[Type, ...], Type]]
    definitions: dict[str, tuple[tuple[Type, ...], Type]]
    actions: dict[str, tuple[Type, ...]]


def sort_of(type_: Type) -> str:
    """``bool``, ``int``, ``set int``, …: what a type's values are, ``none`` apart."""
    base = type_.base if isinstance(type_, Optional) else type_
    if isinstance(base, Collection):
        return f"{base.kind} {sort_of(base.element)}"
    if base == REAL:
        return "real"
    return "colour" if "symbol:colour" in base.kinds else next(iter(base.kinds))


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
        if sort in ("int", "real"):
            choices += numbers(draw, sub, scope, sort)
        if sort == "string":
            choices.append(lambda: Text(("is ", sub(draw(sorts())), "!"), type=STRING))
        choices += collections(draw, sub, scope, sort)
    term: Term = draw(st.sampled_from(choices))()
    return term


def whole_type(sort: str) -> Type:
    """The type of any term of a sort."""
    kind, _, element = sort.partition(" ")
    if kind == "set":
        return Optional(Collection("set", whole_type(element)))
    if kind == "list":
        return Optional(Collection("list", whole_type(element)))
    return {"bool": BOOL, "string": STRING, "int": Optional(INT), "real": Optional(REAL), "colour": Optional(COLOUR)}[
        sort
    ]


def sorts() -> st.SearchStrategy[str]:
    return st.sampled_from([*SORTS, *map(sort_of, COLLECTIONS)])


def literals(sort: str) -> st.SearchStrategy[Literal]:
    return values(sort).map(lambda value: Literal(value, type=literal_type(sort, value)))


def literal_type(sort: str, value: Value) -> Type:
    if sort == "int" and isinstance(value, int):
        return Interval(value, value)
    return COLOUR if sort == "colour" else whole_type(sort)


def values(sort: str) -> st.SearchStrategy[Any]:
    kind, _, element = sort.partition(" ")
    match kind:
        case "bool":
            return st.booleans()
        case "int":
            return st.integers(-3, 6)
        case "real":
            return st.sampled_from([Fraction(1, 2), Fraction(-7, 4), Fraction(1, 3), 0, 2])
        case "string":
            return st.sampled_from(["", "red", "two words"])
        case "set":
            return st.frozensets(values(element), max_size=3)
        case "list":
            return st.lists(values(element), max_size=3).map(tuple)
        case _:
            return st.sampled_from(COLOUR.values)


def formulas(
    draw: Draw, sub: Callable[..., Term], args: Callable[..., Any], words: Vocabulary, scope: tuple[Type, ...]
) -> list[Callable[[], Term]]:
    def comparison() -> Term:
        sort = draw(sorts())
        return Operation(draw(st.sampled_from([Operator.EQUAL, Operator.DIFFERENT])), (sub(sort), sub(sort)), type=BOOL)

    def ordered() -> Term:
        op = draw(st.sampled_from([Operator.LESS, Operator.LESS_EQUAL, Operator.GREATER, Operator.GREATER_EQUAL]))
        if draw(st.booleans()):
            return Operation(op, (sub("colour"), sub("colour")), order=tuple(COLOUR.values), type=BOOL)
        return Operation(op, (sub(draw(st.sampled_from(["int", "real"]))), sub("int")), type=BOOL)

    def element() -> Term:
        sort = draw(st.sampled_from(COLLECTIONS).map(sort_of))
        return Operation(Operator.ELEMENT, (sub(sort.partition(" ")[2]), sub(sort)), type=BOOL)

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
        element,
        lambda: Operation(Operator.NOT, (sub("bool"),), type=BOOL),
        lambda: Membership(sub("int"), draw(st.sampled_from([SMALL, WIDE, Optional(SMALL)])), type=BOOL),
        lambda: Membership(sub("list int"), Collection("list", SMALL), type=BOOL),
        lambda: quantified(draw, sub, scope, draw(st.sampled_from(["exists", "forall"])), "bool"),
    ]
    return [*choices, possible] if words.actions else choices


def numbers(draw: Draw, sub: Callable[..., Term], scope: tuple[Type, ...], sort: str) -> list[Callable[[], Term]]:
    """Operations whose value is a number of a sort; a real one may be made of integers."""
    type_ = REAL if sort == "real" else INT
    binary = [Operator.ADD, Operator.SUBTRACT, Operator.MULTIPLY, Operator.DIVIDE, Operator.MODULO]
    unary = [Operator.NEGATE, Operator.ABSOLUTE]
    return [
        lambda: Operation(draw(st.sampled_from(binary)), (sub(sort), sub("int")), type=type_),
        lambda: Operation(draw(st.sampled_from(unary)), (sub(sort),), type=type_),
        lambda: Operation(
            draw(st.sampled_from([Operator.MINIMUM, Operator.MAXIMUM])), (sub(sort), sub("int")), type=type_
        ),
        lambda: quantified(draw, sub, scope, "count", "bool"),
        lambda: quantified(draw, sub, scope, "sum", sort),
        lambda: quantified(draw, sub, scope, draw(st.sampled_from(["min", "max"])), sort),
        lambda: Operation(Operator.LENGTH, (sub(draw(st.sampled_from(COLLECTIONS).map(sort_of))),), type=INT),
    ]


def collections(draw: Draw, sub: Callable[..., Term], scope: tuple[Type, ...], sort: str) -> list[Callable[[], Term]]:
    """How a collection is made, or taken apart to give something of a sort."""
    type_ = whole_type(sort)
    found: list[Callable[[], Term]] = []
    if isinstance(type_, Optional) and isinstance(type_.base, Collection):
        type_ = base = type_.base
        element = sort.partition(" ")[2]
        both = (
            [Operator.UNION, Operator.DIFFERENCE] if base.kind == "set" else [Operator.CONCATENATION, Operator.REMOVAL]
        )

        def comprehension() -> Term:
            inner, binders = bound(draw, sub, scope)
            where = sub("bool", inner) if draw(st.booleans()) else None
            return Comprehension(binders, where, sub(element, inner), type=base)

        found = [
            lambda: Display(tuple(sub(element) for _ in range(draw(st.integers(0, 3)))), type=base),
            lambda: Operation(draw(st.sampled_from(both)), (sub(sort), sub(sort)), type=base),
            comprehension,
        ]
        if base.kind == "list":
            found.append(lambda: Operation(Operator.REST, (sub(sort),), type=base))
    if f"list {sort}" in map(sort_of, COLLECTIONS):
        found += [
            lambda: Operation(Operator.FIRST, (sub(f"list {sort}"),), type=type_),
            lambda: Operation(Operator.INDEX, (sub(f"list {sort}"), sub("int")), type=type_),
        ]
    return found


def bound(draw: Draw, sub: Callable[..., Term], scope: tuple[Type, ...]) -> tuple[tuple[Type, ...], tuple[Binder, ...]]:
    """The scope inside some binders, and these: over types, or over collections that may depend on those before."""
    binders: tuple[Binder, ...] = ()
    for index in range(draw(st.integers(1, 2))):
        within = None
        type_: Type = draw(st.sampled_from([SMALL, COLOUR, BOOL, Interval(1, 60)]))
        if draw(st.booleans()):
            sort = draw(st.sampled_from(COLLECTIONS).map(sort_of))
            within, type_ = sub(sort, scope), whole_type(sort.partition(" ")[2])
        binders = (*binders, Binder(Variable(len(scope), f"b{index}", type=type_), within))
        scope = (*scope, type_)
    return scope, binders


def quantified(draw: Draw, sub: Callable[..., Term], scope: tuple[Type, ...], kind: Any, body_sort: str) -> Term:
    inner, binders = bound(draw, sub, scope)
    where = sub("bool", inner) if draw(st.booleans()) else None
    type_ = BOOL if kind in ("exists", "forall") else REAL if body_sort == "real" else INT
    return Quantified(kind, binders, where, sub(body_sort, inner), type=type_)


@st.composite
def theories(draw: Draw) -> BasicActionTheory:
    """A theory in which everything may refer to what was made before it."""
    words = Vocabulary({}, {}, {}, {})

    def parameters(types: tuple[Type, ...]) -> tuple[Parameter, ...]:
        return tuple(Parameter(f"x{index}", type_) for index, type_ in enumerate(types))

    statics, fluents, definitions, actions = {}, {}, {}, {}
    for index in range(draw(st.integers(0, 2))):
        types, type_ = draw(st.sampled_from(PARAMETERS)), draw(st.sampled_from(TYPES))
        body = draw(terms(sort_of(type_), words, types, 2))
        statics[f"s{index}"] = Static(f"s{index}", parameters(types), type_, body)
        words.statics[f"s{index}"] = (types, type_)
    for index in range(draw(st.integers(1, 4))):
        types, type_ = draw(st.sampled_from(FINITE_PARAMETERS)), draw(st.sampled_from([*TYPES, INT]))
        initial = Literal(draw(values_of(type_)), type=type_)
        fluents[f"f{index}"] = Fluent(f"f{index}", parameters(types), type_, initial)
        words.fluents[f"f{index}"] = (types, type_)
    for index in range(draw(st.integers(0, 2))):
        types, type_ = draw(st.sampled_from(PARAMETERS)), draw(st.sampled_from([BOOL, INT, REAL, PATH]))
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


def values_of(type_: Type) -> st.SearchStrategy[Any]:
    """Values that belong to a type."""
    match type_:
        case Optional(base=base):
            return st.none() | values_of(base)
        case Collection(kind=kind, element=element):
            some = st.lists(values_of(element), max_size=3)
            return some.map(frozenset) if kind == "set" else some.map(tuple)
        case _:
            return st.sampled_from(list(type_.values)) if type_.finite else values(sort_of(type_))


def random_state(data: st.DataObject, dynamics: Dynamics) -> tuple[Value, ...]:
    names = [name for name, _ in dynamics.layout.ground_fluents]
    return tuple([data.draw(values_of(dynamics.theory.fluents[name].type)) for name in names])


@given(theories(), st.data())
def test_a_compiled_term_has_the_value_that_its_tree_has(theory: BasicActionTheory, data: st.DataObject) -> None:
    dynamics = Dynamics(theory)
    state = random_state(data, dynamics)
    scope: tuple[Type, ...] = (SMALL, COLOUR, NUMBERS)
    env = tuple(data.draw(values_of(type_)) for type_ in scope)
    term = data.draw(terms(data.draw(sorts()), vocabulary(theory), scope, 4))
    compiled = dynamics.compiler.term(term, len(scope))
    found, wanted = (
        outcome(lambda: compiled(state, env)),
        outcome(lambda: dynamics.interpreter.evaluate(term, state, env)),
    )
    assert found == wanted and type(found) is type(wanted)


@given(theories(), st.data())
def test_a_term_about_the_situation_before_has_the_value_that_its_tree_has(
    theory: BasicActionTheory, data: st.DataObject
) -> None:
    dynamics = Dynamics(theory)
    situation: Any = Happened(random_state(data, dynamics), random_state(data, dynamics))
    sort = data.draw(sorts())
    now = data.draw(terms(sort, vocabulary(theory), (SMALL,)))
    term = Display((now, Before(now, type=now.type)), type=Collection("list", now.type))
    env = (data.draw(values_of(SMALL)),)
    compiled = dynamics.compiler.term(term, 1)
    assert outcome(lambda: compiled(situation, env)) == outcome(
        lambda: dynamics.interpreter.evaluate(term, situation, env)
    )


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
