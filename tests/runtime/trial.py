"""A small theory for runs, and a device that must not be used."""

from __future__ import annotations

from golc.runtime.devices.base import Args

HEAD = """
domain trial
type digit = 0..3
type colour = {red, green}
fluent x: digit = 0
fluent p: bool = false
fluent seen: colour = red
action a
action b
action set_x(n: digit):
    causes x := n
action look:
    senses seen
exog become(n: digit):
    poss n != x
    causes x := n
exog flip:
    causes p := not p
exog overflow:
    causes x := x + 1
proc control:
"""


def program(body: str) -> str:
    return HEAD + "\n".join("    " + line for line in body.strip().splitlines()) + "\n"


def never(action: str, args: Args) -> Args:
    raise AssertionError(f"{action} was performed")
