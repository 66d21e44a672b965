"""Large domains: of many declarations as a person might write them, and with a great deal of one thing.

Neither time grows faster than the file: ``python tests/bench growth`` says so of processor time, and
``tests/checks/test_large_files.py`` of the work done.
"""

from __future__ import annotations

from collections.abc import Callable

ROOM = """\
type shelf{n} = {{low{n}, middle{n}, high{n}}}

static distance{n}(a: cell): int = {{1: {n}, 2: 4, 3: 9, 4: 2}}

fluent at{n}: cell = 1
fluent load{n}(s: shelf{n}): 0..9 = 0
fluent door{n}: bool = false
fluent asked{n}(s: shelf{n}) = s in {{low{n}, high{n}}}

define full{n} := forall s: shelf{n}. load{n}(s) > 6
define busy{n} := door{n} and exists s: shelf{n}. asked{n}(s)
define ready{n} := busy{n} and not full{last}

action open{n}:
    poss not door{n} and at{n} = 1
    causes door{n} := true

action shut{n}:
    poss door{n}
    causes door{n} := false

action move{n}(to: cell):
    poss door{n} and abs(to - at{n}) = 1
    causes at{n} := to
    cost distance{n}(to)

action put{n}(s: shelf{n}):
    poss load{n}(s) < 9 and asked{n}(s)
    causes load{n}(s) := load{n}(s) + 1
    causes asked{n}(s) := false

exog ask{n}(s: shelf{n}) from operator:
    poss not asked{n}(s)
    causes asked{n}(s) := true

proc go{n}(to: cell):
    while at{n} != to:
        if at{n} < to:
            move{n}(at{n} + 1)
        else:
            move{n}(at{n} - 1)

proc serve{n}:
    if not door{n}:
        open{n}
    choose:
        go{n}(4)
    or:
        pick s: shelf{n} where asked{n}(s):
            put{n}(s)
    if full{n} and at{n} = 1:
        shut{n}
    {after}
"""


def building(lines: int) -> str:
    """About so many lines: rooms with shelves to fill, each like the others but for its names; one serves the next."""
    count = max(1, (lines - 12) // ROOM.count("\n"))
    rooms = [
        ROOM.format(n=n, last=max(0, n - 1), after=f"serve{n + 1}" if n + 1 < count else "skip") for n in range(count)
    ]
    handlers = [f"        on busy{n}:\n            serve{n}\n" for n in range(0, count, 10)]
    goal = " and ".join([f"ready{n}" for n in range(count)])
    return "\n".join(
        [
            "domain building\n\ntype cell = 1..4\n",
            *rooms,
            f"goal every_room: {goal}\n\nproc control:\n    interrupts:\n{''.join(handlers)}        on true:",
            "            wait\n\nscenario quiet:\n    on ask0(low0) when waiting\n    until door0",
        ]
    )


HEAD = "domain d\n\nfluent f: 0..9 = 0\n\naction a:\n    poss f < 9\n    causes f := f + 1\n\n"


def _lines(form: str, count: int) -> str:
    return "".join([form.format(n=n, m=n + 1, before=n - 1, last=max(0, n - 1)) for n in range(count)])


SHAPES: dict[str, Callable[[int], str]] = {
    "building": building,
    "fluents": lambda n: HEAD + _lines("fluent g{n}: 0..9 = {n} % 10\n", n),
    "changes": lambda n: HEAD + _lines("fluent g{n}: 0..9 = 0\naction b{n}:\n    causes g{n} := g{last} + 0\n", n // 3),
    "one action": lambda n: (
        HEAD
        + _lines("fluent g{n}: 0..9 = 0\n", n // 2)
        + "action b:\n"
        + _lines("    causes g{n} := g{last}\n", n // 2)
    ),
    "one fluent": lambda n: HEAD + "action b(x: 0..9):\n" + _lines("    causes f := {n} % 10 when x = {n}\n", n),
    "free effects": lambda n: HEAD + "action b(x: 0..9):\n" + _lines("    causes f := {n} % 10 when x > {n}\n", n),
    "tests": lambda n: (
        HEAD + _lines("fluent g{n}: 0..9 = 0\n", n // 2) + "proc p:\n" + _lines("    test g{n} = 0\n", n // 2)
    ),
    "functions": lambda n: (
        HEAD
        + "static s0(x: 0..9): int = x\n"
        + _lines("static s{m}(x: 0..9): int = s{n}(x) + s{n}(x)\n", n)
        + f"fluent g: int = s{min(n, 900)}(1)\n"
    ),
    "invariants": lambda n: HEAD + _lines("invariant i{n}: f >= 0 or {n} = 0\n", n),
    "procedures": lambda n: HEAD + _lines("proc p{n}:\n    a\n    p{m}\n\n", n // 4) + f"proc p{n // 4}:\n    a\n",
    "statements": lambda n: HEAD + "proc p:\n" + "    a\n" * n,
    "branches": lambda n: HEAD + "proc p:\n" + _lines("    if f = {n} % 10:\n        a\n", n // 2),
    "choices": lambda n: HEAD + "proc p:\n    choose:\n        a\n" + "    or:\n        a\n" * (n // 2),
    "interrupts": lambda n: (
        HEAD + "proc p:\n    interrupts:\n" + _lines("        on f = {n} % 10:\n            a\n", n // 2)
    ),
    "deep": lambda n: HEAD + _lines("define d{n}(x: 0..9) := " + "not (f = x and " * 5 + "true" + ")" * 5 + "\n", n),
    "long": lambda n: HEAD + "define d := " + "(f = 1 or\n" + "    f = 2 or\n" * n + "    f = 3)\n",
    "sum": lambda n: HEAD + "define d := " + "(f +\n" + "    f +\n" * n + "    f)\n",
    "chain": lambda n: HEAD + "define d0 := f = 1\n" + _lines("define d{m} := not d{n}\n", n) + f"goal g: d{n}\n",
    "doubled": lambda n: (
        HEAD + "define d0 := f = 1\n" + _lines("define d{m} := d{n} and d{n}\n", n) + f"goal g: d{n}\n"
    ),
    "doubled known": lambda n: (
        HEAD + "define d0 := true\n" + _lines("define d{m} := d{n} and d{n}\n", n) + f"goal g: d{n} and f = 1\n"
    ),
    "doubled poss": lambda n: (
        HEAD
        + "define d0 := f = 1\n"
        + _lines("define d{m} := d{n} and d{n}\n", n)
        + f"action b:\n    poss d{n}\n    causes f := 1\n"
    ),
    "doubled statics": lambda n: (
        HEAD
        + "static s0: int = 1\n"
        + _lines("static s{m}: int = s{n} + s{n}\n", n)
        + f"invariant g: s{n} > 0 or f = 1\n"
    ),
    "doubled procedures": lambda n: (
        HEAD
        + "proc p0:\n    a\n"
        + _lines("proc p{m}:\n    p{n}\n    p{n}\n", n // 3)
        + f"proc control:\n    if f = 1:\n        p{n // 3}\n"
    ),
    "consts": lambda n: HEAD + "const c0 = 1\n" + _lines("const c{m} = c{n} + 1\n", n) + f"goal g: f = c{n} - c{n}\n",
    "statics": lambda n: (
        HEAD + "static s0: int = 1\n" + _lines("static s{m}: int = s{n} + 1\n", n) + f"goal g: f < s{n}\n"
    ),
    "types": lambda n: HEAD + "type t0 = {x}\n" + _lines("type t{m} = t0 + {{x{n}}}\n", n) + f"fluent g: t{n} = x\n",
    "symbols": lambda n: (
        HEAD
        + "type t = {"
        + _lines("s{n},\n    ", n)
        + "z}\nfluent g: t = z\naction b(x: t):\n    poss x != g\n    causes g := x\n"
    ),
    "table": lambda n: (
        HEAD
        + f"type t = 1..{n}\nstatic s(x: t): int = {{1: 1"
        + _lines(",\n    {n}: {n}", n + 1).replace(",\n    0: 0,\n    1: 1", "")
        + "}\ngoal g: f < s(1)\n"
    ),
    "unknown names": lambda n: HEAD + _lines("define d{n} := unknown_name_{n} = {n}\n", n),
    "wrong types": lambda n: HEAD + _lines("define d{n} := f = true\n", n),
    "wrong lines": lambda n: HEAD + _lines("define d{n} := f = = {n}\n\n", n // 2),
    "duplicates": lambda n: HEAD + _lines("fluent g: 0..9 = {n} % 10\n", n),
    "unknown calls": lambda n: HEAD + "proc p:\n" + _lines("    do_this_{n}({n})\n", n),
    "scenario": lambda n: HEAD + "proc control:\n    a\n\nscenario s:\n" + _lines("    expect a at most {m}\n", n),
    "scenarios": lambda n: HEAD + "proc control:\n    a\n\n" + _lines("scenario s{n}:\n    until f = 1\n\n", n // 3),
    "axioms": lambda n: (
        HEAD + _lines("fluent g{n} = false\naxiom g{n}:\n    after a := true\n    otherwise unchanged\n", n // 4)
    ),
    "axiom": lambda n: (
        HEAD
        + _lines("action b{n}\n", n // 2)
        + "fluent g = false\naxiom g:\n"
        + _lines("    after b{n} := true\n", n // 2)
        + "    otherwise unchanged\n"
    ),
    "unknown": lambda n: (
        HEAD + _lines("fluent g{n} = unknown\n", n // 2) + _lines("action look{n}:\n    senses g{n}\n", n // 4)
    ),
    "prunes": lambda n: HEAD + _lines("prune p{n}: f = {n}\n", n),
    "device": lambda n: (
        HEAD
        + _lines("action b{n}\n", n // 2)
        + 'device rcx "d.nqc":\n    200 a\n'
        + _lines("    {n} b{n} by call b{n}\n", min(200, n // 2))
    ),
    "host": lambda n: (
        HEAD
        + _lines("action b{n}\n", n // 2)
        + 'device host "d.py":\n    a\n'
        + _lines("    b{n} by call b{n}\n", n // 2)
    ),
    "comments": lambda n: HEAD + "# golc: ignore[GL027]\n" * n,
}
"""A domain of about so many lines with a great deal of one thing."""
