"""What is unknown at first or after an action, what holds in every initial world, and formulas about knowledge."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from golc.theory.scenarios import Assignment, Assumption
from golc.theory.terms import Choice, Display, Epistemic, FluentTerm, Literal, Operation, Operator, Variable
from golc.theory.types import BOOL, INT, Collection, Interval, Optional

Build = Callable[..., Any]

FLOOR = Interval(1, 3)
HEAD = """type floor = 1..3
type door = {open, closed}
fluent gate(f: floor): door = unknown
fluent load: floor = one of {1, 3}
fluent lit = unknown
fluent at: floor = 2
"""


def test_unknown_is_the_list_of_the_values_in_order(theory: Build) -> None:
    fluents = theory(HEAD + "fluent call: floor? = unknown\n").fluents
    door = fluents["gate"].type
    assert fluents["gate"].initial == Choice(Literal(("open", "closed"), type=Collection("list", door)), type=door)
    assert fluents["lit"].initial == Choice(Literal((False, True), type=Collection("list", BOOL)), type=BOOL)
    call = Optional(FLOOR)
    assert fluents["call"].initial == Choice(Literal((None, 1, 2, 3), type=Collection("list", call)), type=call)
    assert fluents["lit"].initial.span.text == "unknown"


def test_one_of_takes_terms_over_the_parameters(theory: Build) -> None:
    fluents = theory(HEAD + "fluent next(n: floor): int = one of {n, n + 1}\n").fluents
    n, two = Variable(0, "n", type=FLOOR), Literal(1, type=INT)
    elements = (n, Operation(Operator.ADD, (n, two), type=INT))
    assert fluents["next"].initial == Choice(Display(elements, type=Collection("set", INT)), type=INT)
    assert fluents["load"].initial.among.elements == (Literal(1, type=INT), Literal(3, type=INT))
    assert fluents["load"].initial.span.text == "one of {1, 3}"


def test_one_value_is_a_choice_too(theory: Build) -> None:
    built = theory("fluent sure: 1..3 = one of [2]\n")
    type_ = Collection("list", Interval(1, 3))
    assert built.fluents["sure"].initial.among == Display((Literal(2, type=INT),), type=type_)


@pytest.mark.parametrize(
    ("choices", "type_"),
    [
        ("floor", Collection("list", FLOOR)),
        ("near", Collection("list", INT)),
        ("[n for n: floor where n != 2]", Collection("list", FLOOR)),
        ("{n for n: floor where n != 2}", Collection("set", FLOOR)),
        ("around(1)", Collection("list", FLOOR)),
    ],
)
def test_any_term_that_is_a_collection_may_be_chosen_from(theory: Build, choices: str, type_: Collection) -> None:
    text = (
        "type floor = 1..3\nconst near = [1, 2]\n"
        "static around(n: floor): list[floor] = [m for m: floor where m != n]\n"
        f"fluent load: floor = one of {choices}\n"
    )
    assert theory(text).fluents["load"].initial.among.type == type_


def test_an_effect_chooses_among_terms_of_the_situation_before_it(theory: Build) -> None:
    text = "action throw(n: floor):\n    causes at := one of {at, n} when lit\n    causes gate(n) := unknown\n"
    thrown, opened = theory(HEAD + text).actions["throw"].effects
    at, n = FluentTerm("at", (), type=FLOOR), Variable(0, "n", type=FLOOR)
    assert thrown.value == Choice(Display((at, n), type=Collection("set", FLOOR)), type=FLOOR)
    assert thrown.condition == FluentTerm("lit", (), type=BOOL)
    assert opened.value.among.value == ("open", "closed")


def test_a_line_of_an_axiom_chooses_too(theory: Build) -> None:
    text = (
        "action throw(n: floor)\naction shake\n"
        "axiom at:\n    after throw(f) := one of {at, f}\n    after shake := unknown\n    otherwise unchanged\n"
    )
    built = theory(HEAD + text)
    at, f = FluentTerm("at", (), type=FLOOR), Variable(0, "f", type=FLOOR)
    (thrown,), (shaken,) = built.actions["throw"].effects, built.actions["shake"].effects
    assert thrown.value == Choice(Display((at, f), type=Collection("set", FLOOR)), type=FLOOR)
    assert shaken.value.among.value == (1, 2, 3)


def test_constraints_on_the_initial_worlds_are_kept_in_order(theory: Build) -> None:
    text = "define low := load = 1\ninitially low or lit\ninitially forall f: floor. gate(f) = open or f != at\n"
    built = theory(HEAD + text)
    assert [condition.span.text for condition in built.initially] == [
        "low or lit",
        "forall f: floor. gate(f) = open or f != at",
    ]


@pytest.mark.parametrize("kind", ["known", "knows", "possible"])
def test_knowledge_is_asked_for_in_any_formula(theory: Build, kind: str) -> None:
    asked = f"{kind}(lit)"
    text = (
        f"define d(f: floor) := {kind}(gate(f) = open)\ngoal g: {asked}\ninvariant i: {asked}\n"
        f"action a:\n    poss {asked}\n    causes lit := {asked} when {asked}\n    senses {asked}\n"
        f"proc control:\n    while not {asked}:\n        a\n    pick f: floor where {kind}(lit):\n        a\n"
        f"prune p: {asked}\n"
    )
    built = theory(HEAD + text)
    lit = Epistemic(kind, FluentTerm("lit", (), type=BOOL), type=BOOL)  # type: ignore[arg-type]
    assert built.definitions["g"].body == built.prunes["p"].condition == lit
    assert built.actions["a"].preconditions == built.actions["a"].senses == (lit,)
    assert built.actions["a"].effects[0].value == built.actions["a"].effects[0].condition == lit
    assert isinstance(built.definitions["d"].body, Epistemic)


def test_the_value_of_any_term_may_be_known_and_knowledge_of_knowledge_too(theory: Build) -> None:
    built = theory(HEAD + "define a := known(load + 1)\ndefine b := knows(not known(load))\n")
    assert built.definitions["a"].body.body.type == INT
    body = built.definitions["b"].body
    assert isinstance(body, Epistemic) and isinstance(body.body, Operation) and isinstance(body.body.args[0], Epistemic)


def test_a_scenario_says_which_world_is_the_real_one(theory: Build) -> None:
    text = (
        "proc control:\n    skip\nscenario s:\n    given gate(1) = open and at = 1\n    given lit\n    given load = 3\n"
    )
    chosen, moved, lit, load = theory(HEAD + text).scenarios["s"].givens
    assert moved == Assignment("at", (), 1)
    assert [type(given) for given in (chosen, lit, load)] == [Assumption] * 3
    assert [given.condition.span.text for given in (chosen, lit, load)] == ["gate(1) = open", "lit", "load = 3"]


@pytest.mark.parametrize(
    ("line", "finding"),
    [
        ("given load = 4", "4:18 GL017 `4` is outside `floor` (1..3)"),
        ("given load = 1 and load = 3", "4:24 GL011 `load` is given two values"),
        ("given gate(5) = open", "4:16 GL017 `5` is outside `floor` (1..3)"),
    ],
)
def test_what_a_scenario_says_of_the_real_world_fits_its_type(found: Build, line: str, finding: str) -> None:
    lines = HEAD.count("\n")
    text = f"{HEAD}proc control:\n    skip\nscenario s:\n    {line}\n"
    number, _, rest = finding.partition(":")
    assert found(text) == [f"{lines + int(number)}:{rest}"]


def test_an_exogenous_action_may_be_expected(theory: Build) -> None:
    actions = theory(HEAD + "exog stop expected\nexog call(f: floor) expected from rcx\nexog knock\n").actions
    assert [action.expected for action in actions.values()] == [True, True, False]
    assert actions["call"].sources == ("rcx",)
