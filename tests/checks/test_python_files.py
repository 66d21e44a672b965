"""The Python files that a domain names: what ``golc check`` sees in their text, and what it proves with trust."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest

from golc.diagnostics import Code, Severity
from golc.loading import Examined, examine, load

Check: TypeAlias = Callable[..., Examined]

ROBOT = """domain robot
type station = 1..4
fluent at: station = 1
action go(n: station):
    poss {poss}
    causes at := n
extern near(a: station, b: station) from "map.py"
proc control:
    go(2)
"""
NEAR = "def near(a, b):\n    return abs(a - b) == 1\n"


@pytest.fixture
def examined(tmp_path: Path) -> Check:
    """Examines a domain, with its file ``map.py``."""

    def examined(text: str, python: str = NEAR, trust: bool = False) -> Examined:
        (tmp_path / "robot.gl").write_text(text)
        (tmp_path / "map.py").write_text(python)
        return examine(tmp_path / "robot.gl", proofs=True, trust=trust)

    return examined


def test_what_depends_on_a_function_is_decided_with_trust(examined: Check) -> None:
    text = ROBOT.format(poss="near(at, n)") + "invariant inside: at < 5\n"

    found = examined(text, trust=True)

    assert found.findings == ()
    assert found.asked > 0


def test_what_depends_on_a_function_is_not_decided_without_trust(examined: Check) -> None:
    found = examined(ROBOT.format(poss="near(at, n)"), "def near(a, b):\n    raise AssertionError('executed')\n")

    (finding,) = found.findings
    assert (finding.code, finding.severity) == (Code.NOT_DECIDED, Severity.NOTE)
    assert finding.message == "not all that depends on `near` is decided: its file is not executed"
    assert (finding.span.line, finding.span.text) == (7, "near")
    assert finding.help == "`--trust` would decide it: it executes the file"
    assert found.undecided > 1
    assert found.theory is not None


@pytest.mark.parametrize("poss", ["at > 4 and near(at, n)", "n != n and near(n, at)"])
def test_what_does_not_depend_on_it_is_decided_all_the_same(examined: Check, poss: str) -> None:
    codes = [finding.code for finding in examined(ROBOT.format(poss=poss)).findings]

    assert Code.NEVER_POSSIBLE in codes
    assert Code.NOT_DECIDED not in codes


def test_a_static_between_hides_nothing(examined: Check) -> None:
    text = ROBOT.format(poss="far(at, n)") + "static far(a: station, b: station) = not near(a, b)\n"

    assert {finding.code for finding in examined(text).findings} == {Code.NOT_DECIDED}
    assert examined(text, trust=True).findings == ()


def test_an_action_that_python_makes_impossible_is_found(examined: Check) -> None:
    found = examined(ROBOT.format(poss="near(at, n)"), "def near(a, b):\n    return False\n", trust=True)

    assert [finding.code for finding in found.findings][:1] == [Code.NEVER_POSSIBLE]


def test_a_function_that_fails_for_some_arguments_makes_an_action_go_wrong(examined: Check) -> None:
    found = examined(ROBOT.format(poss="near(at, n)"), "def near(a, b):\n    return 1 // (a - 3) < 9\n", trust=True)

    (finding,) = found.findings
    assert finding.code is Code.EFFECT_FAILS
    assert finding.message.startswith("`go` can go wrong: `near(3, 1)` failed at ")
    assert finding.notes == ("for example when at = 3 and `go(1)` is done",)
    assert [(label.span.line, label.span.text) for label in finding.labels] == [(2, "return 1 // (a - 3) < 9")]


LARGE = """domain large
type number = 0..100000
type digit = 0..9
fluent a: number = 0
fluent b: number = 0
fluent c: number = 0
fluent at: digit = 0
extern next(n: digit): digit from "map.py"
action step:
    poss a + b + c < 5 and a + b >= 0
    causes at := next(at) {more}
"""


def test_the_solver_has_a_table_of_the_function(examined: Check) -> None:
    pytest.importorskip("z3")
    python = "def next(n):\n    return (n + 1) % 10\n"

    assert examined(LARGE.format(more="when a * b != c + next(at)"), python, trust=True).findings == ()
    wrong = examined(LARGE.format(more="+ 1 when a * b != c + next(at)"), python, trust=True)
    assert [finding.code for finding in wrong.findings] == [Code.EFFECT_FAILS]
    undecided = examined(LARGE.format(more="+ 1 when a * b != c + next(at)"), python)
    assert {finding.code for finding in undecided.findings} == {Code.NOT_DECIDED}


HOST = """domain robot
fluent seen = false
action look(n: 1..2):
    senses seen
action turn
exog push
device host "map.py"{bindings}
"""


@pytest.mark.parametrize(
    ("bindings", "python", "said"),
    [
        (":\n    look(n: 1..2) by call see\n    turn", "def see(n): return True\ndef turn(): pass\n", []),
        ("", "def look(n): return True\ndef turn(): pass\n", []),
        (":\n    look(n: 1..2) by call see\n    turn", "def turn(): pass", ["see map.py has no function `see`"]),
        (
            ":\n    look\n    turn",
            "def look(): pass\ndef turn(): 1",
            ["look `look` in map.py takes 0 arguments, not 1"],
        ),
        (":\n    look\n    turn", "def look(: pass", ["host map.py is not Python: invalid syntax"]),
        (":\n    look\n    turn", "", ["host cannot read `map.py`: it is empty"]),
    ],
)
def test_the_functions_of_a_device_are_looked_for(
    examined: Check, tmp_path: Path, bindings: str, python: str, said: list[str]
) -> None:
    text = HOST.format(bindings=bindings)

    found = [finding for finding in examined(text, python).findings if finding.code is Code.PYTHON]

    assert [f"{f.span.text} {f.message}".replace(f"{tmp_path}/", "") for f in found] == said
    assert load(tmp_path / "robot.gl").devices, "what is planned needs no device"


def test_constraints_without_a_world_are_one_error(examined: Check) -> None:
    text = "domain robot\nfluent gate = unknown\ninitially gate\ninitially not gate\ninvariant open: gate\n"

    assert [finding.code for finding in examined(text).findings] == [Code.NO_INITIAL_WORLD]


def test_states_that_python_leads_to_are_gone_through_with_trust(examined: Check, tmp_path: Path) -> None:
    text = ROBOT.format(poss="near(at, n)").replace("causes at := n", "causes at := n + 1")
    examined(text, "def near(a, b):\n    return b == 2\n")

    reached = examine(tmp_path / "robot.gl", proofs=True, reachable=True, trust=True)
    assert reached.scope is not None and reached.scope.whole
    assert reached.findings == ()
    unknown = examine(tmp_path / "robot.gl", proofs=True, reachable=True)
    assert unknown.scope is not None and not unknown.scope.whole
    assert {finding.severity for finding in unknown.findings} == {Severity.NOTE}


UNBOUNDED = """domain large
fluent total: int = 0
fluent other: int = 0
extern next(n: int): int from "map.py"
invariant same: total = 0 or total = next(other)
action step:
    causes total := next({what})
"""


@pytest.mark.parametrize("trust", [False, True])
def test_the_solver_takes_a_function_of_integers_for_any(examined: Check, trust: bool) -> None:
    pytest.importorskip("z3")
    python = "def next(n):\n    return n + 1\n"

    assert examined(UNBOUNDED.format(what="other + total - total"), python, trust).findings == ()
    (found,) = examined(UNBOUNDED.format(what="other + total"), python, trust).findings
    # With the function at hand a situation may be found in which the invariant breaks, as it does where other is 1.
    assert found.code in ({Code.NOT_DECIDED, Code.INVARIANT_NOT_KEPT} if trust else {Code.NOT_DECIDED})
