"""Initial values of fluents: each can be computed and lies in its type."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.loading import examine


def found(tmp_path: Path, text: str) -> list[tuple[str, str]]:
    """Message and marked text of what is found in fluents that are all used."""
    path = tmp_path / "trial.gl"
    path.write_text(f"domain trial\ntype digit = 0..9\n{text}action use(d: digit):\n    poss x(d) = x(0)\n")
    return [(finding.message, finding.span.text) for finding in examine(path).findings]


@pytest.mark.parametrize("text", ["fluent x(n: digit): digit = 9 - n\n", "fluent x(n: digit) = n * n in {4, 9}\n"])
def test_values_inside_the_type_are_fine(tmp_path: Path, text: str) -> None:
    assert found(tmp_path, text) == []


@pytest.mark.parametrize(
    ("text", "message", "marked"),
    [
        ("fluent x(n: digit): digit = n + 1\n", "the initial value 10 of `x(9)` is outside `digit` (0..9)", "n + 1"),
        (
            "fluent x(n: digit): digit = 6 // n\n",
            "the initial value of `x(0)` cannot be computed: division by zero",
            "6 // n",
        ),
        (
            "static f(n: digit): digit = f(n + 1)\nfluent x(n: digit): digit = f(n)\n",
            "the initial value of `x(0)` cannot be computed: argument 10 of `f` is outside `digit` (0..9)",
            "n + 1",
        ),
        (
            "static f(n: int): int = f(n + 1)\nfluent x(n: digit): int = f(n)\n",
            "the initial value of `x(0)` cannot be computed: the recursion of `f` does not end, or goes too deep",
            "f",
        ),
        (
            "fluent x(n: digit): digit = min m: digit where m > n. m\n",
            "the initial value of `x(9)` cannot be computed: `min` over nothing has no value",
            "min m: digit where m > n. m",
        ),
        (
            "fluent x(n: digit): digit = one of {n, n + 1}\n",
            "the initial value 10 of `x(9)` is outside `digit` (0..9)",
            "one of {n, n + 1}",
        ),
        (
            "fluent x(n: digit): digit = one of [m for m: digit where m > n]\n",
            "fluent `x(9)` is one of no values at first",
            "one of [m for m: digit where m > n]",
        ),
    ],
)
def test_the_first_wrong_instance_is_named(tmp_path: Path, text: str, message: str, marked: str) -> None:
    assert found(tmp_path, text) == [(message, marked)]


def test_what_takes_too_long_is_said_to_be_undecided(tmp_path: Path) -> None:
    (finding,) = found(tmp_path, "fluent x(n: digit): int = sum m: 1..900000. m + n\n")
    assert finding[0] == "the initial values of `x` are not decided: they take too many steps to evaluate"


def test_instances_that_do_not_matter_are_not_enumerated(tmp_path: Path) -> None:
    text = "fluent big(a: 1..900, b: 1..900): digit = 3\nfluent x(n: digit) = big(1, 2) = 3\n"
    assert found(tmp_path, text.replace("big(1, 2) = 3", "true")) == [("fluent `big` is not used", "big")]
