"""Images read back: chunks, symbols, the variables that byte code uses, and what is no image."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from golc.bytecode.image import Chunk, ChunkType, Symbol, read_image, variables_used
from golc.bytecode.opcodes import instructions
from golc.diagnostics import DeviceError
from golc.nqc.toolchain import Target

MakeImage = Callable[..., bytes]
MESSAGE = bytes([0xB2, 2, 7])


def test_a_compiled_program(nqc: Callable[[str, Target], bytes]) -> None:
    text = "int x, y;\nsub help() { x = 1; }\ntask two() { y = 2; }\ntask main() { help(); start two; }\n"
    image = read_image(nqc(text, Target.RCX))
    assert image.target == 0
    assert sorted(str(chunk) for chunk in image.chunks) == ["sub 0", "task 0", "task 1"]
    assert [image.name(ChunkType.TASK, number) for number in (0, 1, 2)] == ["main", "two", ""]
    assert [(s.number, s.name) for s in image.symbols if s.type == 2] == [(0, "x"), (1, "y")]
    assert image.size == sum(len(chunk.code) for chunk in image.chunks)


def test_the_target_is_the_firmware(nqc: Callable[[str, Target], bytes]) -> None:
    assert read_image(nqc("task main() { Wait(1); }", Target.RCX2)).target == 3


def test_symbols_end_where_they_make_no_sense(image_of: MakeImage) -> None:
    data = image_of([(0, 0, MESSAGE)], symbols=[(0, 0, "main"), (2, 1, "x")])
    assert read_image(data).symbols == (Symbol(0, 0, "main"), Symbol(2, 1, "x"))
    assert read_image(data[:-2]).symbols == (Symbol(0, 0, "main"),)
    assert read_image(data[:-1] + b"y").symbols == (Symbol(0, 0, "main"),)


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "cut off"),
        (b"RCXI", "cut off"),
        (b"nonsense that is long enough", "no RCX image"),
        (b"RCXI\x02\x01\x01\x00\x00\x00\x03\x00", "cut off"),
        (b"RCXI\x02\x01\x00\x00\x00\x00\x02\x00", "another toy"),
        (b"RCXI\x02\x01\x01\x00\x00\x00\x03\x00\x00\x00\x05\x00\x90", "cut off"),
        (b"RCXI\x02\x01\x01\x00\x00\x00\x03\x00\x02\x00\x01\x00\x90\x00\x00\x00", "neither task nor sub"),
        (b"RCXI\x02\x01\x02\x00\x00\x00\x03\x00" + b"\x00\x04\x00\x00" * 2, "task 4 twice"),
    ],
)
def test_what_is_no_image_is_a_device_error(data: bytes, why: str) -> None:
    with pytest.raises(DeviceError, match=why):
        read_image(data)


@given(st.binary(max_size=80))
def test_whatever_follows_a_header_is_an_image_or_an_error(rest: bytes) -> None:
    try:
        image = read_image(b"RCXI\x02\x01" + rest)
    except DeviceError:
        return
    assert image.size <= len(rest)


def test_variables_are_found_in_every_kind_of_operand() -> None:
    setv = bytes([0x14, 3, 0, 5, 0])  # var[3] = var[5]
    constant = bytes([0x24, 4, 2, 9, 0])  # var[4] += 9
    check = bytes([0x85, 0x80 | 2, 0, 7, 0, 8, 2])  # branch if 7 != var[8]
    wait = bytes([0x43, 0, 40, 0])  # wait var[40]
    send = bytes([0xB2, 0, 11])
    indirect = bytes([0x05, 36, 12, 0, 13, 0])  # *var[12] = var[13]
    code = setv + constant + check + wait + send + indirect
    assert variables_used(Chunk(ChunkType.TASK, 0, code)) == {3, 4, 5, 8, 11, 12, 13, 40}


@pytest.mark.parametrize(("code", "why"), [([0x90, 0x00], "unknown op code 00 at 1"), ([0x90, 0x14], "cut off at 1")])
def test_what_is_no_instruction_is_a_device_error(code: list[int], why: str) -> None:
    with pytest.raises(DeviceError, match=why):
        list(instructions(bytes(code)))
