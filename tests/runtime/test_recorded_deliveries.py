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
def test_with_wait_until_every_case_is_reproduced_but_for_the_signals_repeated_after_an_unrelated_event(
    name: str, start: Callable[..., Any], case: Callable[[str], Case]
) -> None:
    recorded = case(name)
    trace = without_repeated_signals(recorded["trace"])

    run, recording = reproduce(start, ROOT / "examples/delivery/delivery.gl", trace)

    assert run.story() == recording.story
    assert fluents(run) == recorded["final_fluents"]


def without_repeated_signals(trace: list[Case]) -> list[Case]:
    """The recording without each `signal_arrival` that repeats the one before, as no button was pushed in between.

    The `wait` of the original ends with any event: a request that came while the robot waited for the button made it
    ring again. `wait until not stop_requested(location)` goes on waiting. (Twice in the case of nine requests.)
    """
    kept: list[Case] = []
    signalled = False
    for entry in trace:
        if entry.get("action") == "signal_arrival":
            if signalled:
                continue
            signalled = True
        elif "action" in entry or "push_go_button" in entry.get("exogenous", ()):
            signalled = False
        kept.append(entry)
    return kept


def test_only_the_case_of_nine_requests_has_repeated_signals(case: Callable[[str], Case]) -> None:
    left_out = {name: len(case(name)["trace"]) - len(without_repeated_signals(case(name)["trace"])) for name in CASES}

    assert left_out == {name: 2 if name == CASES[4] else 0 for name in CASES}
