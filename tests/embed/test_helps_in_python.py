"""What is proposed about a theory in Python: it is Python, and with it the finding is gone."""

from __future__ import annotations

from pathlib import Path

import pytest

from golc.diagnostics import Severity
from golc.loading import examine

HEAD = """from __future__ import annotations

from golc.embed import (
    Theory, bind, enum, expect, interval, one_of, poss, run, symbols, unknown, wait,
)

theory = Theory("trial")
station = theory.type("station", interval(1, 6))
phase = theory.type("phase", enum("moving", "stopped"))
moving, stopped = phase
"""

TURN = """
@theory.action
def turn():
    pass

"""

BRICK = f"""{TURN}
@theory.exog(sources=["rcx"])
def lost():
    pass

@theory.device("rcx", file="trial.nqc")
def rcx():
    {{rcx}}
"""

PROPOSED = {
    "a value behind a type": (
        'lit = theory.fluent("lit", bool)',
        'write it behind the type: `theory.fluent("lit", bool, False)`',
        'lit = theory.fluent("lit", bool, False)',
    ),
    "a value in a body": (
        "@theory.fluent\ndef lit(n: station): ...",
        "write `return False` in its body",
        "@theory.fluent\ndef lit(n: station):\n    return False",
    ),
    "the type of a fluent": (
        'at = theory.fluent("at", initial=3)',
        'write its type: `theory.fluent("at", int, 3)`',
        'at = theory.fluent("at", int, 3)',
    ),
    "the type of a static": (
        "@theory.static\ndef next_(n: station):\n    return n + 1",
        "write its type: `def next_(…) -> int: …`",
        "@theory.static\ndef next_(n: station) -> int:\n    return n + 1",
    ),
    "a symbol": (
        'motion = theory.fluent("motion", phase, "stopped")',
        "a string of Python is no symbol: write `phase.stopped`",
        'motion = theory.fluent("motion", phase, phase.stopped)',
    ),
    "a symbol of a type without a name": (
        'gate = theory.fluent("gate", enum("open", "shut"), "open")',
        'a string of Python is no symbol: write `symbols("open")`',
        'gate = theory.fluent("gate", enum("open", "shut"), symbols("open"))',
    ),
    "an empty set": (
        'wanted = theory.fluent("wanted", set[station], [])',
        "the empty set is `set()`",
        'wanted = theory.fluent("wanted", set[station], set())',
    ),
    "a type with None": (
        'wanted = theory.fluent("wanted", station, None)',
        "the type `station | None` has the value `None`, too",
        'wanted = theory.fluent("wanted", station | None, None)',
    ),
    "a range": (
        "@theory.fluent\ndef lit(n: int):\n    return False",
        "give a range, for example `interval(1, 10)`, or a declared type",
        "@theory.fluent\ndef lit(n: interval(1, 10)):\n    return False",
    ),
    "a choice": (
        'at = theory.fluent("at", station, one_of(3))',
        "write `one_of({…})`",
        'at = theory.fluent("at", station, one_of({3}))',
    ),
    "what is true at first": (
        'lit = theory.fluent("lit", bool, unknown)\ntheory.invariant("dark", ~lit)',
        "if it is never so, say it: `theory.initially(…)`",
        'lit = theory.fluent("lit", bool, unknown)\ntheory.initially(~lit)\ntheory.invariant("dark", ~lit)',
    ),
    "a comparison beside a sign": (
        'on = theory.fluent("on", bool, True)\nat = theory.fluent("at", station, 1)\ntheory.goal("g", on & at)',
        "compare it: `(at == …)`",
        'on = theory.fluent("on", bool, True)\nat = theory.fluent("at", station, 1)\ntheory.goal("g", on & (at == 1))',
    ),
    "what does not depend on a variable": (
        'lit = theory.fluent("lit", bool, True)\n'
        "@theory.invariant\ndef well():\n    return any(n == 3 or lit for n in station)",
        "write `any(…) or …`",
        'lit = theory.fluent("lit", bool, True)\n'
        "@theory.invariant\ndef well():\n    return any(n == 3 for n in station) or lit",
    ),
    "a call without arguments": (
        TURN + "@theory.proc\ndef control():\n    turn(3)",
        "write `turn()` alone",
        TURN + "@theory.proc\ndef control():\n    turn()",
    ),
    "a wait for an event": (
        "@theory.exog\ndef lost():\n    pass\n\n@theory.proc\ndef control():\n    lost()",
        "wait for it, for example with `wait(until=…)`",
        "@theory.exog\ndef lost():\n    pass\n\n@theory.proc\ndef control():\n    wait(until=poss(lost()))",
    ),
    "what a scenario runs": (
        TURN + "@theory.proc\ndef go():\n    turn()\n\n@theory.scenario\ndef once():\n    expect(turn(), exactly=1)",
        "add a line `run(…)`",
        TURN + "@theory.proc\ndef go():\n    turn()\n\n"
        "@theory.scenario\ndef once():\n    run(go())\n    expect(turn(), exactly=1)",
    ),
    "a device for an action": (
        BRICK.format(rcx="bind(lost)"),
        'write `bind(turn)` under a device; one under `@theory.device("self")` is for mere bookkeeping',
        BRICK.format(rcx='bind(lost)\n\n@theory.device("self")\ndef books():\n    bind(turn)'),
    ),
    "a device for an event": (
        BRICK.format(rcx="bind(turn)"),
        "write `bind(lost)` under the brick",
        BRICK.format(rcx="bind(turn)\n    bind(lost)"),
    ),
    "a file for a host": (
        TURN + '@theory.device("host")\ndef host():\n    bind(turn)',
        'write `@theory.device("host", file="helpers.py")`',
        TURN + '@theory.device("host", file="helpers.py")\ndef host():\n    bind(turn)',
    ),
    "several numbers": (
        "@theory.action\ndef go(n: station):\n    pass\n\n"
        '@theory.device("rcx", file="trial.nqc")\ndef rcx():\n    bind(go, number=4)',
        "write `first=4`, which takes the numbers from 4 on",
        "@theory.action\ndef go(n: station):\n    pass\n\n"
        '@theory.device("rcx", file="trial.nqc")\ndef rcx():\n    bind(go, first=4)',
    ),
}


@pytest.mark.parametrize("wrong, proposed, right", PROPOSED.values(), ids=PROPOSED.keys())
def test_what_is_proposed_helps(wrong: str, proposed: str, right: str, tmp_path: Path) -> None:
    (tmp_path / "helpers.py").write_text("def turn():\n    pass\n", encoding="utf-8")
    path = tmp_path / "trial.py"
    helps = []
    for text in (wrong, right):
        path.write_text(f"{HEAD}\n{text}\n", encoding="utf-8")
        found = examine(path, proofs=True).findings
        helps.append([finding.help for finding in found if finding.help or finding.severity is Severity.ERROR])

    assert helps == [[proposed], []]
