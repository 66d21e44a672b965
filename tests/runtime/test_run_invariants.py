"""``golc run --check-invariants``: a run ends when something has broken an invariant."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from golc.cli import invoke
from golc.diagnostics import Code, ProgramError
from golc.runtime.loop.happenings import End, Ended
from golc.runtime.loop.policy import Policy

DOMAIN = """
domain tank
fluent level: int = 2
fluent open: bool = false
invariant dry: level < 4 and not (open and level = 3)
action fill:
    causes level := level + 1
exog valve:
    causes open := true
proc control:
    fill
    wait
    fill
    fill

device self:
    fill
"""

Start = Callable[..., Any]
Event = Callable[..., Any]


def test_an_event_that_breaks_an_invariant_ends_the_run(start: Start, event: Event) -> None:
    run = start(DOMAIN, [[event("valve")]], policy=Policy(check_invariants=True))
    with pytest.raises(ProgramError) as caught:
        run.run()
    found = caught.value.diagnostic
    assert found.code is Code.INVARIANT_BROKEN
    assert found.message == "invariant `dry` is false after `valve`"
    assert found.span.text == "valve"
    assert [(label.span.text, label.text) for label in found.labels] == [
        ("not (open and level = 3)", "false: open = true, level = 3")
    ]
    assert found.notes == ("the state: level = 3, open = true",)
    assert run.story() == ["fill", "<valve"]
    assert [ended.end for ended in run.only(Ended)] == [End.FAILED]


def test_without_the_option_nothing_is_checked(start: Start, event: Event) -> None:
    run = start(DOMAIN, [[event("valve")]])
    assert run.run().end is End.FINAL
    assert run.value("level") == 5


def test_an_action_that_breaks_an_invariant_ends_the_command_with_5(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "tank.gl"
    file.write_text(DOMAIN.replace("    wait\n", "").lstrip())
    assert invoke(["run", str(file), "--check-invariants"]) == 5
    assert "error[GL120]: invariant `dry` is false after `fill`\n  --> " in capsys.readouterr().err
    assert invoke(["run", str(file)]) == 0
