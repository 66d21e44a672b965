from __future__ import annotations

import json

from golc.theory.types import show, show_call, writable


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
