"""Sets, lists, real numbers and strings in terms: their types, and what does not go together."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest

from golc.theory.fitting import Either
from golc.theory.terms import (
    Binder,
    Comprehension,
    Display,
    FluentTerm,
    Literal,
    Membership,
    Operation,
    Operator,
    Quantified,
    Text,
    Variable,
)
from golc.theory.types import BOOL, INT, REAL, STRING, Collection, Enumeration, Interval, Optional

Build = Callable[..., Any]

STATION = Interval(1, 6)
STOPS = Collection("list", STATION)
COLOUR = Enumeration((("red", "colour"), ("green", "colour")))
HEAD = """type station = 1..6
type colour = {red, green}
type place = 1..2 + {shelf}
static near(s: station): set[station] = {n for n: station where abs(n - s) <= 1}
fluent at: station = 1
fluent spot: place = shelf
fluent stops: list[station] = []
fluent seen: set[colour] = {red}
fluent order: list[colour]? = none
fluent fuel: real = 2.5
fluent note: string = "new"
fluent lit(n: station) = false
"""
AT = FluentTerm("at", (), type=STATION)
ALL_STOPS = FluentTerm("stops", (), type=STOPS)
SEEN = FluentTerm("seen", (), type=Collection("set", COLOUR))


@pytest.fixture
def term(theory: Build) -> Build:
    """The term of an expression over the names of HEAD."""
    return lambda text: theory(f"{HEAD}define it := {text}\n").definitions["it"].body


@pytest.fixture
def finding(found: Build) -> Build:
    """The message of the only finding about an expression."""

    def find(text: str) -> str:
        (line,) = found(f"{HEAD}define it := {text}\n")
        return str(line.split(" ", 2)[2])

    return find


def one(value: int) -> Literal:
    return Literal(value, type=INT)


def test_elements_written_out_have_a_type_in_common(term: Build) -> None:
    assert term("[at, 9]") == Display((AT, one(9)), type=Collection("list", INT))
    red = Literal("red", type=COLOUR)
    assert term("{red, none}") == Display(
        (red, Literal(None, type=Optional(Enumeration(())))), type=Collection("set", Optional(COLOUR))
    )
    assert term("[[], [0.5]]").type == Collection("list", Collection("list", REAL))


def test_elements_are_of_the_type_that_is_needed_if_they_certainly_belong_to_it(term: Build) -> None:
    assert term("stops = [1, at]").args[1].type == STOPS
    assert term("stops = [1, at + 1]").args[1].type == Collection("list", INT)
    assert term("stops = []").args[1] == Display((), type=STOPS)


def test_elements_with_nothing_in_common_may_go_together_where_both_are_needed(theory: Build) -> None:
    built = theory(f"{HEAD}fluent spots: list[place] = []\naction put:\n    causes spots := [at + 1, shelf]\n")
    assert isinstance(built.actions["put"].effects[0].value.type.element, Either)


def test_a_comprehension_is_of_the_type_of_its_element(term: Build) -> None:
    n, m = Variable(0, "n", type=STATION), Variable(1, "m", type=STATION)
    near = term("[m for n: station, m in near(n) where n != at]")
    assert near == Comprehension(
        (Binder(n), Binder(m, near.binders[1].within)),
        Operation(Operator.DIFFERENT, (n, AT), type=BOOL),
        m,
        type=STOPS,
    )
    assert near.binders[1].within.args == (n,)


def test_plus_and_minus_of_collections(term: Build) -> None:
    last = Display((AT,), type=STOPS)
    assert term("stops + [at]") == Operation(Operator.CONCATENATION, (ALL_STOPS, last), type=STOPS)
    assert term("stops - [at]") == Operation(Operator.REMOVAL, (ALL_STOPS, last), type=STOPS)
    assert term("seen + {green}").op is Operator.UNION
    assert term("seen - {green} + {red}").args[0].op is Operator.DIFFERENCE
    assert term("stops + [at + 1]").type == Collection("list", INT)
    assert term("[] + stops").type == STOPS


def test_parts_of_lists(term: Build) -> None:
    assert term("first(stops)") == Operation(Operator.FIRST, (ALL_STOPS,), type=STATION)
    assert term("rest(stops)") == Operation(Operator.REST, (ALL_STOPS,), type=STOPS)
    assert term("stops[at - 1]").type == STATION
    assert term("len(seen)") == Operation(Operator.LENGTH, (SEEN,), type=INT)
    assert term("first(order)").type == COLOUR
    assert term("[[1], [2]][0][0]").type == INT


def test_membership_in_a_collection(term: Build) -> None:
    assert term("at in stops") == Operation(Operator.ELEMENT, (AT, ALL_STOPS), type=BOOL)
    assert term("at not in rest(stops)").args[0].op is Operator.ELEMENT
    assert term("at in stops + []").args[1].type == STOPS
    assert term("stops in [[1], []]").args[1].type == Collection("set", STOPS)


def test_membership_in_constants_is_that_in_an_enumeration(term: Build) -> None:
    assert term("at in [1, 3]") == Membership(AT, Enumeration(((1, ""), (3, ""))), type=BOOL)
    assert term("fuel in {1, 0.5}").op is Operator.ELEMENT


def test_a_types_name_is_the_list_of_its_values(term: Build) -> None:
    assert term("station") == Literal((1, 2, 3, 4, 5, 6), type=STOPS)
    assert term("len(bool)").args[0].value == (False, True)
    assert term("stops = [1] + station").args[1].args[1].value == (1, 2, 3, 4, 5, 6)


def test_a_variable_in_a_types_name_runs_over_the_type(term: Build) -> None:
    assert term("count n in station. lit(n)") == term("count n: station. lit(n)")


def test_a_later_binder_speaks_of_the_earlier_ones(term: Build) -> None:
    n, m = Variable(0, "n", type=STATION), Variable(1, "m", type=STATION)
    found = term("exists n in stops, m in near(n). lit(m)")
    assert found == Quantified(
        "exists",
        (Binder(n, ALL_STOPS), Binder(m, found.binders[1].within)),
        None,
        FluentTerm("lit", (m,), type=BOOL),
        type=BOOL,
    )
    assert found.binders[1].within.args == (n,)


def test_an_empty_set_takes_the_type_that_is_needed(theory: Build) -> None:
    built = theory(
        "type station = 1..6\nstatic nobody: set[station] = {}\nfluent deep: list[list[int]] = [[]]\n"
        "proc serve(s: set[station]):\n    skip\nproc control:\n    serve({})\n"
    )
    assert built.statics["nobody"].body == Literal(frozenset(), type=Collection("set", STATION))
    assert built.fluents["deep"].initial.type == Collection("list", Collection("list", INT))
    assert built.procedures["control"].body.args == (Display((), type=Collection("set", STATION)),)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[1, red]", "`1`, which is of type `int`, and `red`, which is of type `colour`, cannot be in one list"),
        ("[[]]", "nothing says what the elements of `[[]]` are"),
        ("exists x in []. true", "nothing says what the elements of `[]` are"),
        ("count x in at. true", "`at` is of type `station` (1..6), but `x in …` needs a set or a list"),
        ("len(at)", "`at` is of type `station` (1..6), but `len` needs a set or a list"),
        ("first(seen)", "`seen` is of type `set[colour]`, but `first` needs a list"),
        ("seen[0]", "`seen` is of type `set[colour]`, but `[…]` needs a list"),
        ("stops[0.5]", "`0.5` is of type `real`, but a place in a list needs `int`"),
        ("stops[-1]", "place -1 is outside a list"),
        ("[7, 8][2]", "place 2 is outside a list of 2 elements"),
        ("first([])", "`first` of an empty list has no value"),
        ("stops + at", "`at` is of type `station` (1..6), but `+` after a list needs a list"),
        ("stops + seen", "`seen` is of type `set[colour]`, but `+` after a list needs a list"),
        ("seen - {at}", "`seen`, which is of type `set[colour]`, and `{at}`, which is of type `set[station]`, "
         "have no elements in common"),
        ("seen * 2", "`seen` is of type `set[colour]`, but `*` needs a number"),
        ("stops = [1, red]", "`red` is of type `colour` (red, green), but an element of this list needs `station` "
         "(1..6)"),
        ("red in stops", "`red`, which is of type `colour`, can never be in `stops`, which is of type `list[station]`"),
        ("at in at", "`at` is of type `station` (1..6), but `in` needs a type, a set or a list"),
        ("at in stopz", "unknown fluent `stopz`"),
        ("at in statoin", "unknown type `statoin`"),
        ("len(int)", "`int` cannot stand for the list of its values"),
        ("[x for x in int]", "variable `x` has to be of a type that can be enumerated, and `int` cannot"),
        ("station(1)", "`station` is a type and takes no arguments"),
        ("[misty, at][misty + 1]", "unknown name `misty`"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_of_a_collection(finding: Build, text: str, message: str) -> None:
    assert finding(text) == message


@pytest.mark.parametrize(
    ("declaration", "message"),
    [
        ("x: list[station] = {1, 2}", "`{1, 2}` is of type `set[int]`, but fluent `x` needs `list[station]`"),
        ("x: set[station] = {1} + {7}", "`7` is outside `station` (1..6)"),
        ("x: list[station] = [s for s: 1..9] if true else [8]", "`8` is outside `station` (1..6)"),
        ("x: list[int] = [red for s: 1..9]", "`red` is of type `colour` (red, green), but an element of fluent `x` "
         "needs `int`"),
        ("x: list[int] = [1, 0.5]", "`0.5` is of type `real`, but an element of fluent `x` needs `int`"),
        ("x: list[station] = 3", "`3` is of type `int`, but fluent `x` needs `list[station]`"),
        ("x(s: set[int]) = true", "parameter `s` of fluent `x` has to be of a type that can be enumerated, and "
         "`set[int]` cannot"),
        ("x: list[statoin] = []", "unknown type `statoin`"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_of_a_declaration(found: Build, declaration: str, message: str) -> None:
    (line,) = found(f"{HEAD}fluent {declaration}\n")
    assert line.split(" ", 2)[2] == message


def test_a_real_number_is_exact(term: Build) -> None:
    assert term("0.1") == Literal(Fraction(1, 10), type=REAL)
    assert term("2.0") == Literal(2, type=REAL)


def test_integers_and_real_numbers_mix(term: Build) -> None:
    assert term("fuel + 1").type == REAL
    assert term("at * 0.5").type == REAL
    assert term("max(fuel, at)").type == REAL
    assert term("sum n in [0.5, 1]. n * at").type == REAL
    assert term("fuel // 2").type == INT
    assert term("fuel % 2").type == REAL
    assert term("fuel < at").op is Operator.LESS
    assert term("fuel = at").op is Operator.EQUAL
    assert term("1 if lit(1) else 0.5").type == REAL


@pytest.mark.parametrize(
    ("text", "value"), [("0.1 + 0.2", Fraction(3, 10)), ("-0.5", Fraction(-1, 2)), ("7.5 // 2", 3), ("0.5 + 0.5", 1)]
)
def test_constants_with_decimals_are_worked_out(term: Build, text: str, value: object) -> None:
    assert term(text).value == value


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("lit(2.0)", "`2.0` is of type `real`, but parameter `n` of `lit` needs `station` (1..6)"),
        ("fuel in station", "`fuel` is of type `real`, and `station` (1..6) has only integers"),
        ("sum x: real. x", "variable `x` has to be of a type that can be enumerated, and `real` cannot"),
        ("fuel = red", "`fuel`, which is of type `real`, and `red`, which is of type `colour`, can never be equal"),
    ],
)
def test_a_real_number_is_no_integer(finding: Build, text: str, message: str) -> None:
    assert finding(text) == message


def test_a_message_is_a_string(term: Build) -> None:
    assert term('"two {{words}}"') == Literal("two {words}", type=STRING)
    assert term('"at {at}, {stops}"') == Text(("at ", AT, ", ", ALL_STOPS), type=STRING)
    assert term('note != "new"').op is Operator.DIFFERENT
    assert term('note in {"old", "new"}').op is Operator.ELEMENT


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('at = "1"', '`at`, which is of type `station`, and `"1"`, which is of type `string`, can never be equal'),
        ('note < "x"', '`note`, which is of type `string`, and `"x"`, which is of type `string`, have no order'),
        ('note + "x"', "`note` is of type `string`, but `+` needs a number"),
        ('red in {"red"}', '`"red"` is of type `string`, but a value of `red` needs `colour` (red, green)'),
        ("len(note)", "`note` is of type `string`, but `len` needs a set or a list"),
        ("count s: string. s = note", "variable `s` has to be of a type that can be enumerated, and `string` cannot"),
        ('"{misty}"', "unknown name `misty`"),
    ],
)
def test_a_string_is_only_compared_and_shown(finding: Build, text: str, message: str) -> None:
    assert finding(text) == message


def test_parameters_of_all_but_fluents_may_be_of_any_type(theory: Build) -> None:
    built = theory(
        "static chosen(l: list[int], i: int): int = l[i]\n"
        "define is_new(s: string, r: real) := s = \"new\" and r > 0\n"
        "action drive(way: list[int], speed: real):\n    poss is_new(\"{way}\", speed)\n"
        "exog told(words: list[string])\n"
        "proc control(left: set[int]):\n    drive([n for n in left], 0.5)\n"
    )  # fmt: skip
    assert [parameter.type for parameter in built.actions["drive"].parameters] == [Collection("list", INT), REAL]
    assert built.actions["told"].parameters[0].type == Collection("list", STRING)


def test_costs_and_times_may_be_real(theory: Build) -> None:
    built = theory(
        "const pause = 0.5\nfluent slow: real = 1\naction go:\n    cost slow * 1.5\n"
        "proc control:\n    wait pause s\n    wait slow s\n    search within 2.5 s:\n        go\n"
    )
    assert built.actions["go"].cost.type == REAL
    first, second, third = built.procedures["control"].body.parts
    assert (first.seconds, third.seconds) == (Fraction(1, 2), Fraction(5, 2))
    assert second.seconds == FluentTerm("slow", (), type=REAL)


def test_a_negative_cost_or_time_is_found(found: Build) -> None:
    assert found("action go:\n    cost -0.5\nproc control:\n    wait 0.5 - 1 s\n") == [
        "2:10 GL017 the cost -0.5 is negative",
        "4:10 GL017 the time -0.5 s is negative",
    ]


def test_an_aggregate_that_takes_in_a_comparison_is_one_mistake(found: Build) -> None:
    text = "fluent l: list[int] = []\ndefine it := 1 < 2 and min n in l. n = 2\n"
    assert found(text) == ["2:36 GL016 `n = 2` is of type `bool`, but `min` needs a number"]


def test_consts_may_be_replaced_by_values_that_fit(theory: Build, found: Build) -> None:
    text = 'const few = {1, 2}\nconst speed = 0.5\nconst top = 3\nconst name = "a"\n'
    built = theory(text, {"few": "{}", "speed": "2", "name": '"b c"'})
    assert [constant.value for constant in built.constants.values()] == [frozenset(), 2, 3, "b c"]
    assert built.constants["few"].type == Collection("set", INT)
    assert found(text, {"top": "0.5", "few": "[1]"}) == [
        "1:1 GL016 `few` is `set[int]` in the file, but `list[int]` on the command line",
        "1:1 GL016 `top` is `int` in the file, but `real` on the command line",
    ]
