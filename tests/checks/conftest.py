"""Theories by chance, of the kinds of declarations that theories of people have, and large ones."""

from __future__ import annotations

import random
import runpy
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

HEAD = """\
domain corpus{seed}

const top = {top}

type level = 0..top
type room = {{hall, kitchen, study, attic}}
type phase = {{idle, moving, broken}}
type item = {{cup, book, lamp}}
type place = room + {{charger}}

static next(r: room): room = {{hall: kitchen, kitchen: study, study: attic, attic: hall}}
static weight(i: item): 0..9 = {{cup: 1, book: 3, lamp: 7}}
static distance(a: level, b: level): int = abs(a - b)

fluent at: room = hall
fluent spot: place = charger
fluent height: level = 0
fluent mode: phase = idle
fluent load: 0..20 = 0
fluent fuel: int = {fuel}
fluent steps: int = 0
fluent spent: int = 0
fluent warm: real = 0
fluent lit(r: room) = false
fluent wanted(r: room): item? = none
fluent called(n: level) = false
fluent owner(i: item): room? = none
fluent carried: set[item] = {{}}
fluent seen(r: room): set[level] = {{}}
fluent queue: list[room] = []
fluent target: level? = none

define busy := mode = moving or exists n: level. called(n)
define heavy(i: item) := weight(i) > 2
define left := {fuel} - steps

exog fails:
    causes mode := broken
"""
"""What all of them declare; what an invariant and an action say of it is chosen."""

INVARIANTS = [
    "mode = moving or not called(0)",
    "fuel >= 0",
    "load <= 2 * weight(lamp) and load >= 0",
    "forall i: item. i in carried implies owner(i) = none",
    "target = none or target != height or mode != moving",
    "fuel + steps <= {fuel}",
    "spent <= 3 * steps + 9",
    "(count r: room. lit(r)) <= 3",
    "len(carried) <= 2",
    "forall n: level. n in seen(at) implies n <= height",
    "(sum i: item where i in carried. weight(i)) <= 10",
    "forall r: room. r in queue implies not lit(r)",
    "steps >= 0 and spent >= steps",
    "at in queue implies mode != idle",
]

CONDITIONS = [
    "mode = idle", "mode != broken", "height < top", "fuel > 0", "fuel >= n", "not lit(at)", "lit(next(at))",
    "wanted(at) != none", "len(carried) < 2", "i not in carried", "owner(i) = at", "target != none and target > height",
    "queue != []", "at in queue", "load + weight(i) <= 12", "distance(height, n) <= 2", "called(n)", "not busy",
    "exists r: room where r != at. lit(r)", "forall m: level. called(m) implies m >= height", "steps < left",
    "n in seen(at)", "steps + spent < 2 * fuel", "warm > 1.5", "spot in room", "(count m: level. called(m)) < 3",
    "not (mode = moving and called(n))", "heavy(i)", "steps % 2 = 0", "(min m: level where m > n. m) <= top",
    "carried = {}", "first(queue) = at", "height + n in level", "r != at", "len(queue) < 5",
]  # fmt: skip

EFFECTS = [
    "height := height + 1", "height := height - 1", "height := n", "mode := moving", "mode := idle", "mode := broken",
    "at := next(at)", "at := r", "spot := at", "spot := charger", "fuel := fuel - 1", "fuel := fuel + n",
    "steps := steps + 1", "steps := steps + distance(height, n)", "spent := spent + weight(i)",
    "load := load + weight(i)",
    "load := 0", "lit(at) := true", "lit(r) := not lit(r)", "forall s: room where s != at. lit(s) := false",
    "forall s: room. lit(s) := false", "wanted(at) := i", "wanted(r) := none", "called(n) := true",
    "called(height) := false", "forall m: level where m < n. called(m) := false", "owner(i) := at", "owner(i) := none",
    "carried := carried + {i}", "carried := carried - {i}", "carried := {}", "seen(at) := seen(at) + {height}",
    "seen(r) := {m for m: level where m < n}", "queue := queue + [r]", "queue := rest(queue)", "queue := []",
    "target := n", "target := none", "height := target", "warm := warm + 0.5", "at := first(queue)",
    "forall j in carried. owner(j) := at", "height := min(top, height + n)", "load := max(0, load - weight(i))",
    "fuel := 2 * fuel - steps", "mode := moving when called(n)", "spent := spent + 2 when lit(at)",
    "called(n) := false when n = height", "steps := 0 when mode = idle", "wanted(r) := none when wanted(r) = i",
]  # fmt: skip

PROGRAMS = [
    "while busy:\n        choose:\n            {a}\n        or:\n            {b}",
    "interrupts:\n        on mode = idle and fuel > 0:\n            {a}\n        on some n: level where called(n):\n"
    "            {b}\n        on true:\n            wait",
    "if steps > 3:\n        {a}\n    elif fuel = 0:\n        {b}\n    test mode != broken\n    {a}",
    "pick m: level where called(m) and m > height:\n        {a}\n    wait until not lit(at)\n    {b}",
    "for s: room where lit(s):\n        {a}\n    prefer:\n        {b}\n    over:\n        wait",
    "guard mode != broken:\n        while height < 2:\n            {a}\n"
    "    search:\n        star at most 2:\n            {b}",
]


class _Writer:
    def __init__(self, seed: int) -> None:
        self.chance = random.Random(seed)
        self.seed = seed

    def theory(self) -> str:
        top, fuel = self.chance.choice([(3, 9), (5, 20), (40, 100), (5000, 1000)])
        lines = [HEAD.format(seed=self.seed, top=top, fuel=fuel)]
        for number, body in enumerate(self.chance.sample(INVARIANTS, self.chance.randint(0, 3))):
            lines.append(f"invariant holds{number}: {body.format(fuel=fuel)}\n")
        actions = [f"act{number}" for number in range(self.chance.randint(4, 7))]
        lines += [self.action(name) for name in actions]
        primitive = [name for name, line in zip(actions, lines[-len(actions) :], strict=True) if line.startswith("a")]
        for number, body in enumerate(self.chance.sample(PROGRAMS, 2) if primitive else ()):
            called = {key: f"{self.chance.choice(primitive)}(hall, cup, 1)" for key in "ab"}
            lines.append(f"proc program{number}:\n    {body.format(**called)}\n")
        return "\n".join(lines)

    def action(self, name: str) -> str:
        kind = self.chance.choice(["action", "action", "exog"])
        number = self.chance.choice(["level", "int"]) if kind == "exog" else "level"
        lines = [f"{kind} {name}(r: room, i: item, n: {number}):"]
        lines += [f"    poss {each}" for each in self.chance.sample(CONDITIONS, self.chance.randint(0, 3))]
        fluents = set[str]()
        for effect in self.chance.sample(EFFECTS, self.chance.randint(1, 4)):
            changed = effect.split(" :=")[0].split(".")[-1].strip().split("(")[0]
            if changed not in fluents or self.chance.random() < 0.15:
                lines.append(f"    causes {effect}")
            fluents.add(changed)
        return "\n".join(lines) + "\n"


@pytest.fixture
def write_theory() -> Callable[[int], str]:
    """A theory for each seed."""
    return lambda seed: _Writer(seed).theory()


@pytest.fixture(scope="session")
def shapes() -> Mapping[str, Callable[[int], str]]:
    """Domains of about so many lines with a great deal of one thing, by what it is, as the benchmarks measure them."""
    found: Mapping[str, Callable[[int], str]] = runpy.run_path(str(Path(__file__).parents[1] / "bench/large.py"))[
        "SHAPES"
    ]
    return found
