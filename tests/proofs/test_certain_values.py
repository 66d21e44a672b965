"""What certainly has a value, by its types or by what was asked before it."""

from __future__ import annotations

import pytest

from golc.proofs.certain import Certainty
from tests.theories import theory_of

HEAD = """\
domain trial
type small = 0..3
fluent x: small = 0
fluent y: int = 0
fluent on(n: small): bool = false
fluent route: list[small] = []
fluent queue: list[list[small]] = []
fluent key: small? = none
fluent seen: set[small] = {}
define filled := route != []
define top := first(route)
static same(n: small): small = n
static below(n: small): small = n - 1
action go(n: small):
    poss on(n)
action look:
    poss first(route) = 1
"""


@pytest.mark.parametrize(
    "formula",
    [
        "on(x)",
        "same(x) = 1",
        "poss(go(x))",
        "x // 2 = 1",
        "route != [] and first(route) = 1",
        "len(route) > 0 and first(route) = 1",
        "len(route) >= 1 and first(route) = 1",
        "len(route) != 0 and first(route) = 1",
        "len(route) = 2 and route[0] = 1",
        "0 < len(route) and rest(route) = []",
        "1 <= len(route) and first(route) = 1",
        "2 in route and first(route) = 2",
        "filled and first(route) = 1",
        "not (len(route) <= 0) and first(route) = 1",
        "route = [] or first(route) = 1",
        "len(route) < 1 or first(route) = 1",
        "route != [] implies first(route) = 1",
        "(first(route) if route != [] else 0) = 1",
        "(0 if route = [] else first(route)) = 1",
        "key != none and on(key)",
        "key in small and on(key)",
        "(forall n: small where n in route. first(route) <= n)",
        "[first(l) for l in queue where l != []] = [1]",
        "(count n in seen. on(n)) > 1",
    ],
)
def test_certain(formula: str) -> None:
    assert judged(formula)


@pytest.mark.parametrize(
    "formula",
    [
        "on(y)",
        "below(x) = 1",
        "poss(look)",
        "3 // x = 1",
        "first(route) = 1",
        "top = 1",
        "len(route) >= 0 and first(route) = 1",
        "len(route) != 1 and first(route) = 1",
        "len(route) = 0 and first(route) = 1",
        "len(route) < 2 and first(route) = 1",
        "len(route) > 1 and route[1] = 1",
        "0 <= len(route) and first(route) = 1",
        "1 >= len(route) and first(route) = 1",
        "not filled and first(route) = 1",
        "route != [] or first(route) = 1",
        "first(route) = 1 and route != []",
        "route = [] implies first(route) = 1",
        "(first(route) if route = [] else 0) = 1",
        "(0 if route != [] else first(route)) = 1",
        "queue != [] and first(first(queue)) = 1",
        "on(key)",
        "key != none or on(key)",
        "(forall n: small where n not in route. first(route) <= n)",
        "[first(l) for l in queue] = [1]",
        "(max n in seen. n) > 1",
    ],
)
def test_not_certain(formula: str) -> None:
    assert not judged(formula)


def judged(formula: str) -> bool:
    theory = theory_of(f"{HEAD}define asked := {formula}\n")
    return Certainty(theory).has_value(theory.definitions["asked"].body, ())
