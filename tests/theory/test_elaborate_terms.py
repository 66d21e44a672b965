"""Expressions to terms: levels, operators, orders, what goes together."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.theory.terms import (
    Binder,
    Display,
    FluentTerm,
    Literal,
    Membership,
    Operation,
    Operator,
    PossTerm,
    Quantified,
    Variable,
    subterms,
)
from golc.theory.types import BOOL, INT, Collection, Enumeration, Interval, Optional

Build = Callable[..., Any]

STATION = Interval(1, 6)
HEAD = """type station = 1..6
type phase = {moving, stopped}
type place = block + {table}
type block = {a, b}
fluent at: station = 1
fluent motion: phase = stopped
fluent lit(f: station) = false
fluent on(x: block): place = table
fluent target: station? = none
action go(n: station)
"""
AT = FluentTerm("at", (), type=STATION)


@pytest.fixture
def term(theory: Build) -> Build:
    """The term of an expression over the names of HEAD."""
    return lambda text: theory(f"{HEAD}define it := {text}\n").definitions["it"].body


def one(value: int) -> Literal:
    return Literal(value, type=INT)


def test_chains_of_and_and_or_are_one_operation(term: Build) -> None:
    a, b, c = (FluentTerm("lit", (one(n),), type=BOOL) for n in (1, 2, 3))
    assert term("lit(1) and lit(2) and lit(3)") == Operation(Operator.AND, (a, b, c), type=BOOL)
    assert term("lit(1) or lit(2) and lit(3)").args == (a, Operation(Operator.AND, (b, c), type=BOOL))


def test_operators_lean_to_the_left(term: Build) -> None:
    inner = Operation(Operator.SUBTRACT, (AT, one(2)), type=INT)
    assert term("at - 2 - at") == Operation(Operator.SUBTRACT, (inner, AT), type=INT)


@pytest.mark.parametrize(
    ("text", "value"),
    [("7 // -2", -4), ("7 % -2", -1), ("-(2 + 3) * 2", -10), ("min(3, 1, 2)", 1), ("abs(-4) + max(1, 2)", 6)],
)
def test_constants_are_worked_out(term: Build, text: str, value: int) -> None:
    assert term(text) == one(value)


def test_implications_keep_their_sides(term: Build) -> None:
    assert term("lit(1) implies lit(2)").op is Operator.IMPLIES
    assert term("lit(1) iff lit(2)").op is Operator.IFF


def test_a_conditional_term_has_the_joined_type(term: Build) -> None:
    assert term("at if lit(1) else none").type == Optional(STATION)
    assert term("at if lit(1) else 9").type == INT
    assert term("on(a) if lit(1) else b").type.values == ("a", "b", "table")


def test_levels_count_the_variables_around_a_binder(term: Build) -> None:
    outer = Variable(0, "n", type=STATION)
    inner = Variable(1, "m", type=STATION)
    found = term("exists n: station where lit(n). forall m: station. m < n")
    assert found == Quantified(
        "exists",
        (Binder(outer),),
        FluentTerm("lit", (outer,), type=BOOL),
        Quantified("forall", (Binder(inner),), None, Operation(Operator.LESS, (inner, outer), type=BOOL), type=BOOL),
        type=BOOL,
    )


def test_binders_side_by_side_take_levels_in_order(term: Build) -> None:
    found = term("count n: station, m: {moving, stopped} where m = motion. lit(n)")
    assert [binder.variable.level for binder in found.binders] == [0, 1]
    assert found.type == INT
    assert found.binders[1].values == ("moving", "stopped")


def test_levels_go_back_after_a_binder(term: Build) -> None:
    found = term("(exists n: station. lit(n)) and (exists m: station. lit(m))")
    assert found.args[1].body.args[0].level == 0


def test_membership_in_a_type_an_interval_and_constants(term: Build) -> None:
    assert term("at + 1 in station") == Membership(Operation(Operator.ADD, (AT, one(1)), type=INT), STATION, type=BOOL)
    assert term("at in 2..(1 + 2)") == Membership(AT, Interval(2, 3), type=BOOL)
    assert term("at not in {3, 5}").op is Operator.NOT
    assert term("target in {none, 3}").within == Optional(Enumeration(((3, ""),)))
    assert term("motion in {stopped}").within == Enumeration((("stopped", "phase"),))


def test_membership_in_terms_is_that_in_a_set(term: Build) -> None:
    target = FluentTerm("target", (), type=Optional(STATION))
    choices = Display((one(2), target), type=Collection("set", Optional(INT)))
    assert term("at in {2, target}") == Operation(Operator.ELEMENT, (AT, choices), type=BOOL)


def test_membership_in_nothing_is_never_true(term: Build) -> None:
    assert term("at in {}").within.values == ()


def test_symbols_are_ordered_as_declared(term: Build) -> None:
    assert term("motion < stopped").order == ("moving", "stopped")
    assert term("on(a) >= b").order == ("a", "b", "table")
    assert term("at < 3").order is None


def test_a_subset_has_the_order_of_the_enumeration_that_declares_it(theory: Build) -> None:
    built = theory(f"{HEAD}fluent still: {{stopped, moving}} = stopped\ndefine it := still < moving\n")
    assert built.definitions["it"].body.order == ("moving", "stopped")


def test_poss_asks_for_the_precondition_of_an_action(term: Build) -> None:
    assert term("poss(go(at))") == PossTerm("go", (AT,), type=BOOL)


def test_a_soft_word_may_be_a_name(theory: Build) -> None:
    built = theory("fluent first: int = 1\nfluent abs: int = 2\ndefine both := first + abs + abs(first)\n")
    assert built.definitions["both"].body.args[0].args[1] == FluentTerm("abs", (), type=INT)


def test_an_optional_value_fits_where_a_value_is_needed(term: Build) -> None:
    assert term("lit(target)").args[0].type == Optional(STATION)
    assert term("target + 1").op is Operator.ADD


def test_spans_are_those_of_the_text(theory: Build) -> None:
    built = theory(f"{HEAD}define it := lit( at ) or at  =  3\n")
    body = built.definitions["it"].body
    assert [part.span.text for part in body.args] == ["lit( at )", "at  =  3"]
    assert body.span.text == "lit( at ) or at  =  3"


def test_one_mistake_is_one_finding(found: Build) -> None:
    text = HEAD + "define ok := at = 1 and motion = stopped\n"
    it = "(att + 1) * 2 in station and lit(ta - 1) implies motoin = stopped and not moton"
    text += f"define it := {it}\n"
    codes = [line.split()[1] for line in found(text)]
    assert codes == ["GL012"] * 4  # one for each misspelt word, none for what is around it


def test_a_name_that_is_misspelt_alike_in_several_places_is_one_finding(found: Build) -> None:
    text = HEAD + "define it := motoin = stopped\ndefine other := motoin != stopped and motoin != stopped\n"
    assert [line.split()[1] for line in found(text)] == ["GL012"]


def test_a_variable_that_is_misspelt_where_it_is_bound_is_one_finding(found: Build) -> None:
    text = HEAD + "define it := exists Here: station. here = at and lit(here) and here > 1\n"
    assert [line.split()[1] for line in found(text)] == ["GL012"]


def test_a_variable_that_is_misspelt_in_two_declarations_is_two_findings(found: Build) -> None:
    text = HEAD + "define aa := exists Here: station. here = at\ndefine bb := exists Here: station. lit(here)\n"
    assert [line.split()[1] for line in found(text)] == ["GL012"] * 2


def test_what_uses_a_broken_declaration_is_not_reported(found: Build) -> None:
    text = "fluent at: statoin = 1\ndefine here := at + 1\ndefine far := here > at and at = nowhere\n"
    assert found(text) == ["1:12 GL014 unknown type `statoin`"]


def test_a_repeated_declaration_is_checked_but_not_used(theory: Build, found: Build) -> None:
    assert found("const a = 1\nconst a = b\nfluent at: 0..a = 1\n") == [
        "2:7 GL011 `a` is declared twice",
        "2:11 GL012 unknown name `b`",
    ]


def test_a_nested_choice_of_terms_does_not_explode(term: Build) -> None:
    found = term("(" * 60 + "lit(1)" + " in {lit(2), lit(3)})" * 60)
    assert sum(1 for _ in subterms(found)) == 60 * 6 + 2


def test_an_endless_static_is_given_up(found: Build) -> None:
    assert found("static f(n: int): int = f(n + 1)\nconst c = f(1)\n") == [
        "1:8 GL021 this has no value: the recursion of `f` does not end, or goes too deep"
    ]


def test_a_static_that_takes_for_ever_is_given_up(found: Build) -> None:
    text = "static f(n: int): int = count x: 1..1000, y: 1..1000. x < y + n\nconst c = f(80)\n"
    assert "too many steps" in found(text)[0]


def test_a_static_that_asks_for_the_same_values_again_remembers_them(theory: Build) -> None:
    text = "static f(n: int): int = n if n < 2 else f(n - 1) + f(n - 2)\nconst c = f(80)\n"
    assert theory(text).constants["c"].value == 23416728348467685


def test_a_number_that_grows_without_bounds_is_given_up(found: Build) -> None:
    text = "static f(n: int): int = 2 if n = 0 else f(n - 1) * f(n - 1)\nconst c = f(15)\n"
    assert "more than 14000 bits" in found(text)[0]


@pytest.mark.parametrize("opening, closing", [("(", ")"), ("not (", ")"), ("exists n: bool. (", ")")])
def test_deep_nesting_is_elaborated(theory: Build, opening: str, closing: str) -> None:
    built = theory("fluent lit = true\ndefine it := " + opening * 220 + "lit" + closing * 220 + "\n")
    assert built.definitions["it"].type == BOOL


def test_a_long_chain_of_definitions_is_elaborated(theory: Build) -> None:
    lines = [f"define d{n} := d{n + 1} + 1\n" for n in range(400)]
    assert theory("".join(lines) + "fluent d400: int = 1\n").definitions["d0"].type == INT


@pytest.mark.parametrize("length", [2_000, 12_000])
def test_a_chain_of_definitions_that_is_too_long_is_said_once(found: Build, length: int) -> None:
    lines = [f"define d{n} := d{n + 1} + 1\n" for n in range(length)]
    (said,) = found("".join(lines) + f"fluent d{length}: int = 1\n")
    # d at the end of the chain has 2 levels, each one before it 2 more: the 500th has 1,000, the 501st too many
    place = length - 501
    assert said.startswith(f"{place + 1}:8 GL008 `d{place}` is nested more than 1,000 levels deep")


def test_definitions_that_double_are_said_once_where_they_are_too_large(found: Build) -> None:
    lines = [f"define d{n} := d{n - 1} and d{n - 1}\n" for n in range(1, 300)]
    (said,) = found("fluent f = true\ndefine d0 := f\n" + "".join(lines) + "goal g: d299\n")
    # terms of dn: 1 of d0; 3 and twice as many as the one before it: 4 · 2ⁿ - 3 > 100,000 for n = 15
    assert said.startswith("17:8 GL008 `d15` stands for more than 100,000 terms")


def test_preconditions_that_double_are_said_where_they_are_too_large(found: Build) -> None:
    lines = [f"action a{n}:\n    poss poss(a{n - 1}) and poss(a{n - 1})\n" for n in range(1, 30)]
    (said,) = found("fluent f = true\naction a0:\n    poss f\n" + "".join(lines))
    assert said.startswith("32:8 GL008 the precondition of `a15` stands for more than 100,000 terms")
