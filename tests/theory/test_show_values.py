from __future__ import annotations

import json
from fractions import Fraction

import pytest

from golc.theory.order import spelt
from golc.theory.types import STRING, Enumeration, number, show, show_call, writable


def test_values_are_shown_as_golc_writes_them() -> None:
    assert [show(value) for value in (None, True, False, -3, "stopped")] == ["none", "true", "false", "-3", "stopped"]
    assert show_call("a", (1, None)) == "a(1, none)"
    assert show_call("a", ()) == "a"


def test_a_number_too_large_to_write_is_cut() -> None:
    assert show(1 << 20_000) == "0x1000000000… (20001 bits)"


def test_a_number_too_large_to_write_is_a_text_in_json() -> None:
    record = {"args": (1, None, True, "red", 1 << 20_000), "state": {"n": 1 << 20_000}}
    large = "0x1000000000… (20001 bits)"
    assert writable(record) == {"args": [1, None, True, "red", large], "state": {"n": large}}
    assert json.dumps(writable(record))


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (Fraction(1, 2), "0.5"),
        (Fraction(-2005, 100), "-20.05"),
        (Fraction(1, 3), "1/3"),
        (Fraction(4, 2), "2"),
        (Fraction(1, 2**200), f"1/{2**200}"),
        (Fraction(3, 10**100), f"0.{'0' * 99}3"),
        (Fraction(3, 10**101), f"3/{10**101}"),
        (Fraction(1 << 20_000, 3), "0x1000000000… (20001 bits)/3"),
        (frozenset({10, 9, None}), "{none, 9, 10}"),
        (frozenset({frozenset({"b", "a"}), frozenset()}), "{{}, {a, b}}"),
        (("b", "a", True), "[b, a, true]"),
        ((), "[]"),
        ("two words", "two words"),
        (("two words", 'a "{" \n'), '["two words", "a \\"{{\\" \\n"]'),
    ],
)
def test_real_numbers_sets_lists_and_strings(value: object, text: str) -> None:
    assert show(value) == text


def test_strings_among_arguments_stand_in_quotes() -> None:
    assert show_call("greet", ("two words", "red", (1,))) == 'greet("two words", red, [1])'


def test_a_string_that_is_known_to_be_one_stands_in_quotes() -> None:
    assert [show(spelt(value, STRING)) for value in ("", "red", 'a "b"')] == ['""', '"red"', '"a \\"b\\""']
    assert show(spelt("red", Enumeration((("red", "colour"),)))) == "red"


def test_a_set_is_a_list_in_json_and_a_real_number_a_number_that_is_exact() -> None:
    record = {"s": frozenset({2, 1}), "l": (Fraction(1, 10),), "tiny": Fraction(1, 2**60)}
    assert writable(record) == {"s": [1, 2], "l": [0.1], "tiny": show(Fraction(1, 2**60))}
    assert show(Fraction(1, 2**60)).startswith("0.0000000000000000008673")


def test_a_whole_number_has_one_form() -> None:
    assert [number(value) for value in (Fraction(4, 2), Fraction(1, 2), "x")] == [2, Fraction(1, 2), "x"]
    assert isinstance(number(Fraction(4, 2)), int)
