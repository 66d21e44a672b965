"""The compiled program: its image read back, and the way through the main loop counted in its byte code."""

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

from golc.diagnostics import DeviceError
from golc.nqc.image import OPERANDS, Chunk, Image, instructions, read_image, variables_used
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


def listing(workshop: Workshop, name: str, target: Target) -> list[tuple[int, int]]:
    """The instructions of every chunk as nqc lists them: place and first byte."""
    text = nqc_listing(workshop, name, target)
    lines = re.findall(r"^(\d{3,}) .*  ([0-9a-f]{2})(?: [0-9a-f]{2})* *$", text, re.MULTILINE)
    return [(int(place), int(code, 16)) for place, code in lines]


@pytest.mark.parametrize("target", list(Target))
@pytest.mark.parametrize("name", ["delivery", "elevator", "sorter"])
def test_the_instructions_are_those_that_nqc_lists(workshop: Workshop, name: str, target: Target) -> None:
    image = compiled(workshop, name, target)
    mine = [instruction for chunk in image.chunks for instruction in instructions(chunk.code)]
    assert mine == listing(workshop, name, target)


def test_an_image_says_its_target_and_size(workshop: Workshop) -> None:
    assert compiled(workshop, "delivery", Target.RCX).target == 0
    image = compiled(workshop, "delivery", Target.RCX2)
    assert image.target == 3
    assert image.size == sum(len(chunk.code) for chunk in image.chunks)


@pytest.mark.parametrize(
    "data", [b"", b"RCXI", b"nonsense that is long enough", b"RCXI\x02\x01\x01\x00\x00\x00\x03\x00"]
)
def test_what_is_no_image_is_a_device_error(data: bytes) -> None:
    with pytest.raises(DeviceError):
        read_image(data)


def test_a_cut_image_is_a_device_error(workshop: Workshop) -> None:
    compiled(workshop, "delivery", Target.RCX2)
    data = (workshop.folder / "build" / "delivery-rcx.rcx").read_bytes()
    with pytest.raises(DeviceError, match="cut off"):
        read_image(data[: len(data) // 2])


def test_variables_are_found_in_every_kind_of_operand() -> None:
    setv = bytes([0x14, 3, 0, 5, 0])  # var[3] = var[5]
    constant = bytes([0x24, 4, 2, 9, 0])  # var[4] += 9
    check = bytes([0x85, 0x80 | 2, 0, 7, 0, 8, 2])  # branch if 7 != var[8]
    wait = bytes([0x43, 0, 40, 0])  # wait var[40]
    send = bytes([0xB2, 0, 11])
    assert variables_used(Chunk(0, 0, setv + constant + check + wait + send)) == {3, 4, 5, 8, 11, 40}


def test_an_unknown_op_code_is_a_device_error() -> None:
    with pytest.raises(DeviceError, match="ff at 1"):
        list(instructions(bytes([0x90, 0xFF])))


# ---- the budget


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
        code, after = self.code, place + OPERANDS[self.code[place]].length
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
        places = dict(instructions(self.code))
        reads = [place for place, op in places.items() if op == SET and self.code[place + 2] == MESSAGE]
        read = next(place for place in reads if places[place + OPERANDS[SET].length] in COMPARISONS)
        after = read + OPERANDS[SET].length
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
