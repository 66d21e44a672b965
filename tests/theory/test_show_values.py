from __future__ import annotations

from golc.theory.types import show, show_call


def test_values_are_shown_as_golc_writes_them() -> None:
    assert [show(value) for value in (None, True, False, -3, "stopped")] == ["none", "true", "false", "-3", "stopped"]
    assert show_call("a", (1, None)) == "a(1, none)"
    assert show_call("a", ()) == "a"


def test_a_number_too_large_to_write_is_cut() -> None:
    assert show(1 << 20_000) == "0x1000000000… (20001 bits)"
