"""The operator's desk: the lines of one terminal, which are answers when a question is open and reports otherwise.

A line that answers the open question goes there; every other one is left to the exogenous actions, so that an event
can be reported in the middle of a question. Answers that were sent ahead through a pipe wait for their question; what
somebody typed at a terminal before a question was asked does not answer it.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import TypeVar

from golc.diagnostics import DeviceError
from golc.runtime.devices.base import GivenUpError

T = TypeVar("T")


class WrongAnswerError(Exception):
    """A line that is meant as an answer and is none; the text says why."""


class Desk:
    """Asks the operator one question at a time.

    ``tell`` shows a text to them; ``plausible`` says whether a line could be an answer to any question at all.
    """

    def __init__(
        self, tell: Callable[[str], None], interactive: bool, open_: bool, plausible: Callable[[str], bool]
    ) -> None:
        self._tell = tell
        self._interactive = interactive
        self._open = open_
        self._plausible = plausible
        self._lines: deque[str] = deque()
        self._changed = threading.Condition()
        self._asking = False
        self._interrupted = False

    @property
    def is_open(self) -> bool:
        """Whether somebody can still answer, or has answered ahead."""
        return self._open or bool(self._lines)

    def offer(self, line: str, report: bool) -> bool:
        """Take a line if it is (or may be) an answer; ``report`` says whether it is otherwise a report.

        Called by the thread that reads the terminal. False if the line is not for the desk.
        """
        if report:
            return False
        with self._changed:
            if self._asking or (not self._interactive and self._plausible(line)):
                self._lines.append(line)
                self._changed.notify_all()
                return True
        return not line.strip()

    def close(self) -> None:
        """Nobody will answer any more."""
        with self._changed:
            self._open = False
            self._changed.notify_all()

    def interrupt(self) -> None:
        """Give up the question that is open, if one is."""
        with self._changed:
            self._interrupted = self._asking
            self._changed.notify_all()

    def ask(self, question: str, read: Callable[[str], T]) -> T:
        """Ask until ``read`` makes something of a line.

        ``read`` raises ``WrongAnswerError`` for a line that is no answer. Raises ``DeviceError`` if nobody is there,
        ``GivenUpError`` if the question is interrupted.
        """
        self._begin()
        try:
            self._tell(question)
            while True:
                try:
                    return read(self._next().strip())
                except WrongAnswerError as error:
                    self._tell(str(error))
        finally:
            self._asking = False

    def _begin(self) -> None:
        with self._changed:
            self._asking, self._interrupted = True, False
            if self._interactive:
                self._lines.clear()

    def _next(self) -> str:
        with self._changed:
            self._changed.wait_for(lambda: self._lines or self._interrupted or not self._open)
            if self._interrupted:
                raise GivenUpError("the question was given up")
            if not self._lines:
                raise DeviceError(
                    "nobody is there to answer: standard input has ended",
                    help="run golc in a terminal, or write the answers to its standard input",
                )
            return self._lines.popleft()
