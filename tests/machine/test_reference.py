"""Independent evidence: random programs, evaluated as NQC text by these tests, against compile and run.

The evaluator works on NQC's operators with Python's integers and knows nothing of op codes, sources or tasks.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import pytest

from golc.nqc.toolchain import Target
from golc.runtime.rcxsim.machine.options import WhileSending

if TYPE_CHECKING:
    from tests.machine.conftest import Robot

MakeRobot = Callable[..., "Robot"]
NAMES = "abcdef"
NUMBERS = (0, 1, 2, 3, 7, 10, 100, 181, 255, 256, 1000, 32767, -1, -2, -3, -100, -32768)
BOTH = pytest.mark.parametrize("target", list(Target))


def i16(number: int) -> int:
    number &= 0xFFFF
    return number - 0x10000 if number & 0x8000 else number


def quotient(a: int, b: int) -> int:
    """Toward zero; by zero it is the dividend."""
    if b == 0:
        return a
    size = abs(a) // abs(b)
    return i16(size if (a >= 0) == (b >= 0) else -size)


def operate(sign: str, a: int, b: int) -> int:
    match sign:
        case "+":
            return i16(a + b)
        case "-":
            return i16(a - b)
        case "*":
            return i16(a * b)
        case "/":
            return quotient(a, b)
        case "&":
            return i16(a & b)
        case "|":
            return i16(a | b)
        case "^":
            return i16(a ^ b)
        case "%":
            return i16(a - i16(quotient(a, b) * b))
    raise AssertionError(sign)


class Straight:
    """A straight-line program as text, and what its variables are after each statement."""

    def __init__(self, seed: int, length: int) -> None:
        self.random = random.Random(seed)
        self.values = dict.fromkeys(NAMES, 0)
        self.lines = [self.assign(name, str(self.number())) for name in NAMES]
        self.lines += [self.statement() for _ in range(length)]

    @property
    def text(self) -> str:
        body = "\n".join(f"    {line}" for line in self.lines)
        return f"int {', '.join(NAMES)};\ntask main()\n{{\n{body}\n}}\n"

    def number(self) -> int:
        return self.random.choice((*NUMBERS, self.random.randint(-32768, 32767)))

    def assign(self, name: str, number: str) -> str:
        self.values[name] = int(number)
        return f"{name} = {number};"

    def operand(self) -> tuple[str, int]:
        """A variable, or a constant."""
        if self.random.random() < 0.7:
            name = self.random.choice(NAMES)
            return name, self.values[name]
        number = self.number()
        return str(number), number

    def expression(self, depth: int) -> tuple[str, int]:
        """Its left end is a variable: what nqc folds at compile time is not the machine's to compute."""
        name = self.random.choice(NAMES)
        if depth == 0:
            return name, self.values[name]
        kind = self.random.randrange(9)
        text, value = self.expression(depth - 1)
        if kind == 0:
            return f"abs({text})", min(abs(value), 32767)
        if kind == 1:
            return f"sign({text})", (value > 0) - (value < 0)
        if kind == 2:
            return f"-({text})", i16(-value)
        if kind == 3:
            return f"~({text})", i16(~value)
        sign = self.random.choice("+-*/&|^%")
        right, other = self.operand() if self.random.random() < 0.6 else self.expression(depth - 1)
        if sign == "%" and not right.isalpha():
            right, other = name, self.values[name]
        return f"({text} {sign} {right})", operate(sign, value, other)

    def statement(self) -> str:
        target = self.random.choice(NAMES)
        if self.random.random() < 0.5:
            sign = self.random.choice("+-*/&|")
            text, value = self.operand()
            self.values[target] = operate(sign, self.values[target], value)
            return f"{target} {sign}= {text};"
        text, value = self.expression(self.random.randint(1, 3))
        self.values[target] = value
        return f"{target} = {text};"


@BOTH
def test_straight_programs_compute_what_the_text_says(robot: MakeRobot, target: Target) -> None:
    for seed in range(150):
        straight = Straight(seed, 12)
        program = robot(straight.text, target).finish()
        assert {name: program.variable(name) for name in NAMES} == straight.values, straight.text


COMPARISONS: dict[str, Callable[[int, int], bool]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
}


@BOTH
def test_comparisons_branch_as_the_text_says(robot: MakeRobot, target: Target) -> None:
    chance = random.Random(1)
    pairs = [(chance.choice(NUMBERS), chance.choice(NUMBERS)) for _ in range(20)]
    for a, b in [*pairs, (5, 5), (-1, -1)]:
        tests = "".join(f"if (a {sign} b) n += {1 << place};" for place, sign in enumerate(COMPARISONS))
        tests += "".join(f"if (a {sign} {b}) n += {64 << place};" for place, sign in enumerate(COMPARISONS))
        program = robot(f"int a, b, n; task main() {{ n = 0; a = {a}; b = {b}; {tests} }}", target).run(1)
        bits = sum(compare(a, b) << place for place, compare in enumerate(COMPARISONS.values()))
        assert program.variable("n") == bits | bits << 6, (a, b)


def observed(robot: Robot) -> list[Any]:
    """What can be noticed from outside, in order, without its time."""
    kinds = ("motor", "sound", "dropped")
    seen = [{key: record[key] for key in record if key != "t"} for record in robot.records if record["what"] in kinds]
    return [seen, robot.ears.messages]


@pytest.mark.parametrize("seeds", [range(start, start + 50) for start in (0, 50, 100)])
def test_both_firmwares_do_the_same(robot: MakeRobot, random_program: Callable[..., str], seeds: range) -> None:
    """Programs of one task in which nothing depends on time, with the same time for every op code."""
    acted = 0
    for seed in seeds:
        text = random_program(seed, Target.RCX, tasks=False)
        options = {"op_time": 2000, "while_sending": WhileSending.QUEUE, "sounds": 1000}
        both = [robot(text, target, **options).finish().run(1) for target in Target]
        assert observed(both[0]) == observed(both[1]), text
        acted += len(observed(both[0])[0])
    assert acted > 100
