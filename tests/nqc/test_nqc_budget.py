"""How quickly a compiled program answers: the way through its main loop counted in its byte code."""

from __future__ import annotations

import operator
import re
import struct
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from golc.bytecode.image import Image
from golc.bytecode.opcodes import OPCODES, instructions
from golc.nqc.toolchain import Target

if TYPE_CHECKING:
    from tests.nqc.conftest import Workshop

EXAMPLES = Path(__file__).parents[2] / "examples"
BUDGET = 45
"""Op codes of the main loop between the arrival of a message and its answer."""


def compiled(workshop: Workshop, name: str, target: Target) -> Image:
    workshop.write(f"{name}.nqc", (EXAMPLES / name / f"{name}.nqc").read_text())
    return workshop.compile((EXAMPLES / name / f"{name}.gl").read_text(), target).image


def nqc_listing(workshop: Workshop, name: str, target: Target) -> str:
    command = ["nqc", f"-T{target.nqc}", "-L", f"-I{workshop.folder}", f"{name}-rcx.nqc"]
    folder = workshop.folder / "build"
    return subprocess.run(command, cwd=folder, capture_output=True, check=True, text=True).stdout


VARIABLE, TIMER, CONSTANT, MESSAGE = 0, 1, 2, 15
COMPARISONS = (0x85, 0x95)
SET, CLEAR_MESSAGE, SEND, STOP_TASK = 0x14, 0x90, 0xB2, 0x81
RELATIONS = (operator.le, operator.ge, operator.ne, operator.eq)
UNREACHABLE = -(10**6)


@dataclass(frozen=True)
class MainLoop:
    """The main task's code, seen while the variable ``known`` has a value, perhaps also the timer.

    Comparisons with what is known are decided.
    """

    code: bytes
    known: int
    value: int
    timer: int | None = None

    def following(self, place: int) -> list[int]:
        """Where an instruction can lead to."""
        code, after = self.code, place + OPCODES[self.code[place]].length
        match code[place]:
            case 0x27:
                return [place + 1 + _signed(code[place + 1] & 0x7F, code[place + 1])]
            case 0x72:
                return [place + 1 + _signed((code[place + 1] & 0x7F) + (code[place + 2] << 7), code[place + 1])]
            case 0x85 | 0x95:
                far = code[place + 6] if code[place] == 0x85 else struct.unpack_from("<h", code, place + 6)[0]
                taken = self.decide(place)
                return [after, place + 6 + far] if taken is None else [place + 6 + far if taken else after]
            case _:
                return [after]

    def decide(self, place: int) -> bool | None:
        """The outcome of a comparison of a constant with the known variable or the timer."""
        first, second, constant, variable = struct.unpack_from("<BBhB", self.code, place + 1)
        if first & 0x3F != CONSTANT:
            return None
        if second == TIMER and self.timer is not None:
            return bool(RELATIONS[first >> 6](constant, self.timer))
        if second == VARIABLE and variable == self.known:
            return bool(RELATIONS[first >> 6](constant, self.value))
        return None

    def longest(self, start: int, end: Callable[[int], bool], avoid: Callable[[int], bool]) -> int:
        """Op codes from a place up to and with the first one that is an ``end``, on the longest way to one."""

        @cache
        def count(place: int) -> int:
            if end(place):
                return 1
            if avoid(place):
                return UNREACHABLE
            return 1 + max(count(following) for following in self.following(place))

        return count(start)

    def round_and_answer(self) -> tuple[int, int]:
        """The longest round without a message, and the longest way from reading a message to the answer.

        The round goes from just after the reading of the message to the next reading, and that is included; it is one
        in which no time is up, for that happens once in seconds. The states ABORT and PANIC begin with stopping the
        worker.
        """
        places = {instruction.place: instruction.op.code for instruction in instructions(self.code)}
        reads = [place for place, op in places.items() if op == SET and self.code[place + 2] == MESSAGE]
        read = next(place for place in reads if places[place + OPCODES[SET].length] in COMPARISONS)
        after = read + OPCODES[SET].length
        ops = {kind: {p for p, op in places.items() if op == kind} for kind in (STOP_TASK, CLEAR_MESSAGE, SEND)}
        others = ops[STOP_TASK] | ops[CLEAR_MESSAGE] | ops[SEND]
        idle = replace(self, timer=0).longest(after, lambda place: place == read, lambda place: place in others)
        left = ops[STOP_TASK] | {read}
        return idle, self.longest(after, lambda place: place in ops[SEND], lambda place: place in left)


def _signed(size: int, sign: int) -> int:
    return -size if sign & 0x80 else size


def state_variable(workshop: Workshop, name: str, target: Target) -> int:
    """The number of the variable that says what is under way."""
    text = nqc_listing(workshop, name, target)
    (number,) = re.findall(r"^\*\*\* Var (\d+) = golc_state$", text, re.MULTILINE)
    return int(number)


@pytest.mark.parametrize("target", list(Target))
@pytest.mark.parametrize("name", ["delivery", "sorter"])
def test_an_answer_takes_no_more_op_codes_than_the_budget(workshop: Workshop, name: str, target: Target) -> None:
    """Polls, digits, more time, and actions that start a task: what the main loop answers by itself, in each state.

    A message that arrives just after the loop has looked waits for a round, at worst one in which an event is taken
    from its counter.
    """
    (main,) = [chunk for chunk in compiled(workshop, name, target).chunks if (chunk.type, chunk.number) == (0, 0)]
    known = state_variable(workshop, name, target)
    waiting, working, value, part = 0, 1, -1, -2
    for state in (waiting, working, value, part):
        idle, answer = MainLoop(main.code, known, state).round_and_answer()
        assert idle > 10
        assert answer > 10
        assert idle + answer <= BUDGET, (state, idle, answer)
