"""Values as people type them."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest

from golc.diagnostics import Findings, Source, Span, UserError
from golc.theory.ground import example, read_exogenous, read_procedure
from golc.theory.types import Value

Build = Callable[..., Any]

DOMAIN = """type colour = {red, green}
type digit = 0..9
const half = 0.5
const few = [1, 2]
const word = "red"
exog told(who: string?, ahead: set[colour], way: list[list[digit]], speed: real)
proc control(x: real?, c: colour, l: list[colour]):
    skip
"""
BOTH = frozenset({"red", "green"})


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ('told("a b", {green, red, red}, [[1], []], 0.50)', ("a b", BOTH, ((1,), ()), Fraction(1, 2))),
        ("told(none, {}, [few, digit], half)", (None, frozenset(), ((1, 2), tuple(range(10))), Fraction(1, 2))),
        ('told("", {red}, [], -2.0)', ("", frozenset({"red"}), (), -2)),
    ],
)
def test_values_of_every_type_can_be_typed(theory: Build, text: str, values: tuple[Value, ...]) -> None:
    findings = Findings()
    call = read_exogenous(theory(DOMAIN), Span(Source("<stdin>", text), 0, len(text)), findings)
    assert findings.diagnostics == []
    assert call is not None and call.args == values and [*map(type, call.args)] == [*map(type, values)]


@pytest.mark.parametrize(
    ("args", "marked", "message"),
    [
        ("1, red, [red, none]", "none", "an element of `l` of `control` is of type colour (red, green), not `none`"),
        ("1, red, {red}", "{red}", "`l` of `control` is of type list[colour], not `{red}`"),
        ('"1", red, []', '"1"', '`x` of `control` is of type real or none, not `"1"`'),
        ('1, "red", []', '"red"', '`c` of `control` is of type colour (red, green), not `"red"`'),
        ("red, red, []", "red", "`x` of `control` is of type real or none, not `red`"),
        ("1, word, []", "word", "`c` of `control` is of type colour (red, green), not `word`"),
        ("1, few, []", "few", "`c` of `control` is of type colour (red, green), not `few`"),
        ("1, red, [yellow]", "yellow", "unknown value `yellow`"),
        ("1, red, digit", "digit", "`l` of `control` is of type list[colour], not `digit`"),
        ("1 + 1, red, []", "1 + 1", "a value is needed, not an expression"),
        ('1, red, ["{half}"]', '"{half}"', "a value is needed, not an expression"),
    ],
)
def test_what_is_no_value_of_its_type_is_said_at_its_place(theory: Build, args: str, marked: str, message: str) -> None:
    with pytest.raises(UserError) as caught:
        read_procedure(theory(DOMAIN), f"control({args})")
    (finding,) = caught.value.diagnostics
    assert (finding.message, finding.span.text) == (message, marked)


def test_the_example_of_an_event_can_be_typed(theory: Build) -> None:
    built = theory(DOMAIN)
    text = example(built, exogenous=True)
    assert text == 'told("some text", {green}, [[9]], 0.5)'
    assert read_exogenous(built, Span(Source("<stdin>", text), 0, len(text)), Findings()) is not None
