"""What collections, real numbers and texts are, read off the tree."""

from __future__ import annotations

from fractions import Fraction

import pytest

from golc.theory.closed import Closed, NoValueError
from golc.theory.order import arranged, elements
from golc.theory.terms import (
    Binder,
    Comprehension,
    Display,
    Literal,
    Operation,
    Operator,
    Quantified,
    Term,
    Text,
    Variable,
)
from golc.theory.types import (
    BOOL,
    INT,
    REAL,
    STRING,
    Collection,
    Enumeration,
    Interval,
    Optional,
    Type,
    Unknown,
    Value,
    show,
    writable,
)

COLOUR = Enumeration((("red", "colour"), ("green", "colour"), ("blue", "colour")), "colour")
DIGITS = Collection("set", Interval(0, 9))
NUMBERS = Collection("list", INT)


def value(term: Term) -> Value:
    return Closed(lambda name: None, lambda name: None).value(term)


def literal(of: Value, type_: Type) -> Literal:
    return Literal(of, type=type_)


def integers(*values: int) -> Term:
    return Display(tuple(literal(each, INT) for each in values), type=NUMBERS)


def digits(*values: int) -> Term:
    return Display(tuple(literal(each, INT) for each in values), type=DIGITS)


def apply(op: Operator, *args: Term, type: Type = INT) -> Term:
    return Operation(op, args, type=type)


@pytest.mark.parametrize(
    ("term", "wanted"),
    [
        (digits(3, 1, 3), frozenset({1, 3})),
        (integers(3, 1, 3), (3, 1, 3)),
        (apply(Operator.UNION, digits(1, 2), digits(2, 3)), frozenset({1, 2, 3})),
        (apply(Operator.DIFFERENCE, digits(1, 2), digits(2, 3)), frozenset({1})),
        (apply(Operator.CONCATENATION, integers(1, 2), integers(2)), (1, 2, 2)),
        (apply(Operator.REMOVAL, integers(1, 2, 3, 2), integers(2, 7)), (1, 3)),
        (apply(Operator.ELEMENT, literal(None, Optional(INT)), digits(1)), False),
        (apply(Operator.ELEMENT, literal(1, INT), integers(2, 1)), True),
        (apply(Operator.INDEX, integers(5, 6), literal(1, INT)), 6),
        (apply(Operator.LENGTH, digits(4, 4)), 1),
        (apply(Operator.FIRST, integers(5, 6)), 5),
        (apply(Operator.REST, integers(5, 6)), (6,)),
        (apply(Operator.EQUAL, digits(1, 2), digits(2, 1)), True),
        (apply(Operator.EQUAL, integers(1, 2), integers(2, 1)), False),
        (apply(Operator.MULTIPLY, literal(Fraction(1, 2), REAL), literal(4, INT)), 2),
        (apply(Operator.DIVIDE, literal(Fraction(-7, 2), REAL), literal(2, INT)), -2),
        (apply(Operator.MODULO, literal(Fraction(-7, 2), REAL), literal(2, INT)), Fraction(1, 2)),
        (apply(Operator.LESS, literal(Fraction(1, 3), REAL), literal(1, INT)), True),
        (Text(("at ", literal(3, INT), "!"), type=STRING), "at 3!"),
    ],
)
def test_operations(term: Term, wanted: Value) -> None:
    found = value(term)
    assert found == wanted and type(found) is type(wanted)


@pytest.mark.parametrize(
    ("term", "reason"),
    [
        (apply(Operator.FIRST, integers()), "`first` of an empty list has no value"),
        (apply(Operator.REST, integers()), "`rest` of an empty list has no value"),
        (apply(Operator.INDEX, integers(1, 2), literal(2, INT)), "place 2 is outside a list of 2 elements"),
        (apply(Operator.INDEX, integers(1, 2), literal(-1, INT)), "place -1 is outside a list of 2 elements"),
        (apply(Operator.MODULO, literal(Fraction(1, 2), REAL), literal(0, INT)), "division by zero"),
        (apply(Operator.LENGTH, literal(None, Optional(NUMBERS))), "an operand is `none`, where a value is needed"),
    ],
)
def test_what_has_no_value(term: Term, reason: str) -> None:
    with pytest.raises(NoValueError, match=f"^{reason}$"):
        value(term)


@pytest.mark.parametrize(
    ("type_", "values"),
    [
        (BOOL, [False, True]),
        (INT, [-2, 0, 10]),
        (REAL, [-1, Fraction(1, 3), Fraction(1, 2), 1]),
        (STRING, ["a", "ab", "b"]),
        (COLOUR, ["red", "green", "blue"]),
        (Enumeration(((1, ""), (-1, ""))), [1, -1]),
        (Optional(COLOUR), [None, "red", "blue"]),
        (Optional(Optional(INT)), [None, 1, 2]),
        (Collection("list", COLOUR), [(), ("red", "blue"), ("green",), ("green", "red")]),
        (Collection("list", INT), [(1,), (1, 0), (2,)]),
        (Collection("set", INT), [frozenset(), frozenset({1, 9}), frozenset({2, 3})]),
        (Collection("set", COLOUR), [frozenset({"red", "blue"}), frozenset({"green"}), frozenset({"blue"})]),
    ],
)
def test_values_have_an_order(type_: Type, values: list[Value]) -> None:
    assert elements(frozenset(values), Optional(Collection("set", type_))) == values
    assert elements(tuple(reversed(values)), Collection("list", type_)) == tuple(reversed(values))


def over(term: Term, level: int, type_: Type) -> Binder:
    return Binder(Variable(level, f"x{level}", type=type_), term)


def test_a_set_is_run_through_in_the_order_of_the_type_of_its_elements() -> None:
    colours = Display(tuple(literal(each, COLOUR) for each in ("blue", "green", "red")), type=Collection("set", COLOUR))
    term = Comprehension(
        (over(colours, 0, COLOUR),), None, Variable(0, "x0", type=COLOUR), type=Collection("list", COLOUR)
    )
    assert value(term) == ("red", "green", "blue")


def test_what_a_binder_runs_over_may_depend_on_the_binders_before_it() -> None:
    """[x * 10 + y for x in [2, 1], y in [x, 5] where y > 1]"""
    x, y = Variable(0, "x", type=INT), Variable(1, "y", type=INT)
    binders = (
        Binder(x, integers(2, 1)),
        Binder(y, Display((x, literal(5, INT)), type=NUMBERS)),
    )
    number = apply(Operator.ADD, apply(Operator.MULTIPLY, x, literal(10, INT)), y)
    where = apply(Operator.GREATER, y, literal(1, INT), type=BOOL)
    assert value(Comprehension(binders, where, number, type=NUMBERS)) == (22, 25, 15)
    assert value(Quantified("sum", binders, where, number, type=INT)) == 62


def test_a_quantifier_stops_at_what_decides() -> None:
    x = Variable(0, "x", type=INT)
    one_by_x = apply(Operator.DIVIDE, literal(2, INT), x)
    found = Quantified(
        "exists", (Binder(x, integers(1, 0)),), None, apply(Operator.EQUAL, one_by_x, literal(2, INT)), type=BOOL
    )
    assert value(found) is True
    with pytest.raises(NoValueError, match="division by zero"):
        value(Quantified("exists", (Binder(x, integers(3, 0)),), None, found.body, type=BOOL))


@pytest.mark.parametrize(
    ("written", "type_", "text", "json"),
    [
        (frozenset({"blue", "red"}), Collection("set", COLOUR), "{red, blue}", ["red", "blue"]),
        (("b", "a b"), Optional(Collection("list", STRING)), '["b", "a b"]', ["b", "a b"]),
        (
            (frozenset({"green", "red"}), None),
            Collection("list", Optional(Collection("set", COLOUR))),
            "[{red, green}, none]",
            [["red", "green"], None],
        ),
        (None, Optional(Collection("list", STRING)), "none", None),
        ("a b", STRING, "a b", "a b"),
        (frozenset({1, "outside"}), Collection("set", COLOUR), "{1, outside}", [1, "outside"]),
        (Unknown((frozenset({"green", "red"}), frozenset())), Collection("set", COLOUR), "{} or {red, green}", None),
    ],
)
def test_what_is_written_knows_its_order_and_its_strings(written: Value, type_: Type, text: str, json: object) -> None:
    found = arranged(written, type_)
    assert show(found) == text
    assert isinstance(written, Unknown) or (found == written and writable(found) == json)
