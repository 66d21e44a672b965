"""Every error of the language at run time: its place and its text, from generated code and from the tree."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from golc.diagnostics import ProgramError
from golc.situation.dynamics import Dynamics
from golc.theory.recursion import deep_recursion
from golc.theory.theory import BasicActionTheory
from tests.theories import theory_of

DOMAIN = """domain d
type t = 1..3
type side = {left, right}
fluent x: int = 0
fluent y: t = 1
fluent z: t? = none
fluent on(n: t): bool = false
static half(n: int): int = 10 // n
static small(n: int): t = n
static ever(n: int): int = ever(n + 1)
"""

ERRORS = [
    ("x := 1 // x", "GL103", "1 // x", "division by zero"),
    ("x := 1 % x", "GL103", "1 % x", "division by zero"),
    ("x := half(x)", "GL103", "10 // n", "division by zero"),
    ("y := y + 3", "GL101", "y + 3", "`y` would be 4, which is outside `t` (1..3)"),
    ("on(x) := true", "GL100", "x", "argument 0 of `on` is outside `t` (1..3)"),
    ("x := 1 when on(y + 7)", "GL100", "y + 7", "argument 8 of `on` is outside `t` (1..3)"),
    ("x := small(7)", "GL101", "n", "`small(7)` would be 7, which is outside `t` (1..3)"),
    ("x := z + 1", "GL102", "z", "an operand is `none`, where a value is needed"),
    ("x := 1 when z < 2", "GL102", "z", "an operand is `none`, where a value is needed"),
    ("on(z) := true", "GL102", "z", "an argument of `on` is `none`, where a value is needed"),
    ("x := min n: t where on(n). n", "GL104", "min n: t where on(n). n", "`min` over nothing has no value"),
    ("x := ever(0)", "GL106", "ever", "the recursion of `ever` does not end, or goes too deep"),
    ("forall n: t. y := n", "GL105", "causes forall n: t. y := n", "two effects give `y` the values 1 and 2"),
]


def test_a_number_has_100_000_bits_at_most() -> None:
    text = "fluent two: int = 2\naction put(n: int):\n    causes x := n\naction twice:\n    causes x := x * two\n"
    dynamics = Dynamics(theory_of(DOMAIN + text))
    state = dynamics.progress(dynamics.initial(), "put", (2**99_998,))
    largest = dynamics.progress(state, "twice", ())

    assert dynamics.value(largest, "x") == 2**99_999
    with pytest.raises(ProgramError, match="goes up to 100,000 bits"):
        dynamics.progress(largest, "twice", ())


def test_a_list_has_only_so_many_elements(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("golc.situation.guards.MOST_ELEMENTS", 3)
    text = "fluent l: list[int] = [7, 8]\naction put(n: int):\n    causes l := l + [n]\n"
    dynamics = Dynamics(theory_of(DOMAIN + text))
    full = dynamics.progress(dynamics.initial(), "put", (9,))

    assert dynamics.value(full, "l") == (7, 8, 9)
    with pytest.raises(ProgramError, match="goes up to 3 elements"):
        dynamics.progress(full, "put", (9,))


@pytest.mark.parametrize(("effect", "code", "place", "message"), ERRORS, ids=[error[0] for error in ERRORS])
def test_an_effect_that_cannot_be_is_an_error_with_its_place(effect: str, code: str, place: str, message: str) -> None:
    theory = theory_of(f"{DOMAIN}action a:\n    causes {effect}\n")
    dynamics = Dynamics(theory)
    state = dynamics.realize(dynamics.initial())
    ways: list[Callable[[], object]] = [
        lambda: dynamics.progress(state, "a", ()),
        lambda: dynamics.interpreter.progress(theory.actions["a"], state, ()),
    ]
    for way in ways:
        with pytest.raises(ProgramError) as caught:
            way()
        diagnostic = caught.value.diagnostic
        assert diagnostic.code.code == code
        assert diagnostic.span.text.strip() == place
        assert diagnostic.message == message


def test_what_is_not_evaluated_is_no_error() -> None:
    theory = theory_of(f"{DOMAIN}action a:\n    causes x := 1 when x != 0 and 1 // x = 1\n")
    dynamics = Dynamics(theory)
    assert dynamics.progress(dynamics.initial(), "a", ()) == dynamics.initial()


def test_terms_may_be_as_deep_as_the_parser_allows() -> None:
    deep = "(1 + " * 480 + "x" + ")" * 480
    text = f"{DOMAIN}action a:\n    poss {'not (' * 480}x = 0{')' * 480}\n    causes x := {deep}\n"
    theory = theory_of(text)
    dynamics = Dynamics(theory)
    state = dynamics.initial()
    assert dynamics.possible(state, "a", ())
    assert dynamics.value(dynamics.progress(state, "a", ()), "x") == 480


TOTAL = "static total(n: int): int = 0 if n = 0 else n + total(n - 1)\n"
ANY = "static total(n: int): int = 0 if n = 0 or not (exists x: 1..300. total(n - 1) < 9999 * x) else n\n"


@pytest.mark.parametrize("static", [TOTAL, ANY])
def test_a_recursion_is_endless_at_one_depth(static: str) -> None:
    """With n = 999 there are 1,000 calls open at a time, the most that there may be."""
    theory = theory_of(
        f"{DOMAIN}{static}action a:\n    causes x := total(999)\naction b:\n    causes x := total(1000)\n"
    )
    for way in (lambda name: Dynamics(theory).progress(Dynamics(theory).initial(), name, ()), by_the_tree(theory)):
        way("a")
        with pytest.raises(ProgramError, match="the recursion of `total` does not end, or goes too deep"):
            way("b")


def by_the_tree(theory: BasicActionTheory) -> Callable[[str], object]:
    dynamics = Dynamics(theory)
    start = dynamics.realize(dynamics.initial())

    def progress(action: str) -> object:
        with deep_recursion():
            return dynamics.interpreter.progress(theory.actions[action], start, ())

    return progress


def test_recursive_functions_may_go_deep_if_they_end() -> None:
    theory = theory_of(f"{DOMAIN}{TOTAL}action a:\n    causes x := total(400)\n")
    dynamics = Dynamics(theory)
    assert dynamics.value(dynamics.progress(dynamics.initial(), "a", ()), "x") == 80200
