"""Actions with their clauses, and devices."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from golc.theory.statements import Message
from golc.theory.terms import Binder, FluentTerm, Literal, Operation, Operator, Variable
from golc.theory.theory import Binding, ByCall, ByPrompt, ByStart, Effect, Fixed, Parameter
from golc.theory.types import BOOL, INT, NONE, Interval, Optional

Build = Callable[..., Any]

STATION = Interval(1, 6)
DELIVERY = """type station = 1..6
type colour = {red, green}
fluent location: station = 1
fluent held(to: station) = false
fluent asked(origin: station): station? = none
fluent seen: colour = red
"""
LOCATION = FluentTerm("location", (), type=STATION)


def test_clauses_are_kept_in_order(theory: Build) -> None:
    built = theory(
        DELIVERY
        + """action look(s: station):
    poss location = s
    senses seen
    poss not held(s)
    senses location > 1
    cost 2 * 3
"""
    )
    look = built.actions["look"]
    assert [term.op for term in look.preconditions] == [Operator.EQUAL, Operator.NOT]
    assert [term.span.text for term in look.senses] == ["seen", "location > 1"]
    assert look.cost == Literal(6, type=INT)
    assert not look.exogenous


def test_binders_of_an_effect_follow_the_parameters(theory: Build) -> None:
    built = theory(
        DELIVERY
        + """exog push(s: station):
    causes forall m: station where m != s. held(m) := true when asked(s) = m
"""
    )
    s, m = Variable(0, "s", type=STATION), Variable(1, "m", type=STATION)
    asked = FluentTerm("asked", (s,), type=Optional(STATION))
    assert built.actions["push"].effects == (
        Effect(
            (Binder(m),),
            Operation(Operator.DIFFERENT, (m, s), type=BOOL),
            "held",
            (m,),
            Literal(True, type=BOOL),
            Operation(Operator.EQUAL, (asked, m), type=BOOL),
        ),
    )


def test_an_effect_may_set_none(theory: Build) -> None:
    built = theory(DELIVERY + "exog push:\n    causes asked(location) := none\n")
    assert built.actions["push"].effects[0].value == Literal(None, type=NONE)
    assert built.actions["push"].effects[0].args == (LOCATION,)


def test_who_reports_an_exogenous_action(theory: Build) -> None:
    built = theory(DELIVERY + "exog push from operator, left\ndevice rcx left:\n    0 push\n")
    assert built.actions["push"].sources == ("operator", "left")


def test_a_binding_without_arguments_is_for_all_instances(theory: Build) -> None:
    built = theory(DELIVERY + 'action go(s: station)\ndevice rcx "a.nqc":\n    8 .. go by call drive\n')
    (device,) = built.devices
    assert (device.kind, device.name, device.file) == ("rcx", "rcx", "a.nqc")
    assert device.bindings == (Binding("go", (Parameter("s", STATION),), 8, ByCall("drive"), table=None, timeout=None),)


def test_a_binding_may_fix_arguments(theory: Build) -> None:
    text = "action go(c: colour, s: station)\ndevice rcx:\n    0 .. go(red, s: 2..3) by start drive timeout 2.5 s\n"
    (binding,) = theory(DELIVERY + text).devices[0].bindings
    assert binding.args == (Fixed("red"), Parameter("s", Interval(2, 3)))
    assert binding.behaviour == ByStart("drive")
    assert binding.timeout == Fraction(5, 2)


def test_a_table_says_what_a_number_senses(theory: Build) -> None:
    text = "action look:\n    senses seen\ndevice rcx:\n    15 look by call peek {3: green, 1 + 3: red}\n"
    (binding,) = theory(DELIVERY + text).devices[0].bindings
    assert binding.table == {3: "green", 4: "red"}


def test_a_prompt_speaks_of_fluents_and_parameters(theory: Build) -> None:
    text = 'action ask(s: station)\ndevice operator:\n    ask by prompt "Is {s} near {location}?"\n'
    (binding,) = theory(DELIVERY + text).devices[0].bindings
    message = Message(("Is ", Variable(0, "s", type=STATION), " near ", LOCATION, "?"))
    assert binding.behaviour == ByPrompt(message)


def test_settings_have_exact_values(theory: Build) -> None:
    text = "const pause = 3\ndevice rcx left:\n    set poll 0.25 s\n    set range pause\n    set low -1\n"
    (device,) = theory(text).devices
    assert {name: setting.value for name, setting in device.settings.items()} == {
        "poll": Fraction(1, 4),
        "range": 3,
        "low": -1,
    }
    assert device.name == "left"
