"""Questions that a run puts to the operator: what to do about a failure, and whether to go on."""

from __future__ import annotations

import contextlib
from collections.abc import Callable

from golc.diagnostics import DeviceError
from golc.program.labels import Act
from golc.runtime.devices.base import GivenUpError
from golc.runtime.devices.desk import Desk, WrongAnswerError
from golc.runtime.loop.happenings import Remedy

REMEDIES = {
    "retry": Remedy.RETRY,
    "r": Remedy.RETRY,
    "next": Remedy.NEXT,
    "n": Remedy.NEXT,
    "skip": Remedy.NEXT,
    "stop": Remedy.STOP,
    "s": Remedy.STOP,
}
"""What the operator may answer when an action has failed."""

ALL = "all"


def always(remedy: Remedy) -> Callable[[Act, DeviceError], Remedy]:
    """The same answer to every failure; but when trying again is of no use the run stops."""

    def decide(label: Act, error: DeviceError) -> Remedy:
        return Remedy.STOP if error.lasting else remedy

    return decide


class AskAboutFailure:
    """Lets the operator decide about a failed action; without an operator the run stops.

    ``show`` has texts for ``state`` and ``history``.
    """

    def __init__(self, desk: Desk, show: Callable[[str], str]) -> None:
        self._desk = desk
        self._show = show

    def __call__(self, label: Act, error: DeviceError) -> Remedy:
        if error.lasting or not self._desk.is_open:
            return Remedy.STOP
        question = f"{label} has failed: retry, next (take another way) or stop? Also: state, history"
        try:
            return self._desk.ask(question, self._read)
        except GivenUpError:
            return Remedy.RETRY
        except DeviceError:
            return Remedy.STOP

    def _read(self, line: str) -> Remedy:
        word = line.lower()
        if word in ("state", "history"):
            raise WrongAnswerError(self._show(word))
        if word not in REMEDIES:
            raise WrongAnswerError("type retry, next or stop")
        return REMEDIES[word]


class AskBeforeActions:
    """Lets the operator confirm each action, until they have had enough of it."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self._all = False

    def __call__(self, label: Act) -> None:
        if self._all:
            return
        with contextlib.suppress(GivenUpError):
            self._all = self._desk.ask(f"next is {label}: press Enter, or type {ALL} to go on by itself", self._read)

    def _read(self, line: str) -> bool:
        if line.lower() not in ("", ALL):
            raise WrongAnswerError(f"press Enter, or type {ALL}; !stop ends the run")
        return line != ""
