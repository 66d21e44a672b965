"""What the line reaches: the control programs of every brick that a theory declares, and the firmware beside them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from golc.runtime.rcxsim.frames import SET_MESSAGE, message_in
from golc.runtime.rcxsim.line import Air
from golc.runtime.rcxsim.theory import firmware
from golc.runtime.rcxsim.trace import Trace

REACTION = 0.03
"""From the end of a request to the start of its answer, scaled like air time: some fifteen op codes of 2 ms."""


class Program(Protocol):
    """A program on a brick: hears messages, keeps an eye on the clock, and answers with messages."""

    def hear(self, message: int, now: float) -> Sequence[int]:
        """Take a message; the messages that answer it at once."""

    def tick(self, now: float) -> Sequence[int]:
        """Do what is due at ``now``; the messages to send."""

    def due(self) -> float | None:
        """When ``tick`` is wanted next."""

    def reset(self, now: float) -> None:
        """The brick has been switched off."""


class Programs:
    """Every program hears everything; each has its own range of messages."""

    def __init__(self, programs: Sequence[Program], trace: Trace) -> None:
        self._programs = programs
        self._trace = trace
        self._now = 0.0
        self._on = True

    def hear(self, payload: bytes, now: float, air: Air) -> None:
        value = message_in(payload)
        if value is None:
            answer = firmware.reply(payload)
            self._trace.tell(now, "request", payload=payload.hex(" "), answered=answer is not None)
            if answer is not None:
                air.send(answer, now, REACTION)
            return
        for program in self._programs:
            self._send(program.hear(value, now), now, air)

    def run(self, until: float, air: Air) -> None:
        while (due := self.due()) is not None and due <= until:
            self._now = max(self._now, due)  # what was held up is due in the past
            for program in self._programs:
                if program.due() == due:
                    self._send(program.tick(self._now), self._now, air)
        self._now = max(self._now, until)

    def due(self) -> float | None:
        if not self._on:
            return None
        return min([due for program in self._programs if (due := program.due()) is not None], default=None)

    def switch(self, on: bool, now: float) -> None:
        self._on = on
        self._trace.tell(now, "switched", on=on)
        if not on:
            for program in self._programs:
                program.reset(now)

    def _send(self, messages: Sequence[int], now: float, air: Air) -> None:
        for value in messages:
            air.send(bytes((SET_MESSAGE, value)), now, REACTION)
