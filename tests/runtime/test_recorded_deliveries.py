"""The delivery robot does exactly what it was recorded to do."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from golc.diagnostics import Findings, Source, Span
from golc.loading import load
from golc.runtime.loop.happenings import End
from golc.runtime.loop.inbox import Report
from golc.theory.ground import read_exogenous
from golc.theory.theory import BasicActionTheory

ROOT = Path(__file__).parent.parent.parent
CASES = [
    "delivery-01-initial",
    "delivery-02-request-mid-move",
    "delivery-03-lost-and-recovered",
    "delivery-04-request-then-cancel",
    "delivery-05-nine-requests",
]
Case = dict[str, Any]


class Recording:
    """The world of a recorded case: which events come right after which action, and which at which wait."""

    def __init__(self, theory: BasicActionTheory, trace: list[Case]) -> None:
        self.theory = theory
        self.batches: list[list[Report]] = []
        self.immediate: list[list[Report]] = []
        self.story: list[str] = []
        for entry in trace:
            if "exogenous" not in entry:
                self.immediate.append([])
                self.story.append(entry.get("action", "reposition_robot"))
                continue
            reports = [self._report(text) for text in entry["exogenous"]]
            self.story.extend(f"<{text.replace(',', ', ')}" for text in entry["exogenous"])
            if entry["when"] == "immediate":
                self.immediate[-1].extend(reports)
            else:
                self.batches.append(reports)

    def _report(self, text: str) -> Report:
        findings = Findings()
        call = read_exogenous(self.theory, Span(Source("case", text), 0, len(text)), findings)
        assert call is not None, findings.diagnostics
        return Report(call.action, call.args, "test")


def reproduce(start: Callable[..., Any], path: Path, trace: list[Case]) -> tuple[Any, Recording]:
    theory = load(path)
    recording = Recording(theory, trace)
    immediate = iter(recording.immediate)

    def perform(action: str, args: object) -> tuple[()]:
        run.inbox.items.extend(next(immediate))
        return ()

    run = start(theory, recording.batches, perform)
    assert run.run().end is End.IDLE
    return run, recording


def fluents(run: Any) -> dict[str, object]:
    """The state as the recordings write it: 0 for nothing and false."""
    state = run.executive.dynamics.show(run.executive.state)
    return {name: value or 0 for name, value in state.items()}


@pytest.mark.parametrize("name", CASES)
def test_with_wait_every_case_is_reproduced_step_by_step(
    name: str, start: Callable[..., Any], case: Callable[[str], Case]
) -> None:
    recorded = case(name)

    run, recording = reproduce(start, ROOT / "tests/programs/delivery_wait.gl", recorded["trace"])

    assert run.story() == recording.story
    actions = [line for line in run.story() if not line.startswith("<") and line != "reposition_robot"]
    assert actions == recorded["actions"]
    assert fluents(run) == recorded["final_fluents"]


@pytest.mark.parametrize("name", CASES)
def test_the_example_as_it_is_shipped_reproduces_every_case_step_by_step(
    name: str, start: Callable[..., Any], case: Callable[[str], Case]
) -> None:
    recorded = case(name)

    run, recording = reproduce(start, ROOT / "examples/delivery/delivery.gl", recorded["trace"])

    assert run.story() == recording.story
    actions = [line for line in run.story() if not line.startswith("<") and line != "reposition_robot"]
    assert actions == recorded["actions"]
    assert fluents(run) == recorded["final_fluents"]


def test_a_button_that_is_pushed_while_the_robot_still_signals_is_not_waited_for(
    start: Callable[..., Any], delivery: BasicActionTheory
) -> None:
    answers = {"start_to_next_station": "arrive_at_station", "signal_arrival": "push_go_button"}

    def perform(action: str, args: object) -> tuple[()]:
        if action in answers:
            run.inbox.items.append(Report(answers[action], (), "test"))
        return ()

    run = start(delivery, [], perform)
    assert run.run().end is End.IDLE

    assert run.story().count("signal_arrival") == 2
    assert fluents(run)["location"] == 1
