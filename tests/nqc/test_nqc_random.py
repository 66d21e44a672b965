"""Random theories: whatever a domain says of a brick, its program compiles with the real nqc for both firmwares.

The byte code is decoded, too, and listed as nqc does it.
"""

from __future__ import annotations

import random
import subprocess
from typing import TYPE_CHECKING

import pytest

from golc.bytecode.image import read_image
from golc.bytecode.listing import listing
from golc.nqc.toolchain import Target

if TYPE_CHECKING:
    from tests.nqc.conftest import Workshop

THEORIES = 200
TYPES = {
    "station": ("1..6", 6),
    "heading": ("{-1, 1}", 2),
    "odd": ("{1, 2, 7, 30}", 4),
    "colour": ("{red, green, blue}", 3),
    "bool": ("", 2),
}
SENSED = {"0..100": "0", "bool": "false", "colour": "red", "int": "0", "station": "1"}
MOST_EVENTS = 9


def theory(rng: random.Random) -> str:
    """A domain with a brick that does, starts and reports some things, with and without arguments and numbers."""
    lines = ["domain robot", *(f"type {name} = {spelt}" for name, (spelt, _) in TYPES.items() if spelt)]
    lines += [f"fluent seen{place}: {type_} = {value}" for place, (type_, value) in enumerate(SENSED.items())]
    bindings, number, events, tasks = [], 0, 0, 0
    for place in range(rng.randint(1, 9)):
        names = rng.sample(sorted(TYPES), rng.choice([0, 0, 0, 1, 1, 2]))
        parameters = f"({', '.join(f'p{i}: {name}' for i, name in enumerate(names))})" if names else ""
        count = 1
        for name in names:
            count *= TYPES[name][1]
        exogenous = rng.random() < 0.35 and events + count <= MOST_EVENTS
        lines.append(f"{'exog' if exogenous else 'action'} a{place}{parameters}")
        if exogenous:
            events += count
        elif rng.random() < 0.4:
            lines[-1] += ":"
            lines.append(f"    senses seen{rng.randrange(len(SENSED))}")
        number += rng.choice([0, 0, 1, 7, 100])
        head = f"{number} {'.. ' if count > 1 else ''}" if rng.random() < 0.7 else ""
        number += count if head else 0
        by = "" if exogenous or rng.random() < 0.2 else f" by call f{place}"
        if by and tasks < 8 and rng.random() < 0.4:
            by, tasks = f" by start t{place}", tasks + 1
        bindings.append(f"    {head}a{place}{parameters}{by}")
    settings = rng.choice(["", "    set range 1", "    set range 2", "    set action_digits 10", "    set poll 0.1 s"])
    return "\n".join([*lines, "device rcx:", *bindings, settings, ""])


def test_random_theories_differ() -> None:
    made = {theory(random.Random(seed)) for seed in range(THEORIES)}
    assert len(made) == THEORIES
    text = "\n".join(made)
    assert all(word in text for word in (" by start ", " by call ", "exog", "senses", " .. "))


@pytest.mark.parametrize("target", list(Target))
def test_random_theories_compile_and_are_listed_as_by_nqc(workshop: Workshop, target: Target) -> None:
    for seed in range(THEORIES):
        text = theory(random.Random(seed))
        compiled = workshop.compile(text, target)
        assert 700 < compiled.image.size < 4000, text
        shown = subprocess.run(["nqc", "-L", compiled.path], capture_output=True, check=True).stdout
        assert listing(read_image(compiled.path.read_bytes())) == shown.decode("latin-1"), text
