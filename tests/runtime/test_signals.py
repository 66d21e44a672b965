"""Signals: the first one ends a run, and none keeps a device from being told to stop."""

from __future__ import annotations

import signal
from collections.abc import Callable
from typing import Any

import pytest

from golc.runtime.loop.happenings import End, Ended
from golc.runtime.signals import Interrupted, ending_on_signals

Start = Callable[..., Any]

NAMES = ["SIGINT", "SIGTERM", "SIGHUP"]


@pytest.mark.parametrize("name", NAMES)
def test_the_first_signal_ends_what_runs_and_the_next_does_nothing(name: str) -> None:
    def end_twice() -> None:
        try:
            signal.raise_signal(getattr(signal, name))
        finally:
            signal.raise_signal(getattr(signal, name))

    before = signal.getsignal(getattr(signal, name))
    with ending_on_signals(), pytest.raises(Interrupted, match=f"interrupted by {name}"):
        end_twice()
    assert signal.getsignal(getattr(signal, name)) is before


@pytest.mark.parametrize("name", NAMES)
def test_a_signal_at_the_end_of_a_run_keeps_nothing_from_being_done(start: Start, name: str) -> None:
    run = start("domain d\naction a\nproc control:\n    a\n")

    def abort() -> None:
        signal.raise_signal(getattr(signal, name))
        run.device.told.append("aborted")

    run.device.abort = abort
    with ending_on_signals():
        assert run.run().end is End.FINAL

    assert run.device.told == ["open", "a", "aborted", "close"]
    assert [ended.unstopped for ended in run.only(Ended)] == [()]


def test_a_signal_that_was_ignored_stays_so() -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with ending_on_signals():
            signal.raise_signal(signal.SIGHUP)
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)
