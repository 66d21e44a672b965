"""Single constructs of programs, and all executions of a program."""

from __future__ import annotations

from golc.diagnostics import Findings, Source
from golc.planning.limits import Limits
from golc.planning.planner import Executable, Planning, executable
from golc.syntax.parse import parse_file
from golc.theory.elaborate import elaborate
from golc.theory.theory import BasicActionTheory
from tests.bench.measure import Row, Unit, seconds

HEAD = """domain bench
type number = 1..100
fluent x: int = 0
action inc:
    causes x := x + 1
action take(n: number):
    causes x := x + 1
proc control:
"""
SEQUENCE = "    test x = 0\n" * 20_000
LOOP = "    while x = 0:\n        test x = 0\n"
INTERRUPTS = (
    "    interrupts:\n"
    + "".join(f"        on x = -{number}:\n            inc\n" for number in range(1, 6))
    + "        on x >= 0:\n            inc\n"
)
PICK = "    while true:\n        pick n: number where n = 100:\n            take(n)\n"

LIFT = """domain lift
type floor = 0..10
fluent at: floor = 4
fluent on(n: floor) = n in {1, 2, 3, 5, 6, 7}
action up(n: floor):
    poss at < n
    causes at := n
action down(n: floor):
    poss at > n
    causes at := n
action open
action close
action turnoff(n: floor):
    poss on(n)
    causes on(n) := false
proc control:
    while exists n: floor. on(n):
        pick n: floor:
            test on(n)
            choose:
                test at = n
            or:
                up(n)
            or:
                down(n)
            turnoff(n)
            open
            close
    down(0)
    open
"""


def theory_of(text: str) -> BasicActionTheory:
    """The theory that a text declares."""
    findings, source = Findings(), Source("bench.gl", text)
    file = parse_file(source, findings)
    theory = None if file is None else elaborate(file, source, findings)
    assert theory is not None, findings.diagnostics
    return theory


def ready(text: str) -> Executable:
    """The program of a text, compiled."""
    return executable(theory_of(text), "control")


def rate(body: str, steps: int) -> float:
    """Decisions a second over so many steps."""
    made = ready(HEAD + body)
    machine, node, state = made.machine, made.node, made.dynamics.initial()

    def decide() -> None:
        nonlocal node, state
        for _ in range(steps):
            transition = machine.decide(node, state)
            assert transition is not None
            state, node = machine.successor(state, transition.label), transition.residual

    return steps / seconds(decide)


def all_executions() -> float:
    """Seconds to list every distinct execution of the lift with six calls."""
    made = ready(LIFT)

    def plan() -> None:
        assert sum(1 for _ in Planning(made, Limits(), all_plans=True)) == 720

    return seconds(plan)


ROWS = [
    Row("sequence", "20,000 tests in sequence", 1e6, Unit.RATE, lambda: rate(SEQUENCE, 20_000)),
    Row("while", "while x = 0: test x = 0", 5e5, Unit.RATE, lambda: rate(LOOP, 50_000)),
    Row("interrupts", "six interrupts, the last fires", 4e5, Unit.RATE, lambda: rate(INTERRUPTS, 20_000)),
    Row("pick", "pick over 100, the last matches", 5e4, Unit.RATE, lambda: rate(PICK, 10_000)),
    Row("lift", "all executions of the lift with 6 calls: 720", 0.1, Unit.SECONDS, all_executions),
]
