"""The listing of an image, against the one that the real nqc writes for the same file."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path

import pytest

from golc.bytecode.image import read_image
from golc.bytecode.listing import listing
from golc.diagnostics import Findings
from golc.loading import load
from golc.nqc.generate import generate
from golc.nqc.numbering import number_device
from golc.nqc.toolchain import Target, compile_program

EXAMPLES = Path(__file__).parents[2] / "examples"
BOTH = pytest.mark.parametrize("target", list(Target))
Compile = Callable[[str, Target], bytes]
List = Callable[[bytes], str]


@BOTH
@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*/*.gl")), ids=lambda path: path.stem)
def test_the_examples_are_listed_as_by_nqc(tmp_path: Path, nqc_listing: List, path: Path, target: Target) -> None:
    theory = load(path)
    for device in theory.devices:
        if device.kind != "rcx":
            continue
        findings = Findings()
        actions = number_device(theory, device, findings)
        generated = generate(theory, actions, tmp_path, findings, False)
        assert generated is not None
        image = compile_program(generated.path, generated.folders, target, device.span).path.read_bytes()
        assert "*** Task 0 = main, size: " in listing(read_image(image))
        assert listing(read_image(image)) == nqc_listing(image)


@BOTH
def test_random_programs_are_listed_as_by_nqc(
    nqc: Compile, nqc_listing: List, random_program: Callable[..., str], target: Target
) -> None:
    for seed in range(300):
        image = nqc(random_program(seed, target), target)
        assert listing(read_image(image)) == nqc_listing(image), seed


@pytest.mark.parametrize("seed", range(20))
def test_random_bytes_are_listed_as_by_nqc(image_of: Callable[..., bytes], nqc_listing: List, seed: int) -> None:
    """Every op code with every kind of operand, unknown ones, and those that are cut off at the end."""
    chance = random.Random(seed)
    chunks = [(type_, n, chance.randbytes(chance.randrange(1500))) for type_ in (0, 1) for n in range(8)]
    chance.shuffle(chunks)
    image = image_of(chunks, chance.choice([0, 3]), [(0, 0, "main"), (2, 3, "x"), (1, 2, "sub"), (2, 3, "y")])
    assert listing(read_image(image)) == nqc_listing(image)


def test_a_jump_of_more_than_127_is_shown_wrong_as_nqc_shows_it(image_of: Callable[..., bytes]) -> None:
    check = bytes([0x85, 0xC2, 0, 5, 0, 1, 200])  # to 6 + 200, were it not shown as signed
    assert "chk      5 == var[1], -50   " in listing(read_image(image_of([(0, 0, check)])))


def test_a_long_first_value_runs_into_the_second_as_in_nqc(image_of: Callable[..., bytes]) -> None:
    check = bytes([0x85, 0x23, 2, 0, 0, 3, 2])
    assert "chk      FirmwareVersion(3 <= 3, 8 " in listing(read_image(image_of([(0, 0, check)])))
