"""Sending and receiving messages: one buffer for what is heard, one transmitter."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Protocol

from golc.runtime.rcxsim.frames import BYTE_SECONDS, SET_MESSAGE, packet
from golc.runtime.rcxsim.machine.options import WhileSending


class Radio(Protocol):
    """What carries the brick's packets away."""

    def send(self, payload: bytes, now: int) -> int:
        """Begin to send a packet; the time at which it is through."""


class Alone:
    """Nobody is there to hear the brick; sending takes its time all the same."""

    def send(self, payload: bytes, now: int) -> int:
        return now + round(len(packet(payload)) * BYTE_SECONDS * 1e6)


class Messages:
    """``buffer`` is the last message heard, 0 if none. ``lose`` is told of a message that is not sent."""

    def __init__(self, radio: Radio, while_sending: WhileSending, lose: Callable[[str], None]) -> None:
        self.buffer = 0
        self._radio = radio
        self._policy = while_sending
        self._lose = lose
        self._busy_until = 0
        self._waiting: deque[bytes] = deque()

    def send(self, value: int, now: int) -> None:
        """Send a message, if nothing is in the air; the task does not wait for it."""
        self.transmit(bytes((SET_MESSAGE, value & 0xFF)), now)

    def transmit(self, payload: bytes, now: int) -> None:
        """Send a packet."""
        self.catch_up(now)
        if now >= self._busy_until:
            self._busy_until = self._radio.send(payload, now)
        elif self._policy is WhileSending.DROP:
            self._lose(f"message {payload[-1]}: another one is in the air")
        else:
            if self._policy is WhileSending.REPLACE and self._waiting:
                self._lose(f"message {self._waiting.popleft()[-1]}: another one takes its place")
            self._waiting.append(payload)

    def catch_up(self, now: int) -> None:
        """Send what has waited, if the packet before is through."""
        if self._waiting and self._busy_until <= now:
            self._busy_until = self._radio.send(self._waiting.popleft(), now)

    def occupied(self, until: int) -> None:
        """The transmitter is busy with an answer to a request."""
        self._busy_until = max(self._busy_until, until)

    def forget(self) -> None:
        """The brick was switched off."""
        self._waiting.clear()
        self.buffer = 0
