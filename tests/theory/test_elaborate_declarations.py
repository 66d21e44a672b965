"""Declarations: what becomes of consts, types, statics, fluents and definitions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.theory.terms import DefinedTerm, FluentTerm, Literal, Membership, Operation, Operator, StaticTerm, Variable
from golc.theory.theory import Constant, Parameter
from golc.theory.types import BOOL, INT, NONE, Enumeration, Interval, Optional

Build = Callable[..., Any]


def test_an_interval_is_bounded_by_consts(theory: Build) -> None:
    built = theory("const floors = 6\ntype floor = 0..(floors - 1)\n")
    assert built.types["floor"] == Interval(0, 5)
    assert str(built.types["floor"]) == "floor"


def test_a_const_may_use_a_later_one(theory: Build) -> None:
    built = theory("const top = floors - 1\nconst floors = 6\n")
    assert built.constants["top"] == Constant("top", 5, INT)
    assert [*built.constants] == ["top", "floors"]


def test_a_const_may_be_a_symbol_or_a_truth_value(theory: Build) -> None:
    built = theory("type colour = {red, green}\nconst start = green\nconst loud = not true\n")
    assert built.constants["start"].value == "green"
    assert built.constants["start"].type == built.types["colour"]
    assert built.constants["loud"] == Constant("loud", False, BOOL)


def test_an_enumeration_declares_its_symbols(theory: Build) -> None:
    built = theory("type phase = {moving, stopped}\n")
    assert built.types["phase"] == Enumeration((("moving", "phase"), ("stopped", "phase")))


def test_an_enumeration_of_integers_has_no_symbols(theory: Build) -> None:
    built = theory("type heading = {-1, 1}\n")
    assert built.types["heading"].values == (-1, 1)
    assert built.symbols == frozenset()


def test_a_union_lists_the_values_of_its_pieces(theory: Build) -> None:
    built = theory("type place = block + {table} + 1..2\ntype block = {a, b}\n")
    assert built.types["place"].values == ("a", "b", "table", 1, 2)
    assert built.types["place"].kinds == {"symbol:block", "symbol:place", "int"}


def test_an_alias_is_the_same_type_under_another_name(theory: Build) -> None:
    built = theory("type floor = 1..6\ntype station = floor\n")
    assert built.types["station"] == built.types["floor"]
    assert str(built.types["station"]) == "station"


def test_an_optional_type_has_none_first(theory: Build) -> None:
    built = theory("type station = 1..3\nfluent target: station? = none\n")
    fluent = built.fluents["target"]
    assert fluent.type == Optional(Interval(1, 3))
    assert [*fluent.type.values] == [None, 1, 2, 3]
    assert fluent.initial == Literal(None, type=NONE)


def test_an_enumeration_in_place_of_a_name_declares_its_symbols(theory: Build) -> None:
    built = theory("fluent door: {open, shut} = open\nfluent hatch: {shut, open} = shut\n")
    assert built.symbols == {"open", "shut"}
    assert built.fluents["door"].type.kinds == built.fluents["hatch"].type.kinds
    assert built.fluents["hatch"].type.values == ("shut", "open")


def test_an_enumeration_of_declared_symbols_is_a_subset(theory: Build) -> None:
    built = theory("type phase = {moving, stopped, lost}\nfluent motion: {stopped, moving} = stopped\n")
    assert built.fluents["motion"].type == Enumeration((("stopped", "phase"), ("moving", "phase")))


def test_a_declared_subset_needs_no_particular_order(theory: Build) -> None:
    built = theory("type still = {stopped, lost}\ntype phase = {moving, stopped, lost}\n")
    assert built.types["still"].kinds == {"symbol:phase"}


def test_a_relational_fluent_is_of_type_bool(theory: Build) -> None:
    built = theory("fluent holding(to: 1..6) = to in {4, 6}\n")
    fluent = built.fluents["holding"]
    assert fluent.type == BOOL
    assert fluent.parameters == (Parameter("to", Interval(1, 6)),)
    to = Variable(0, "to", type=Interval(1, 6))
    assert fluent.initial == Membership(to, Enumeration(((4, ""), (6, ""))), type=BOOL)


def test_a_definition_has_the_type_of_its_body(theory: Build) -> None:
    built = theory("fluent at: 1..6 = 1\ndefine twice(n: int) := n * at\ndefine far := twice(2) > 3\n")
    assert built.definitions["twice"].type == INT
    assert built.definitions["far"].body == Operation(
        Operator.GREATER,
        (DefinedTerm("twice", (Literal(2, type=INT),), type=INT), Literal(3, type=INT)),
        type=BOOL,
    )


def test_a_static_may_be_recursive(theory: Build) -> None:
    built = theory("static fact(n: int): int = 1 if n = 0 else n * fact(n - 1)\nconst six = fact(3)\n")
    assert built.constants["six"].value == 6
    assert any(isinstance(part, StaticTerm) for part in built.statics["fact"].body.args[2].args)


def test_a_static_without_parameters_is_its_value(theory: Build) -> None:
    built = theory("static twice: int = floors * 2\nconst floors = 4\nfluent at: 0..twice = twice\n")
    assert built.statics["twice"].body == Literal(8, type=INT)
    assert built.fluents["at"].type == Interval(0, 8)
    assert built.fluents["at"].initial == Literal(8, type=INT)


def test_a_table_maps_arguments_to_values(theory: Build) -> None:
    table = "{(hall, true): 1, (hall, false): 2, (attic, true): 3, (attic, false): 2 + 2}"
    built = theory("type room = {hall, attic}\nstatic up(r: room, b: bool): int = " + table + "\n")
    assert built.statics["up"].body == {
        ("hall", True): 1,
        ("hall", False): 2,
        ("attic", True): 3,
        ("attic", False): 4,
    }


def test_the_command_line_replaces_a_const(theory: Build) -> None:
    built = theory("const floors = 6\ntype floor = 1..floors\n", {"floors": "2 * 6"})
    assert built.constants["floors"].value == 12
    assert built.types["floor"] == Interval(1, 12)


@pytest.mark.parametrize(
    ("constants", "finding"),
    [
        ({"flors": "3"}, "1:1 GL024 `flors` is not declared, so that `-D` cannot replace it"),
        ({"at": "3"}, "1:1 GL024 `at` is a fluent, not a const, so that `-D` cannot replace it"),
        ({"floors": "true"}, "1:1 GL016 `floors` is `int` in the file, but `bool` on the command line"),
        ({"floors": "1 // 0"}, "1:1 GL021 division by zero"),
        ({"floors": "flors + 1"}, "1:1 GL012 unknown const `flors`"),
    ],
)
def test_the_command_line_is_checked(found: Build, constants: dict[str, str], finding: str) -> None:
    assert found("const floors = 6\nfluent at: int = floors\n", constants) == [finding]


def test_a_replaced_const_is_parsed(found: Build) -> None:
    assert "GL004" in found("const floors = 6\n", {"floors": "3 +"})[0]


def test_names_come_in_any_order(theory: Build) -> None:
    text = "fluent at: station = start\nconst start = top // 2\ntype station = 1..top\nconst top = 6\n"
    assert theory(text).fluents["at"].initial.value == 3


def test_a_local_name_comes_before_a_declared_one(theory: Build) -> None:
    built = theory("fluent at: 1..3 = 1\nfluent free(at: 1..3) = at = 2\n")
    assert isinstance(built.fluents["free"].initial.args[0], Variable)


def test_actions_have_a_namespace_of_their_own(theory: Build) -> None:
    built = theory("fluent open = false\naction open:\n    poss not open\n    causes open := true\n")
    assert built.actions["open"].preconditions[0].args == (FluentTerm("open", (), type=BOOL),)


def test_what_stands_in_place_of_a_name_declares_even_if_nothing_uses_it(theory: Build) -> None:
    assert theory("action paint(c: {red, green})\n").symbols == {"red", "green"}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("type t = 2..2\n", []),
        ("type t = 3..2\n", ["1:10 GL022 the interval 3..2 is empty"]),
        ("fluent f(n: 1..1000, m: 1..1000) = false\n", []),
        ("fluent f(n: 1..1000, m: 1..1001) = false\n", ["1:8 GL022 fluent `f` has more than 1000000 instances"]),
        ("action a:\n    cost 0\n", []),
        ("action a:\n    cost -1\n", ["2:10 GL017 the cost -1 is negative"]),
        ("proc p:\n    star at most 0:\n        skip\n", []),
        ("proc p:\n    star at most -1:\n        skip\n", ["2:18 GL017 the number -1 is negative"]),
        ("proc p:\n    wait 0 s\n", []),
        ("proc p:\n    wait -0.5 s\n", ["2:10 GL017 the time -0.5 s is negative"]),
        ("action a\ndevice self:\n    a timeout 0.1 s\n", []),
        ("action a\ndevice self:\n    a timeout 0 s\n", ["3:15 GL017 a timeout has to be positive"]),
    ],
)
def test_limits_are_exact(found: Build, text: str, expected: list[str]) -> None:
    assert found(text) == expected


def test_an_interval_that_cannot_be_counted_is_refused(found: Build) -> None:
    text = f"const top = {2**70}\ntype vast = 0..top\nfluent far: vast = top\n"
    assert [line.split()[1] for line in found(text)] == ["GL022"]


def test_none_comes_before_a_range_that_is_not_listed(theory: Build) -> None:
    fluent = theory(f"fluent far: (-{2**40})..{2**40}? = none\n").fluents["far"]
    assert len(fluent.type.values) == 2**41 + 2
    assert (fluent.type.values[0], fluent.type.values[1], fluent.type.values[-1]) == (None, -(2**40), 2**40)
    assert fluent.type.values[:2] == (None, -(2**40))
    assert 7 in fluent.type.values


def test_a_text_with_syntax_errors_is_elaborated_as_far_as_it_goes(found: Build) -> None:
    text = (
        "type phase = {moving stopped}\nfluent motion phase = moving\naction go:\n    poss motion = stopped and lit\n"
    )
    assert [line.split()[1] for line in found(text)][-1] == "GL012"
    assert [line.partition(" ")[2] for line in found(text)][-1] == "GL012 unknown name `lit`"
