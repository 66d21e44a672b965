"""Arithmetic on 16 bits: the values that were measured on LEGO's own firmware."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

from golc.nqc.toolchain import Target

if TYPE_CHECKING:
    from tests.machine.conftest import Robot

MakeRobot = Callable[..., "Robot"]
BOTH = pytest.mark.parametrize("target", list(Target))

GOLDEN = [
    ("7", "/=", "0", 7),
    ("-7", "/=", "2", -3),
    ("7", "/=", "-2", -3),
    ("-7", "/=", "-2", 3),
    ("-32768", "/=", "-1", -32768),
    ("1", "/=", "3", 0),
    ("300", "*=", "300", 24464),
    ("-300", "*=", "300", -24464),
    ("-32768", "*=", "-1", -32768),
    ("32767", "+=", "1", -32768),
    ("-32768", "+=", "-1", 32767),
    ("-32768", "-=", "1", 32767),
    ("-1", "&=", "0x0ff0", 0x0FF0),
    ("0x0f00", "|=", "0x00f0", 0x0FF0),
    ("0", "||=", "-32768", 32767),
    ("9", "+-=", "-5", -1),
    ("9", "+-=", "0", 0),
    ("9", "+-=", "300", 1),
    ("5", "%=", "3", 2),
]


@BOTH
@pytest.mark.parametrize(("before", "operator", "operand", "after"), GOLDEN)
def test_what_was_measured(
    robot: MakeRobot, target: Target, before: str, operator: str, operand: str, after: int
) -> None:
    assignment = f"a = a {operator[:-1]} b" if operator == "%=" else f"a {operator} b"
    program = robot(f"int a, b; task main() {{ a = {before}; b = {operand}; {assignment}; }}", target)
    assert program.run(1).variable("a") == after


@BOTH
def test_division_by_zero_leaves_the_variable_alone(robot: MakeRobot, target: Target) -> None:
    assert robot("int a, b; task main() { a = 7; b = 0; a /= b; }", target).run(1).variable("a") == 7


@BOTH
def test_a_jump_of_more_than_127_leads_forward(robot: MakeRobot, target: Target) -> None:
    """The listing of nqc shows it backward; the measured result of this program is 105."""
    long = "b += 1; " * 40
    text = f"int a, b; task main() {{ a = 105; if (a != 105) {{ {long} a = 1; }} b += 1; }}"
    program = robot(text, target).run(1)
    assert (program.variable("a"), program.variable("b")) == (105, 1)
