"""Several theories in one program: each speaks of what it declares, or of what is joined with it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from golc.diagnostics import Diagnostic

Text = Callable[[str], str]
Wrong = Callable[[str], list[Diagnostic]]

TWO = """from __future__ import annotations
from golc.embed import Theory, after, bind, causes, each, enum, exists, expect, interval, on, poss, symbols

stairs = Theory("stairs")
step = stairs.type("step", interval(1, 3))
room = stairs.type("room", enum("hall", "attic"))
hall, attic = room
height = stairs.fluent("at", step, 1)


@stairs.action
def climb(n: step):
    causes(height, n)


theory = Theory("lift")
floor = theory.type("step", interval(1, 3))
place = theory.type("room", enum("hall", "attic"))
at = theory.fluent("at", floor, 1)
where_ = theory.fluent("spot", place, place.hall)


@theory.action(name="climb")
def ride(n: floor):
    causes(at, n)


"""


@pytest.mark.parametrize(
    ("code", "place", "name"),
    [
        ("theory.goal('g', height == 3)\n", "height", "at"),
        ("theory.goal('g', exists(step, lambda n: at == n))\n", "exists(step, lambda n: at == n)", "step"),
        ("theory.fluent('f', step, 1)\n", "step", "step"),
        ("theory.fluent('f', place, hall)\n", "hall", "hall"),
        ("theory.fluent('f', place, room.hall)\n", "room.hall", "hall"),
        ("theory.static('s', int, {attic: 1}, parameters={'r': place})\n", "{attic: 1}", "attic"),
        ("@theory.define\ndef d():\n    return any(n == at for n in step)\n", "step", "step"),
        ("@theory.define\ndef d(n: step):\n    return n == at\n", "step", "step"),
        ("@theory.define\ndef d():\n    return where_ == attic\n", "attic", "attic"),
        ("@theory.proc\ndef p():\n    climb(2)\n", "climb", "climb"),
        ("@theory.axiom(height)\ndef a():\n    pass\n", "theory.axiom(height)", "at"),
        ("@theory.axiom(at)\ndef a():\n    after(climb(n), 3)\n", "climb", "climb"),
        ("@theory.device('rcx')\ndef brick():\n    bind(climb, number=1)\n", "climb", "climb"),
    ],
)
def test_a_handle_of_another_theory_is_not_taken_for_the_own_thing_of_its_name(
    wrong_with: Wrong, code: str, place: str, name: str
) -> None:
    (found,) = wrong_with(TWO + code)

    assert (found.code.code, found.span.text) == ("GL143", place)
    assert found.message == f"`{name}` is declared by another theory, `stairs`"
    assert found.help == f"join that theory with this one by `theory.include(…)`, or declare `{name}` in this one"


def test_every_such_handle_of_a_declaration_is_said(wrong_with: Wrong) -> None:
    found = wrong_with(TWO + "@theory.action\ndef jump(n: step):\n    poss(height < n)\n    causes(height, n)\n")

    assert [(each.span.text, each.span.line) for each in found] == [("step", 29), ("height", 30), ("height", 31)]


PARTS = """from golc.embed import Theory, interval

def part(name, *included):
    made = Theory(name)
    for other in included:
        made.include(other)
    return made, made.fluent(name, interval(0, 9), 0)

"""


def test_what_is_joined_over_other_theories_can_be_meant(text_of: Text) -> None:
    text = text_of(
        PARTS
        + "a, x = part('a')\nb, y = part('b', a)\ntheory, z = part('c', b)\ntheory.goal('g', (x == y) & (y == z))\n"
    )

    assert text.endswith("goal g: a = b and b = c\n")


def test_what_is_joined_last_can_be_meant_before(text_of: Text) -> None:
    text = text_of(PARTS + "a, x = part('a')\ntheory, y = part('b')\ntheory.goal('g', x == y)\ntheory.include(a)\n")

    assert text == "domain b\n\nfluent b: 0..9 = 0\n\ngoal g: a = b\n\nfluent a: 0..9 = 0\n"


def test_theories_that_include_each_other_are_one(text_of: Text) -> None:
    text = text_of(PARTS + "a, x = part('a')\ntheory, y = part('b', a)\na.include(theory)\na.goal('g', x == y)\n")

    assert text == "domain b\n\nfluent a: 0..9 = 0\n\ngoal g: a = b\n\nfluent b: 0..9 = 0\n"


def test_names_that_no_theory_declares_belong_to_all(text_of: Text) -> None:
    text = text_of(
        "from golc.embed import Theory, enum, names, symbols, types\n"
        "low, high = symbols('low', 'high')\nlevel, bed = enum(low, high), names('bed')\nrow = types('row')\n"
        "for name in ('a', 'b'):\n"
        "    theory = Theory(name)\n"
        "    theory.fluent('f', level, low)\n"
        "    theory.fluent('g', row, bed)\n"
    )

    assert text == "domain b\n\nfluent f: {low, high} = low\nfluent g: row = bed\n"


def test_the_values_of_a_type_of_a_joined_theory_can_be_listed(text_of: Text) -> None:
    text = text_of(
        "from golc.embed import Theory, enum\n"
        "parts = Theory('parts')\nroom = parts.type('room', enum('hall', 'attic'))\n"
        "theory = Theory('house')\ntheory.include(parts)\n"
        "place = theory.type('place', room | enum('garden'))\n"
        "for one in place:\n    theory.fluent(f'in_{one}', initial=one == place.garden)\n"
    )

    assert text.endswith(
        "fluent in_hall = hall = garden\nfluent in_attic = attic = garden\nfluent in_garden = garden = garden\n"
    )
