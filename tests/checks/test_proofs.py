"""What ``golc check`` proves, or refutes with an example, about all situations of a theory."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.diagnostics import Diagnostic
from golc.loading import examine

ROOT = Path(__file__).parents[2]
LEGOLOG = ROOT / "tests/programs/legolog_delivery.gl"


def proved(path: Path) -> tuple[list[tuple[str, int, str]], tuple[str, ...]]:
    """Code, line and message of what proofs find, and all their notes."""
    found = [finding for finding in examine(path, proofs=True).findings if _is_proved(finding)]
    places = [(finding.code.code, finding.span.line, finding.message) for finding in found]
    return places, tuple(note for finding in found for note in finding.notes)


def _is_proved(finding: Diagnostic) -> bool:
    return "GL040" <= finding.code.code <= "GL049" or "GL071" <= finding.code.code <= "GL079"


def test_the_original_delivery_robot_has_three_faults() -> None:
    found, notes = proved(LEGOLOG)
    assert found == [
        (
            "GL041",
            21,
            "`arrive_at_station` can go wrong: `location` would be 0, which is outside `station` (1..6)",
        ),
        ("GL040", 29, "`push_go_button` may give `holding_delivery_for` two values at once"),
        ("GL072", 41, "`start_to_next_station` can never be possible here"),
    ]
    assert notes == (
        "for example when location = 1, direction = -1, motion = moving and `arrive_at_station` happens",
        "for example when location = 1, delivery_requested(1) = 1 and `push_go_button` happens",
    )


PARTS = (ROOT / "examples/greenhouse/beds.gl",)
"""Files without actions, whose declarations are proved where they are imported."""


@pytest.mark.parametrize(
    "path", [path for path in sorted(ROOT.glob("examples/*/*.gl")) if path not in PARTS], ids=lambda path: path.stem
)
def test_nothing_is_wrong_with_the_examples(path: Path) -> None:
    examined = examine(path, proofs=True)
    assert examined.findings == ()
    assert examined.asked > 0
    assert examined.undecided == 0


def test_nothing_is_wrong_with_the_museum_and_its_floor_plan() -> None:
    examined = examine(ROOT / "examples/museum/museum.gl", proofs=True, trust=True)
    assert (examined.findings, examined.undecided) == ((), 0)


DOMAIN = """\
domain trial
type small = 0..3
type door = {open, closed, locked}
fluent x: small = 0
fluent y: int = 0
fluent gate: door = closed
fluent on(n: small): bool = false
"""


def found(tmp_path: Path, text: str) -> list[tuple[str, int, str]]:
    path = tmp_path / "trial.gl"
    path.write_text(DOMAIN + text)
    return proved(path)[0]


CASES = {
    "an effect that leaves its type": (
        "action a:\n    causes x := x + 1\n",
        [("GL041", 9, "`a` can go wrong: `x` would be 4, which is outside `small` (0..3)")],
    ),
    "kept in its type by the precondition": ("action a:\n    poss x < 3\n    causes x := x + 1\n", []),
    "kept in its type by an invariant": (
        "invariant low: x < 3\naction a:\n    poss gate = open and not on(1)\n"
        "    causes x := 2\n    causes on(x + 1) := true\n",
        [],
    ),
    "parameters that cannot be gone through and do not matter": (
        "exog tell(s: string, r: real, l: list[int]):\n    poss x < 3\n    causes x := x + 1\ninvariant shut: x >= 0\n",
        [],
    ),
    "a set that loses what another one gets": (
        "fluent here: set[door] = {open, locked}\nfluent there(n: small): set[door] = {}\n"
        "invariant once: forall d: door. d in here or d in there(0) or not exists n: small. d in there(n)\n"
        "action move(some_: set[door]):\n    poss forall d in some_. d in here\n    causes here := here - some_\n"
        "    causes there(0) := there(0) + some_\n",
        [],
    ),
    "what is in a list, if it has ten elements or none": (
        "fluent l: list[door] = []\ninvariant shut: open not in l or gate = open\n"
        "action a:\n    poss gate = open\n    causes l := l + [open]\n"
        "action b:\n    causes gate := closed\n    causes l := l - [open]\n",
        [],
    ),
    "an unbounded integer that leaves a small type": (
        "action a:\n    poss y >= 0\n    causes x := y\n",
        [("GL041", 10, "`a` can go wrong: `x` would be 4, which is outside `small` (0..3)")],
    ),
    "effects of different conditions": (
        "action a(n: small):\n    causes on(n) := true when x = 1\n    causes on(2) := false when x != 1\n",
        [],
    ),
    "effects that meet for one argument": (
        "action a(n: small):\n    causes on(n) := true\n    causes on(2) := false\n",
        [("GL040", 10, "`a` may give `on` two values at once")],
    ),
    "one effect that meets itself": (
        "action a:\n    causes forall n: small. x := n\n",
        [("GL040", 9, "`a` may give `x` two values at once")],
    ),
    "effects for values of variables of their own": (
        "action a:\n    causes forall n: small. x := 1 when n = 1\n    causes forall n: small. x := 2 when n = 2\n",
        [("GL040", 10, "`a` may give `x` two values at once")],
    ),
    "an invariant that an action breaks": (
        "invariant shut: gate != open or x = 0\naction a:\n    causes x := 1\n",
        [("GL042", 9, "`a` may break invariant `shut`")],
    ),
    "an invariant that is preserved": (
        "invariant shut: gate != open or x = 0\naction a:\n    causes x := 1\n    causes gate := locked\n",
        [],
    ),
    "an invariant broken by an unknown value": (
        "invariant shut: gate != open\naction a:\n    causes gate := unknown\n",
        [("GL042", 9, "`a` may break invariant `shut`")],
    ),
    "an action that is never possible": (
        "action a:\n    poss gate = open and gate = closed\n    causes x := 1\n",
        [("GL043", 9, "`a` can never be possible")],
    ),
    "a precondition that has no value": (
        "action a:\n    poss on(x + 1)\n",
        [("GL041", 9, "`a` can go wrong: argument 4 of `on` is outside `small` (0..3)")],
    ),
    "the first of a list that may be empty": (
        "fluent l: list[small] = []\naction a:\n    causes x := first(l)\n",
        [("GL041", 10, "`a` can go wrong: `first` of an empty list has no value")],
    ),
    "the first of a list that has one": (
        "fluent l: list[small] = []\naction a:\n    poss l != [] and x < 3\n"
        "    causes on(first(l)) := true\n    causes l := rest(l)\n    causes x := x + 1\n",
        [],
    ),
    "sets and lists that change": (
        "fluent l: list[small] = []\nfluent s: set[small]? = none\naction a(n: small):\n    poss s != none and n in s\n"
        "    causes s := s - {n}\n    causes l := l + [m for m in s where m != n]\n"
        "    causes forall m in l. on(m) := m in s\n",
        [],
    ),
    "a list and two effects": (
        "fluent l: list[small] = []\naction a:\n    causes forall m in l. on(m) := true\n    causes on(1) := false\n",
        [("GL040", 11, "`a` may give `on` two values at once")],
    ),
    "a string and a real number": (
        'fluent n: string = ""\nfluent r: real = 0\naction a(t: string, q: real):\n    poss n != t and q > r\n'
        '    causes n := "{t} {q}"\n    causes r := r + q * 0.5\n',
        [],
    ),
    "an interrupt that never fires": (
        "invariant never_locked: gate != locked\n"
        "proc control:\n    interrupts:\n        on gate = locked:\n            wait\n",
        [("GL071", 11, "this interrupt can never fire: its condition is false in every situation")],
    ),
    "an action after a test that excludes it": (
        "action a:\n    poss gate = open\nproc control:\n    test gate = closed\n    a\n",
        [("GL072", 12, "`a` can never be possible here")],
    ),
    "an instance that is never possible, though others are": (
        "action a(n: small):\n    poss n != 2\n    causes x := n\nproc control:\n    a(1)\n    a(2)\n",
        [("GL072", 13, "`a(2)` can never be possible here")],
    ),
    "an action that somebody may make possible meanwhile": (
        "action a:\n    poss gate = open\nexog opens:\n    causes gate := open\n"
        "proc control:\n    test gate = closed\n    a\n",
        [],
    ),
    "an action that another branch may do meanwhile": (
        "action inc:\n    poss x < 3\n    causes x := x + 1\nproc control:\n    together:\n        test x = 1\n"
        "        if x = 1:\n            inc\n    and:\n        inc\n",
        [],
    ),
    "a branch that nothing disturbs": (
        "action inc:\n    poss x < 3\n    causes x := x + 1\naction b\nproc control:\n"
        "    together:\n        test x = 1\n        if x = 1:\n            inc\n    and:\n        b\n",
        [("GL073", 15, "this condition is always true here")],
    ),
    "an action that an action before it makes possible": (
        "action a:\n    poss gate = open\naction b:\n    causes gate := open\n"
        "proc control:\n    test gate = closed\n    b\n    a\n",
        [],
    ),
    "a condition that is false where it stands": (
        "action a:\n    causes x := 1\nproc control:\n    if gate = open:\n        if gate = closed:\n            a\n",
        [("GL073", 12, "this condition is always false here")],
    ),
    "a condition that is true where it stands": (
        "action a:\n    causes x := 1\n"
        "proc control:\n    while gate = open:\n        if gate != closed:\n            a\n        b\n"
        "action b:\n    causes gate := locked\n",
        [("GL073", 12, "this condition is always true here")],
    ),
    "a loop that nothing ends": (
        "action a:\n    causes x := 1\nproc control:\n    while gate = open:\n        a\n",
        [("GL074", 11, "nothing in this loop changes its condition, so that it never ends once it has begun")],
    ),
    "a loop that an exogenous action ends": (
        "action a:\n    causes x := 1\nexog shut:\n    causes gate := closed\n"
        "proc control:\n    while gate = open:\n        a\n",
        [],
    ),
    "effects on conditions about knowledge that exclude each other": (
        "action look:\n    senses gate\n"
        "action a:\n    causes x := 1 when known(gate)\n    causes x := 2 when not known(gate)\n",
        [
            (
                "GL049",
                12,
                "whether these effects of `a` agree on `x` is not decided: it depends on what the agent knows then",
            )
        ],
    ),
    "an invariant about what is known afterwards": (
        "invariant sure: known(x)\naction a:\n    causes x := 1\n",
        [
            (
                "GL049",
                9,
                "whether `a` preserves invariant `sure` is not decided: it depends on what the agent knows then",
            )
        ],
    ),
    "a value outside its type where something is known": (
        "action look:\n    senses gate\naction a:\n    poss knows(gate = open)\n    causes x := x + 1\n",
        [("GL041", 12, "`a` can go wrong: `x` would be 4, which is outside `small` (0..3)")],
    ),
    "what is known of a variable of the program": (
        "fluent key: small = unknown\naction a(n: small):\n    causes x := n\n"
        "proc control:\n    pick n: small where possible(key = n):\n        a(n)\n",
        [],
    ),
    "what is known is as good as true": (
        "action look:\n    senses gate\naction a:\n    poss knows(gate = open) and gate = closed\n"
        "proc control:\n    look\n    a\n",
        [("GL043", 11, "`a` can never be possible")],
    ),
}


def test_what_is_proved_stands_among_the_other_findings_in_the_order_of_the_places(tmp_path: Path) -> None:
    path = tmp_path / "trial.gl"
    path.write_text(f"{DOMAIN}const spare = 3\naction a:\n    causes x := x + 1\nconst rest = 4\n")
    findings = examine(path, proofs=True).findings
    assert [(f.code.code, f.span.line) for f in findings if f.span.line > 7] == [
        ("GL027", 8),
        ("GL041", 10),
        ("GL027", 11),
    ]


@pytest.mark.parametrize(("text", "expected"), CASES.values(), ids=CASES)
def test_a_property_of_all_situations(tmp_path: Path, text: str, expected: list[tuple[str, int, str]]) -> None:
    assert found(tmp_path, text) == expected
